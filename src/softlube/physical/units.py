"""Quantities by the name of an input, and units as they are printed."""

from __future__ import annotations

import math
from typing import Any

from softlube.errors import InputError
from softlube.physical.inputs import declared

PREFIXES = ((-9, "n"), (-6, "µ"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G"))
"""Exponents and symbols of the prefixes that are printed."""


def to_si(name: str, value: object) -> float:
    """One physical input in SI.

    Parameters
    ----------
    name : str
        Name of an input, see `softlube.physical.inputs`.
    value : str, float or pint.Quantity
        Text with a unit, a number already in SI, or a quantity.

    Raises
    ------
    InputError
        If the value is not what the input's declaration says; the message names the input.
    """
    return declared()[name].read(value)


def unit_factor(name: str, unit: str) -> float:
    """What a number in `unit` is multiplied by to be in SI.

    Parameters
    ----------
    name : str
        Name of an input, see `softlube.physical.inputs`.
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


def prefixed(value: float, unit: str, below: float = 1e3) -> tuple[float, str]:
    """Factor and unit with the first SI prefix under which a value stays below a bound.

    Examples
    --------
    >>> prefixed(2.5e-7, "m")
    (1000000000.0, 'nm')
    """
    exponent, prefix = next((pair for pair in PREFIXES if abs(value) < below * 10.0 ** pair[0]), PREFIXES[-1])
    return 10.0**-exponent, prefix + unit
