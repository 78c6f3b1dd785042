"""The start of sliding in SI units and to a stated accuracy: `softlube squeeze --speed`."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from softlube.approach.physical import in_unit, si
from softlube.approach.sliding import SlidingStart, start_sliding
from softlube.contact import Contact
from softlube.errors import InputError, NotConvergedError
from softlube.quantities import measure
from softlube.solution import Quantity

if TYPE_CHECKING:
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
KIND = {name: name.split("_")[0] for name in DESCRIPTION} | {"film_center": "height", "film_min": "height"}


@dataclass(frozen=True)
class Slide:
    """A sphere that starts to slide; all in SI units.

    Attributes
    ----------
    contact : Contact
        The input.
    run : SlidingStart
        The finest integration, normalised with the Hertz indentation of the load.
    time : ndarray, shape (k,)
        Time since the start of the sliding [s].
    histories, errors : mapping of str to ndarray, shape (k,)
        `DESCRIPTION` lists them, with estimates of |value − exact|.
    angles : tuple of int
        Angular intervals of the grids that were used.
    """

    contact: Contact
    run: SlidingStart
    time: Array
    histories: Mapping[str, Array]
    errors: Mapping[str, Array]
    angles: tuple[int, ...]

    @property
    def final(self) -> dict[str, Quantity]:
        """The last values with their errors."""
        scales = _scales(self.contact)
        return {name: Quantity(self.histories[name][-1], self.errors[name][-1], scales[KIND[name]][1]) for name in DESCRIPTION}

    @property
    def dataset(self) -> Dataset:
        """Film and pressure on (time, r, theta), 0 ≤ θ ≤ π from the inlet, and the histories."""
        import xarray as xr

        scales, first = _scales(self.contact), self.run.fields[0]
        coordinates = {
            "time": ("time", self.time, {"long_name": "time since the start of the sliding", "units": "s"}),
            "r": ("r", first.r * self.contact.unit_length, {"long_name": "distance from the axis", "units": "m"}),
            "theta": ("theta", first.theta, {"long_name": "angle from the inlet", "units": "rad"}),
        }
        data: dict[str, tuple[Any, ...]] = {}
        for name, kind in (("film", "height"), ("pressure", "pressure")):
            values = np.array([getattr(fields, name) for fields in self.run.fields]) * scales[kind][0]
            data[name] = (("time", "r", "theta"), values, {"long_name": name, "units": scales[kind][1]})
        for name, text in DESCRIPTION.items():
            unit = scales[KIND[name]][1]
            data[name] = ("time", self.histories[name], {"long_name": text, "units": unit})
            data[name + "_error"] = ("time", self.errors[name], {"long_name": f"error of the {text}", "units": unit})
        attributes = {"title": "Start of sliding under a load", "inputs_SI": json.dumps(self.contact.inputs())}
        return xr.Dataset(data, coords=coordinates, attrs=attributes)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write `dataset` as NetCDF 4."""
        from softlube.files import check_destination, whole_file

        with whole_file(check_destination("output", path)) as temporary:
            self.dataset.to_netcdf(temporary, engine="h5netcdf")

    def to_dict(self) -> dict[str, Any]:
        """Final values and what was done, ready for JSON."""
        return {
            "time": float(self.time[-1]),
            "final": {name: {"value": float(q), "error": q.error, "unit": q.unit} for name, q in self.final.items()},
            "angles": list(self.angles),
            "steps": self.time.size,
            "rejected_steps": self.run.rejected,
        }


def _scales(contact: Contact) -> dict[str, tuple[float, str]]:
    """SI value and unit of each normalised unit."""
    height, length = contact.unit_height, contact.unit_length
    pressure = 4 * np.pi * contact.shear_modulus * np.sqrt(height / contact.radius)
    return {
        "height": (height, "m"),
        "pressure": (pressure, "Pa"),
        "load": (pressure * length**2, "N"),
        "friction": (2 * np.pi / 3 * contact.shear_modulus * height**2, "N"),
        "time": (12 * contact.viscosity * contact.radius / (height * pressure), "s"),
    }


def slide(
    *,
    radius: object = None,
    young_modulus: object = None,
    shear_modulus: object = None,
    viscosity: object = None,
    load: object = None,
    speed: object = None,
    initial_height: object = None,
    duration: object = None,
    pressed: object = 0.0,
    cavitation: str = "reynolds",
    accuracy: float = 2e-2,
    progress: Callable[[str], None] | None = None,
) -> Slide:
    """Follow a sphere that is pressed onto a soft half-space by a constant load and starts to slide.

    Quantities take text with a unit, a pint quantity, or a number in SI.

    Parameters
    ----------
    radius, young_modulus, shear_modulus, viscosity, load, speed, cavitation
        As for `softlube.Contact`; the load is constant.
    initial_height
        Height of the lowest point over the undeformed surface at the start.
    duration
        How long to follow the sliding.
    pressed
        How long the sphere is pressed without sliding before.
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
    if callable(load):
        raise InputError("load, speed: a sphere that slides takes a constant load")
    if load is None:
        raise InputError("load: missing; a sphere that slides takes a constant load")
    if not FINEST_ACCURACY <= accuracy <= COARSEST_ACCURACY:
        raise InputError(
            f"accuracy: expected a number from {FINEST_ACCURACY:g} to {COARSEST_ACCURACY:g} with sliding, got {accuracy!r}"
        )
    for name, value in (("initial_height", initial_height), ("duration", duration)):
        if value is None:
            raise InputError(f"{name}: missing; expected {'a length' if name == 'initial_height' else 'a time'} with its unit")
    contact = Contact(
        radius=radius,
        young_modulus=young_modulus,
        shear_modulus=shear_modulus,
        viscosity=viscosity,
        load=load,
        speed=speed,
        cavitation=cavitation,
    )
    scales = _scales(contact)
    clock = scales["time"][0]
    times = {
        name: in_unit(name, value, "s", "a time such as '10 s'")
        for name, value in (("duration", duration), ("pressed", pressed))
    }
    if not times["duration"] > 0 or times["pressed"] < 0:
        raise InputError(f"duration, pressed: expected positive times, got {duration!s} and {pressed!s}")
    height = si("initial_height", initial_height) / contact.unit_height

    def run(n_theta: int) -> tuple[SlidingStart, dict[str, Array]]:
        started = start_sliding(
            contact.problem().parameter,
            initial_height=height,
            duration=times["duration"] / clock,
            pressed=times["pressed"] / clock,
            cavitation=cavitation,
            n_theta=n_theta,
            # a coarser grid with longer steps, so that their difference tells of both
            tolerance=TOLERANCE * accuracy * (LADDER[1] / n_theta) ** 2,
            progress=progress,
        )
        values = [measure(fields) for fields in started.fields]
        return started, {name: np.array([v[name] for v in values]) * scales[KIND[name]][0] for name in DESCRIPTION}

    coarse, before = run(LADDER[0])
    worst = np.inf
    for step, n_theta in enumerate(LADDER[1:], 2):
        fine, own = run(n_theta)
        same = {name: PchipInterpolator(coarse.time, before[name])(fine.time) for name in DESCRIPTION}
        errors = {name: np.abs(own[name] - same[name]) for name in DESCRIPTION}
        worst = max(float(np.max(errors[name] / own[name])) for name in JUDGED)
        if worst <= accuracy:
            return Slide(contact, fine, fine.time * clock, own, errors, LADDER[:step])
        coarse, before = fine, own
    raise NotConvergedError(f"the film is known to {worst:.1e} only, not to {accuracy:.1e}; ask for less")
