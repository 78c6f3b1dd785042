// What is given, as text: the fragment of the address, a command, a few lines of Python.

/** Texts by name from a fragment such as "#radius=2+mm"; only inputs that are known. */
export function fromFragment(fragment, known) {
  const given = {};
  for (const [name, text] of new URLSearchParams(fragment.replace(/^#/, ""))) if (known.includes(name)) given[name] = text;
  return given;
}

export const toFragment = (given) => `#${new URLSearchParams(entries(given))}`;

const entries = (given) => Object.entries(given).filter(([, text]) => text.trim() !== "");

/** The command that prints these numbers. */
export function command(given) {
  const options = entries(given).map(([name, text]) => `--${name.replaceAll("_", "-")} "${text.trim()}"`);
  return `softlube solve ${options.join(" ")} --fast`;
}

/** Lines of Python that give these numbers, and solve the contact. */
export function python(given) {
  const named = entries(given).map(([name, text]) => `    ${name}=${JSON.stringify(text.trim())},`);
  return [
    "from softlube import Contact, curve",
    "",
    "contact = Contact(",
    ...named,
    ")",
    "quantities = contact.dimensional(curve.quantities(contact.problem()))  # as on the page",
    'print(quantities["film_min"], quantities["friction_coefficient"])',
    "",
    "solution = contact.solve()  # solved anew, with fields",
    'print(solution.dimensional["film_min"], solution.dimensional["friction_coefficient"])',
  ].join("\n");
}
