"""Inputs by their names in SI, and units with the SI prefixes that are printed."""

from __future__ import annotations

from softlube.physical.inputs import declared

PREFIXES = ((-9, "n"), (-6, "µ"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G"))
"""Exponents and symbols of the prefixes that are printed."""


def to_si(name: str, value: object) -> float:
    """The value of an input in SI.

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


def prefixed(value: float, unit: str, below: float = 1e3) -> tuple[float, str]:
    """Factor and unit with the first SI prefix under which a value stays below a bound.

    Examples
    --------
    >>> prefixed(2.5e-7, "m")
    (1000000000.0, 'nm')
    """
    exponent, prefix = next((pair for pair in PREFIXES if abs(value) < below * 10.0 ** pair[0]), PREFIXES[-1])
    return 10.0**-exponent, prefix + unit
