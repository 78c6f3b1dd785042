// A contact in SI, as softlube.Contact has it: inputs in, dimensionless problem, quantities in SI with errors, doubts.
import { InputError, filled, general, repr } from "./python.js";
import { MasterCurve } from "./curve.js";
import { Units } from "./units.js";

const FORCES = ["load", "indentation"];
const MODULI = ["young_modulus", "shear_modulus"];

/** All that the page can compute, from the tables that Python exports. */
export class Calculator {
  constructor(data) {
    Object.assign(this, data);
    this.reader = new Units(data.units);
    this.curve = new MasterCurve(data.curve, data.quantities);
  }

  /** The value in SI of an input's text; null where nothing is given. */
  read(name, text) {
    const input = this.inputs[name];
    const { unit, expected, signed, between } = input;
    if (text === undefined || text.trim() === "") {
      if (input.required) throw new InputError(`${name}: missing; expected ${expected}`);
      return input.default;
    }
    if (input.choices.length) {
      if (!input.choices.includes(text)) throw new InputError(`${name}: expected ${expected}, got ${repr(text)}`);
      return text;
    }
    let number;
    try {
      number = this.reader.read(text, unit);
    } catch (error) {
      if (!(error instanceof InputError)) throw error;
      throw new InputError(`${name}: ${error.message}; expected ${expected}`);
    }
    if (between) {
      const [low, high] = between;
      if (!(low <= number && number <= high)) {
        const range = `${general(low)} and ${general(high)}`;
        throw new InputError(`${name}: expected a number between ${range}, got ${repr(text)}`);
      }
    } else if (number <= 0 && !signed) {
      throw new InputError(`${name}: expected a positive, finite quantity, ${expected}; got ${text}`);
    } else if (number && !(this.bounds.least <= Math.abs(number) && Math.abs(number) <= this.bounds.greatest)) {
      const size = `${general(this.bounds.least)} to ${general(this.bounds.greatest)} ${unit}`.trim();
      throw new InputError(`${name}: expected a magnitude from ${size}; got ${repr(text)}`);
    }
    return number;
  }

  /** Every input in SI, from texts by name; the first that is wrong is refused. */
  inputsOf(given) {
    const values = {};
    const read = (...names) => names.forEach((name) => (values[name] = this.read(name, given[name])));
    read("radius", ...MODULI, "poisson_ratio");
    this.exactlyOne(values, MODULI);
    read("viscosity", "density", "speed");
    this.exactlyOne(Object.fromEntries(FORCES.map((name) => [name, given[name]?.trim() || null])), FORCES);
    read(...FORCES, "roughness", "cavitation");
    values.shear_modulus ??= values.young_modulus / (2 * (1 + values.poisson_ratio));
    return values;
  }

  exactlyOne(values, names) {
    const given = names.filter((name) => values[name] !== null);
    if (given.length === 1) return;
    const verb = given.length ? "are both given" : "are both missing";
    const expected = names.map((name) => this.inputs[name].expected).join(" or ");
    throw new InputError(`${names.join(", ")}: ${verb}; give exactly one, ${expected}`);
  }

  /** The contact of some texts, computed. */
  contact(given) {
    return this.solve(this.inputsOf(given));
  }

  /** The contact of some values in SI: β, quantities, quantities in SI, and doubts. */
  solve(inputs) {
    const { radius, viscosity, speed, load, indentation, cavitation } = inputs;
    const modulus = inputs.shear_modulus / (2 * (1 - inputs.poisson_ratio));
    const byLoad = load !== null;
    const height = byLoad
      ? ((3 * load) / (16 * modulus * Math.sqrt(radius))) ** (2 / 3)
      : Math.abs(indentation) || Math.sqrt((1.5 * radius * viscosity * speed) / (Math.PI * modulus));
    const length = Math.sqrt(radius * height);
    const beta = ((2 / 3) * (height ** 2 / radius) * Math.PI * modulus) / (viscosity * speed);
    const touching = byLoad || indentation > 0;
    if (touching && length > radius) {
      const name = byLoad ? "load" : "indentation";
      throw new InputError(filled(this.words.too_wide, { name, share: length / radius, largest: this.bounds.slope }));
    }
    if (!touching) throw new InputError(this.words.no_gaps);
    const contact = { inputs, byLoad, beta, cavitation, modulus, units: unitsOf(radius, modulus, viscosity, speed, height) };
    contact.quantities = this.quantitiesAt(contact);
    contact.dimensional = this.dimensional(contact);
    contact.warnings = this.doubts(contact);
    contact.betaLoad = byLoad ? beta : beta * (contact.quantities.load.value / this.bounds.hertz_load) ** (4 / 3);
    return contact;
  }

