"""Histories of a load or a height from CSV files."""

from __future__ import annotations

import os
from typing import Literal, cast

import numpy as np

from softlube.errors import InputError
from softlube.files.tables import given_as, header_names, one_of, read_table
from softlube.model.inputs import FORCE, LENGTH, TIME, Input
from softlube.physical.squeeze import History

COLUMNS = {
    "time": Input("Time since the start", TIME, "10 ms", signed=True),
    "load": Input("Normal load", FORCE, "100 mN", signed=True),
    "height": Input("Height of the lowest point over the undeformed surface", LENGTH, "20 um", signed=True),
}
"""Columns of a history; a load that pulls and a height below the undeformed surface are negative."""


def read_history(path: str | os.PathLike[str]) -> History:
    """Read a load or a height that is given at some times from a CSV file.

    Parameters
    ----------
    path : path
        A file with columns "time" and "load", or "time" and "height"; other columns are ignored.  Units stand in the header, as
        in "time [ms], load (mN)"; a column without a unit is in SI.  `softlube.files.tables.read_table` says what else a file
        may have: semicolons, decimal commas, comments, ….

    Raises
    ------
    InputError
        If the file is missing or is no such table, or its times do not start at 0 and increase; the message names the line.
    """
    with given_as("history"):
        if header_names(path) and not {"load", "height"} & {*header_names(path)}:
            raise InputError(f"{os.path.basename(path)}, line 1: expected columns headed 'time, load' or 'time, height'")
        control = one_of(path, "load", "height")
        table = read_table(path, ["time", control], columns=COLUMNS, si_without_unit=True)
        time, values = table.columns["time"], table.columns[control]
        wrong = np.diff(time, prepend=-1.0) <= 0
        wrong[0] = time[0] != 0
        if wrong.any():
            row = int(np.argmax(wrong))
            reason = f"expected times that start at 0 and increase, got {time[row]:g} s"
            raise InputError(f"{table.source}, line {table.lines[row]}: {reason}")
        if len(table) < 2:
            raise InputError(f"{table.source}, line {table.lines[-1]}: expected at least two points of time and {control}")
    return History(cast(Literal["load", "height"], control), time, values, table.source)
