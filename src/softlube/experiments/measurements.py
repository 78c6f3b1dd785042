"""Measured friction: what a rig writes down, read and checked."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from softlube.errors import printable
from softlube.experiments.columns import checked_columns, summary_of
from softlube.files.tables import header_names, one_of, read_table
from softlube.model.summary import Summarised, Summary

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.floating]


@dataclass(frozen=True, repr=False)
class Measurements(Summarised):
    """Friction at loads and speeds, in SI.

    Attributes
    ----------
    load, friction : ndarray, shape (rows,)
        Normal load and friction force [N].
    speed : ndarray, shape (rows,)
        Sum of the surface speeds: the sliding speed where one surface rests, twice the entrainment speed otherwise [m/s].
    slide_to_roll : ndarray, shape (rows,)
        (v₁ − v₂) over the mean of both; 2 where the substrate rests.
    lines : ndarray of int, shape (rows,)
        Where each row stands in the file.
    source : str
        Name of the file.
    notices : tuple of str
        What was left out of the file, with the lines.
    """

    load: Array
    speed: Array
    friction: Array
    slide_to_roll: Array
    lines: NDArray[np.integer]
    source: str = "data"
    notices: tuple[str, ...] = ()

    def __len__(self) -> int:
        return self.load.size

    @classmethod
    def from_arrays(cls, load: object, speed: object, friction: object, *, slide_to_roll: float = 2.0) -> Measurements:
        """Measurements from arrays in SI.

        Raises
        ------
        InputError
            If they differ in length, or a number is not finite, or a load or a speed not positive.
        """
        given = {"load": load, "speed": speed, "friction": friction}
        loads, speeds, forces = checked_columns(given, signed={"friction"})
        return cls(loads, speeds, forces, np.full(loads.size, float(slide_to_roll)), np.arange(1, loads.size + 1))

    @property
    def headline(self) -> str:
        """How many rows there are, and where they are from."""
        return f"Measurements: {len(self)} rows of {printable(self.source)}"

    def summary(self) -> Summary:
        """Least, median and greatest value of every column, and what was left out of the file."""
        columns = (
            ("load", self.load, "N"),
            ("speed", self.speed, "m/s"),
            ("friction", self.friction, "N"),
            ("friction_coefficient", self.friction / self.load, ""),
            ("slide_to_roll", self.slide_to_roll, ""),
        )
        return summary_of(self.headline, columns, self.notices)

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each measurement, units in the headers; "line" is where it stands in the file."""
        import pandas as pd

        columns = {"load [N]": self.load, "speed [m/s]": self.speed, "friction [N]": self.friction}
        return pd.DataFrame(columns | {"slide_to_roll": self.slide_to_roll, "line": self.lines})

    def take(self, rows: NDArray[np.integer]) -> Measurements:
        """Some of the rows."""
        return Measurements(
            self.load[rows], self.speed[rows], self.friction[rows], self.slide_to_roll[rows], self.lines[rows], self.source
        )


def read_measurements(path: str | os.PathLike[str], *, slide_to_roll: float = 2.0) -> Measurements:
    """Measurements from a CSV file.

    Columns, with units in the header: load; speed (sliding, one surface at rest) or entrainment_speed; friction or
    friction_coefficient; slide_to_roll if it varies.  Others are ignored.  A row without one of them is left out and one that
    repeats another in every cell of the file is counted once; both are told in `Measurements.notices`.

    Raises
    ------
    InputError
        See `softlube.files.tables.read_table`; also if both or none of two alternative columns are there.
    """
    names = header_names(path)
    kind = one_of(path, "speed", "entrainment_speed")
    force = one_of(path, "friction", "friction_coefficient")
    rolls = ["slide_to_roll"] if "slide_to_roll" in names else []
    table = read_table(path, ["load", kind, force, *rolls], drop_repeats=True, drop_missing=True)
    columns = table.columns
    load = columns["load"]
    return Measurements(
        load,
        columns[kind] * (2 if kind == "entrainment_speed" else 1),
        columns[force] * (load if force == "friction_coefficient" else 1),
        columns["slide_to_roll"] if rolls else np.full(load.size, float(slide_to_roll)),
        table.lines,
        table.source,
        table.notices,
    )
