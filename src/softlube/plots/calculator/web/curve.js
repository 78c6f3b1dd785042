// The master curve, as softlube.theory.master_curve evaluates it: cubic splines over ln β, continued beyond both ends.

const decoded = (text) => new Float64Array(Uint8Array.from(atob(text), (each) => each.charCodeAt(0)).buffer);

/** A cubic spline from its values and slopes at the knots. */
class Spline {
  constructor(x, values, slopes) {
    Object.assign(this, { x, values, slopes });
  }

  /** Value and slope at a place between the first and the last knot. */
  at(place) {
    const { x, values, slopes } = this;
    let [low, high] = [0, x.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (x[middle] <= place) low = middle;
      else high = middle;
    }
    const [width, s] = [x[low + 1] - x[low], place - x[low]];
    const chord = (values[low + 1] - values[low]) / width;
    const bend = (slopes[low] + slopes[low + 1] - 2 * chord) / width;
    const [cubic, square, slope] = [bend / width, (chord - slopes[low]) / width - bend, slopes[low]];
    return [values[low] + s * (slope + s * (square + s * cubic)), slope + s * (2 * square + 3 * s * cubic)];
  }
}

/** One quantity as a function of β. */
class Curve {
  constructor(row, law, correction, spline, error) {
    Object.assign(this, { ...row, law, correction, spline, error });
  }

  /** [value, error] at β. */
  at(beta) {
    const { x } = this.spline;
    const place = Math.log(beta);
    const inside = Math.min(Math.max(place, x[0]), x[x.length - 1]);
    let [value] = this.spline.at(inside);
    let error = Math.exp(this.error.at(inside)[0]);
    if (place !== inside) {
      const [continued, doubt] = this.continued(value, place, place - inside);
      [value, error] = [continued, error + doubt];
    }
    if (this.limit !== null) return [value, error];
    const positive = Math.exp(value);
    return [positive - this.offset, error * positive];
  }

  /** The value at a distance beyond the table's ends, and the doubt that this adds. */
  continued(value, place, beyond) {
    const { x } = this.spline;
    const [low, high] = [x[0], x[x.length - 1]];
    if (this.limit !== null) {
      if (beyond < 0) return [value, 0];
      const faded = this.limit + (value - this.limit) * Math.exp((this.exponent ?? this.correction) * beyond);
      return [faded, 0.2 * Math.abs(faded - value)];
    }
    if (beyond < 0) {
      const [slope, before] = [low, low + Math.log(10)].map((each) => this.spline.at(each)[1]);
      return [value + slope * beyond, Math.abs((slope - before) * beyond)];
    }
    const [end, slope] = this.spline.at(high);
    if (!this.law) {
      const power = this.exponent ?? 0;
      return [value + power * beyond, Math.abs((slope - power) * beyond)];
    }
    const lawAt = (each) => Math.log(this.law.reduce((sum, [factor, power]) => sum + factor * Math.exp(each) ** power, 0));
    const off = end - lawAt(high);
    const fading = Math.exp(this.correction * beyond);
    return [lawAt(place) + off * fading, 0.5 * Math.abs(off) * (1 - fading)];
  }
}

/** Every curve, by cavitation, normalisation and name of the quantity. */
export class MasterCurve {
  constructor({ correction, families }, quantities) {
    this.families = {};
    for (const [key, { knots, names, laws, numbers }] of Object.entries(families)) {
      const all = decoded(numbers);
      const piece = (k) => all.subarray(k * knots, (k + 1) * knots);
      this.families[key] = new Map(
        names.map((name, k) => {
          const [value, slope, error, errorSlope] = [1, 2, 3, 4].map((part) => piece(4 * k + part));
          const [spline, ofError] = [new Spline(piece(0), value, slope), new Spline(piece(0), error, errorSlope)];
          const row = quantities.find((each) => each.name === name);
          return [name, new Curve(row, laws[name] ?? null, correction, spline, ofError)];
        }),
      );
    }
  }

  family(cavitation, byLoad) {
    return this.families[`${cavitation} ${byLoad ? "load" : "indentation"}`];
  }

  /** First and last β of the table. */
  ends(cavitation, byLoad) {
    const { x } = this.family(cavitation, byLoad).get("film_center").spline;
    return [Math.exp(x[0]), Math.exp(x[x.length - 1])];
  }
}
