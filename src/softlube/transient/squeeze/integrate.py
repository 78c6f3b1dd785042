"""Integration in time: SciPy's implicit multistep method (BDF) with the exact Jacobian, adaptive in step and order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.sparse import csc_array

from softlube.discretization.grid import PolarGrid
from softlube.discretization.splines import lowest, slope_matrix
from softlube.errors import InputError, NotConvergedError
from softlube.solvers.progress import Listener, Progress
from softlube.solvers.threads import one_thread
from softlube.transient.motion import Motion
from softlube.transient.squeeze.memory import Memory
from softlube.transient.squeeze.rings import SqueezeFilm

Array = NDArray[np.floating]

BALANCE_RADIUS = 2.0
"""Radius, over that of the grid's edge, within which the balance of volume is checked."""
FAR_ABOVE = 4.0
"""Height of the indenter's surface over that at the grid's edge beyond which the film's own size says nothing."""
REMEMBERED = 1e-4
"""Pressure below which what is remembered needs no relative accuracy, over the radius of the grid's edge."""
ROUND_OFF = 1e4
"""Round-off of the pressure times this is the least tolerance on what is remembered: Newton's method asks for 10⁻³ of that."""
HISTORIES = ("film_center", "film_min", "film_min_radius", "pressure_center", "pressure_max", "pressure_min", "height", "load")
"""Quantities of a squeeze film that are functions of the time; see `softlube.model.quantities`."""


@dataclass(frozen=True)
class Run:
    """One integration on one grid.

    Attributes
    ----------
    film : SqueezeFilm
        The discrete equations.
    motion : Motion
        The load or the height that was followed.
    tolerance : float
        Relative tolerance of the integrator on the film.
    time : ndarray, shape (k,)
        The accepted steps.
    films, pressures : ndarray, shape (k, N)
        Film thickness and pressure on the rings.
    heights, loads : ndarray, shape (k,)
        Height h₀ of the sphere's lowest point over the undeformed surface, and load ∫p dA.
    volume, inflow : ndarray, shape (k,)
        Liquid within `BALANCE_RADIUS`, and what has flowed in since the start, integrated on its own.
    ended_by : {"duration", "film_limit"}
        What the integration stopped at.
    evaluations : int
        Number of evaluations of ∂u/∂t.
    dense : callable
        States of the film at any times, shape (times, k), by the integrator's own interpolant.
    """

    film: SqueezeFilm
    motion: Motion
    tolerance: float
    time: Array
    films: Array
    pressures: Array
    heights: Array
    loads: Array
    volume: Array
    inflow: Array
    ended_by: str
    evaluations: int
    dense: Callable[[Array], Array]

    @property
    def r(self) -> Array:
        """Radii of the rings."""
        return self.film.grid.r

    @property
    def volume_error(self) -> float:
        """Largest defect of the balance of volume, over the largest change of the volume."""
        change = self.volume - self.volume[0]
        return float(np.max(np.abs(change - self.inflow)) / np.max(np.abs(change), initial=1e-300))

    def histories(self, time: Array | None = None) -> dict[str, Array]:
        """The `HISTORIES` at the steps, or at other times up to the last step."""
        if time is None:
            return read(self.film, self.films, self.pressures, self.heights, self.loads)
        return read(self.film, *_fields(self.film, self.motion, time, self.dense(time)))


def _fields(film: SqueezeFilm, motion: Motion, time: Array, states: Array) -> tuple[Array, Array, Array, Array]:
    """Films and pressures on all rings, heights and loads, from the states of the film, shape (times, k)."""
    drive = np.array([float(motion.drive(t)) for t in time])
    pressures = film.pressure(states, drive)
    return film.whole_film(states, drive), pressures, film.height(states, drive), pressures @ film.load_weights


def read(film: SqueezeFilm, films: Array, pressures: Array, heights: Array, loads: Array) -> dict[str, Array]:
    """The `HISTORIES` of fields at some times."""
    least, radius = _lowest(film, films)
    return {
        "film_center": _center(films),
        "film_min": least,
        "film_min_radius": radius,
        "pressure_center": _center(pressures),
        "pressure_max": -_lowest(film, -pressures)[0],
        "pressure_min": _lowest(film, pressures)[0],
        "height": heights,
        "load": loads,
    }


def _center(fields: Array) -> Array:
    """Value at r = 0 of fields even in r, by the quartic through the three innermost rings."""
    return fields[:, :3] @ np.array([150.0, -25.0, 3.0]) / 128


def _lowest(film: SqueezeFilm, fields: Array) -> tuple[Array, Array]:
    """Least value of each field and its radius, of the cubic spline."""
    xi = film.grid.xi
    mirrored = np.concatenate([fields[:, 2::-1], fields], axis=1)
    slopes = mirrored @ slope_matrix(np.concatenate([-xi[2::-1], xi]))[3:].T
    # The cubic about the centre is even.
    line = np.stack([fields, slopes])
    center = np.stack([fields[:, :1] - slopes[:, :1] * xi[0] / 2, np.zeros((len(fields), 1))])
    place, least = lowest(np.append(0.0, xi), np.concatenate([center, line], axis=-1))
    return least, film.grid.r_of(place)


