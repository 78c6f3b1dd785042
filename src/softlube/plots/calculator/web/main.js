// The page: fields and sliders in, numbers and pictures out.
import "uplot/dist/uPlot.min.css";
import { Pictures } from "./pictures.js";
import { Calculator, printed } from "./contact.js";
import { centreLine } from "./profiles.js";
import { engineering, rounded, shown, typeset } from "./format.js";
import { InputError, general } from "./python.js";
import { command, fromFragment, python, toFragment } from "./state.js";

const PER_DECADE = 100;
const QUIET = 700;
const HEADLINE = ["film_center", "film_min", "friction_coefficient", "pressure_max"];
const PAIRS = [
  ["young_modulus", "shear_modulus"],
  ["load", "indentation"],
];

const element = (id) => document.getElementById(id);
const calculator = new Calculator(JSON.parse(element("softlube-data").textContent));
const known = Object.keys(calculator.inputs);
const fields = [...document.querySelectorAll("[data-field]")];
const pictures = new Pictures(calculator);
let given = {};
let quiet;

/** The input that a field stands for: of two that exclude each other, the one chosen. */
const nameOf = (field) => element(`${field.dataset.field}-choice`)?.value ?? field.dataset.field;

function refusalOf(name) {
  try {
    calculator.read(name, given[name]);
  } catch (error) {
    if (error instanceof InputError) return error.message.slice(name.length + 2);
    throw error;
  }
  return "";
}

/** Fields, sliders and messages as what is given says; the field that is being typed in stays. */
function showFields(typed) {
  for (const field of fields) {
    const name = nameOf(field);
    const text = given[name] ?? "";
    if (field !== typed && field.value !== text) field.value = text || calculator.inputs[name].choices[0] || "";
    const missing = !text.trim() && (calculator.inputs[name].required || PAIRS.flat().includes(name));
    const refusal = missing ? `missing; expected ${calculator.inputs[name].expected}` : refusalOf(name);
    mark(field, refusal);
    const slider = element(`${field.id}-slider`);
    if (slider) showSlider(slider, name, text, refusal);
  }
}

/** Mark a field as wrong, with the reason; as right without one. */
function mark(field, refusal) {
  const message = element(`${field.id}-message`);
  field.setAttribute("aria-invalid", String(Boolean(refusal)));
  if (message) message.textContent = refusal;
}

/** Mark the field that a refusal of the whole contact names, unless something is wrong with it already. */
function markNamed(refusal) {
  const [, name, reason] = /^(\w+): (.*)$/s.exec(refusal) ?? [];
  const field = fields.find((each) => nameOf(each) === name);
  if (field?.getAttribute("aria-invalid") === "false") mark(field, reason);
}

function showSlider(slider, name, text, refusal) {
  const [low, high] = calculator.inputs[name].slider.map((end) => Math.round(Math.log10(end) * PER_DECADE));
  Object.assign(slider, { min: low, max: high });
  if (refusal) return;
  const value = Math.abs(calculator.read(name, text)) || 10 ** (low / PER_DECADE);
  if (slider !== document.activeElement || slider.dataset.moved !== "yes") slider.value = Math.log10(value) * PER_DECADE;
  slider.setAttribute("aria-valuetext", text);
}

function setResult(id, [value, error, unit]) {
  const row = element(id);
  row.querySelector(".value").textContent = typeset(value);
  row.querySelector(".error").textContent = error ? `± ${typeset(error)}` : "";
  row.querySelector(".unit").textContent = typeset(unit);
}

function resultOf(contact, { name, place, dimension }) {
  const quantity = contact.dimensional[name];
  if (quantity) return engineering(calculator.prefixes, quantity);
  const { value, error } = contact.quantities[name] ?? {};
  return place && dimension === "angle" ? [...rounded(value, error), "°"] : ["–", "", ""];
}

const rows = [...calculator.quantities, ...calculator.derived].filter(({ name }) => element(`row-${name}`));

function showNumbers(contact) {
  for (const row of rows) {
    const result = contact ? resultOf(contact, row) : ["–", "", ""];
    setResult(`row-${row.name}`, result);
    element(`row-${row.name}`).hidden = Boolean(contact) && !(row.name in contact.dimensional) && !(row.name in contact.quantities);
    if (HEADLINE.includes(row.name)) setResult(`card-${row.name}`, result);
  }
  element("summary").textContent = contact ? summary(contact) : "Refused: see the field above.";
  element("thickening").textContent = contact ? thickening(contact) : "";
  element("beta").textContent = contact
    ? `${contact.byLoad ? "β (by the load)" : "β"} = ${typeset(general(contact.beta, 5))}`
    : "";
  const list = element("doubts");
  list.replaceChildren(
    ...(contact?.warnings ?? []).map((doubt) => {
      const item = document.createElement("li");
      item.textContent = `${doubt}.`;
      return item;
    }),
  );
  list.hidden = !list.children.length;
  element("regime").textContent = contact ? regime(contact) : "";
}

/** The headline in a line, for the foot of a telephone's screen while the sliders are in view. */
function summary(contact) {
  const texts = HEADLINE.map((name) => {
    const { value, unit } = contact.dimensional[name];
    return typeset(shown(calculator.prefixes, value, unit, 3));
  });
  return `u ${texts[0]} · min ${texts[1]} · F/N ${texts[2]} · p ${texts[3]}`;
}

