"""Flow curves: viscosity against shear rate as a rheometer measures it, and the laws of thinning liquids through them."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from softlube.errors import printable
from softlube.experiments.columns import checked_columns, summary_of
from softlube.files.tables import one_of, read_table
from softlube.model.inputs import PRESSURE, VISCOSITY, Dimension, Input
from softlube.model.liquids import CarreauYasudaLaw, NewtonianLaw
from softlube.model.summary import Summarised, Summary

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.floating]

COLUMNS = {
    "shear_rate": Input("Shear rate", Dimension("1/s", "a shear rate"), "10 1/s"),
    "shear_stress": Input("Shear stress", PRESSURE, "5 Pa"),
    "viscosity": Input("Viscosity at the shear rate", VISCOSITY, "20 mPa s"),
}
"""Columns of a flow curve."""
LEAST_INDEX = 0.02
FARTHEST = 1e3
"""Factor beyond the data's rates or viscosities within which the parameters are looked for."""
TRANSITIONS = (0.2, 20.0)
"""Range of Yasuda's exponent."""


@dataclass(frozen=True, repr=False)
class FlowCurve(Summarised):
    """Viscosities at shear rates, in SI.

    Attributes
    ----------
    shear_rate : ndarray, shape (rows,)
        Positive [1/s].
    viscosity : ndarray, shape (rows,)
        Shear stress over shear rate [Pa s].
    lines : ndarray of int, shape (rows,)
        Where each row stands in the file.
    source : str
        Name of the file.
    notices : tuple of str
        What was left out of the file, with the lines.
    """

    shear_rate: Array
    viscosity: Array
    lines: NDArray[np.integer]
    source: str = "data"
    notices: tuple[str, ...] = ()

    def __len__(self) -> int:
        return self.shear_rate.size

    @classmethod
    def from_arrays(cls, shear_rate: object, viscosity: object) -> FlowCurve:
        """A flow curve from arrays in SI.

        Raises
        ------
        InputError
            If they differ in length or a number is not positive and finite.
        """
        rates, viscosities = checked_columns({"shear_rate": shear_rate, "viscosity": viscosity})
        return cls(rates, viscosities, np.arange(1, rates.size + 1))

    @property
    def headline(self) -> str:
        """How many rows there are, and over which shear rates."""
        rates = " to ".join(f"{rate:.4g}" for rate in (self.shear_rate.min(), self.shear_rate.max()))
        return f"FlowCurve: {len(self)} rows of {printable(self.source)}, {rates} 1/s"

    def summary(self) -> Summary:
        """Least, median and greatest value of every column, and what was left out of the file."""
        columns = (("shear_rate", self.shear_rate, "1/s"), ("viscosity", self.viscosity, "Pa s"))
        return summary_of(self.headline, columns, self.notices)

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each measurement, units in the headers; "line" is where it stands in the file."""
        import pandas as pd

        columns = {"shear_rate [1/s]": self.shear_rate, "viscosity [Pa s]": self.viscosity, "line": self.lines}
        return pd.DataFrame(columns)


def read_flow_curve(path: str | os.PathLike[str]) -> FlowCurve:
    """A flow curve from a CSV file.

    Columns, with units in the header: shear_rate; viscosity or shear_stress.  Others are ignored.  A row without one of them is
    left out and one that repeats another in every cell is counted once; both are told in `FlowCurve.notices`.

    Raises
    ------
    InputError
        See `softlube.files.tables.read_table`; also if both viscosity and stress are there.
    """
    kind = one_of(path, "viscosity", "shear_stress")
    table = read_table(path, ["shear_rate", kind], columns=COLUMNS, drop_repeats=True, drop_missing=True)
    rate = table.columns["shear_rate"]
    viscosity = table.columns[kind] / (rate if kind == "shear_stress" else 1.0)
    return FlowCurve(rate, viscosity, table.lines, table.source, table.notices)


# --- laws through it ----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Candidate:
    """A law that may describe a flow curve, with or without a second plateau.

    Attributes
    ----------
    kind : str
        Name of the liquid's part in the slot "liquid".
    names : tuple of str
        Its parameters, as the part declares them.
    """

    kind: str
    names: tuple[str, ...]

    @property
    def words(self) -> str:
        """What it is called in a table."""
        return self.kind + (" with a second plateau" if "infinite_viscosity" in self.names else "")

    def viscosity(self, rate: Array, values: Mapping[str, float]) -> Array:
        """Viscosity at shear rates, in SI."""
        if self.kind == "newtonian":
            return np.full_like(rate, values["viscosity"])
        if self.kind == "power-law":
            return values["consistency"] * rate ** (values["index"] - 1)
        at_rest, index = values["viscosity"], values["index"]
        transition = {"carreau": 2.0, "cross": max(1 - index, 1e-6)}.get(self.kind) or values["transition"]
        infinite = min(values.get("infinite_viscosity", 0.0) / at_rest, 1.0)
        # In units of the viscosity at rest and seconds.
        law = CarreauYasudaLaw(NewtonianLaw(), values["relaxation_time"], index, infinite, transition)
        return at_rest * law.flow_curve(rate) / rate


_PLATEAU = ("viscosity", "relaxation_time", "index")
_SECOND = ("viscosity", "infinite_viscosity", "relaxation_time", "index")
CANDIDATES = (
    Candidate("newtonian", ("viscosity",)),
    Candidate("power-law", ("consistency", "index")),
    Candidate("carreau", _PLATEAU),
    Candidate("cross", _PLATEAU),
    Candidate("carreau", _SECOND),
    Candidate("cross", _SECOND),
    Candidate("carreau-yasuda", (*_PLATEAU, "transition")),
    Candidate("carreau-yasuda", (*_SECOND, "transition")),
)
"""Laws that are tried."""


@dataclass(frozen=True)
class FlowModel:
    """Viscosity as a function of the parameters of a law.

    Attributes
    ----------
    data : FlowCurve
    candidate : Candidate
    fixed : mapping of str to float
        Values of the parameters that are not fitted, in SI.
    free : tuple of str
        Parameters that are fitted.
    """

    data: FlowCurve
    candidate: Candidate
    fixed: Mapping[str, float]
    free: tuple[str, ...]

    def values(self, x: Array) -> dict[str, float]:
        """All parameters in SI from the vector that is fitted, their logarithms."""
        return dict(self.fixed) | {name: math.exp(value) for name, value in zip(self.free, x, strict=True)}

    def vector(self, values: Mapping[str, float]) -> Array:
        """Inverse of `values`."""
        return np.log([values[name] for name in self.free])

    def residuals(self, values: Mapping[str, float]) -> Array:
        """ln(measured/law)."""
        return np.log(self.data.viscosity / self.candidate.viscosity(self.data.shear_rate, values))

    @cached_property
    def ranges(self) -> dict[str, tuple[float, float]]:
        """Least and greatest value of each parameter that is looked for."""
        rate, viscosity = self.data.shear_rate, self.data.viscosity
        sizes = viscosity.min() / FARTHEST, viscosity.max() * FARTHEST
        return {
            "viscosity": (viscosity.min() / 2, sizes[1]),
            "infinite_viscosity": (sizes[0], viscosity.max()),
            "consistency": (sizes[0] * 1e-6, sizes[1] * 1e6),
            "relaxation_time": (1 / (FARTHEST * rate.max()), FARTHEST / rate.min()),
            "index": (LEAST_INDEX, 1.0),
            "transition": TRANSITIONS,
        }

    @property
    def limited(self) -> bool:
        """False: the bounds are far beyond the data."""
        return False

    def bounds(self) -> tuple[Array, Array]:
        """Least and greatest vector, see `values`."""
        low, high = np.log([self.ranges[name] for name in self.free]).T
        return low, high

    def starts(self) -> list[dict[str, float]]:
        """Parameters to start from: the plateaus at the ends of the data, a knee here and there."""
        rate, viscosity = self.data.shear_rate, self.data.viscosity
        usual = {
            "viscosity": (float(viscosity.max()),),
            "infinite_viscosity": (0.5 * float(viscosity.min()),),
            "consistency": (float(np.exp(np.mean(np.log(viscosity)))),),
            "relaxation_time": tuple(1 / np.geomspace(rate.min(), rate.max(), 5)),
            "index": (0.3, 0.7),
            "transition": (0.8, 2.0),
        }
        if self.candidate.kind == "power-law":
            usual |= {"consistency": tuple(viscosity.max() * rate.min() ** (1 - n) for n in (0.3, 0.7))}
        return [dict(zip(self.free, each, strict=True)) for each in product(*(usual[name] for name in self.free))]
