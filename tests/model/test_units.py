"""Texts with units: each is read right or refused, and none is scaled in silence."""

import re
from contextlib import suppress
from fractions import Fraction
from math import isclose

import pint
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from softlube.errors import InputError
from softlube.model.units import names, read_number, read_quantity, unit_factor

FAST, THOROUGH = settings(max_examples=300, deadline=None), settings(max_examples=5000, deadline=None)

UNITS = {
    "m": [("mm", "1/1000"), ("µm", "1/1000000"), ("μm", "1/1000000"), ("um", "1/1000000"), ("nm", "1/1000000000"), ("m", "1"),
          ("cm", "1/100"), ("in", "254/10000"), ("inches", "254/10000"), ("micrometre", "1/1000000"), ("Å", "1/10000000000")],
    "m/s": [("mm/s", "1/1000"), ("mm s^-1", "1/1000"), ("mm s-1", "1/1000"), ("mm·s⁻¹", "1/1000"), ("mm / s", "1/1000"),
            ("um/s", "1/1000000"), ("cm/min", "1/6000"), ("m s**-1", "1"), ("m.s-1", "1"), ("m/h", "1/3600")],
    "N": [("mN", "1/1000"), ("N", "1"), ("kgf", "980665/100000"), ("µN", "1/1000000"), ("kg m/s^2", "1"), ("newtons", "1")],
    "Pa": [("MPa", "1000000"), ("GPa", "1000000000"), ("N/mm2", "1000000"), ("N/mm²", "1000000"), ("N/mm^2", "1000000"),
           ("N mm-2", "1000000"), ("bar", "100000"), ("kPa", "1000"), ("kg/(m s2)", "1"), ("kg/m/s^2", "1"), ("mPa", "1/1000")],
    "Pa s": [("Pa s", "1"), ("mPas", "1/1000"), ("mPa.s", "1/1000"), ("mPa·s", "1/1000"), ("mPa s", "1/1000"), ("cP", "1/1000"),
             ("Pa*s", "1"), ("Pas", "1"), ("poise", "1/10"), ("N s/m2", "1"), ("kg/(m·s)", "1")],
    "1/Pa": [("GPa-1", "1/1000000000"), ("GPa^-1", "1/1000000000"), ("1/GPa", "1/1000000000"), ("/GPa", "1/1000000000"),
             ("GPa⁻¹", "1/1000000000"), ("GPa**-1", "1/1000000000"), ("m2/N", "1"), ("1 / MPa", "1/1000000")],
    "kg/m^3": [("kg/m3", "1"), ("kg/m³", "1"), ("g/cm^3", "1000"), ("g/mL", "1000"), ("kg m^-3", "1"), ("g/cm³", "1000")],
    "s": [("s", "1"), ("ms", "1/1000"), ("min", "60"), ("h", "3600"), ("µs", "1/1000000"), ("seconds", "1")],
}  # fmt: skip
"""Spellings that are read, with their factors to SI."""
WRONG = ["", "Mm", "MM", "mpa", "Gpa", "GPA", "Kg", "mmm", "parrot", "µ", "°", "%", "m m", "kg/m s", "Pa-s", "mm 3", "mm # x",
         "mm,", "mm.", "mm^9^9", "mm**9**9", "mm^0.5", "N/mm 2", "/", "1", "mm;", "(mm)", "mm mm", "½ mm", "minch", "kmm",
         "m^12"]  # fmt: skip
"""No unit of anything here, or none that means one thing."""

WHOLE, PART = st.from_regex(r"[0-9]{1,7}", fullmatch=True), st.from_regex(r"[0-9]{1,6}", fullmatch=True)
SIGN = st.sampled_from(["", "", "+", "-", "−"])
SPACE = st.sampled_from([" ", " ", "", "  ", "\u00a0", "\u202f", "\t"])