def least_on_nodes(film: Array) -> float:
    """Least film, by the parabola through the lowest ring and its neighbours."""
    lowest = int(np.argmin(film))
    if not 0 < lowest < film.size - 1:
        return float(film[lowest])
    before, here, after = film[lowest - 1 : lowest + 2]
    bend = before - 2 * here + after
    return float(here - (before - after) ** 2 / (8 * bend)) if bend > 0 else float(here)


@one_thread
def integrate(
    motion: Motion,
    *,
    rings: int | PolarGrid,
    tolerance: float,
    film_limit: float = 0.0,
    progress: Listener | None = None,
) -> Run:
    """Follow the film through a motion.

    Parameters
    ----------
    motion : Motion
        What moves the sphere, and over what.
    rings : int or PolarGrid
        Rings of the grid that suits the motion, or a grid.
    tolerance : float
        Relative error of the film allowed in a time step.
    film_limit : float
        Minimum film at which to stop.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` every 20 steps.

    Raises
    ------
    InputError
        If the film is below the limit from the start.
    NotConvergedError
        If the time step becomes too small.

    Notes
    -----
    The integrator works on u − s with a constant s(r) = max(0, f(r) − 4f(edge)): its relative tolerance is one of the film
    where that is thin, and one of h₀ far outside, where the film's own size, r²/2, says nothing.  It conserves volume, which is
    linear in this unknown, to round-off.
    """
    grid = motion.grid(rings) if isinstance(rings, int) else rings
    film = SqueezeFilm.on(grid, motion.control, motion.substrate, motion.liquid, motion.indenter)
    n = film.n
    shape = film.shape[:n]
    added = np.minimum(shape, FAR_ABOVE * motion.indenter.height(grid.edge))  # to the lift
    inside = max(3, int(np.searchsorted(grid.r, BALANCE_RADIUS * grid.edge)))
    to_inflow, to_volume = film.inflow_weights(inside), film.volume_weights(inside)
    memory = Memory(film)
    pressure = motion.first_pressure(film)
    first = film.lift_under(motion.yielded(film.shape) * pressure, motion.initial_height)
    thinnest = float(np.min(first + shape))
    if thinnest <= film_limit:
        raise InputError(
            f"initial_height, film_limit: the film starts at {thinnest / motion.initial_height:.3g} of the initial height, not "
            f"above the limit, {film_limit / motion.initial_height:.3g} of it"
        )

    def state(z: Array) -> Array:
        return memory.state(z[..., :n] - added, z[..., n + 1 :])

    def rate(t: float, z: Array) -> Array:
        now, drive = state(z), float(motion.drive(t))
        flux = film.flux(now, drive)
        return memory.rate(np.append(film.rate(flux), to_inflow @ flux), z[n + 1 :], now, drive)

    def jacobian(t: float, z: Array) -> Array | csc_array:
        by_state = film.flux_derivative(state(z), float(motion.drive(t)))
        return memory.jacobian(film.rate(by_state), to_inflow @ by_state)

    steps = 0

    def above_limit(t: float, z: Array) -> float:
        nonlocal steps
        steps += 1
        if progress is not None and steps % 20 == 0:
            progress(Progress(f"{grid.n_r} rings: {100 * t / motion.duration:.3g} % of the time, step {steps}", steps))
        return least_on_nodes(z[:n] - added + shape) - film_limit

    above_limit.terminal = True  # type: ignore[attr-defined]
    remembered = memory.at_first(motion.taken_up(film.shape) * pressure)
    least = np.full(n + 1 + remembered.size, 1e-5 * tolerance * grid.edge**2)
    least[n + 1 :] = np.maximum(REMEMBERED * tolerance * grid.edge, ROUND_OFF * memory.round_off(first + added))
    least[n] = 0.1 * tolerance * float(to_volume @ (first + shape))
    with np.errstate(over="ignore", invalid="ignore"):  # BDF computes with rows that it has not filled yet
        result = solve_ivp(
            rate,
            (0.0, motion.duration),
            np.concatenate([first + added, [0.0], remembered]),
            method="BDF",
            jac=jacobian,
            rtol=tolerance,
            atol=least,
            max_step=motion.longest_step,
            events=above_limit,
            dense_output=True,
        )
    if not result.success or result.sol is None:
        raise NotConvergedError(
            f"the time integration failed at {result.t[-1] / motion.duration:.3g} of the time: {result.message}"
        )
    interpolant = result.sol
    films, pressures, heights, loads = _fields(film, motion, result.t, state(result.y.T))
    return Run(
        film=film,
        motion=motion,
        tolerance=tolerance,
        time=result.t,
        films=films,
        pressures=pressures,
        heights=heights,
        loads=loads,
        volume=films[:, :n] @ to_volume,
        inflow=result.y[n],
        ended_by="film_limit" if result.status == 1 else "duration",
        evaluations=result.nfev,
        dense=lambda times: state(interpolant(times).T),
    )
