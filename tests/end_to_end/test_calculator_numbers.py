"""The calculator in a real browser: its numbers are those of `softlube solve --fast`, its refusals those of softlube."""

import json
import random
import re

import pytest

from softlube.cli.main import main
from softlube.errors import InputError
from softlube.model.quantities import STEADY
from softlube.model.summary import engineering
from softlube.model.units import names, read_number, read_quantity
from softlube.physical.contact import Contact
from softlube.plots.calculator.export import exported
from softlube.theory import master_curve
from softlube.theory.centre_line import profiles

AGREEMENT = 1e-10
FIRST = exported()["first"]


def random_inputs(rng):
    """Inputs as someone may write them: any magnitude, several units, both ways of loading."""

    def between(low, high, units):
        unit, factor = rng.choice(units)
        number = f"{10 ** rng.uniform(low, high) / factor:.{rng.randint(1, 6)}g}"
        return f"{number.replace('.', ',') if rng.random() < 0.1 and len(number.partition('.')[2]) != 3 else number} {unit}"

    moduli, pressures = (
        ("young_modulus", "shear_modulus"),
        [("Pa", 1), ("kPa", 1e3), ("MPa", 1e6), ("N/mm²", 1e6), ("bar", 1e5)],
    )
    lengths = [("m", 1), ("mm", 1e-3), ("µm", 1e-6), ("in", 0.0254)]
    given = {
        "radius": between(-5, -1, lengths),
        rng.choice(moduli): between(3, 10, pressures),
        "viscosity": between(-4, 3, [("Pa s", 1), ("mPas", 1e-3), ("cP", 1e-3), ("kg/(m s)", 1)]),
        "speed": between(-7, 1, [("m/s", 1), ("mm/s", 1e-3), ("µm s^-1", 1e-6), ("cm/min", 1 / 6000)]),
    }
    if rng.random() < 0.6:
        given["load"] = between(-6, 2, [("N", 1), ("mN", 1e-3), ("gf", 0.00980665)])
    else:
        given["indentation"] = rng.choice(["", "", "", "", "-"]) + between(-8, -3, lengths)
    for name, text in {
        "poisson_ratio": f"{rng.uniform(0, 0.5):.3f}",
        "roughness": between(-9, -6, [("nm", 1e-9), ("Å", 1e-10)]),
        "density": f"{rng.uniform(500, 2000):.4g} kg/m3",
        "cavitation": rng.choice(["reynolds", "none"]),
    }.items():
        if rng.random() < 0.4:
            given[name] = text
    return given


def by_command(given, capsys):
    """What `softlube solve --fast` says: its JSON, or the line with which it refuses."""
    options = [part for name, text in given.items() for part in (f"--{name.replace('_', '-')}", text)]
    code = main(["solve", *options, "--fast", "--json"])
    said = capsys.readouterr()
    return json.loads(said.out) if code == 0 else said.err.strip()


SPELLED = {
    "m": ["mm", "µm", "um", "μm", "nm", "in", "inches", "micrometre", "Å"],
    "Pa": ["MPa", "N/mm²", "N mm-2", "kg/(m s2)", "kg/m/s^2", "bar", "psi"],
    "Pa s": ["mPa.s", "mPa·s", "cP", "N s/m2", "kg/(m·s)", "Pa*s", "poise"],
    "m/s": ["mm s⁻¹", "mm / s", "m s**-1", "cm/min", "m.s-1", "m/h"],
    "N": ["mN", "kgf", "µN", "kg m/s^2", "newtons", "lbf"],
    "": ["", "%"],
}
"""Units with spellings that are read."""
NUMBERS = [
    "2",
    "2.5",
    "0,25",
    "1,234",
    "1.234,5",
    "1e-3",
    "−4",
    "+7",
    ".5",
    "3.",
    "1e999",
    "0",
    "5-6",
    "1/2",
    "1'000",
    "2±1",
    "1 000",
    "1 1/2",
    "2 x10^-3",
    "3·10⁴",
]
PIECES = [
    "",
    "µ",
    "%",
    "#",
    "±",
    "/",
    ".",
    ",",
    "1e3",
    "½",
    "inf",
    "two",
    "-3",
    "^2",
    "**2",
    "⁻¹",
    "(m",
    "s)",
    "m·s⁻¹",
    "to",
    "…",
    "20%",
    "kg/(m",
    " ",
]
MANGLED = "0123456789.,-+eE ^*/()±#µμ²³⁻¹'\"_·mMPasNkGgunci\u00a0–"
BY_PAGE = """cases => cases.map(given => {
  try { return softlube.printed(softlube.contact(given)); } catch (error) { return error.message; }
})"""


