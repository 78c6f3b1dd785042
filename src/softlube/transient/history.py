"""A film that changes with time: what a squeeze film and a start of sliding have in common, in SI or normalised."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from softlube.model.quantities import QUANTITIES, Quantity, header
from softlube.model.summary import QUANTITY_COLUMNS, Summarised, Summary, in_words, rows_at_the_end
from softlube.transient.extremes import Extremes
from softlube.transient.motion import Motion

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure
    from xarray import Dataset

Array = NDArray[np.floating]


NEIGHBOURS = 1.5
"""Factor of the time within which other times are neighbours."""


def among_neighbours(time: Array, error: Array) -> Array:
    """Largest error at neighbouring times: histories that are compared cross now and then, which makes neither of them exact.

    Parameters
    ----------
    time : ndarray, shape (k,)
        Increasing.
    error : ndarray, shape (k,)
        Differences of histories.
    """
    first = np.searchsorted(time, time / NEIGHBOURS)
    last = np.searchsorted(time, time * NEIGHBOURS, side="right")
    return np.array([error[i:j].max() for i, j in zip(first, last, strict=True)])


class Integration(Protocol):
    """One integration in time on one grid, normalised."""

    @property
    def time(self) -> Array:
        """Times of the steps, shape (k,)."""
        ...

    @property
    def r(self) -> Array:
        """Radii of the grid's nodes."""
        ...

    @property
    def films(self) -> Array:
        """Film thickness at every step; the first axis is the time, the second the radius."""
        ...

    @property
    def pressures(self) -> Array:
        """Pressure at every step, on the nodes of `films`."""
        ...

    @property
    def ended_by(self) -> str:
        """Why the integration ended: "duration" or "film_limit"."""
        ...


class PhysicalInput(Protocol):
    """The physical input of a film in time, in SI; `softlube.physical.squeeze.Setup` is one."""

    @property
    def units(self) -> Mapping[str, tuple[float, str]]:
        """SI value and SI unit of each unit of the normalised problem, by dimension."""
        ...

    def doubts(self, extremes: Extremes) -> tuple[str, ...]:
        """Warnings where the model may not describe the experiment, from its extremes in SI."""
        ...

    def inputs(self) -> dict[str, float | str | None]:
        """Every input in SI by its name."""
        ...


