"""Measured friction for Fig. 13, from a CSV file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError
from softlube.files.tables import given_as, header_names, read_table
from softlube.model.exact import hertz_indentation
from softlube.model.inputs import FORCE, NUMBER, Input

Array = NDArray[np.floating]

NORMALISED = {
    "beta": Input("β by the load, Eq. (30)", NUMBER, "1000"),
    "friction": Input("Friction over (2π/3) G δ², Eqs. (26) and (29)", NUMBER, "0.2"),
}
"""Columns of points that are normalised already."""
PHYSICAL = ("radius", "young_modulus", "viscosity", "speed", "load", "friction")
"""Columns of points in physical units."""
FRICTION = {"friction": Input("Friction force", FORCE, "5 mN")}
"""The friction that Fig. 13 takes is positive: its axis is logarithmic."""
EXPECTED = (
    "columns 'beta' and 'friction' (normalised by the load, Eqs. 26, 29, 30), or all of "
    "'radius [mm]', 'young_modulus [MPa]', 'viscosity [Pa s]', 'speed [mm/s]', 'load [mN]', 'friction [mN]' with any such unit"
)


@dataclass(frozen=True)
class Measured:
    """Points of Fig. 13.

    Attributes
    ----------
    beta : ndarray, shape (points,)
        β by the load, Eq. (30).
    friction : ndarray, shape (points,)
        Friction over (2π/3) G δ², Eqs. (26) and (29).
    """

    beta: Array
    friction: Array


def read_friction(path: Path) -> Measured:
    """Read measured friction.

    The file has one point a line under a header: columns ``beta, friction``, already normalised, or ``radius [mm],
    young_modulus [MPa], viscosity [Pa s], speed [mm/s], load [mN], friction [mN]``, each with its unit; other columns are
    ignored.  `softlube.files.tables.read_table` says what else a file may have.

    Raises
    ------
    InputError
        If the file is missing, a column or unit is wrong, or a value is not a positive number; the message names the line.
    """
    with given_as("data"):
        names = header_names(path)
        if names and not {"beta", "radius"} & {*names}:
            raise InputError(f"{Path(path).name}, line 1: expected {EXPECTED}; the header has {', '.join(map(repr, names))}")
        if "beta" in names:
            columns = read_table(path, list(NORMALISED), columns=NORMALISED).columns
            return Measured(columns["beta"], columns["friction"])
        columns = read_table(path, PHYSICAL, columns=FRICTION).columns
    shear = columns["young_modulus"] / 3
    indentation = hertz_indentation(columns["load"], columns["radius"], shear)
    beta = (2 / 3) * indentation**2 / columns["radius"] * np.pi * shear / (columns["viscosity"] * columns["speed"])
    return Measured(beta, columns["friction"] / (2 * np.pi / 3 * shear * indentation**2))
