"""The start of sliding in SI units and to a stated accuracy: `softlube squeeze --speed`."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from importlib.metadata import version
from typing import TYPE_CHECKING, Any, get_args

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from softlube import fluids, substrates
from softlube.approach.physical import Setup, read_motion, si
from softlube.approach.sliding import SlidingStart, start_sliding
from softlube.errors import InputError, NotConvergedError
from softlube.problem import Cavitation
from softlube.quantities import measure
from softlube.solution import Quantity
from softlube.units import KINDS, in_unit

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
DESCRIPTION = {
    "film_center": "film at the centre",
    "film_min": "minimum film",
    "pressure_max": "largest pressure",
    "height": "height over the undeformed surface",
    "load": "load",
    "friction_domain": "friction over r ≤ 2a",
}
"""Where the height is prescribed a = √(R × the initial height), under a load √(R × the Hertz indentation of the largest)."""
KIND = {name: name.split("_")[0] for name in DESCRIPTION} | {"film_center": "height", "film_min": "height"}


@dataclass(frozen=True)
class Slide:
    """A sphere that starts to slide; all in SI units.

    Attributes
    ----------
    setup : Setup
        The input, but for the sliding.
    sliding : mapping of str to object
        Speed, time that the sphere is pressed before, cavitation condition.
    run : SlidingStart
        The finest integration, normalised with the setup's unit of height.
    time : ndarray, shape (k,)
        Time since the start of the sliding [s].
    histories, errors : mapping of str to ndarray, shape (k,)
        `DESCRIPTION` lists them, with estimates of |value − exact|.
    time_error : float
        Estimated error of the time at which the film limit was reached; 0 where it was not [s].
    angles : tuple of int
        Angular intervals of the grids that were used.
    accuracy : float
        Relative accuracy asked of the films.
    """

    setup: Setup
    sliding: Mapping[str, Any]
    run: SlidingStart
    time: Array
    histories: Mapping[str, Array]
    errors: Mapping[str, Array]
    time_error: float
    angles: tuple[int, ...]
    accuracy: float

    @property
    def final(self) -> dict[str, Quantity]:
        """The last values with their errors."""
        units = self.setup.units
        return {name: Quantity(self.histories[name][-1], self.errors[name][-1], units[KIND[name]][1]) for name in DESCRIPTION}

    @property
    def warnings(self) -> tuple[str, ...]:
        """Doubts about the physics."""

        def history(name: str) -> Array:
            if name != "pressure_min":
                return self.histories[name]
            return self.setup.units["pressure"][0] * np.array([fields.pressure.min() for fields in self.run.fields])

        return self.setup.doubts(self.time, history)

    @property
    def dataset(self) -> Dataset:
        """Film and pressure on (time, r, theta), 0 ≤ θ ≤ π from the inlet, and the histories."""
        import xarray as xr

        units, first = self.setup.units, self.run.fields[0]
        coordinates = {
            "time": ("time", self.time, {"long_name": "time since the start of the sliding", "units": "s"}),
            "r": ("r", first.r * units["length"][0], {"long_name": "distance from the axis", "units": "m"}),
            "theta": ("theta", first.theta, {"long_name": "angle from the inlet", "units": "rad"}),
        }
        data: dict[str, tuple[Any, ...]] = {}
        for name, kind in (("film", "height"), ("pressure", "pressure")):
            values = np.array([getattr(fields, name) for fields in self.run.fields]) * units[kind][0]
            data[name] = (("time", "r", "theta"), values, {"long_name": name, "units": units[kind][1]})
        for name, text in DESCRIPTION.items():
            unit = units[KIND[name]][1]
            data[name] = ("time", self.histories[name], {"long_name": text, "units": unit})
            data[name + "_error"] = ("time", self.errors[name], {"long_name": f"error of the {text}", "units": unit})
        height = self.setup.unit_height
        attributes = {
            "title": "Start of sliding",
            "softlube_version": version("softlube"),
            "ended_by": self.run.ended_by,
            "accuracy": self.accuracy,
            "angles": json.dumps(self.angles),
            "warnings": json.dumps(self.warnings),
            "substrate": json.dumps(substrates.to_plain(self.setup.substrate_for(height))),
            "fluid": json.dumps(fluids.to_plain(self.setup.fluid_for(height))),
            "inputs_SI": json.dumps(asdict(self.setup) | dict(self.sliding)),
        }
        return xr.Dataset(data, coords=coordinates, attrs=attributes)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write `dataset` as NetCDF 4."""
        from softlube.files import check_destination, whole_file

        with whole_file(check_destination("output", path)) as temporary:
            self.dataset.to_netcdf(temporary, engine="h5netcdf")

    def plot(self, path: str | os.PathLike[str] | None = None) -> Figure:
        """Film and pressure along the direction of sliding at some times, and the histories."""
        from softlube.approach.picture import sliding_picture

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