@dataclass(frozen=True, kw_only=True, repr=False)
class Transient(Summarised):
    """A film that changes with time.

    Attributes, histories, fields and errors are in SI if the input was physical, and normalised with the unit of height of the
    motion otherwise.

    Attributes
    ----------
    motion : Motion
        What moves the sphere up and down, normalised.
    run : Integration
        The finest integration, normalised.
    values, value_errors : mapping of str to ndarray, shape (k,)
        Normalised histories, and estimates of |value − exact|, at ``run.time``; see `histories`.
    end_error : float
        Estimated error of the normalised time at which the film limit was reached; 0 where it was not reached.
    accuracy : float
        Relative accuracy of the films that was asked for.
    setup : PhysicalInput or None
        The physical input; None for a normalised motion.
    sliding : mapping of str to object
        Inputs of the sliding: speed (normalised: β), time for which the sphere is pressed before, cavitation condition.  Empty
        without sliding.
    """

    title: ClassVar[str]
    """What the film is, in words, for files."""
    start: ClassVar[str]
    """What happens at time 0, in words."""
    axes: ClassVar[tuple[str, ...]]
    """Names of the axes of film and pressure after the time: attributes of `run`."""
    balance: ClassVar[tuple[str, ...]] = ()
    """Names of further functions of the time in files, without errors: attributes of `run`."""

    motion: Motion
    run: Integration
    values: Mapping[str, Array]
    value_errors: Mapping[str, Array]
    end_error: float
    accuracy: float
    setup: PhysicalInput | None = None
    sliding: Mapping[str, Any] = field(default_factory=dict)

    def scale(self, dimension: str) -> tuple[float, str]:
        """SI value and SI unit of the normalised unit of a dimension; 1 and "" for a normalised motion.

        Parameters
        ----------
        dimension : {"time", "length", "height", "pressure", "load", "friction", "volume"}
            A key of `softlube.model.quantities.UNITS`.
        """
        return (1.0, "") if self.setup is None else self.setup.units[dimension]

    @property
    def time(self) -> Array:
        """Times of the steps, shape (k,)."""
        return self.run.time * self.scale("time")[0]

    @property
    def time_error(self) -> float:
        """Estimated error of the time at which the film limit was reached; 0 where it was not reached."""
        return self.end_error * self.scale("time")[0]

    @cached_property
    def histories(self) -> dict[str, Array]:
        """Quantities of `softlube.model.quantities` as functions of `time`, by their names; each has the shape (k,)."""
        return {name: values * self.scale(QUANTITIES[name].dimension)[0] for name, values in self.values.items()}

    @cached_property
    def errors(self) -> dict[str, Array]:
        """Estimates of |value − exact| of the histories, by their names."""
        return {name: errors * self.scale(QUANTITIES[name].dimension)[0] for name, errors in self.value_errors.items()}

    @property
    def final(self) -> dict[str, Quantity]:
        """The last value of each history, with its error and its SI unit."""
        return {
            name: Quantity(values[-1], self.errors[name][-1], self.scale(QUANTITIES[name].dimension)[1])
            for name, values in self.histories.items()
        }

    @property
    def r(self) -> Array:
        """Radii of the grid's nodes, shape (n,)."""
        return self.run.r * self.scale("length")[0]

    @property
    def film(self) -> Array:
        """Film thickness; the first axis is the time, the others are `axes`."""
        return self.run.films * self.scale("height")[0]

    @property
    def pressure(self) -> Array:
        """Pressure; the first axis is the time, the others are `axes`."""
        return self.run.pressures * self.scale("pressure")[0]

    @property
    def extremes(self) -> Extremes:
        """Extremes of height, pressure, speed and film, which the warnings depend on."""
        return Extremes.of(self.time, self.histories, self.pressure)

    @cached_property
    def warnings(self) -> tuple[str, ...]:
        """Doubts about the physics; none for a normalised motion."""
        return () if self.setup is None else self.setup.doubts(self.extremes)

    @property
    def why_it_ended(self) -> str:
        """Why the integration ended, in words."""
        return "the film reached its limit" if self.run.ended_by == "film_limit" else "the end of the motion"

    @property
    def headline(self) -> str:
        """When and why it ended, and the films then."""
        films = ", ".join(in_words(name, self.final[name]) for name in ("film_center", "film_min"))
        end = f"{self.time[-1]:.6g} {self.scale('time')[1]}".strip()
        return f"{type(self).__name__}: after {end} ({self.why_it_ended}) {films}"

    def summary(self) -> Summary:
        """The last value of each history with its error, and the warnings.

        Extremes of a pressure that is next to nothing are left out: far out it is, and so is the least pressure where the
        liquid is pressed out everywhere.
        """
        least = 1e-3 * abs(float(self.final.get("pressure_center", 0.0)))
        kept = {name: q for name, q in self.final.items() if name not in ("pressure_max", "pressure_min") or abs(q) > least}
        notes = tuple(f"Warning: {doubt}" for doubt in self.warnings)
        return Summary(self.headline, QUANTITY_COLUMNS, tuple(rows_at_the_end(kept)), notes)

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each time step: the time, and every history with its error; units in the headers."""
        import pandas as pd

        columns = {header("time", self.scale("time")[1]): self.time}
        for name, values in self.histories.items():
            unit = self.scale(QUANTITIES[name].dimension)[1]
            columns[header(name, unit)] = values
            columns[header(name, unit, error=True)] = self.errors[name]
        return pd.DataFrame(columns)

    @property
    def numerics(self) -> dict[str, Any]:
        """What the computation took, in plain values: grids, and how good the time steps are."""
        raise NotImplementedError

    @property
    def dataset(self) -> Dataset:
        """Film, pressure and histories with their errors as an xarray Dataset, as `save` writes it."""
        from softlube.files.transient import to_dataset

        return to_dataset(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write `dataset` as NetCDF 4.

        Raises
        ------
        InputError
            If the folder does not exist.
        """
        from softlube.files.transient import save

        save(self, path)

    def plot(self, path: str | os.PathLike[str] | None = None) -> Figure:
        """Profiles of film and pressure at some times, and histories; see `softlube.plots.transient.picture`."""
        from softlube.plots.transient import picture

        return picture(self, path)

    def to_dict(self) -> dict[str, Any]:
        """Final values and what the computation took, ready for JSON."""
        return {
            "ended_by": self.run.ended_by,
            "time": {"value": float(self.time[-1]), "error": self.time_error},
            "final": {name: {"value": float(q), "error": q.error, "unit": q.unit or "1"} for name, q in self.final.items()},
            "accuracy": self.accuracy,
            **self.numerics,
            "steps": self.run.time.size,
            "warnings": list(self.warnings),
        }
