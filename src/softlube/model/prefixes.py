"""SI prefixes as they are printed: numbers below a thousand, with the unit that makes them so."""

from __future__ import annotations

PREFIXES = ((-9, "n"), (-6, "µ"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G"))
"""Exponents and symbols of the prefixes that are printed."""


def prefixed(value: float, unit: str, below: float = 1e3) -> tuple[float, str]:
    """Factor and unit with the first SI prefix under which a value stays below a bound.

    Examples
    --------
    >>> prefixed(2.5e-7, "m")
    (1000000000.0, 'nm')
    """
    below *= 1 - 1e-12  # so that rounding does not make 1000 nm of 1 µm
    exponent, prefix = next((pair for pair in PREFIXES if abs(value) * 10.0 ** -pair[0] < below), PREFIXES[-1])
    return 10.0**-exponent, prefix + unit


def shown(value: float, unit: str) -> str:
    """A value as an input is written, with a prefix in use where the unit takes one.

    Examples
    --------
    >>> shown(0.1, "N"), shown(2e-8, "1/Pa"), shown(900.0, "kg/m^3"), shown(0.5, "")
    ('100 mN', '20 1/GPa', '900 kg/m^3', '0.5')
    """
    text, inverse = unit.removeprefix("1/"), unit.startswith("1/")
    if value == 0 or not unit or text.startswith("kg") or (text == "s" and abs(value) >= 1):
        return f"{value:.10g} {unit}".strip()
    # A value in 1/GPa is that in 1/Pa times 1e9, as one in nm is that in m.
    factor, symbol = prefixed(value, "")
    if inverse:
        symbol = dict(PREFIXES)[-next(exponent for exponent, each in PREFIXES if each == symbol)]
    return f"{value * factor:.10g} {'1/' * inverse}{symbol}{text}"
