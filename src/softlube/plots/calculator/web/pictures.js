// What the four pictures show of a contact, in numbers and in words.
import { Chart } from "./charts.js";
import { axisUnit, engineering, shown, typeset } from "./format.js";
import { general } from "./python.js";
import { centreLine } from "./profiles.js";
import { speedsBetween, stribeck } from "./stribeck.js";

const element = (id) => document.getElementById(id);
const EXPONENTS = [-6, -5, -4, -3, -2, -1, 0, 1];

export class Pictures {
  constructor(calculator) {
    this.calculator = calculator;
    const { prefixes } = calculator;
    this.view = { x: [-1, 1], film: [0, 1], pressure: [0, 1], lambda: [], films: [] };
    // What is drawn, for the words beside the pointer: values of quantities in SI.
    this.curve = { speeds: [] };
    this.line = { x: [] };
    const si = (value, unit) => typeset(shown(prefixes, value, unit, 3));
    const speedAt = (k) => si(this.curve.speeds[k], "m/s");
    const placeAt = (k) => `x = ${si(this.line.x[k], "m")}`;
    const speed = { log: true, prefixes, unit: "m/s", room: 64, label: "speed" };
    const place = { label: "x", range: () => this.view.x };
    const beyond = { dash: [2, 4] };
    const point = { ink: "accent", point: true };
    this.friction = new Chart(element("friction-chart"), {
      x: speed,
      y: { log: true, prefixes, unit: "", room: 26, label: "friction coefficient F/N" },
      series: [{ ink: "friction" }, { ink: "friction", ...beyond }, point],
      shade: () => this.view.lambda,
      tell: (k) => `${speedAt(k)}: ${typeset(general(this.curve.friction[k], 3))}`,
    });
    this.film = new Chart(element("film-chart"), {
      x: speed,
      y: { log: true, prefixes, unit: "m", room: 26, label: "film thickness" },
      series: [
        { ink: "film" },
        { ink: "film", ...beyond },
        { ink: "thinnest", dash: [9, 5] },
        { ink: "thinnest", ...beyond },
        point,
        point,
      ],
      shade: () => this.view.films,
      tell: (k) => `${speedAt(k)}: ${si(this.curve.center[k], "m")}, minimum ${si(this.curve.minimum[k], "m")}`,
    });
    this.gap = new Chart(element("gap-chart"), {
      x: place,
      y: { label: "film", range: () => this.view.film },
      series: [{ ink: "film" }],
      spline: true,
      tell: (k) => `${placeAt(k)}: ${si(this.line.film[k], "m")}`,
    });
    this.pressure = new Chart(element("pressure-chart"), {
      x: place,
      y: { label: "pressure", range: () => this.view.pressure },
      series: [{ ink: "ink-soft", dash: [6, 5], width: 1.5 }, { ink: "pressure" }],
      spline: true,
      tell: (k) => `${placeAt(k)}: ${si(this.line.pressure[k], "Pa")}`,
    });
  }

  redraw() {
    for (const chart of [this.friction, this.film, this.gap, this.pressure]) chart.redraw();
  }

  draw(contact) {
    this.drawStribeck(contact);
    this.drawProfiles(contact);
  }

  text(quantity) {
    const [value, , unit] = engineering(this.calculator.prefixes, quantity);
    return typeset(`${value} ${unit}`.trim());
  }

  // --- Stribeck curves ------------------------------------------------------------------------------------------------

