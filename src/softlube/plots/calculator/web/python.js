// What Python does and JavaScript has not: repr of a text, format of a number, one line of a message, near misses of a word.

/** A refusal: an input that is missing, contradictory or impossible, in the words of softlube's InputError. */
export class InputError extends Error {
  constructor(message) {
    super(oneLine(message));
  }
}

const LONGEST = 300;
const HIDDEN = /[\p{C}\p{Z}]/u;

function escaped(character) {
  if (character === " " || !HIDDEN.test(character)) return character;
  const code = character.codePointAt(0);
  const named = { 9: "\\t", 10: "\\n", 13: "\\r" }[code];
  if (named) return named;
  if (code < 0x100) return `\\x${code.toString(16).padStart(2, "0")}`;
  return code < 0x10000 ? `\\u${code.toString(16).padStart(4, "0")}` : `\\U${code.toString(16).padStart(8, "0")}`;
}

/** A message as softlube.errors.one_line makes it: no control characters, the middle cut out if it is long. */
function oneLine(text) {
  const line = [...[...text].map(escaped).join("")];
  const half = (LONGEST - 3) >> 1;
  return line.length <= LONGEST ? line.join("") : `${line.slice(0, half).join("")} … ${line.slice(-half).join("")}`;
}

/** repr of a text. */
export function repr(text) {
  const quote = text.includes("'") && !text.includes('"') ? '"' : "'";
  const inside = [...text].map((each) => (each === "\\" || each === quote ? `\\${each}` : escaped(each))).join("");
  return quote + inside + quote;
}

/** format(value, ".Ng"): N significant digits, an exponent where it is shorter, no zeros at the end. */
export function general(value, digits = 6) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "nan" : value > 0 ? "inf" : "-inf";
  if (value === 0) return Object.is(value, -0) ? "-0" : "0";
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  const exponent = Number(power);
  if (exponent < -4 || exponent >= digits) return `${bare(mantissa)}e${exponent < 0 ? "-" : "+"}${pad(exponent)}`;
  return bare(value.toFixed(digits - 1 - exponent));
}

/** format(value, ".Ne"). */
export function scientific(value, digits) {
  const [mantissa, power] = value.toExponential(digits).split("e");
  return `${mantissa}e${Number(power) < 0 ? "-" : "+"}${pad(Number(power))}`;
}

const bare = (text) => (text.includes(".") ? text.replace(/\.?0+$/, "") : text);
const pad = (exponent) => String(Math.abs(exponent)).padStart(2, "0");

/** str.format for a template with names, such as "{ratio:.2g} times". */
export function filled(template, values) {
  return template.replace(/\{(\w+)(?::(?:\.(\d+))?g)?\}/g, (_, name, digits) => {
    const value = values[name];
    return typeof value === "number" ? general(value, digits ? Number(digits) : 6) : String(value);
  });
}

/** difflib.get_close_matches: up to n words that are like one, best first. */
export function closeMatches(word, words, n, cutoff) {
  const scored = words.map((each) => [similarity([...each], [...word]), each]).filter(([score]) => score >= cutoff);
  scored.sort(([one, a], [two, b]) => two - one || (a < b ? 1 : a > b ? -1 : 0));
  return scored.slice(0, n).map(([, each]) => each);
}

/** difflib.SequenceMatcher(a, b).ratio(): twice the length of the matching blocks over both lengths. */
function similarity(a, b) {
  return a.length + b.length ? (2 * matching(a, b)) / (a.length + b.length) : 1;
}

function matching(a, b) {
  let best = [0, 0, 0];
  for (let i = 0; i < a.length; i++)
    for (let j = 0; j < b.length; j++) {
      let size = 0;
      while (i + size < a.length && j + size < b.length && a[i + size] === b[j + size]) size++;
      if (size > best[2]) best = [i, j, size];
    }
  const [i, j, size] = best;
  if (!size) return 0;
  return size + matching(a.slice(0, i), b.slice(0, j)) + matching(a.slice(i + size), b.slice(j + size));
}
