"""Text with units, read strictly: one number and one unit, each with one meaning, or a refusal that says what to write.

A number has a point or a comma for the decimals and no signs between thousands.  A unit is a product of names with small
integer powers, and quotients: "mm", "Pa s", "kg/m^3", "GPa^-1", "kg/(m s)".  Only the names of the table below, with
the prefixes that are in use, are units: "Mm" for mm is refused and not read as a million metres.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

from softlube.errors import InputError


class Unit(NamedTuple):
    """A unit: 10^`ten` × `rest` of the coherent SI unit, whose powers of metre, kilogram and second are `powers`.

    The power of ten is apart because a decimal number times it can be read without rounding twice.
    """

    ten: int
    rest: float
    powers: tuple[int, int, int]

    def times(self, other: Unit, power: int) -> Unit:
        """The product with a power of another unit."""
        powers = tuple(one + power * two for one, two in zip(self.powers, other.powers, strict=True))
        return Unit(self.ten + power * other.ten, self.rest * other.rest**power, powers)  # type: ignore[arg-type]


PREFIXES = {
    "p": ("pico", -12),
    "n": ("nano", -9),
    "µ": ("micro", -6),
    "m": ("milli", -3),
    "c": ("centi", -2),
    "d": ("deci", -1),
    "h": ("hecto", 2),
    "k": ("kilo", 3),
    "M": ("mega", 6),
    "G": ("giga", 9),
    "T": ("tera", 12),
}
"""Symbols of prefixes, with their names and exponents."""
MICRO = ("µ", "μ", "u")
"""Spellings of the prefix micro: U+00B5, U+03BC and the letter u."""
POUND, INCH, GRAVITY = 0.45359237, 0.0254, 9.80665
"""Pound [kg], inch [m] and standard acceleration of free fall [m/s²]; exact by definition (NIST Special Publication 811)."""
LENGTH, AREA_RATE, VOLUME, MASS, TIME = (1, 0, 0), (2, 0, -1), (3, 0, 0), (0, 1, 0), (0, 0, 1)
FORCE, PRESSURE, VISCOSITY, ENERGY = (1, 1, -2), (-1, 1, -2), (-1, 1, -1), (2, 1, -2)
NAMES = (
    # symbols, words, prefixes in use, unit
    ("m", "metre meter", "nµmcdk", Unit(0, 1.0, LENGTH)),
    ("Å", "angstrom ångström", "", Unit(-10, 1.0, LENGTH)),
    ("", "micron", "", Unit(-6, 1.0, LENGTH)),
    ("in", "inch", "", Unit(0, INCH, LENGTH)),
    ("ft", "foot", "", Unit(0, 12 * INCH, LENGTH)),
    ("g", "gram gramme", "nµmk", Unit(-3, 1.0, MASS)),
    ("lb", "", "", Unit(0, POUND, MASS)),
    ("s sec", "second", "nµm", Unit(0, 1.0, TIME)),
    ("min", "minute", "", Unit(0, 60.0, TIME)),
    ("h hr", "hour", "", Unit(0, 3600.0, TIME)),
    ("", "day", "", Unit(0, 86400.0, TIME)),
    ("N", "newton", "pnµmckM", Unit(0, 1.0, FORCE)),
    ("dyn", "dyne", "", Unit(-5, 1.0, FORCE)),
    ("kgf kp", "", "", Unit(0, GRAVITY, FORCE)),
    ("gf", "", "", Unit(-3, GRAVITY, FORCE)),
    ("lbf", "", "", Unit(0, POUND * GRAVITY, FORCE)),
    ("Pa", "pascal", "µmhkMGT", Unit(0, 1.0, PRESSURE)),
    ("bar", "bar", "mk", Unit(5, 1.0, PRESSURE)),
    ("atm", "atmosphere", "", Unit(0, 101325.0, PRESSURE)),
    ("psi", "", "k", Unit(0, POUND * GRAVITY / INCH**2, PRESSURE)),
    ("ksi", "", "", Unit(3, POUND * GRAVITY / INCH**2, PRESSURE)),
    ("Pas", "", "µmkMG", Unit(0, 1.0, VISCOSITY)),  # "mPas" is what rheometers print for mPa s
    ("P", "poise", "c", Unit(-1, 1.0, VISCOSITY)),
    ("St", "stokes", "c", Unit(-4, 1.0, AREA_RATE)),
    ("J", "joule", "µmkM", Unit(0, 1.0, ENERGY)),
    ("L l", "litre liter", "µmcd", Unit(-3, 1.0, VOLUME)),
)
"""Units by their symbols and words.  Prefixes that nobody uses at a rig are left out: "Mm" is a slip for mm."""
PLURALS = {"inch": "inches", "foot": "feet", "poise": "poise", "stokes": "stokes", "bar": "bars"}

LONGEST = 100
"""Characters that a quantity may have."""
LEAST, GREATEST = 1e-290, 1e290
"""Magnitudes between which no digit is lost."""

WHOLE = re.compile(r"[+-]?[0-9]{1,9}")
"""A whole number that is no quantity: how many, or a seed."""
THOUSANDS = re.compile(r"[+-]?[1-9][0-9]{0,2},[0-9]{3}")
"""A number whose comma may be a decimal sign or part thousands."""

_DASHES = str.maketrans("−–‐‑", "----")
_NUMBER = re.compile(r"([+-]?(?:[0-9]+(?:[.,][0-9]*)?|[.,][0-9]+))(?:[eE]([+-]?[0-9]{1,3})(?![0-9]))?")
_SUPERSCRIPTS = str.maketrans("⁻¹²³⁴", "-1234")
_POWER = r"(?:\^|\*\*)?-?[1-9]|(?:\^|\*\*)\(-?[1-9]\)|⁻?[¹²³⁴]"
_NAME = r"[^\W\d_⁰¹²³⁴-⁹½¼¾⅓⅔]+|[%‰°'\"]"
_FACTOR = rf"(?:{_NAME})(?:{_POWER})?"
_PRODUCT = rf"{_FACTOR}(?:(?: ?[·⋅*.] ?| ){_FACTOR})*"
_UNIT = re.compile(rf"(?:{_PRODUCT}|1(?= ?/)|)(?: ?/ ?(?:{_FACTOR}|\( ?{_PRODUCT} ?\)))*")


def read_quantity(text: str, unit: str) -> float:
    """The value of a text such as "2 mm" or "20 GPa^-1" in a unit.

    Parameters
    ----------
    text : str
        A number and a unit.
    unit : str
        The unit of the value returned, such as "m" or "Pa s".

    Raises
    ------
    InputError
        If the text is not one number with one unit, or the unit has another dimension; the message says what to write.
    """
    text = _tidy(text)
    digits, exponent, rest = _number(text)
    if not rest:
        raise InputError(f"{text!r} has no unit")
    if not _UNIT.fullmatch(rest):
        raise InputError(f"cannot read {text!r}: {_meant(text)}")
    ten, factor = _factor(text, rest, unit)
    return _value(text, digits, exponent + ten, factor)


def read_number(text: str) -> float:
    """The value of a text such as "0.5" or "0,5", without unit.

    Raises
    ------
    InputError
        If the text is not one number; the message says what to write.
    """
    text = _tidy(text)
    digits, exponent, rest = _number(text)
    if rest:
        reason = "it takes no unit" if _UNIT.fullmatch(rest) and rest not in "%‰" else _meant(text)
        raise InputError(f"cannot read {text!r}: {reason}")
    return _value(text, digits, exponent, 1.0)


def unit_factor(text: str, unit: str) -> float:
    """What a number in one unit is multiplied by to be in another.

    Parameters
    ----------
    text : str
        The unit of the number, such as "mN" or "1/GPa".
    unit : str
        The unit wanted.

    Raises
    ------
    InputError
        If the text is no unit, or one of another dimension.
    """
    text = _tidy(text)
    if not text or not _UNIT.fullmatch(text):
        raise InputError(f"cannot read the unit {text!r}: {_meant(f'1 {text}')}")
    ten, factor = _factor(text, text, unit)
    return _value(text, "1", ten, factor)


def _tidy(text: str) -> str:
    """The text with one kind of dash and single spaces."""
    if len(text) > LONGEST:
        raise InputError(f"cannot read a text of {len(text)} characters: expected one number and one unit")
    return re.sub(r"\s+", " ", text.strip()).translate(_DASHES)


def _number(text: str) -> tuple[str, int, str]:
    """Digits with a decimal point, exponent, and what follows the number."""
    match = _NUMBER.match(text)
    if match is None:
        raise InputError(f"cannot read {text!r}: {_meant(text)}")
    rest = text[match.end() :].lstrip()
    digits = match[1]
    if digits.endswith(",") or re.match(r"[0-9.,'’_]", rest.removeprefix("1" if re.match("1 ?/", rest) else "")):
        raise InputError(f"cannot read {text!r}: {_meant(text)}")
    if THOUSANDS.fullmatch(digits):
        point, none = (f"{digits.replace(',', mark)}{text[match.end(1) :]}" for mark in (".", ""))
        raise InputError(f"cannot read {text!r}: the comma may part decimals or thousands; write {point!r} or {none!r}")
    return digits.replace(",", "."), int(match[2] or 0), rest


def _value(text: str, digits: str, exponent: int, factor: float) -> float:
    value = float(f"{digits}e{exponent}") * factor
    if LEAST < abs(value) < GREATEST or not float(digits):
        return value
    raise InputError(f"cannot read {text!r}: the number is too {'small' if abs(value) < 1 else 'large'}")


def _factor(text: str, written: str, wanted: str) -> tuple[int, float]:
    """Power of ten, and rest, of a unit in another unit."""
    unit, target = _unit(text, written), _unit(wanted, wanted)
    if unit.powers != target.powers:
        raise InputError(f"{text} has the wrong dimension")
    return unit.ten - target.ten, unit.rest / target.rest


def _unit(text: str, written: str) -> Unit:
    above, *below = written.split("/")
    result, factors = Unit(0, 1.0, (0, 0, 0)), [*_factors(above, 1), *(each for part in below for each in _factors(part, -1))]
    if len(dict(factors)) < len(factors):
        raise InputError(f"cannot read {text!r}: a unit stands there twice")
    for name, power in factors:
        known = names().get(name)
        if known is None:
            raise InputError(f"{text!r} has an unknown unit ({name!r}{_nearest(name)})")
        result = result.times(known, power)
    return result


def _factors(product: str, sign: int) -> Iterator[tuple[str, int]]:
    for name, power in re.findall(rf"({_NAME})({_POWER})?", product):
        digits = re.sub(r"[^-0-9]", "", power.translate(_SUPERSCRIPTS))
        yield name, sign * int(digits or 1)


@cache
def names() -> dict[str, Unit]:
    """Every name of a unit, with its prefixes and plurals."""
    found: list[tuple[str, Unit]] = []
    for symbols, words, prefixes, unit in NAMES:
        for prefix in ("", *prefixes):
            long, ten = PREFIXES[prefix] if prefix else ("", 0)
            made = unit._replace(ten=unit.ten + ten)
            short = MICRO if prefix == "µ" else (prefix,)
            found += [(each + symbol, made) for symbol in symbols.split() for each in short]
            found += [(long + word, made) for name in words.split() for word in {name, PLURALS.get(name, f"{name}s")}]
    return dict(found)


def _nearest(name: str) -> str:
    """What may have been meant by an unknown name, for a message."""
    if name in (*PREFIXES, *MICRO):
        return ", a prefix without a unit"
    known = names()
    near = [each for each in known if each.casefold() == name.casefold()]
    near += [f"{name[:i]} {name[i:]}" for i in range(1, len(name)) if {name[:i], name[i:]} <= known.keys()][:1]
    if not near:
        from difflib import get_close_matches

        near = get_close_matches(name, known, n=2, cutoff=0.7)
    return f"; write {' or '.join(map(repr, near))}" if near else ""


# --- what was meant by a text that cannot be read ----------------------------------------------------------------------

_DIGITS = r"[+-]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)"
_GROUPS = re.compile(
    r"(?P<sign>[+-]?)(?P<whole>[0-9]{1,3}(?:(?P<mark>[., '’_])[0-9]{3})(?:(?P=mark)[0-9]{3})*)(?:[.,](?P<part>[0-9]+))?"
)
_TIMES_TEN = re.compile(rf"({_DIGITS})? ?[x×*·⋅.]? ?10(?:\^|\*\*)?\(?([-⁻+]?[0-9⁰¹²³⁴⁵⁶⁷⁸⁹]+)\)?(?= ?[^0-9.,]|$)")


def _meant(text: str) -> str:
    """Why a text is no quantity, with the right spelling where it can be guessed."""
    power = _TIMES_TEN.match(text)
    if power and re.search(r"[x×*·⋅^⁻⁰¹²³⁴⁵⁶⁷⁸⁹]", power[0]):
        exponent = power[2].translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
        meant = f"{(power[1] or '1').rstrip('.,')}e{exponent}{text[power.end() :]}"
        return f"write the power of ten as in {meant!r}"
    if re.search(r"±|\+ ?/? ?-|[0-9]\([0-9]+\)", text):
        return "a tolerance is not taken; give the value alone"
    if re.search(rf"^{_DIGITS} ?[^\W\d_]* ?(?:-|\.\.+|…|~|to|bis) ?{_DIGITS}", text):
        return "a range is not taken; give one value"
    if re.match(r"[+-]?[0-9]+ ?/ ?[0-9]|[+-]?[0-9]+ [0-9]+ ?/ ?[0-9]|[0-9 ]*[½¼¾⅓⅔]", text):
        return "write the fraction as a decimal number, such as 0.5"
    groups = _GROUPS.match(text)
    if groups and not re.match(r"[., '’_]?[0-9.,]", text[groups.end() :]):
        whole = re.sub(r"[^0-9]", "", groups["whole"])
        meant = f"{groups['sign']}{whole}{'.' + groups['part'] if groups['part'] else ''}{text[groups.end() :]}"
        return f"write it without signs between thousands, {meant!r}"
    if text.endswith(("%", "‰")):
        return "write the share as a number, such as 0.5 for 50 %"
    if "#" in text:
        return "a comment is not taken"
    if re.match(r"[+-]?(?:inf|nan)", text, re.IGNORECASE):
        return "expected a finite number"
    if not re.match(r"[+-]?[.,]?[0-9]", text):
        return "it does not begin with a number"
    if re.search(r"/[^/(]*[·⋅*. ]", re.sub(r" ?/ ?", "/", text)) and not re.search(r"/.*[0-9]", text):
        return "what stands under the slash? Use brackets, as in 'kg/(m s)'"
    if re.search(r"[^\W\d_]-[^\W\d_]", text):
        return "write the product with a space, as in 'Pa s'"
    if re.search(rf"[ ,;x×*]{_DIGITS}", text):
        return "there is more than one number"
    return "expected one number and one unit"