def grouped(whole: str, mark: str) -> str:
    """A whole number with signs between thousands."""
    return re.sub(r"(?<=[0-9])(?=([0-9]{3})+$)", mark, whole)


@st.composite
def numbers(draw):
    """A number as someone may write it, its value, and whether it means one thing only."""
    sign, whole, part, power = draw(SIGN), draw(WHOLE), draw(PART), draw(st.integers(-12, 12))
    value = Fraction(f"{whole}.{part}") * (-1 if sign in ("-", "−") else 1)
    style = draw(st.integers(0, 15))
    other = draw(WHOLE)
    if style == 0:
        return sign + whole, Fraction(sign.replace("−", "-") + whole), True
    if style <= 3:
        exponent = draw(st.sampled_from([f"e{power}", f"E{power:+}", f"e{power}".replace("-", "−")]))
        return f"{sign}{whole}.{part}{exponent}", value * Fraction(10) ** power, True
    if style <= 6:
        # A comma before three digits may part thousands.
        clear = len(part) != 3 or len(whole) > 3 or whole.startswith("0")
        return f"{sign}{whole},{part}", value, clear
    if style == 7:
        return f"{sign}.{part}", Fraction(f"0.{part}") * (-1 if sign in ("-", "−") else 1), True
    if style == 8:
        return f"{sign}{whole}.{part}", value, True
    mark = draw(st.sampled_from([",", ".", " ", "'", "_", "\u202f", "’"]))
    between = draw(st.sampled_from(["–", "-", " - ", "...", " to ", "±", "+-", " +/- ", "/", " ", "*", "x", "**", "^", ";"]))
    times = draw(st.sampled_from(["x10^", "·10^", "*10**", " 10^"]))
    decimal = "," if mark == "." else "."
    return draw(
        st.sampled_from(
            [
                sign + grouped("1" + whole + "000", mark) + decimal + part,
                f"{whole}{between}{other}",
                f"{whole}({other})",
                f"{whole}.{part}{times}{power}",
                f"{whole}.{part}.{other}",
                f"{whole},{part},{other}",
                f"{whole}² ",
                f"9**9**{whole}",
                f"--{whole}",
                f"~{whole}",
                f"0x{whole}",
                f"{whole},",
                draw(st.sampled_from(["inf", "nan", "", "½", "1/2", "two", "٣", "３"])),
            ]
        )
    ), None, False  # fmt: skip


@st.composite
def texts(draw):
    """A text, the unit that is wanted, and its value there; None where it must be refused."""
    number, value, clear = draw(numbers())
    wanted = draw(st.sampled_from([*UNITS]))
    if draw(st.integers(0, 5)) == 0:
        return number + draw(SPACE) + draw(st.sampled_from(WRONG)), wanted, None
    kind = draw(st.sampled_from([wanted, wanted, wanted, *UNITS]))
    spelling, factor = draw(st.sampled_from(UNITS[kind]))
    gap = draw(SPACE)
    if spelling[0] == "1" and not gap:
        gap = " "
    if not number and spelling[0] == "1":  # "1/GPa" has its number
        number, value, clear = "1", Fraction(1), True
        spelling = spelling[1:]
    if not clear or kind != wanted:
        return number + gap + spelling, wanted, None
    return number + gap + spelling, wanted, value * Fraction(factor)


def check(case):
    text, wanted, value = case
    if value is None:
        with pytest.raises(InputError):
            read_quantity(text, wanted)
    else:
        assert isclose(read_quantity(text, wanted), value, rel_tol=1e-15, abs_tol=0.0), text


@given(texts())
@FAST
def test_read_right_or_refused(case):
    check(case)


@pytest.mark.slow
@given(texts())
@THOROUGH
def test_five_thousand_are_read_right_or_refused(case):
    check(case)


MANGLED = st.text(alphabet="0123456789.,-+eE ^*/()±#µμ²³⁻¹'_·mMPasNkGgunci\u00a0–", max_size=8)
REGISTRY = pint.UnitRegistry()