def slide(
    *,
    radius: object = None,
    young_modulus: object = None,
    shear_modulus: object = None,
    viscosity: object = None,
    speed: object = None,
    load: object = None,
    approach_speed: object = None,
    height: Callable[[float], float] | None = None,
    history: str | os.PathLike[str] | None = None,
    initial_height: object = None,
    duration: object = None,
    film_limit: object = None,
    pressed: object = None,
    cavitation: str = "reynolds",
    density: object = 1000.0,
    thickness: object = None,
    poisson_ratio: object = 0.5,
    base: str = "bonded",
    pressure_viscosity: object = None,
    viscosity_law: str = "barus",
    density_law: str = "constant",
    accuracy: float = 2e-2,
    progress: Callable[[str], None] | None = None,
) -> Slide:
    """Follow a sphere that is moved through a film as by `softlube.squeeze` and slides from time 0 on.

    Quantities take text with a unit, a pint quantity, or a number in SI.

    Parameters
    ----------
    radius, young_modulus, shear_modulus, viscosity, density, thickness, poisson_ratio, base
        As for `softlube.squeeze`.
    pressure_viscosity, viscosity_law, density_law
        Likewise.
    load, approach_speed, height, history, initial_height, duration, film_limit
        Likewise; times count from the start of the sliding.
    speed
        Of the sliding.
    pressed
        How long the sphere is pressed by the load of time 0, without sliding, before.
    cavitation
        "reynolds" (no negative pressure) or "none".
    accuracy
        Relative error of the films aimed at, at every time.
    progress
        Called with a line of text after each step.

    Raises
    ------
    InputError
        If an input is missing, contradictory or impossible.
    NotConvergedError
        If the accuracy is not reached.
    """
    own = ("speed", "pressed", "cavitation", "accuracy", "progress")
    setup, motion = read_motion({name: value for name, value in locals().items() if name not in own})
    if not FINEST_ACCURACY <= accuracy <= COARSEST_ACCURACY:
        raise InputError(
            f"accuracy: expected a number from {FINEST_ACCURACY:g} to {COARSEST_ACCURACY:g} with sliding, got {accuracy!r}"
        )
    if speed is None:
        raise InputError(f"speed: missing; expected {KINDS['speed'][1]}")
    if cavitation not in get_args(Cavitation):
        raise InputError(f"cavitation: expected 'reynolds' or 'none', got {cavitation!r}")
    waited = 0.0 if pressed is None else in_unit("pressed", pressed, "s", "a time such as '10 s'")
    if waited < 0:
        raise InputError(f"pressed: expected a positive time, got {pressed!s}")
    velocity = si("speed", speed)
    beta = setup.beta(setup.unit_height, velocity)
    units = {name: value for name, (value, _) in setup.units.items()}

    def run(n_theta: int) -> tuple[SlidingStart, dict[str, Array]]:
        started = start_sliding(
            beta,
            motion,
            pressed=waited / units["time"],
            cavitation=cavitation,  # type: ignore[arg-type]
            n_theta=n_theta,
            # a coarser grid with longer steps, so that their difference tells of both
            tolerance=TOLERANCE * accuracy * (LADDER[1] / n_theta) ** 2,
            film_limit=setup.film_limit / setup.unit_height,
            progress=progress,
        )
        values = [measure(fields) for fields in started.fields]
        return started, {name: np.array([v[name] for v in values]) * units[KIND[name]] for name in DESCRIPTION}

    coarse, before = run(LADDER[0])
    worst = np.inf
    for step, n_theta in enumerate(LADDER[1:], 2):
        fine, histories = run(n_theta)
        # Where the film limit ended the runs, they end at slightly different times.
        end = min(coarse.time[-1], fine.time[-1])
        both = np.minimum(fine.time, end)
        errors = {}
        for name, values in histories.items():
            here = PchipInterpolator(fine.time, values)(both)
            errors[name] = np.abs(here - PchipInterpolator(coarse.time, before[name])(both))
        worst = max(float(np.max(errors[name] / histories[name])) for name in JUDGED)
        if worst <= accuracy:
            return Slide(
                setup=setup,
                sliding={"speed": velocity, "pressed": waited, "cavitation": cavitation},
                run=fine,
                time=fine.time * units["time"],
                histories=histories,
                errors=errors,
                time_error=float(abs(fine.time[-1] - coarse.time[-1])) * units["time"],
                angles=LADDER[:step],
                accuracy=accuracy,
            )
        coarse, before = fine, histories
    raise NotConvergedError(f"the film is known to {worst:.1e} only, not to {accuracy:.1e}; ask for less")
