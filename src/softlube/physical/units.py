"""Inputs by their names in SI."""

from __future__ import annotations

from softlube.physical.inputs import declared


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
