"""Measured profiles of indenters from CSV files and from those of instruments."""

from __future__ import annotations

import os
from pathlib import Path

from softlube.files.tables import Array, given_as, read_table
from softlube.files.topography import is_topography, read_topography
from softlube.model.inputs import LENGTH, Input

COLUMNS = {
    "r": Input("Distance from the axis", LENGTH, "0.5 mm", signed=True),
    "z": Input("Height over the lowest point", LENGTH, "20 um", signed=True),
}
"""Columns of a profile; radii of both signs are those of a trace across the axis."""


def read_profile(path: str | os.PathLike[str]) -> tuple[Array, Array, float]:
    """Read radii and heights [m], and how much the heights of a map differ around the axis, 0 for other files.

    Parameters
    ----------
    path : path
        A table with the columns r and z, whose header gives their units; see `softlube.files.tables.read_table`.  A file whose
        ending is not a table's is read by SurfaceTopography; see `softlube.files.topography`.

    Raises
    ------
    InputError
        If the file is missing or cannot be read; the message names the line of a table.
    """
    with given_as("profile"):
        if is_topography(Path(path)):
            return read_topography(Path(path))
        table = read_table(path, ["r", "z"], columns=COLUMNS)
    return table.columns["r"], table.columns["z"], 0.0
