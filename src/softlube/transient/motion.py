"""The motion of a sphere: a load or a height as a function of time, normalised as in `softlube.transient.squeeze.rings`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from softlube.discretization.grid import PolarGrid
from softlube.errors import InputError, NotConvergedError
from softlube.model import indenters, substrates
from softlube.model import liquids as liquids
from softlube.model.dry import PARABOLOID, DryContact, dry_contact_at
from softlube.model.indenters import Shape
from softlube.model.liquids import Liquid, NewtonianLaw
from softlube.model.substrates import HalfSpaceKernel, Substrate
from softlube.transient import drives
from softlube.transient.creep import relaxed_loads, taken_up
from softlube.transient.squeeze.rings import Control, SqueezeFilm, radial_moment

Array = NDArray[np.floating]

REACH = 30.0
"""Radius where the far field takes over, in units of the contact or of √(2h₀), whichever is larger."""
EDGE_WIDTH, MOVING_EDGE_WIDTH, LEAST_EDGE_WIDTH = 0.1, 0.2, 0.003
"""Width of the refined zone at the contact's edge, over its radius: at most under a load, where the height is given (the edge
then moves), and at least."""
NECK, NECK_EXPONENT = 0.5, -0.36
"""Under a load the neck at the edge of the dimple has the width NECK × time^NECK_EXPONENT over the contact radius; fitted to
computed films."""
THIN = 5.0
"""How many e-folds a rigid sphere has sunk, by Taylor's law, when the film is called thin."""
RINGS_FOR_GROWTH = 16.0
"""How much the grid's coordinate grows by a band of even cells where the contact grows by creep, over that part of the radius.

While a contact doubles its radius and the film at its edge thins to 3·10⁻⁴, 181 rings give that film to 6·10⁻⁴; without a
band they gave it to 7 %."""
DAMPING, LARGEST_ITERATIONS = 0.4, 200
"""Damping factor, and most steps, of the fixed-point iteration for the pressure at the start."""
LEAST_FLUIDITY = 1e-12
"""Fluidity η₀/η below which a liquid is taken to thicken without bound at the start."""
SAMPLES = 2001
"""Number of times at which a history is evaluated to find its extremes."""


