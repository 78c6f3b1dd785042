// Friction coefficient and film against speed, everything else as it is, as far as the film is thinner than the sphere.

const PER_DECADE = 16;

/** Speeds from one to another, evenly spread in their logarithm, with the operating speed among them. */
export function speedsBetween(low, high, operating) {
  const [first, last] = [Math.min(low, operating), Math.max(high, operating)].map(Math.log10);
  const count = Math.ceil((last - first) * PER_DECADE);
  const even = Array.from({ length: count + 1 }, (_, k) => 10 ** (first + ((last - first) * k) / count));
  return [...even.filter((each) => Math.abs(each / operating - 1) > 1e-9), operating].sort((one, two) => one - two);
}

/** Speeds, friction coefficient, films, and whether the speed is within the table of the master curve and the model's reach. */
export function stribeck(calculator, contact, speeds) {
  const { cavitation, byLoad, units, inputs } = contact;
  const family = calculator.curve.family(cavitation, byLoad);
  const [first, last] = calculator.curve.ends(cavitation, byLoad);
  const result = { speeds: [], friction: [], center: [], minimum: [], inside: [] };
  for (const speed of speeds) {
    const beta = (contact.beta * inputs.speed) / speed;
    const value = (name) => family.get(name).at(beta)[0];
    const center = units.height * value("film_center");
    if (center > inputs.radius && speed !== inputs.speed) continue;
    const gap = byLoad ? Math.max(units.height * value("height"), 0) : 0;
    const flat = Math.sqrt(2 * inputs.radius * gap) <= calculator.bounds.slope * inputs.radius;
    const load = byLoad ? inputs.load : units.load * value("load");
    result.speeds.push(speed);
    result.friction.push((units.friction * value("friction_total")) / load);
    result.center.push(center);
    result.minimum.push(units.height * value("film_min"));
    result.inside.push(flat && first <= beta && beta <= last);
  }
  return result;
}
