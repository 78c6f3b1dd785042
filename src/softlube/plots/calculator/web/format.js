// Numbers as softlube prints them: with the digits that their errors leave, and the SI prefix that suits them.
import { general, scientific } from "./python.js";

const PREFIXED = ["m", "N", "Pa", "Pa/m"];

/** Factor and prefix under which a value stays below 1000. */
function prefixed(prefixes, value) {
  const fits = ([exponent]) => Math.abs(value) * 10 ** -exponent < 1e3 * (1 - 1e-12);
  const [exponent, symbol] = prefixes.find(fits) ?? prefixes[prefixes.length - 1];
  return [10 ** -exponent, symbol];
}

/** Value and error as texts, the value cut at the second significant digit of the error. */
export function rounded(value, error) {
  if (Number.isNaN(value)) return ["none", "-"];
  if (!(Number.isFinite(error) && error > 0)) return [general(value), error === 0 ? "0" : "unknown"];
  const digits = 1 - Math.floor(Math.log10(error));
  const short = general(error, 2);
  if (Math.abs(value) >= 1e6 || digits > 9) {
    const relative = value ? Math.max(0, Math.floor(Math.log10(Math.abs(value))) + digits) : 0;
    return [scientific(value, Math.min(relative, 12)), short];
  }
  return [value.toFixed(Math.max(digits, 0)), short];
}

/** Value, error and unit of a quantity in SI. */
export function engineering(prefixes, { value, error, unit }) {
  if (!PREFIXED.includes(unit) || Number.isNaN(value)) return [...rounded(value, error), unit];
  const [factor, symbol] = prefixed(prefixes, value);
  return [...rounded(value * factor, error * factor), symbol + unit];
}

/** A value as an input is written: "100 mN"; with so many significant digits. */
export function shown(prefixes, value, unit, digits = 10) {
  if (value === 0 || !unit || unit.startsWith("kg")) return `${general(value, digits)} ${unit}`.trim();
  const [factor, symbol] = prefixed(prefixes, Number(value.toPrecision(digits)));
  return `${general(value * factor, digits)} ${symbol}${unit}`;
}

/** Factor and unit, with the prefix that suits a value, for the ticks of an axis. */
export function axisUnit(prefixes, value, unit) {
  const [factor, symbol] = prefixed(prefixes, value);
  return [factor, symbol + unit];
}

/** Typography: minus signs, powers of ten, powers of units. */
export function typeset(text) {
  const raised = (digits) => [...digits].map((each) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(each)]).join("");
  return text
    .replace(/e([+-])0*(\d+)/g, (_, sign, digits) => ` × 10${raised((sign === "-" ? "-" : "") + digits)}`)
    .replace(/\^(-?\d)/g, (_, power) => raised(power))
    .replace(/-(?=\d)/g, "−");
}
