"""The input that a command understood: a line above its output, and "inputs" in its JSON."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from softlube.model.prefixes import shown
from softlube.physical.inputs import declared

MEANT = {"slowest": "entrainment_speed", "fastest": "entrainment_speed"}
"""Options that have the dimension of an input with another name."""


def understood(given: Mapping[str, object]) -> dict[str, dict[str, Any]]:
    """Value in SI, and unit, of every input that is given.

    Parameters
    ----------
    given : mapping of str to object
        Values by the names of inputs or options, lists among them; None for what is not given.

    Returns
    -------
    dict of str to dict
        Under each name "value", a number, a text or a list of them, and "unit", empty for a text or a plain number.
    """
    result = {}
    for name, value in given.items():
        if value is None:
            continue
        known = declared().get(MEANT.get(name, name))
        if known is None:
            result[name] = {"value": value, "unit": ""}
        else:
            read = known.read_all(value) if isinstance(value, list) else known.read(value)
            result[name] = {"value": read, "unit": known.unit}
    return result


def echo(inputs: Mapping[str, Mapping[str, Any]]) -> str:
    """Inputs in a line, with prefixes: "Input: radius 2 mm, young_modulus 3 MPa."

    Parameters
    ----------
    inputs : mapping
        As `understood` gives them.
    """
    return "Input: " + ", ".join(f"{name} {_values(each['value'], each['unit'])}" for name, each in inputs.items()) + "."


def _values(value: Any, unit: str) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, list):
        return value if isinstance(value, str) else shown(value, unit)
    texts = [_values(each, unit) for each in value]
    if len(texts) <= 3:
        return " and ".join(texts)
    ends = texts if isinstance(value[0], str) else [_values(min(value), unit), _values(max(value), unit)]
    return f"{ends[0]} to {ends[-1]} ({len(texts)} values)"
