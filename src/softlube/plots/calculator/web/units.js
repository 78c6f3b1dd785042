// Texts with units, read as softlube.model.units reads them: one number and one unit, each with one meaning, or a refusal.
// The names of the units come from that module; a test holds every message against Python's.
import { InputError, closeMatches, repr } from "./python.js";

const SPACES = /[\s\x1c-\x1f\x85]+/gu;
const NUMBER = /^([+-]?(?:[0-9]+(?:[.,][0-9]*)?|[.,][0-9]+))(?:[eE]([+-]?[0-9]{1,3}))?/;
const THOUSANDS = /^[+-]?[1-9][0-9]{0,2},[0-9]{3}$/;
const POWER = String.raw`(?:\^|\*\*)?-?[1-9]|(?:\^|\*\*)\(-?[1-9]\)|⁻?[¹²³⁴]`;
const NAME = String.raw`(?:(?![⁰¹²³⁴-⁹½¼¾⅓⅔])[\p{L}\p{Nl}\p{No}])+|[%‰°'"]`;
const FACTOR = `(?:${NAME})(?:${POWER})?`;
const PRODUCT = String.raw`${FACTOR}(?:(?: ?[·⋅*.] ?| )${FACTOR})*`;
const UNIT = new RegExp(String.raw`^(?:${PRODUCT}|1(?= ?/)|)(?: ?/ ?(?:${FACTOR}|\( ?${PRODUCT} ?\)))*$`, "u");
const FACTORS = new RegExp(`(${NAME})(${POWER})?`, "gu");
const SUPERSCRIPTS = Object.fromEntries([..."⁻⁰¹²³⁴⁵⁶⁷⁸⁹"].map((each, k) => [each, "-0123456789"[k]]));
const LETTER = String.raw`(?![\p{Nd}])[\p{L}\p{N}]`;