  drawStribeck(contact) {
    const body = element("stribeck-table");
    if (!contact) {
      this.view.lambda = this.view.films = [];
      this.friction.draw([[], [], [], []], "No curve: the input is refused.");
      this.film.draw([[], [], [], [], [], [], []], "No curve: the input is refused.");
      body.replaceChildren();
      return;
    }
    const { inputs, dimensional } = contact;
    const [slowest, fastest] = this.calculator.inputs.speed.slider;
    const curve = stribeck(this.calculator, contact, speedsBetween(slowest, fastest, inputs.speed));
    const { speeds } = curve;
    this.curve = curve;
    element("friction-beyond").hidden = element("film-beyond").hidden = curve.inside.every(Boolean);
    const here = (values) => values.map((each, k) => (speeds[k] === inputs.speed ? each : null));
    // A point next to the table's end belongs to both parts, so that they join.
    const near = (k, wanted) => [k - 1, k, k + 1].some((each) => curve.inside[each] === wanted);
    const within = (values) => values.map((each, k) => (curve.inside[k] ? each : null));
    const beyond = (values) => values.map((each, k) => (!curve.inside[k] || near(k, false) ? each : null));
    const { friction, center, minimum } = curve;
    this.shadeByRoughness(inputs.roughness, curve);
    const lowest = friction.indexOf(Math.min(...friction));
    const operating = `at ${typeset(shown(this.calculator.prefixes, inputs.speed, "m/s", 3))}`;
    this.friction.draw(
      [speeds, within(friction), beyond(friction), here(friction)],
      `Friction coefficient against speed, both logarithmic: ${typeset(general(friction[0], 2))} at the slowest, lowest ` +
        `${typeset(general(friction[lowest], 2))}, ${typeset(general(friction[friction.length - 1], 2))} at the fastest speed; ` +
        `${typeset(general(dimensional.friction_coefficient.value, 3))} ${operating}, which is marked.`,
    );
    this.film.draw(
      [speeds, within(center), beyond(center), within(minimum), beyond(minimum), here(center), here(minimum)],
      `Film against speed, both logarithmic: it grows with the speed. ${operating}, which is marked, ` +
        `${this.text(dimensional.film_center)} at the centre and ${this.text(dimensional.film_min)} at the thinnest place.`,
    );
    const table = stribeck(this.calculator, contact, EXPONENTS.map((exponent) => 10 ** exponent));
    body.replaceChildren(
      ...table.speeds.map((speed, k) => {
        const row = document.createElement("tr");
        const lengths = [speed, table.center[k], table.minimum[k]].map((value, j) =>
          shown(this.calculator.prefixes, value, j ? "m" : "m/s", 3),
        );
        for (const text of [...lengths, general(table.friction[k], 3)]) {
          const cell = document.createElement("td");
          cell.textContent = typeset(text);
          row.append(cell);
        }
        return row;
      }),
    );
  }

  /** Grey where asperities touch: below λ = 3 a little, below 1 more. */
  shadeByRoughness(roughness, { speeds, minimum }) {
    this.view.lambda = this.view.films = [];
    element("lambda-key").hidden = roughness === null;
    if (roughness === null) return;
    const { full, mixed } = this.calculator.lambda;
    const levels = [full, mixed].map((ratio) => ratio * roughness);
    this.view.films = levels.map((to) => ({ axis: "y", from: 0, to, ink: "touching" }));
    this.view.lambda = levels.map((level) => {
      const first = minimum.findIndex((each) => each >= level);
      return { axis: "x", from: 0, to: first < 0 ? Infinity : speeds[first], ink: "touching" };
    });
  }

  // --- the centre line ------------------------------------------------------------------------------------------------

  drawProfiles(contact) {
    const line = contact && centreLine(this.calculator, contact);
    element("profiles-missing").hidden = !contact || Boolean(line);
    if (!line) {
      this.gap.draw([[], []], "No profile.");
      this.pressure.draw([[], [], []], "No profile.");
      return;
    }
    const { prefixes } = this.calculator;
    this.line = line;
    // A sphere that floats has its pressure far about, a Hertz contact within its radius.
    const end = Math.min((5 - 3.3 * (line.radius / line.span) ** 2) * line.span, line.x[line.x.length - 1]);
    const highest = Math.max(...line.pressure);
    const lowest = Math.min(...line.pressure);
    const thickest = 3 * contact.dimensional.film_center.value;
    const [byX, unitX] = axisUnit(prefixes, end, "m");
    const [byFilm, unitFilm] = axisUnit(prefixes, thickest, "m");
    const [byPressure, unitPressure] = axisUnit(prefixes, highest, "Pa");
    const pressed = contact.quantities.height.value < 0;
    const top = Math.min(pressed ? Math.max(highest, ...line.hertz) : highest, 1.6 * highest);
    element("hertz-key").hidden = !pressed;
    this.view = {
      ...this.view,
      x: [-end * byX, end * byX],
      film: [0, thickest * byFilm],
      pressure: [1.1 * Math.min(lowest, 0) * byPressure, 1.12 * top * byPressure],
    };
    const x = line.x.map((each) => each * byX);
    this.gap.label(`x [${unitX}], inlet on the right`, `film [${unitFilm}]`);
    this.pressure.label(`x [${unitX}], inlet on the right`, `pressure [${unitPressure}]`);
    this.gap.draw(
      [x, line.film.map((each) => each * byFilm)],
      `Film along the centre line: ${this.text(contact.dimensional.film_center)} at the centre, ` +
        `${this.text(contact.dimensional.film_inlet)} at the inlet edge of the contact, ` +
        `${this.text(contact.dimensional.film_outlet_min)} at the thinnest place on the outlet side.`,
    );
    this.pressure.draw(
      [x, line.hertz.map((each) => (pressed ? each * byPressure : null)), line.pressure.map((each) => each * byPressure)],
      `Pressure along the centre line: at most ${this.text(contact.dimensional.pressure_max)}, ` +
        `${this.text(contact.dimensional.pressure_center)} at the centre` +
        `${pressed ? "; Hertz's pressure in the dry contact is drawn for comparison" : ""}.`,
    );
  }
}