  quantitiesAt({ byLoad, beta, cavitation }) {
    const family = this.curve.family(cavitation, byLoad);
    const exact = byLoad ? { load: this.bounds.hertz_load } : { height: -1 };
    const result = {};
    for (const { name } of this.quantities) {
      if (name in exact) result[name] = { value: exact[name], error: 0 };
      else if (family.has(name)) {
        const [value, error] = family.get(name).at(beta);
        result[name] = { value, error };
      }
    }
    return result;
  }

  dimensional({ inputs, units, quantities }) {
    const result = {};
    for (const { name, dimension, si } of this.quantities) {
      if (name === "height" || !(name in quantities) || !(dimension in units)) continue;
      result[name] = scaled(quantities[name], units[dimension], si);
    }
    if (inputs.load !== null) result.load = { value: inputs.load, error: 0, unit: "N" };
    const { friction_total: friction, load } = result;
    result.indentation = { ...scaled(quantities.height, units.height, "m"), value: -units.height * quantities.height.value };
    result.contact_radius = { value: units.length, error: 0, unit: "m" };
    const value = friction.value / load.value;
    const error = Math.abs(value) * (friction.error / Math.abs(friction.value) + load.error / Math.abs(load.value));
    result.friction_coefficient = { value, error, unit: "" };
    if (inputs.roughness !== null) result.lambda_ratio = scaled(result.film_min, 1 / inputs.roughness, "");
    return result;
  }

  /** "full film", "mixed" or "boundary" for a ratio λ. */
  lubrication(ratio) {
    const { full, mixed, words } = this.lambda;
    return words[ratio >= full ? 0 : ratio >= mixed ? 1 : 2];
  }

  doubts({ inputs, units, dimensional }) {
    const { slope, film_reynolds, traction, newtonian_stress } = this.bounds;
    const value = (name) => dimensional[name].value;
    const doubts = [];
    const doubt = (name, values) => doubts.push(filled(this.words[name], values));
    const gap = Math.max(-value("indentation"), 0);
    const radius = gap > 0 ? Math.sqrt(2 * inputs.radius * gap) : units.length;
    const share = radius / inputs.radius;
    if (share > slope) doubt("wide", { what: gap > 0 ? "pressure reaches" : "contact radius is", share, largest: slope });
    if (inputs.roughness !== null && value("lambda_ratio") < this.lambda.full) {
      const ratio = value("lambda_ratio");
      doubt("rough", { ratio, lubrication: this.lubrication(ratio), full: this.lambda.full });
    }
    if (gap === 0) {
      const shear = Math.abs(value("friction_contact"));
      const [stress, share] = [shear / (Math.PI * radius ** 2), shear / value("load_contact")];
      if (share > traction && stress > newtonian_stress) doubt("limiting_stress", { stress, share, largest: traction });
    }
    const reynolds = (inputs.density * inputs.speed * value("film_center") ** 2) / (inputs.viscosity * radius);
    if (reynolds > film_reynolds) doubt("inertia", { reynolds });
    return doubts;
  }
}

/** What softlube solve --fast --json prints of a contact. */
export function printed({ byLoad, beta, quantities, dimensional, warnings }) {
  return { [byLoad ? "beta_load" : "beta"]: beta, quantities, dimensional, warnings };
}

const scaled = ({ value, error }, factor, unit) => ({ value: factor * value, error: factor * error, unit });

/** SI values of the units of the dimensionless problem, Eqs. (4) and (26). */
function unitsOf(radius, modulus, viscosity, speed, height) {
  const length = Math.sqrt(radius * height);
  const pressure = 4 * Math.PI * modulus * Math.sqrt(height / radius);
  return {
    height,
    length,
    pressure,
    load: pressure * length ** 2,
    friction: ((2 * Math.PI) / 3) * modulus * height ** 2,
    pressure_gradient: pressure / length,
    shear_rate: speed / height,
  };
}
