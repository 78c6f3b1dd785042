// The four pictures, drawn by uPlot: what each shows, in the colours of the page's style sheet.
import uPlot from "uplot";
import { axisUnit, typeset } from "./format.js";
import { general } from "./python.js";

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** A picture in a box: made once, given new data, drawn anew when the box or the colours change. */
export class Chart {
  constructor(box, { x, y, series, spline = false, shade, tell }) {
    this.box = box;
    this.told = box.parentElement.querySelector(".told");
    this.shade = shade ?? (() => []);
    this.xAxis = x;
    this.yAxis = y;
    const stroke = (name) => () => colour(name);
    const axis = (spec, size) => ({
      stroke: stroke("ink-soft"),
      grid: { stroke: stroke("grid"), width: 1 },
      ticks: { stroke: stroke("grid"), width: 1, size: 4 },
      font: "12px system-ui, sans-serif",
      labelFont: "12px system-ui, sans-serif",
      labelSize: 18,
      size,
      label: spec.label,
      ...(spec.log ? logTicks(spec) : { values: (_, splits) => splits.map((each) => typeset(general(each, 6))) }),
    });
    const paths = spline ? uPlot.paths.spline() : uPlot.paths.linear();
    this.plot = new uPlot(
      {
        width: this.width(),
        height: this.height(),
        cursor: { y: false, drag: { x: false, y: false }, points: { size: 7 } },
        legend: { show: false },
        padding: [10, 12, 0, 0],
        scales: {
          x: { time: false, distr: x.log ? 3 : 1, range: (_, low, high) => x.range?.() ?? [low, high] },
          y: { distr: y.log ? 3 : 1, range: (_, low, high) => (y.log ? logRange(low, high) : (y.range?.() ?? [low, high])) },
        },
        axes: [axis(x, 34), axis(y, 60)],
        series: [{}, ...series.map((each) => this.series(each, paths))],
        hooks: {
          drawClear: [(plot) => this.drawShade(plot)],
          setCursor: [({ cursor }) => (this.told.textContent = cursor.idx === null ? "" : tell(cursor.idx))],
        },
      },
      [[], ...series.map(() => [])],
      box,
    );
    new ResizeObserver(() => this.plot.setSize({ width: this.width(), height: this.height() })).observe(box);
  }

  series({ ink, dash, width = 2, point = false }, paths) {
    const stroke = () => colour(ink);
    if (!point) return { stroke, dash, width, paths, pxAlign: 0, points: { show: false } };
    const ring = { show: true, size: 11, width: 2, stroke: () => colour("paper"), fill: stroke };
    return { stroke, width: 0, paths: () => null, points: ring };
  }

  width() {
    return Math.max(this.box.clientWidth, 200);
  }

  height() {
    return this.box.clientHeight;
  }

  /** Draw new data, with what a screen reader says of them. */
  draw(data, description) {
    this.box.setAttribute("aria-label", description);
    this.plot.setData(data);
  }

  /** Axis labels of the next drawing. */
  label(x, y) {
    this.plot.axes[0].label = x;
    this.plot.axes[1].label = y;
  }

  redraw() {
    this.plot.redraw(false, true);
  }

  drawShade(plot) {
    const { ctx, bbox } = plot;
    for (const { axis, from, to, ink } of this.shade()) {
      const [a, b] = [from, to].map((each) => {
        const { min, max } = plot.scales[axis];
        return plot.valToPos(Math.min(Math.max(each, min), max), axis, true);
      });
      ctx.fillStyle = colour(ink);
      if (axis === "x") ctx.fillRect(Math.min(a, b), bbox.top, Math.abs(b - a), bbox.height);
      else ctx.fillRect(bbox.left, Math.min(a, b), bbox.width, Math.abs(b - a));
    }
  }
}

/** Whole decades about some values; at least one. */
function logRange(low, high) {
  if (!(low > 0)) return [1e-3, 1];
  const [first, last] = [Math.floor(Math.log10(low) + 1e-9), Math.ceil(Math.log10(high) - 1e-9)];
  return [10 ** first, 10 ** Math.max(last, first + 1)];
}

/** Ticks at powers of ten, so many that their labels have room. */
function logTicks({ prefixes, unit, room }) {
  return {
    splits: (_, __, low, high) => {
      const [first, last] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
      return Array.from({ length: last - first + 1 }, (_, k) => 10 ** (first + k));
    },
    filter: (_, splits) => splits,
    values: (plot, splits, axis) => {
      const length = axis === 0 ? plot.width - 70 : plot.height - 60;
      const every = Math.ceil((splits.length * room) / length);
      return splits.map((each, k) => (k % every ? "" : power(prefixes, each, unit)));
    },
  };
}

/** A power of ten with its unit, or as a plain number or a power where it has none. */
function power(prefixes, value, unit) {
  const exponent = Math.round(Math.log10(value));
  if (!unit && Math.abs(exponent) <= 3) return general(value);
  if (!unit) return typeset(`1e${exponent < 0 ? "-" : "+"}${Math.abs(exponent)}`).replace("1 × ", "");
  const [factor, name] = axisUnit(prefixes, value, unit);
  return `${general(value * factor, 3)} ${name}`;
}