def by_pint(text, wanted):
    """Value by pint of a text that was read; its number is a plain one and its unit is spelled for pint."""
    match = re.match(r"([+-]?[0-9]*[.,]?[0-9]*(?:[eE][+-]?[0-9]+)?)(.*)", re.sub(r"\s+", " ", text.strip()).replace("–", "-"))
    unit = match[2].strip().translate(str.maketrans("⁻¹²³·.", "-123**"))
    unit = re.sub(r"(?<=[A-Za-zµμ])(?:\^|\*\*)?\(?(-?[1-9])\)?", r"**(\1)", unit).replace("Pas", "Pa*s")
    return (
        REGISTRY.Quantity(f"{float(match[1].replace(',', '.'))!r} * ({'1' * unit.startswith('/')}{unit})").to(wanted).magnitude
    )


def check_mangled(case):
    (number, unit, wanted), cut, insert = case
    text = number + unit
    cut = min(cut, len(text))
    text = text[:cut] + insert + text[cut:]
    try:
        value = read_quantity(text, wanted)
    except InputError:
        return
    assert isclose(value, by_pint(text, wanted), rel_tol=1e-12), text


WHOLES = st.tuples(
    st.sampled_from(["2", "2.5", "1,5 ", "-30 ", "1e-3 ", "120 ", "0.02 "]),
    st.sampled_from(["mm", "um", "µm", "mm "]),
    st.just("m"),
) | st.tuples(st.sampled_from(["2", "2.5 ", "20 "]), st.sampled_from(["GPa^-1", "1/GPa", "GPa-1"]), st.just("1/Pa"))


@given(st.tuples(WHOLES, st.integers(0, 12), MANGLED))
@example((("2", "1/GPa", "1/Pa"), 1, "E000"))  # no exponent has four digits
@FAST
def test_slips_of_the_pen_are_read_as_pint_reads_the_clean_text_or_refused(case):
    check_mangled(case)


@pytest.mark.slow
@given(st.tuples(WHOLES, st.integers(0, 12), MANGLED))
@THOROUGH
def test_five_thousand_slips_of_the_pen(case):
    check_mangled(case)


@given(st.text(max_size=40))
@example("9**9**9 mm")
@example("(" * 99)
@example("1" * 99 + " mm")
@example("1 " + "m" * 98)
@example("1e999 m")
@FAST
def test_any_text_is_answered(text):
    for read in (lambda: read_quantity(text, "m"), lambda: read_number(text), lambda: unit_factor(text, "m")):
        with suppress(InputError):
            assert isinstance(read(), float)


def test_the_names_of_units_agree_with_pint():
    own = {"kgf": 9.80665, "kp": 9.80665, "gf": 9.80665e-3, "L": 1e-3, "l": 1e-3}
    for name, unit in names().items():
        metre, kilogram, second = unit.powers
        si = f"m**{metre}*kg**{kilogram}*s**{second}"
        ours = 10.0**unit.ten * unit.rest
        if name in own:
            assert isclose(ours, own[name], rel_tol=1e-15)
            continue
        pints = {"hr": "hour", "Pas": "Pa*s"}.get(name, name)
        if name.endswith("Pas"):
            pints = f"{name[:-1]}*s"
        if name.endswith("sec"):
            pints = name.removesuffix("ec")
        if name == "ångström":
            pints = "angstrom"
        pints = pints.replace("gramme", "gram")
        assert isclose(ours, REGISTRY.Quantity(1.0, pints).to(si).magnitude, rel_tol=1e-12), name