def test_a_hundred_random_inputs_give_the_numbers_of_fast(open_page, capsys):
    rng = random.Random(20)
    cases = [random_inputs(rng) for _ in range(100)]
    results = open_page().evaluate(BY_PAGE, cases)
    worst, solved, warned, outside = 0.0, 0, 0, 0
    for given, ours in zip(cases, results, strict=True):
        theirs = by_command(given, capsys)
        if isinstance(theirs, str):
            assert re.sub("--([a-z-]+)", lambda match: match[1].replace("-", "_"), theirs) == f"softlube: {ours}", given
            continue
        solved += 1
        warned += bool(ours["warnings"])
        assert ours["warnings"] == theirs["warnings"], given
        beta = next(name for name in ("beta", "beta_load") if name in theirs)
        outside += not 1e-4 < theirs[beta] < 1e8
        assert ours[beta] == pytest.approx(theirs[beta], rel=1e-13)
        for part in ("quantities", "dimensional"):
            assert ours[part].keys() == theirs[part].keys()
            for name, quantity in theirs[part].items():
                assert ours[part][name].get("unit") == quantity.get("unit")
                # A number that may vanish is right in units of what it is interpolated with: a radius of 3e-10 in those of 1.
                offset = STEADY[name].offset or abs(STEADY[name].limit or 0.0) if name in STEADY else 0.0
                size = offset * abs(quantity["value"] / (theirs["quantities"][name]["value"] or 1)) if offset else 0.0
                for what in ("value", "error"):
                    miss = abs(ours[part][name][what] - quantity[what])
                    worst = max(worst, miss / ((abs(quantity[what]) + size) or 1))
    assert worst < AGREEMENT
    assert solved > 50
    assert warned > 5
    assert outside > 5


def test_texts_are_read_or_refused_in_the_same_words(open_page):
    rng = random.Random(21)
    texts = [
        (f"{rng.choice(NUMBERS)} {rng.choice([*spellings, *names()])}", unit)
        for unit, spellings in SPELLED.items()
        for _ in range(400)
    ]
    for _ in range(1500):
        pieces = "".join(rng.choices([*PIECES, *names()], k=rng.randint(0, 3)))
        texts.append((rng.choice(NUMBERS) + rng.choice(["", " ", "\t"]) + pieces, rng.choice([*SPELLED])))
        texts.append(("".join(rng.choices(MANGLED, k=rng.randint(1, 9))), rng.choice([*SPELLED])))
    texts += [(f"3 {name}", "m") for name in (*names(), "Mm", "mpa", "milimetre", "pas", "m" * 200, "\x1b[2J mm", "µ", "m m")]
    read = """pairs => pairs.map(([text, unit]) => {
      try { return softlube.calculator.reader.read(text, unit); } catch (error) { return error.message; }
    })"""
    accepted = 0
    for (text, unit), ours in zip(texts, open_page().evaluate(read, texts), strict=True):
        try:
            theirs = read_quantity(text, unit) if unit else read_number(text)
        except InputError as error:
            theirs = str(error)
        accepted += isinstance(theirs, float)
        assert ours == (pytest.approx(theirs, rel=1e-14) if isinstance(theirs, float) else theirs), (text, unit)
    assert accepted > 200


@pytest.mark.parametrize(
    "changes",
    [
        {"radius": ""},
        {"young_modulus": ""},
        {"load": ""},
        {"load": "", "indentation": "0 mm"},
        {"load": "", "indentation": "-1 um"},
        {"radius": "-2 mm"},
        {"viscosity": "1e40 Pa s"},
        {"poisson_ratio": "0.6"},
        {"poisson_ratio": "0.4 mm"},
        {"roughness": "20"},
        {"load": "1 MN"},
        {"cavitation": "some"},
    ],
)
def test_refusals_are_those_of_the_contact(open_page, changes):
    given = {name: text for name, text in (FIRST | changes).items() if text}
    (ours,) = open_page().evaluate(BY_PAGE, [given])
    with pytest.raises(InputError) as refusal:
        master_curve.quantities(Contact(**given).problem())
    assert ours == str(refusal.value)


def test_profiles_are_those_of_the_table(open_page):
    page = open_page()
    for load in ("1e-5 N", "3 mN", "2 N"):
        contact = Contact(**FIRST | {"load": load, "speed": "3 mm/s"})
        line, unit = profiles(contact.problem().beta_load), contact.unit_height
        ours = page.evaluate(
            "given => softlube.centreLine(softlube.calculator, softlube.contact(given))",
            FIRST | {"load": load, "speed": "3 mm/s"},
        )
        assert ours["x"] == pytest.approx(contact.unit_length * line.x, rel=1e-11)
        assert ours["film"] == pytest.approx(unit * line.film, rel=1e-10)
        pressure = contact.scales(unit)["pressure"][0]
        assert ours["pressure"] == pytest.approx(pressure * line.pressure, rel=1e-10, abs=1e-10 * pressure)


def test_the_table_prints_what_the_command_prints(open_page):
    contact = Contact(**FIRST)
    quantities = contact.dimensional(master_curve.quantities(contact.problem()))
    page = open_page()
    for name, quantity in quantities.items():
        value, error, unit = engineering(quantity)
        shown = [page.locator(f"#row-{name} .{part}").inner_text() for part in ("value", "error", "unit")]
        plain = [text.replace("−", "-").replace("± ", "") for text in shown]
        plain = [re.sub(r" × 10⁻(.)", lambda match: f"e-0{'⁰¹²³⁴⁵⁶⁷⁸⁹'.index(match[1])}", text) for text in plain]
        assert plain == [value, error, unit], name
