"""Measured profiles of indenters from CSV files."""

from __future__ import annotations

import os

from softlube.files.tables import Array, given_as, read_table
from softlube.model.inputs import LENGTH, Input

COLUMNS = {
    "r": Input("Distance from the axis", LENGTH, "0.5 mm", signed=True),
    "z": Input("Height over the lowest point", LENGTH, "20 um", signed=True),
}
"""Columns of a profile; radii of both signs are those of a trace across the axis."""


def read_profile(path: str | os.PathLike[str]) -> tuple[Array, Array]:
    """Read radii and heights [m].

    Parameters
    ----------
    path : path
        A file with the columns r and z, whose header gives their units; see `softlube.files.tables.read_table`.

    Raises
    ------
    InputError
        If the file is missing or is no such table; the message names the line.
    """
    with given_as("profile"):
        table = read_table(path, ["r", "z"], columns=COLUMNS)
    return table.columns["r"], table.columns["z"]