@pytest.mark.parametrize(
    ("text", "wanted", "message"),
    [
        ("1.234,5 mm", "m", "without signs between thousands, '1234.5 mm'"),
        ("1,234.5 mm", "m", "without signs between thousands, '1234.5 mm'"),
        ("2 500 um", "m", "'2500 um'"),
        ("1'234 mm", "m", "'1234 mm'"),
        ("1.234.567 mm", "m", "'1234567 mm'"),
        ("-1,234 mm", "m", "the comma may part decimals or thousands; write '-1.234 mm' or '-1234 mm'"),
        ("1,234e3 mm", "m", "write '1.234e3 mm' or '1234e3 mm'"),
        ("2–3 mm", "m", "a range is not taken"),
        ("2 mm to 3 mm", "m", "a range is not taken"),
        ("2±0.1 mm", "m", "a tolerance is not taken"),
        ("2 +/- 0.1 mm", "m", "a tolerance is not taken"),
        ("2 mm 3", "m", "more than one number"),
        ("5 ft 3 in", "m", "more than one number"),
        ("9**9**9 mm", "m", "more than one number"),
        ("2 mm # x", "m", "a comment is not taken"),
        ("2·10⁻³ m", "m", "write the power of ten as in '2e-3 m'"),
        ("10^-3 m", "m", "write the power of ten as in '1e-3 m'"),
        ("2 1/2 mm", "m", "write the fraction as a decimal number"),
        ("2 kg/m s", "Pa s", "what stands under the slash"),
        ("2 Pa-s", "Pa s", "write the product with a space, as in 'Pa s'"),
        ("2 mm/mm mm", "m", "what stands under the slash"),
        ("2 mm mm", "m", "a unit stands there twice"),
        ("~2 mm", "m", "does not begin with a number"),
        ("inf mm", "m", "expected a finite number"),
        ("1e999 mm", "m", "too large"),
        ("1e-320 mm", "m", "too small"),
        ("1" * 101, "m", "a text of 101 characters"),
        ("3 mpa", "Pa", "unknown unit ('mpa'; write 'mPa' or 'MPa')"),
        ("3 Gpa", "Pa", "write 'GPa'"),
        ("3 Mm", "m", "write 'mm'"),
        ("3 Ns", "Pa s", "'N s'"),
        ("3 µ", "m", "a prefix without a unit"),
        ("3 %", "m", "unknown unit ('%')"),
        ("3 °", "m", "unknown unit ('°')"),
        ("100 cSt", "Pa s", "100 cSt has the wrong dimension"),
        ("20 ms-1", "m/s", "has the wrong dimension"),
        ("2", "m", "'2' has no unit"),
    ],
)
def test_what_is_refused_and_what_to_write(text, wanted, message):
    with pytest.raises(InputError, match=re.escape(message)):
        read_quantity(text, wanted)


@pytest.mark.parametrize(("text", "value"), [("0,5", 0.5), (" .5", 0.5), ("5.", 5.0), ("−1e-3", -1e-3), ("1.234", 1.234)])
def test_plain_numbers(text, value):
    assert read_number(text) == value


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("50 %", "write the share as a number, such as 0.5 for 50 %"),
        ("1,234", "write '1.234' or '1234'"),
        ("2 mm", "it takes no unit"),
        ("1_0", "expected one number"),
        ("nan", "expected a finite number"),
        ("1/2", "write the fraction as a decimal number"),
    ],
)
def test_what_is_no_plain_number(text, message):
    with pytest.raises(InputError, match=message):
        read_number(text)


def test_numbers_are_rounded_once():
    assert read_quantity("5.6 mm", "m") == 5.6e-3  # while 5.6 * 1e-3 is not
    assert read_quantity("0,3 um", "m") == 0.3e-6
    assert read_quantity("0 mm", "m") == 0.0


def test_factors_of_units():
    assert unit_factor("mN", "N") == 1e-3
    assert unit_factor("1/GPa", "1/Pa") == 1e-9
    assert unit_factor("km/s", "mm/s") == 1e6
    for text in ("2 mm", "500 um", ".5 mm", "s", "", "mm, m", "e3m"):
        with pytest.raises(InputError):
            unit_factor(text, "m")