/** The regime of lubrication, in words. */
function regime(contact) {
  const { words, elastic } = calculator.regimes;
  const lifted = contact.quantities.height.value >= 0;
  const [name, sentence] = words[lifted ? 0 : contact.betaLoad < elastic ? 1 : 2];
  const share = contact.quantities.film_center.value / Math.abs(contact.quantities.height.value);
  const thin = lifted ? "" : ` The film at the centre is ${typeset(general(100 * share, 2))} % of the indentation.`;
  const ratio = contact.dimensional.lambda_ratio?.value;
  const rough = ratio === undefined ? "" : ` λ = ${typeset(general(ratio, 2))}: ${calculator.lubrication(ratio)} lubrication.`;
  const [first, last] = calculator.curve.ends(contact.cavitation, contact.byLoad);
  const outside = contact.beta < first || contact.beta > last;
  const beyond = outside ? " This β is beyond the solved table: the values follow from limiting laws, with wider errors." : "";
  return `${name[0].toUpperCase()}${name.slice(1)}. ${sentence}${thin}${rough}${beyond}`;
}

/** How much a liquid that thickens under pressure would thicken here: the page's liquid does not. */
function thickening(contact) {
  const { coefficient, example, worth } = calculator.thickening;
  const rise = Math.exp(coefficient * contact.dimensional.pressure_max.value);
  if (rise < worth) return "";
  const times = rise > 100 ? "more than a hundred times" : `${typeset(general(rise, 2))} times`;
  return (
    "The viscosity is taken as constant. At the maximum pressure that of an oil with a pressure-viscosity coefficient of " +
    `${typeset(example)} is ${times} as high; the command and Python take such a coefficient.`
  );
}

/** Tell a screen reader something, after a while; what was to be told before is not told any more. */
function say(what, delay) {
  clearTimeout(quiet);
  quiet = setTimeout(() => (element("announcement").textContent = what()), delay);
}

/** Tell the result once the input rests. */
function announce(contact, refusal) {
  say(() => {
    const said = HEADLINE.map((name) => {
      const row = rows.find((each) => each.name === name);
      const [value, , unit] = contact ? resultOf(contact, row) : ["", "", ""];
      return `${row.words} ${typeset(value)} ${unit}`.trim();
    });
    return contact ? `${said.join(", ")}.` : `Refused. ${refusal}`;
  }, QUIET);
}

function update(typed) {
  let contact = null;
  let refusal = "";
  try {
    contact = calculator.contact(given);
  } catch (error) {
    if (!(error instanceof InputError)) throw error;
    refusal = error.message;
  }
  showFields(typed);
  markNamed(refusal);
  element("refusal").hidden = !refusal;
  element("refusal").textContent = refusal;
  document.body.classList.toggle("refused", !contact);
  showNumbers(contact);
  pictures.draw(contact);
  for (const button of document.querySelectorAll("[data-copy]")) button.disabled = !contact;
  element("command").textContent = contact ? command(given) : "";
  element("python").textContent = contact ? python(given) : "";
  element("link").textContent = contact ? location.href.replace(/#.*$/s, "") + toFragment(given) : "";
  if (contact) history.replaceState(null, "", toFragment(given));
  announce(contact, refusal);
  return contact;
}

/** Of two inputs that exclude each other the other one is given from now on, with the value that leaves the contact as it is. */
function choose(pair, chosen) {
  const left = pair.find((name) => name !== chosen);
  let value = null;
  try {
    const contact = calculator.contact(given);
    const { poisson_ratio: ratio, shear_modulus: shear } = contact.inputs;
    const moduli = { shear_modulus: shear, young_modulus: 2 * (1 + ratio) * shear };
    value = moduli[chosen] ?? contact.dimensional[chosen].value;
  } catch (error) {
    if (!(error instanceof InputError)) throw error;
  }
  delete given[left];
  given[chosen] = value > 0 ? shown(calculator.prefixes, value, calculator.inputs[chosen].unit, 6) : "";
}

function start(fragment, quietly = false) {
  const said = fromFragment(fragment, known);
  given = Object.keys(said).length ? said : { ...calculator.first };
  for (const pair of PAIRS) {
    const chosen = pair.find((name) => name in given) ?? pair[0];
    element(`${pair[0]}-choice`).value = chosen;
  }
  const contact = update();
  if (contact && quietly) clearTimeout(quiet);
}

for (const field of fields) {
  field.addEventListener("input", () => {
    given[nameOf(field)] = field.value;
    update(field);
  });
  const slider = element(`${field.id}-slider`);
  slider?.addEventListener("input", () => {
    const name = nameOf(field);
    slider.dataset.moved = "yes";
    given[name] = shown(calculator.prefixes, 10 ** (slider.value / PER_DECADE), calculator.inputs[name].unit, 3);
    update();
    slider.dataset.moved = "no";
  });
}
for (const pair of PAIRS) {
  const choice = element(`${pair[0]}-choice`);
  choice.addEventListener("change", () => {
    choose(pair, choice.value);
    update();
  });
}

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = Object.assign(document.createElement("textarea"), { value: text, readOnly: true, className: "unseen" });
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
}

for (const button of document.querySelectorAll("[data-copy]")) {
  button.addEventListener("click", async () => {
    await copy(element(button.dataset.copy).textContent);
    button.focus();
    const words = button.textContent;
    if (words === "Copied") return;
    button.textContent = "Copied";
    say(() => `Copied: ${button.dataset.copy}.`, 0);
    setTimeout(() => (button.textContent = words), 1500);
  });
}

new IntersectionObserver(([{ isIntersecting, boundingClientRect }]) => {
  element("summary").classList.toggle("needed", !isIntersecting && boundingClientRect.top > 0);
}).observe(document.querySelector(".cards"));

element("reset").addEventListener("click", () => start(""));
addEventListener("hashchange", () => start(location.hash));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => pictures.redraw());
start(location.hash, true);

// For tests, and for whoever wants the numbers in the browser's console.
window.softlube = { calculator, contact: (texts) => calculator.contact(texts), printed, centreLine };
