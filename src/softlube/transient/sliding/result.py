"""Following a start of sliding to a stated accuracy, and what comes of it."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from softlube.discretization.measure import measure
from softlube.errors import InputError, NotConvergedError
from softlube.model import liquids as liquids
from softlube.model import substrates
from softlube.model.problem import Cavitation
from softlube.model.quantities import QUANTITIES, Quantity
from softlube.physical.squeeze import Setup
from softlube.solvers.progress import Listener
from softlube.transient.extremes import Extremes
from softlube.transient.motion import Motion
from softlube.transient.sliding.integrate import SlidingStart, start_sliding

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from xarray import Dataset

Array = NDArray[np.floating]

LADDER = (12, 18, 26, 39)
"""Angular intervals of the grids, coarse to fine."""
TOLERANCE = 0.1
"""Tolerance of a time step over the accuracy asked for."""
FINEST_ACCURACY, COARSEST_ACCURACY = 1e-3, 0.1
JUDGED = ("film_center", "film_min")
HISTORIES = ("film_center", "film_min", "pressure_max", "height", "load", "friction_domain")
"""Histories of a start of sliding.  Where the height is prescribed a = √(R × the initial height), under a load √(R × the Hertz
indentation of the largest)."""


@dataclass(frozen=True)
class Slide:
    """A sphere that starts to slide; in SI units if the input was physical, normalised otherwise.

    Attributes
    ----------
    motion : Motion
        What moves the sphere up and down, normalised.
    sliding : mapping of str to object
        Speed (normalised: β), time that the sphere is pressed before, cavitation condition.
    run : SlidingStart
        The finest integration, normalised with the motion's unit of height.
    values, value_errors : mapping of str to ndarray, shape (k,)
        Of the quantities in `HISTORIES`, see `softlube.model.quantities`; normalised, with estimates of |value − exact|.
    end_error : float
        Estimated error of the normalised time at which the film limit was reached; 0 where it was not.
    angles : tuple of int
        Angular intervals of the grids that were used.
    accuracy : float
        Relative accuracy asked of the films.
    setup : Setup or None
        The physical input, but for the sliding.
    """

    motion: Motion
    sliding: Mapping[str, Any]
    run: SlidingStart
    values: Mapping[str, Array]
    value_errors: Mapping[str, Array]
    end_error: float
    angles: tuple[int, ...]
    accuracy: float
    setup: Setup | None = None

    def scale(self, kind: str) -> tuple[float, str]:
        """SI value and unit of the normalised unit of "time", "length", "height", "pressure", "load" or "friction"."""
        return (1.0, "") if self.setup is None else self.setup.units[kind]

    @property
    def time(self) -> Array:
        """Time since the start of the sliding, in s if the input was physical."""
        return self.run.time * self.scale("time")[0]

    @property
    def time_error(self) -> float:
        """`end_error`, likewise."""
        return self.end_error * self.scale("time")[0]

    @cached_property
    def histories(self) -> dict[str, Array]:
        """`values`, in SI if the input was physical."""
        return {name: values * self.scale(QUANTITIES[name].dimension)[0] for name, values in self.values.items()}

    @cached_property
    def errors(self) -> dict[str, Array]:
        """`value_errors`, likewise."""
        return {name: errors * self.scale(QUANTITIES[name].dimension)[0] for name, errors in self.value_errors.items()}

    @property
    def final(self) -> dict[str, Quantity]:
        """The last values with their errors."""
        return {
            name: Quantity(self.histories[name][-1], self.errors[name][-1], self.scale(QUANTITIES[name].dimension)[1])
            for name in HISTORIES
        }

    @property
    def extremes(self) -> Extremes:
        """What the doubts about it go by, in SI if the input was physical."""

        def history(name: str) -> Array:
            if name != "pressure_min":
                return self.histories[name]
            return self.scale("pressure")[0] * np.array([fields.pressure.min() for fields in self.run.fields])

        return Extremes.of(self.time, history)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Doubts about the physics."""
        return () if self.setup is None else self.setup.doubts(self.extremes)

    @property
    def dataset(self) -> Dataset:
        """Film and pressure on (time, r, theta), 0 ≤ θ ≤ π from the inlet, and the histories."""
        import xarray as xr

        from softlube.files.transient import in_units

        first = self.run.fields[0]
        coordinates = {
            "time": ("time", self.run.time, {"long_name": "time since the start of the sliding"}),
            "r": ("r", first.r, {"long_name": "distance from the axis"}),
            "theta": ("theta", first.theta, {"long_name": "angle from the inlet", "units": "rad"}),
        }
        data: dict[str, tuple[Any, ...]] = {}
        for name in ("film", "pressure"):
            data[name] = (("time", "r", "theta"), np.array([getattr(f, name) for f in self.run.fields]), {"long_name": name})
        for name in HISTORIES:
            data[name] = ("time", self.values[name], {"long_name": QUANTITIES[name].words})
            data[name + "_error"] = ("time", self.value_errors[name], {"long_name": f"error of the {QUANTITIES[name].words}"})
        attributes = {
            "title": "Start of sliding",
            "softlube_version": version("softlube"),
            "ended_by": self.run.ended_by,
            "accuracy": self.accuracy,
            "angles": json.dumps(self.angles),
            "warnings": json.dumps(self.warnings),
            "substrate": json.dumps(substrates.to_plain(self.motion.substrate)),
            "liquid": json.dumps(liquids.to_plain(self.motion.liquid)),
        }
        return in_units(xr.Dataset(data, coords=coordinates, attrs=attributes), self.setup, self.sliding)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write `dataset` as NetCDF 4."""
        from softlube.files.writing import check_destination, whole_file

        with whole_file(check_destination("output", path)) as temporary:
            self.dataset.to_netcdf(temporary, engine="h5netcdf")

    def plot(self, path: str | os.PathLike[str] | None = None) -> Figure:
        """Film and pressure along the direction of sliding at some times, and the histories."""
        from softlube.plots.transient import sliding_picture

        return sliding_picture(self, path)

    def to_dict(self) -> dict[str, Any]:
        """Final values and what was done, ready for JSON."""
        return {
            "ended_by": self.run.ended_by,
            "time": {"value": float(self.time[-1]), "error": self.time_error},
            "final": {name: {"value": float(q), "error": q.error, "unit": q.unit} for name, q in self.final.items()},
            "accuracy": self.accuracy,
            "angles": list(self.angles),
            "steps": self.time.size,
            "rejected_steps": self.run.rejected,
            "warnings": list(self.warnings),
        }


def check_accuracy(accuracy: float) -> None:
    """Refuse an accuracy that no grid reaches, or that none is needed for."""
    if not FINEST_ACCURACY <= accuracy <= COARSEST_ACCURACY:
        raise InputError(
            f"accuracy: expected a number from {FINEST_ACCURACY:g} to {COARSEST_ACCURACY:g} with sliding, got {accuracy!r}"
        )


def follow_sliding(
    motion: Motion,
    *,
    beta: float,
    pressed: float = 0.0,
    cavitation: Cavitation = "reynolds",
    film_limit: float = 0.0,
    accuracy: float = 2e-2,
    progress: Listener | None = None,
) -> Slide:
    """Follow a normalised start of sliding on ever finer grids until the films are as accurate as asked for.

    Parameters
    ----------
    motion, beta, pressed, cavitation, film_limit
        As for `softlube.transient.sliding.integrate.start_sliding`.
    accuracy, progress
        As for `slide`.

    Raises
    ------
    InputError
        If an input is not as described.
    NotConvergedError
        If the accuracy is not reached.
    """
    check_accuracy(accuracy)

    def run(n_theta: int) -> tuple[SlidingStart, dict[str, Array]]:
        started = start_sliding(
            beta,
            motion,
            pressed=pressed,
            cavitation=cavitation,
            n_theta=n_theta,
            # a coarser grid with longer steps, so that their difference tells of both
            tolerance=TOLERANCE * accuracy * (LADDER[1] / n_theta) ** 2,
            film_limit=film_limit,
            progress=progress,
        )
        measured = [measure(fields) for fields in started.fields]
        return started, {name: np.array([each[name] for each in measured]) for name in HISTORIES}

    coarse, before = run(LADDER[0])
    worst = np.inf
    for step, n_theta in enumerate(LADDER[1:], 2):
        fine, values = run(n_theta)
        # Where the film limit ended the runs, they end at slightly different times.
        end = min(coarse.time[-1], fine.time[-1])
        both = np.minimum(fine.time, end)
        errors = {}
        for name in values:
            here = PchipInterpolator(fine.time, values[name])(both)
            errors[name] = np.abs(here - PchipInterpolator(coarse.time, before[name])(both))
        worst = max(float(np.max(errors[name] / values[name])) for name in JUDGED)
        if worst <= accuracy:
            return Slide(
                motion=motion,
                sliding={"beta": beta, "pressed": pressed, "cavitation": cavitation},
                run=fine,
                values=values,
                value_errors=errors,
                end_error=float(abs(fine.time[-1] - coarse.time[-1])),
                angles=LADDER[:step],
                accuracy=accuracy,
            )
        coarse, before = fine, values
    raise NotConvergedError(f"the film is known to {worst:.1e} only, not to {accuracy:.1e}; ask for less")