const plain = (text) => text.replace(/[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (each) => SUPERSCRIPTS[each]);

/** A reader of quantities for the tables of units that Python exports. */
export class Units {
  constructor({ names, prefixes, longest, least, greatest }) {
    Object.assign(this, { names: new Map(Object.entries(names)), prefixes, longest, least, greatest });
  }

  /** The value of a text such as "2 mm" in a unit; without unit if that is empty. */
  read(text, unit) {
    text = this.tidy(text);
    const [digits, exponent, rest] = this.number(text);
    if (!unit) {
      if (!rest) return this.value(text, digits, exponent, 1);
      throw this.unreadable(text, UNIT.test(rest) && !"%‰".includes(rest) ? "it takes no unit" : meant(text));
    }
    if (!rest) throw new InputError(`${repr(text)} has no unit`);
    if (!UNIT.test(rest)) throw this.unreadable(text);
    const [found, target] = [this.unit(text, rest), this.unit(unit, unit)];
    if (found.powers.some((power, k) => power !== target.powers[k])) {
      throw new InputError(`${text} has the wrong dimension`);
    }
    return this.value(text, digits, exponent + found.ten - target.ten, found.rest / target.rest);
  }

  tidy(text) {
    const length = [...text].length;
    if (length > this.longest) {
      throw new InputError(`cannot read a text of ${length} characters: expected one number and one unit`);
    }
    return text.replace(SPACES, " ").trim().replace(/[−–‐‑]/g, "-");
  }

  unreadable(text, reason = meant(text)) {
    return new InputError(`cannot read ${repr(text)}: ${reason}`);
  }

  number(text) {
    const match = NUMBER.exec(text);
    if (!match) throw this.unreadable(text);
    const rest = text.slice(match[0].length).trimStart();
    const digits = match[1];
    if (digits.endsWith(",") || /^[0-9.,'’_]/.test(/^1 ?\//.test(rest) ? rest.slice(1) : rest)) throw this.unreadable(text);
    if (THOUSANDS.test(digits)) {
      const [point, none] = [".", ""].map((mark) => repr(digits.replace(",", mark) + text.slice(digits.length)));
      throw this.unreadable(text, `the comma may part decimals or thousands; write ${point} or ${none}`);
    }
    return [digits.replace(",", "."), Number(match[2] ?? 0), rest];
  }

  value(text, digits, exponent, factor) {
    const value = Number(`${digits}e${exponent}`) * factor;
    const size = Math.abs(value);
    if ((this.least < size && size < this.greatest) || Number(digits) === 0) return value;
    throw this.unreadable(text, `the number is too ${size < 1 ? "small" : "large"}`);
  }

  unit(text, written) {
    const [above, ...below] = written.split("/");
    const factors = [...this.factors(above, 1), ...below.flatMap((part) => this.factors(part, -1))];
    if (new Set(factors.map(([name]) => name)).size < factors.length) throw this.unreadable(text, "a unit stands there twice");
    const result = { ten: 0, rest: 1, powers: [0, 0, 0] };
    for (const [name, power] of factors) {
      const known = this.names.get(name);
      if (!known) throw new InputError(`${repr(text)} has an unknown unit (${repr(name)}${this.nearest(name)})`);
      const [ten, rest, powers] = known;
      result.ten += power * ten;
      result.rest *= rest ** power;
      result.powers = result.powers.map((each, k) => each + power * powers[k]);
    }
    return result;
  }

  factors(product, sign) {
    return [...product.matchAll(FACTORS)].map(([, name, power]) => {
      const digits = plain(power ?? "").replace(/[^-0-9]/g, "");
      return [name, sign * Number(digits || 1)];
    });
  }

  nearest(name) {
    if (this.prefixes.includes(name)) return ", a prefix without a unit";
    const all = [...this.names.keys()];
    let near = all.filter((each) => each.toLowerCase() === name.toLowerCase());
    const characters = [...name];
    const cut = characters.findIndex(
      (_, i) => i > 0 && [characters.slice(0, i), characters.slice(i)].every((part) => this.names.has(part.join(""))),
    );
    if (cut > 0) near.push(`${characters.slice(0, cut).join("")} ${characters.slice(cut).join("")}`);
    if (!near.length) near = closeMatches(name, all, 2, 0.7);
    return near.length ? `; write ${near.map(repr).join(" or ")}` : "";
  }
}

const DIGITS = String.raw`[+-]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)`;
const GROUPS = /^([+-]?)([0-9]{1,3}(?:([., '’_])[0-9]{3})(?:\3[0-9]{3})*)(?:[.,]([0-9]+))?/;
const TIMES_TEN = new RegExp(
  String.raw`^(${DIGITS})? ?[x×*·⋅.]? ?10(?:\^|\*\*)?\(?([-⁻+]?[0-9⁰¹²³⁴⁵⁶⁷⁸⁹]+)\)?(?= ?[^0-9.,]|$)`,
);
const RANGE = new RegExp(String.raw`^${DIGITS} ?(?:${LETTER})* ?(?:-|\.\.+|…|~|to|bis) ?${DIGITS}`, "u");
const PRODUCT_BY_DASH = new RegExp(`${LETTER}-${LETTER}`, "u");
const SECOND_NUMBER = new RegExp(`[ ,;x×*]${DIGITS}`);

/** Why a text is no quantity, with the right spelling where it can be guessed. */
function meant(text) {
  const power = TIMES_TEN.exec(text);
  if (power && /[x×*·⋅^⁻⁰¹²³⁴⁵⁶⁷⁸⁹]/.test(power[0])) {
    const number = (power[1] || "1").replace(/[.,]+$/, "");
    return `write the power of ten as in ${repr(`${number}e${plain(power[2])}${text.slice(power[0].length)}`)}`;
  }
  if (/±|\+ ?\/? ?-|[0-9]\([0-9]+\)/.test(text)) return "a tolerance is not taken; give the value alone";
  if (RANGE.test(text)) return "a range is not taken; give one value";
  if (/^(?:[+-]?[0-9]+ ?\/ ?[0-9]|[+-]?[0-9]+ [0-9]+ ?\/ ?[0-9]|[0-9 ]*[½¼¾⅓⅔])/.test(text)) {
    return "write the fraction as a decimal number, such as 0.5";
  }
  const groups = GROUPS.exec(text);
  const after = groups && text.slice(groups[0].length);
  if (groups && !/^[., '’_]?[0-9.,]/.test(after)) {
    const whole = groups[2].replace(/[^0-9]/g, "");
    return `write it without signs between thousands, ${repr(`${groups[1]}${whole}${groups[4] ? `.${groups[4]}` : ""}${after}`)}`;
  }
  if (/[%‰]$/.test(text)) return "write the share as a number, such as 0.5 for 50 %";
  if (text.includes("#")) return "a comment is not taken";
  if (/^[+-]?(?:inf|nan)/i.test(text)) return "expected a finite number";
  if (!/^[+-]?[.,]?[0-9]/.test(text)) return "it does not begin with a number";
  if (/\/[^/(]*[·⋅*. ]/.test(text.replace(/ ?\/ ?/g, "/")) && !/\/.*[0-9]/.test(text)) {
    return "what stands under the slash? Use brackets, as in 'kg/(m s)'";
  }
  if (PRODUCT_BY_DASH.test(text)) return "write the product with a space, as in 'Pa s'";
  if (SECOND_NUMBER.test(text)) return "there is more than one number";
  return "expected one number and one unit";
}
