// Film and pressure along the centre line, as softlube.theory.centre_line interpolates them.

/** The profiles of a contact in SI, or null where its β is outside the table. */
export function centreLine(calculator, contact) {
  const { nodes, step, wider: growth, layer, reach, intervals, tables } = calculator.lines;
  const at = Math.log10(contact.betaLoad);
  if (!(nodes[0] <= at && at <= nodes[nodes.length - 1])) return null;
  const { film, pressure } = tables[contact.cavitation];
  const after = nodes.findIndex((node) => node >= at);
  const first = Math.min(Math.max(after - 2, 0), nodes.length - 4);
  const weights = cubicWeights(nodes.slice(first, first + 4), at);
  const mixed = (table, k) => step * weights.reduce((sum, weight, j) => sum + weight * table[first + j][k], 0);

  // In the units of the load's Hertz contact, whatever is prescribed: δ = |h₀| (β_load/β)^(1/2).
  const rescale = Math.sqrt(contact.betaLoad / contact.beta);
  const center = contact.quantities.film_center.value / rescale;
  const wider = 1 + growth * center;
  const width = (layer[0] + contact.betaLoad) ** layer[1];
  const end = reach[0] + reach[1] * (1 - 1 / wider);
  const [before, behind] = [Math.asinh(1 / width), Math.asinh((end - 1) / width)];
  const radius = contact.units.length * Math.sqrt(rescale);
  const half = Array.from({ length: intervals }, (_, k) => {
    const xi = (k + 1) / intervals;
    return radius * Math.sqrt(wider) * (1 + width * Math.sinh((before + behind) * xi - before));
  });
  const x = [...half.map((each) => -each).reverse(), 0, ...half];
  const [thick, high] = [contact.dimensional.film_center.value, contact.dimensional.pressure_max.value];
  return {
    x,
    film: x.map((_, k) => thick * Math.exp(mixed(film, k))),
    pressure: x.map((_, k) => high * mixed(pressure, k)),
    hertz: x.map((each) => calculator.bounds.hertz_pressure * contact.units.pressure * hertz(each / radius, rescale)),
    radius,
    span: radius * Math.sqrt(wider),
  };
}

/** Hertz's pressure over the unit of pressure and 2/π², at a place over the contact radius. */
const hertz = (place, rescale) => Math.sqrt(rescale) * Math.sqrt(Math.max(1 - place ** 2, 0));

/** Lagrange's weights of the values at some nodes for a place. */
function cubicWeights(nodes, at) {
  return nodes.map((node, k) =>
    nodes.reduce((product, other, j) => (j === k ? product : (product * (at - other)) / (node - other)), 1),
  );
}
