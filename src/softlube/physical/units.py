"""Physical inputs: text with units in, floats in SI out."""

from __future__ import annotations

import math
from functools import cache
from typing import Any, SupportsFloat

from softlube.errors import InputError

KINDS = {
    "radius": ("m", "a length such as '2 mm'"),
    "young_modulus": ("Pa", "a pressure such as '3 MPa'"),
    "shear_modulus": ("Pa", "a pressure such as '1 MPa'"),
    "viscosity": ("Pa s", "a dynamic viscosity such as '2 Pa s'"),
    "speed": ("m/s", "a speed such as '0.1 mm/s'"),
    "entrainment_speed": ("m/s", "a speed such as '0.05 mm/s'"),
    "load": ("N", "a force such as '100 mN'"),
    "friction": ("N", "a force such as '5 mN'"),
    "indentation": ("m", "a length such as '50 um', or '-1 um' for a gap"),
    "roughness": ("m", "a length such as '20 nm'"),
    "thickness": ("m", "a length such as '2 mm'"),
    "density": ("kg/m^3", "a density such as '970 kg/m^3'"),
    "poisson_ratio": ("", "a number such as '0.45'"),
    "pressure_viscosity": ("1/Pa", "an inverse pressure such as '20 GPa^-1'"),
    "approach_speed": ("m/s", "a speed such as '10 um/s', or '-10 um/s' for separation"),
    "initial_height": ("m", "a length such as '100 um'"),
    "film_limit": ("m", "a length such as '20 nm'"),
    "duration": ("s", "a time such as '10 s'"),
    "pressed": ("s", "a time such as '1 s'"),
}
"""Unit and example of every physical input."""

PREFIXES = ((-9, "n"), (-6, "µ"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G"))
"""Exponents and symbols of the prefixes that are printed."""

SIGNED = ("indentation", "approach_speed", "pressed")
"""Inputs that may be zero or negative."""


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


def to_si(name: str, value: object) -> float:
    """One physical input in SI.

    Parameters
    ----------
    name : str
        A key of `KINDS`.
    value : str, float or pint.Quantity
        Text with a unit, a number already in SI, or a quantity.

    Raises
    ------
    InputError
        If the value is not a finite quantity of the right dimension, and positive unless it is one of `SIGNED`; the message
        names the parameter.
    """
    unit, expected = KINDS[name]
    if not unit:
        return _number(name, value)
    quantity: Any
    if isinstance(value, str):
        import pint

        text = value.strip()
        try:
            quantity = _registry().Quantity(text)
        except pint.UndefinedUnitError as error:
            raise InputError(f"{name}: {text!r} has an unknown unit ({error.args[0]!r}); expected {expected}") from None
        except Exception:  # pint's parser raises whatever the text provokes: SyntaxError, TypeError, DefinitionSyntaxError, …
            raise InputError(f"{name}: cannot read {text!r}; expected {expected}") from None
        if quantity.unitless:
            raise InputError(f"{name}: {text!r} has no unit; expected {expected}")
    elif hasattr(value, "to") and hasattr(value, "magnitude"):
        quantity = value
    elif isinstance(value, SupportsFloat) and not isinstance(value, bool):
        return _checked(name, float(value), value)
    else:
        raise InputError(f"{name}: cannot read {value!r}; expected {expected}")
    try:
        number = float(quantity.to(unit).magnitude)
    except Exception as error:
        if type(error).__name__ == "DimensionalityError":
            raise InputError(f"{name}: {value!s} has the wrong dimension; expected {expected}") from None
        raise InputError(f"{name}: cannot read {value!r}; expected {expected}") from None
    return _checked(name, number, value)


def unit_factor(name: str, unit: str) -> float:
    """What a number in `unit` is multiplied by to be in SI.

    Parameters
    ----------
    name : str
        A key of `KINDS`.
    unit : str
        In any spelling pint knows, such as "mN" or "mm/s".

    Raises
    ------
    InputError
        If the unit is unknown or of the wrong dimension.
    """
    return to_si(name, f"1 {unit}") if unit.strip() else to_si(name, "1")


def in_unit(name: str, value: object, unit: str, example: str) -> float:
    """A finite quantity of any sign in a unit; text, pint quantity, or a number already in it."""
    import pint

    try:
        if isinstance(value, str):
            quantity: Any = pint.get_application_registry().Quantity(value.strip())
            number = float(quantity.to(unit).magnitude)
        elif hasattr(value, "to") and hasattr(value, "magnitude"):
            number = float(value.to(unit).magnitude)  # type: ignore[union-attr]
        else:
            number = float(value)  # type: ignore[arg-type]
    except Exception:  # pint's parser raises whatever the text provokes
        raise InputError(f"{name}: cannot read {value!r}; expected {example}") from None
    if not math.isfinite(number):
        raise InputError(f"{name}: expected a finite quantity, {example}; got {value!s}")
    return number


def _checked(name: str, number: float, given: object) -> float:
    signed = name in SIGNED
    if not math.isfinite(number) or (number <= 0 and not signed):
        raise InputError(f"{name}: expected a {'' if signed else 'positive, '}finite quantity, {KINDS[name][1]}; got {given!s}")
    return number


def _number(name: str, value: object) -> float:
    """A plain number, given as one or as text."""
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise InputError(f"{name}: expected a number without unit, got {value!r}") from None


def prefixed(value: float, unit: str, below: float = 1e3) -> tuple[float, str]:
    """Factor and unit with the first SI prefix under which a value stays below a bound.

    Examples
    --------
    >>> prefixed(2.5e-7, "m")
    (1000000000.0, 'nm')
    """
    exponent, prefix = next((pair for pair in PREFIXES if abs(value) < below * 10.0 ** pair[0]), PREFIXES[-1])
    return 10.0**-exponent, prefix + unit