@dataclass(frozen=True)
class Motion:
    """A history of the load or of the height.

    Parameters
    ----------
    control : {"load", "height"}
        What is prescribed.
    drive : callable
        Load ∫p dA, or height h₀ of the sphere's lowest point over the undeformed surface, at a time from 0 to `duration`.
    initial_height : float
        h₀ at the start, positive.
    duration : float
        End of the history.
    longest_step : float
        No time step is longer, so that none leaps over a feature of the history.
    substrate : Substrate
        What the sphere moves over; lengths over √(R × unit of height).
    liquid : Liquid
        The law of the viscosity; pressures over 4πG√(unit of height/R).
    indenter : Shape
        The indenter's surface; lengths over √(R × unit of height).
    """

    control: Control
    drive: Callable[[float], float]
    initial_height: float
    duration: float
    longest_step: float = np.inf
    substrate: Substrate = field(default_factory=HalfSpaceKernel)
    liquid: Liquid = field(default_factory=NewtonianLaw)
    indenter: Shape = PARABOLOID

    def __post_init__(self) -> None:
        if self.control not in ("load", "height"):
            raise InputError(f"control: expected 'load' or 'height', got {self.control!r}")
        for name in ("initial_height", "duration"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise InputError(f"{name}: expected a positive, finite number, got {value!r}")
        if np.any(self.liquid.density(np.ones(1))[1]):
            raise InputError("liquid: the density must be constant where the film changes with time")
        if not np.all(np.isfinite(self.samples)):
            raise InputError("history: not a finite number at every time from 0 to its end")
        if self.control == "load" and not np.any(self.samples):
            raise InputError("load: zero all the time; nothing moves the sphere")

    def to_plain(self) -> dict[str, Any]:
        """The motion in plain values, for files.

        Raises
        ------
        InputError
            If its history is a function of the time that cannot be written down.
        """
        plain = {
            "control": self.control,
            "drive": drives.to_plain(self.drive),
            "initial_height": self.initial_height,
            "duration": self.duration,
            "longest_step": self.longest_step if np.isfinite(self.longest_step) else None,
            "substrate": substrates.to_plain(self.substrate),
            "liquid": liquids.to_plain(self.liquid),
        }
        # A paraboloid looks as it did before there were other shapes.
        return plain if self.indenter == PARABOLOID else plain | {"indenter": indenters.to_plain(self.indenter)}

    @classmethod
    def from_plain(cls, values: Mapping[str, Any]) -> Motion:
        """The motion that `to_plain` wrote."""
        parts: dict[str, Any] = {
            "drive": drives.from_plain(values["drive"]),
            "longest_step": np.inf if values["longest_step"] is None else values["longest_step"],
            "substrate": substrates.from_plain(values["substrate"]),
            "liquid": liquids.from_plain(values["liquid"]),
            "indenter": indenters.from_plain(values.get("indenter")),
        }
        return cls(**(dict(values) | parts))

    @cached_property
    def samples(self) -> Array:
        """The history at evenly spaced times."""
        return drives.sampled(self.drive, np.linspace(0, self.duration, SAMPLES))

    def in_units(self, unit: float) -> Motion:
        """The motion normalised with another unit of height, given over the present one."""
        clock, size = unit**1.5, unit**-1.5 if self.control == "load" else 1 / unit
        return replace(
            self,
            drive=lambda t: size * self.drive(t / clock),
            initial_height=self.initial_height / unit,
            duration=self.duration * clock,
            longest_step=self.longest_step * clock,
            substrate=self.substrate.in_units(unit),
            liquid=self.liquid.in_units(unit),
            indenter=self.indenter.in_units(unit),
        )

    @cached_property
    def deepest(self) -> DryContact | None:
        """The dry contact at the lowest height, None for a sphere that stays above the undeformed surface.

        Under a load: the one under the largest load, unless a rigid sphere, sinking by Taylor's law, does not come so far.
        """
        samples = self.samples
        if self.control == "height":
            lowest = float(samples.min())
            return dry_contact_at(self.substrate, indentation=-lowest, indenter=self.indenter) if lowest < 0 else None
        largest = float(self._relaxed_loads.max())
        dry = dry_contact_at(self.substrate, load=largest, indenter=self.indenter) if largest > 0 else None
        return dry if dry is not None and self._rigid_height <= dry.indentation else None

    @cached_property
    def _relaxed_loads(self) -> Array:
        """`softlube.transient.creep.relaxed_loads` of the `samples`: those that press the relaxed substrate as far."""
        first = self.taken_up(np.zeros(1))[:, 0]
        return relaxed_loads(self.substrate.creep, first, self.samples, self.duration / (SAMPLES - 1))

    @property
    def _radius_when_thin(self) -> float:
        """Radius of the dry contact once the film is thin, from where it grows by creep; infinite where it does not grow so."""
        if self.control == "height" or not self.substrate.creep.terms:
            return np.inf
        sunk = 2 / np.pi * self.duration / SAMPLES * np.cumsum(np.maximum(self.samples, 0.0))
        load = float(np.max(self._relaxed_loads[: 1 + int(np.searchsorted(sunk, THIN))]))
        return dry_contact_at(self.substrate, load=load, indenter=self.indenter).radius if load > 0 else np.inf

    @property
    def _rigid_height(self) -> float:
        """Height that a rigid sphere sinks to under a load by Taylor's law, h₀ exp(−(2/π) ∫N dt)."""
        impulse = self.duration * float(np.mean(np.maximum(self.samples, 0.0)))
        return self.initial_height * float(np.exp(-min(2 * impulse / np.pi, 50.0)))

    @property
    def lowest_height(self) -> float:
        """Lowest h₀ that the motion comes to, estimated beforehand: that of `deepest`, or a rigid sphere's."""
        if self.control == "height":
            return float(self.samples.min())
        return self._rigid_height if self.deepest is None else -self.deepest.indentation

    def taken_up(self, shape: Array) -> Array:
        """Share of the first pressure that each term of the creep has taken up, see `softlube.transient.creep.taken_up`."""
        return taken_up(self.substrate.creep, self.control, self._first_speed, self.initial_height, shape)

    def yielded(self, shape: Array) -> Array:
        """Part of its compliance by which the substrate has yielded to the first pressure, J₀ + ΣJᵢ times `taken_up`."""
        return self.substrate.creep.instantaneous + np.array(
            [term.weight for term in self.substrate.creep.terms]
        ) @ self.taken_up(shape)

    @cached_property
    def _first_speed(self) -> float:
        """Speed of approach at the start; under a load that of Taylor's law, N = πV/(2h₀)."""
        start = float(self.drive(0.0))
        if self.control == "load":
            return 2 * start * self.initial_height / np.pi
        instant = 1e-6 * self.duration
        return (start - float(self.drive(instant))) / instant

    def first_pressure(self, film: SqueezeFilm) -> Array:
        """Pressure at the start, on all rings.

        A sphere that comes down has done so from afar: the pressure is what drives the liquid out from under it at the speed
        (or with the load) of the start, −φu³ ∂p/∂r = V r/2 with the film that this pressure makes; Taylor's p = V/(4u²) where
        the substrate hardly yields.  A sphere that is to be pulled away stands still at first: p = 0.

        Raises
        ------
        NotConvergedError
            If the liquid thickens so much that no pressure drives it out.
        """
        if self._first_speed <= 0:
            return np.zeros_like(film.shape)
        speed = 1.0 if self.control == "load" else self._first_speed
        grid, yielded = film.grid, self.yielded(film.shape)
        pressure = np.zeros_like(film.shape)
        for _ in range(LARGEST_ITERATIONS):
            u = self.initial_height + film.shape + film.compliance @ (yielded * pressure)
            fluidity, _ = film.liquid.fluidity(pressure)
            if np.min(fluidity) < LEAST_FLUIDITY:
                break
            slope = _slope_for(film.liquid, speed * grid.r / (2 * fluidity), u)
            spline = CubicSpline(grid.xi, slope * grid.dr_dxi(grid.r)).antiderivative()
            # Beyond the last ring Taylor's pressure, as steep as the pressure is there.
            driven = spline(grid.xi[-1]) - spline(grid.xi) + slope[-1] * u[-1] / (2 * grid.r[-1])
            if self.control == "load":
                driven *= float(self.drive(0.0)) / film.load(driven)
            change = driven - pressure
            # p goes like u⁻³, so a full step would overshoot threefold where the deflection makes most of the film.
            pressure = pressure + DAMPING * change
            if np.max(np.abs(change)) < 1e-10 * np.max(pressure):
                return pressure
        raise NotConvergedError(
            "no pressure was found that drives the liquid out at the start: the viscosity rises too steeply with the pressure"
        )

    def yielding(self) -> float:
        """Estimate of the substrate's largest deflection over the film, from Taylor's pressure at the first and lowest height.

        Of a substrate that creeps it is the deflection at once, by which the film tells the pressure.
        Infinite where the sphere comes down to the undeformed surface.
        """
        lowest = self.lowest_height
        if lowest <= 0:
            return np.inf
        film = SqueezeFilm.on(self.grid(64), self.control, self.substrate, indenter=self.indenter)
        steps = np.diff(self.samples) * (SAMPLES - 1) / self.duration
        shares = []
        for height in (self.initial_height, lowest):
            taylor = (height + film.shape) ** -2.0
            strength = np.max(np.abs(self.samples)) / film.load(taylor) if self.control == "load" else np.max(np.abs(steps)) / 4
            shares.append(strength * self.substrate.creep.instantaneous * float((film.compliance @ taylor)[0]) / height)
        return max(shares)

    def grid(self, n_r: int) -> PolarGrid:
        """Rings that suit the history: dense at the largest contact's edge, or within √(2h₀) of a sphere that stays above."""
        dry, lowest = self.deepest, self.lowest_height
        edge, band = np.sqrt(max(2 * lowest, 0.05 * self.initial_height)), 1.0
        if dry is None:
            width = 0.5
        else:
            edge = max(edge, dry.radius)
            # The time in units of the load's own, for which a half-space's edge is at 1: near its edge every contact is like
            # Hertz's of the same p/√(a − r).
            narrowing = NECK * (self.duration * (edge * dry.edge_rise) ** 3) ** NECK_EXPONENT
            width = MOVING_EDGE_WIDTH if self.control == "height" else np.clip(narrowing, LEAST_EDGE_WIDTH, EDGE_WIDTH)
            band = min(self._radius_when_thin / edge, 1.0)
            band = band if 1 - band > width else 1.0  # the zone at the edge holds it
        reach = REACH * max(
            1.0, np.sqrt(2 * max(self.initial_height, self.samples.max() if self.control == "height" else 0)) / edge
        )
        return PolarGrid(
            n_r=n_r,
            n_theta=6,
            edge_width=float(width),
            reach=float(reach),
            edge=float(edge),
            band=float(band),
            band_share=float(RINGS_FOR_GROWTH * (1 - band)),
        )


def constant_load(load: float, initial_height: float, duration: float) -> Motion:
    """A motion under a constant load."""
    return Motion("load", drives.Constant(load), initial_height, duration)


def constant_speed(speed: float, initial_height: float, duration: float) -> Motion:
    """A motion at a constant speed of approach; a negative speed is a separation."""
    return Motion("height", drives.Descent(initial_height, speed), initial_height, duration)


def points(time: ArrayLike, values: ArrayLike) -> tuple[Array, Array]:
    """Times and values of a history as arrays.

    Raises
    ------
    InputError
        If there are fewer than two points, the times do not increase from 0, or a number is not finite.
    """
    time, values = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    if time.ndim != 1 or time.shape != values.shape or time.size < 2:
        raise InputError("history: expected at least two points of time and load or height")
    if not (np.all(np.isfinite(time)) and np.all(np.isfinite(values))):
        raise InputError("history: expected finite numbers only")
    if time[0] != 0 or np.any(np.diff(time) <= 0):
        raise InputError("history: expected times that start at 0 and increase")
    return time, values


def history(control: Control, time: ArrayLike, values: ArrayLike, initial_height: float | None = None) -> Motion:
    """A motion whose load or height is given at some times; see `softlube.transient.drives.Points`.

    Parameters
    ----------
    control : {"load", "height"}
        What the values are.
    time, values : array_like
        Points, the first at time 0.
    initial_height : float, optional
        Under a load; of a height it is the first value.

    Raises
    ------
    InputError
        If there are fewer than two points, times that do not increase from 0, or values that are no numbers.
    """
    time, values = points(time, values)
    if control == "height":
        initial_height = float(values[0])
    if initial_height is None:
        raise InputError("initial_height: missing; a history of the load does not say where the sphere starts")
    return Motion(
        control,
        drives.Points(tuple(time.tolist()), tuple(values.tolist())),
        initial_height,
        float(time[-1]),
        longest_step=max(2 * float(np.diff(time).min()), float(time[-1]) / 2000),
    )


def _slope_for(liquid: Liquid, flux: Array, film: Array) -> Array:
    """−∂p/∂r that drives a flux over the fluidity at rest, u³ times it for constant viscosity, see `radial_moment`."""
    if not liquid.thins:
        return flux / film**3
    wanted = 6 * flux / film**2
    difference = wanted.copy()
    for _ in range(LARGEST_ITERATIONS):
        moment, mobility = radial_moment(liquid, difference)
        step = (np.log(moment) - np.log(wanted)) * moment / (mobility * difference)  # of ln b, with a slope from 1 to 1/n
        difference *= np.exp(-step)
        if np.max(np.abs(step)) < 1e-12:
            break
    return difference / (6 * film)
