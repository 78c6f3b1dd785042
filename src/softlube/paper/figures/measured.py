"""Measured friction for Fig. 13, from a CSV file."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError

Array = NDArray[np.floating]

NORMALISED = ("beta", "friction")
PHYSICAL = {
    "radius": "m",
    "young_modulus": "Pa",
    "viscosity": "Pa s",
    "speed": "m/s",
    "load": "N",
    "friction": "N",
}
EXPECTED = (
    "columns 'beta' and 'friction' (normalised by the load, Eqs. 26, 29, 30), or all of "
    + ", ".join(f"'{name} [{unit}]'" for name, unit in PHYSICAL.items())
    + " with any unit of that kind"
)


@dataclass(frozen=True)
class Measured:
    """Points of Fig. 13: β by the load (30), and the friction in units of (2π/3) G δ²."""

    beta: Array
    friction: Array


def read_friction(path: Path) -> Measured:
    """Read measured friction.

    The file has one header line, and one point a line: columns ``beta, friction`` already normalised, or ``radius [mm],
    young_modulus [MPa], viscosity [Pa s], speed [mm/s], load [mN], friction [mN]``, each with its unit in brackets.

    Raises
    ------
    InputError
        If the file is missing, a column or unit is wrong, or a value is not a positive number; the message names the line.
    """
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise InputError(f"data: {str(path)!r} does not exist") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"data: {str(path)!r} cannot be read ({error})") from None
    rows = [row for row in csv.reader(text.splitlines()) if row and not row[0].lstrip().startswith("#")]
    if len(rows) < 2:
        raise InputError(f"data: {str(path)!r} has no points; expected {EXPECTED}")
    header = [re.fullmatch(r"\s*(\w+)\s*(?:\[(.*)\])?\s*", cell) for cell in rows[0]]
    units = {match[1]: (match[2] or "").strip() for match in header if match}
    columns = [match[1] if match else "" for match in header]
    normalised = all(name in units and not units[name] for name in NORMALISED)
    wanted = NORMALISED if normalised else tuple(PHYSICAL)
    missing = [name for name in wanted if name not in units]
    if missing:
        raise InputError(f"data: {str(path)!r} has no column {missing[0]!r}; expected {EXPECTED}")
    values = {name: _column(rows, columns.index(name), name) for name in wanted}
    if normalised:
        return Measured(values["beta"], values["friction"])
    si = {name: values[name] * _factor(name, units[name]) for name in PHYSICAL}
    shear = si["young_modulus"] / 3
    indentation = (3 * si["load"] / (16 * shear * np.sqrt(si["radius"]))) ** (2 / 3)
    beta = (2 / 3) * indentation**2 / si["radius"] * np.pi * shear / (si["viscosity"] * si["speed"])
    return Measured(beta, si["friction"] / (2 * np.pi / 3 * shear * indentation**2))


def _column(rows: list[list[str]], index: int, name: str) -> Array:
    values = []
    for line, row in enumerate(rows[1:], start=1):
        cell = row[index].strip() if index < len(row) else ""
        try:
            value = float(cell)
        except ValueError:
            raise InputError(f"data: point {line}, column {name!r}: expected a number, got {cell!r}") from None
        if not (np.isfinite(value) and value > 0):
            raise InputError(f"data: point {line}, column {name!r}: expected a positive, finite number, got {cell!r}")
        values.append(value)
    return np.array(values)


def _factor(name: str, unit: str) -> float:
    """Factor from a unit to SI."""
    from softlube.physical.units import to_si

    kind = "load" if name == "friction" else name
    try:
        return to_si(kind, f"1 {unit}")
    except InputError:
        raise InputError(
            f"data: column {name!r} has the unit {unit!r}; expected one like '{name} [{PHYSICAL[name]}]'"
        ) from None
