"""A sphere that starts to slide: the transient in the plane, with the cavitation condition.

In the frame of the sphere, normalised as in `softlube.transient.squeeze.rings`,

    ∂u/∂t + R(p, u) ≥ 0,     p ≥ 0,     p (∂u/∂t + R) = 0,     R = −∇·(u³∇p) − (1/β) ∂u/∂x,

R being the residual of the steady solver.  A node changes from film to cavity at instants that are not known beforehand, so no
ODE is left that a library's integrator could take: each implicit step is a complementarity problem, solved by the steady
solver's own Newton method.  The steps are those of the two-step backward differentiation formula (BDF2) with variable length.
"""

from __future__ import annotations

import math
from copy import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.elasticity import rim_slice
from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.discretization.measure import measure
from softlube.discretization.system import ContactSystem
from softlube.discretization.unsteady import Step, mass_matrix
from softlube.errors import InputError, NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.problem import Cavitation, Problem
from softlube.model.substrates import Substrate
from softlube.solvers.newton import newton
from softlube.solvers.progress import Listener, Progress
from softlube.steady.mesh import angles_for, grid_for
from softlube.steady.regime import Regime
from softlube.transient.motion import REACH, Motion
from softlube.transient.squeeze.integrate import integrate
from softlube.transient.squeeze.rings import SqueezeFilm

Array = NDArray[np.floating]

MILNE = 2 / 11
"""Error of BDF2 over its difference from the quadratic extrapolation, for equal steps."""
FIRST_STEP = 1e-3
"""Of the time in which a rigid sphere sinks by its own height, about, or of the duration."""
LONGEST_GROWTH, SAFETY = 1.6, 0.85
JUDGED_RADIUS = 3.0
"""Radius, over the contact's, within which the error of a step is judged."""
NEWTON_TOLERANCE = 1e-3
"""Of Newton's method in a step, over the tolerance of the step."""
LIMIT_MET = 0.1
"""Relative distance from the film limit that counts as met, over the tolerance of a step."""


def deepest_problem(beta: float, motion: Motion, cavitation: str) -> tuple[Problem, float]:
    """Steady sliding under the largest load or at the lowest height, whose mesh serves for the way there.

    Parameters
    ----------
    beta : float
        β with the motion's unit of height.
    motion : Motion
        Load or height.
    cavitation : {"reynolds", "none"}
        Of the problem.

    Returns
    -------
    problem : Problem
        What it slides like there.
    unit : float
        Its unit of height over the motion's.
    """
    parameters: dict[str, Any] = {}
    if motion.control == "load":
        unit = float((motion.samples.max() / HERTZ_LOAD) ** (2 / 3))
        parameters["beta_load"] = beta * unit**2
    else:
        lowest = float(motion.samples.min())
        unit = abs(lowest) or 1.0
        parameters |= {"beta": beta * unit**2, "height": int(np.sign(lowest))}
    models: dict[str, Any] = {"substrate": motion.substrate.in_units(unit), "liquid": motion.liquid.in_units(unit)}
    models["indenter"] = motion.indenter.in_units(unit)
    return Problem(**parameters, **models, cavitation=cavitation), unit  # type: ignore[arg-type]


def at_instant(system: ContactSystem, prescribed: float, speed: float, height: float) -> ContactSystem:
    """The system with the load or the height of an instant, and what a descent adds to the far field.

    That is Taylor's p = V/(4h²) at the rim, its deflection, its load beyond: a sphere one unit of height above the surface has
    half a percent of its load beyond the steady solver's rim.
    """
    grid, rim = system.grid, rim_slice(system.grid)
    speed = max(speed, 0.0) if system.problem.cavitation == "reynolds" else speed
    taylor = np.repeat(speed / (4 * (height + system.indenter.height(grid.r[grid.n_r :])) ** 2), grid.shape[1])
    other = copy(system)
    other.prescribed = prescribed
    other.rim_pressure = system.rim_pressure + np.outer([1, 0], taylor)
    deflection = system.elastic.deflection(np.concatenate([np.zeros(grid.n_unknown), taylor]))
    other.film_offset = system.film_offset + np.outer([1, 0], deflection)
    beyond = np.pi * speed / (2 * (height + float(system.indenter.height(grid.r[-1]))))
    other.load_offset = system.load_offset + np.array([1, 0]) * (taylor @ system.elastic.load_weights[rim] + beyond)
    return other


@dataclass(frozen=True)
class SlidingStart:
    """Films and pressures in the plane as a function of time.

    Attributes
    ----------
    time : ndarray, shape (k,)
        Accepted steps, the start included.
    fields : tuple of Fields
        Normalised like the motion.
    rejected : int
        Steps that were taken back.
    ended_by : {"duration", "film_limit"}
    """

    time: Array
    fields: tuple[Fields, ...]
    rejected: int
    ended_by: str

    @property
    def height(self) -> Array:
        """h₀ at every step."""
        return np.array([fields.height for fields in self.fields])

    @property
    def r(self) -> Array:
        """Radii of the grid's nodes."""
        return self.fields[0].r

    @property
    def theta(self) -> Array:
        """Angles of the grid's nodes from the inlet, 0 to π [rad]."""
        return self.fields[0].theta

    @property
    def films(self) -> Array:
        """Film thickness on (time, r, theta)."""
        return np.array([fields.film for fields in self.fields])

    @property
    def pressures(self) -> Array:
        """Pressure on (time, r, theta)."""
        return np.array([fields.pressure for fields in self.fields])

    @property
    def film_center(self) -> Array:
        """Film at the centre at every step."""
        return np.array([float(fields.film_at(0.0, 0.0)) for fields in self.fields])


def _extrapolated(times: list[float], values: list[Array], time: float) -> Array:
    """Polynomial through the last values (at most three) at a later time."""
    times, values = times[-3:], values[-3:]
    result = np.zeros_like(values[0])
    for i, own in enumerate(times):
        weight = np.prod([(time - other) / (own - other) for j, other in enumerate(times) if j != i])
        result += weight * values[i]
    return result


def _difference(times: list[float], films: list[Array], time: float) -> tuple[float, Array]:
    """Backward differentiation at a new time: weight of the new film, and the rest."""
    step = time - times[-1]
    if len(times) == 1:
        return 1 / step, -films[-1] / step
    ratio = step / (times[-1] - times[-2])
    before = ratio**2 / (1 + ratio) / step
    return (1 + 2 * ratio) / (1 + ratio) / step, before * films[-2] - (1 + ratio) / step * films[-1]


def check_substrate(substrate: Substrate) -> None:
    """Refuse a substrate that remembers: its memory moves with the surface, and would be another matrix for every time step.

    Raises
    ------
    InputError
        If it does.
    """
    if substrate.creep.terms:
        raise InputError(
            "substrate: a start of sliding on one that remembers is not solved, as what it remembers moves with its surface. "
            "Give the relaxed modulus alone if the film is slow beside every time, the instantaneous one if it is fast; or "
            "leave the sliding out, as a squeeze film is solved"
        )


def _check(motion: Motion, pressed: float, cavitation: str, tolerance: float) -> None:
    """Refuse what `start_sliding` does not take."""
    check_substrate(motion.substrate)
    by_load = motion.control == "load"
    if not 0 < tolerance <= 0.1:
        raise InputError(f"tolerance: expected a number from 0 to 0.1, got {tolerance!r}")
    if by_load and cavitation == "reynolds" and np.min(motion.samples) <= 0:
        raise InputError("load: not positive all the time; under the Reynolds condition the film cannot pull at the sphere")
    if pressed and not by_load:
        raise InputError("pressed: a sphere is pressed by a load; with its height given it only waits, so leave it out")


def grid_under(regime: Regime, motion: Motion, n_theta: int) -> PolarGrid:
    """The steady problem's grid, extended for a height that is prescribed.

    Under a load that changes the surface moves like Ṅ/r, so that the descent at the rim is not the sphere's; far out that is
    little.
    """
    grid = grid_for(regime, angles_for(regime, n_theta))
    if motion.control == "load":
        return grid
    n_r = max(grid.n_r, math.ceil(float(grid.xi_of(REACH * np.sqrt(2 * max(motion.samples)))) / grid.d_xi))
    return replace(grid, reach=float(grid.r_of(n_r * grid.d_xi)) / grid.edge).resized(n_r, grid.n_theta)


def before_sliding(
    motion: Motion, grid: PolarGrid, pressed: float, tolerance: float, progress: Listener | None
) -> tuple[Array, float]:
    """Pressure on the rings and height when the sliding starts, after the first load has acted for some time."""
    if not pressed:
        film = SqueezeFilm.on(grid, motion.control, motion.substrate, motion.liquid, motion.indenter)
        return motion.first_pressure(film), motion.initial_height
    first = motion.drive(0.0)
    held = replace(motion, drive=lambda _: first, duration=pressed)
    run = integrate(held, rings=grid, tolerance=tolerance, progress=progress)
    return run.pressures[-1], float(run.heights[-1])


def thinnest(fields: Fields, limit: float) -> float:
    """Least film, found between the nodes where it may be near a limit."""
    on_nodes = float(fields.film.min())
    return on_nodes if on_nodes > 1.5 * limit else measure(fields)["film_min"]


def start_sliding(
    beta: float,
    motion: Motion,
    *,
    pressed: float = 0.0,
    cavitation: Cavitation = "reynolds",
    n_theta: int = 18,
    tolerance: float = 1e-3,
    film_limit: float = 0.0,
    progress: Listener | None = None,
) -> SlidingStart:
    """Follow a sphere that is moved towards the substrate, or away, and slides from time 0 on.

    Parameters
    ----------
    beta : float
        β with the motion's unit of height, Eq. (6d) or (30); 1/β is the speed.
    motion : Motion
        The load or the height from the start of the sliding on.  Liquid takes about 2β to pass through the contact.
    pressed : float
        How long the sphere is pressed before, without sliding, by the load that it has at time 0.
    cavitation : {"reynolds", "none"}
        Reynolds condition, or negative pressures allowed.
    n_theta : int
        Angular intervals of the grid, that of the steady solver.
    tolerance : float
        Relative error of the film allowed in a time step.
    film_limit : float
        Minimum film at which to stop.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each time step.

    Raises
    ------
    InputError
        If an input is not as described.
    NotConvergedError
        If the time step becomes too small.

    Notes
    -----
    At the rim the pressure is that of steady sliding and of the descent in the step before.
    """
    by_load = motion.control == "load"
    _check(motion, pressed, cavitation, tolerance)
    problem, deepest = deepest_problem(beta, motion, cavitation)
    regime = Regime.of(problem)
    scale = regime.unit
    unit = deepest * scale
    motion = motion.in_units(unit)
    grid = grid_under(regime, motion, n_theta)
    system = ContactSystem(problem, grid, scale)
    mass = mass_matrix(system)
    rings, height = before_sliding(motion, grid, pressed * unit**1.5, min(1e-3 * tolerance, 1e-6), progress)
    x = np.repeat(rings[: grid.n_r], grid.shape[1])
    if by_load:
        x = np.append(x, height)
    descent = 4 * float(rings[-1]) * (height + float(motion.indenter.height(grid.r[-1]))) ** 2
    own = at_instant(system, motion.drive(0.0), descent, height)
    inside = np.repeat(grid.r < JUDGED_RADIUS, grid.shape[1])
    limit = film_limit / unit

    def told(own: ContactSystem, x: Array) -> Fields:
        return own.fields(x).in_units(1 / deepest)

    times, states, films, fields = [0.0], [x], [own.film(x)], [told(own, x)]
    least = thinnest(fields[0], film_limit) / unit if limit else np.inf
    if least <= limit:
        raise InputError(f"film_limit: the film starts at {least / limit:.3g} of the limit, not above it")
    step = min(FIRST_STEP * min(motion.initial_height * unit**2.5, motion.duration), motion.longest_step)
    rejected, ended_by = 0, "duration"
    while times[-1] < motion.duration * (1 - 1e-12) and ended_by == "duration":
        step = min(step, motion.duration - times[-1], motion.longest_step)
        time = times[-1] + step
        guess = _extrapolated(times, states, time)
        guess[system.constrained] = np.maximum(guess[system.constrained], 0.0)
        own = at_instant(system, motion.drive(time), descent, height)
        if np.min(own.film(guess)) <= 0:
            guess = states[-1]
        equations = Step(own, mass, *_difference(times, films, time))
        with np.errstate(over="ignore", invalid="ignore"):  # of iterates that go astray; a shorter step follows
            solved = newton(equations, guess, tolerance=NEWTON_TOLERANCE * tolerance)
        film_now = own.film(solved.x)
        error = MILNE * float(np.max(np.abs(film_now - _extrapolated(times, films, time))[inside] / film_now[inside]))
        # Without a past the extrapolation is too poor to judge by: the first two steps are short and taken as they are.
        judged = len(times) > 2
        if not solved.converged or (judged and error > tolerance):
            rejected += 1
            step *= 0.3 if not solved.converged else max(0.2, SAFETY * (tolerance / error) ** (1 / 3))
            if step < 1e-12 * motion.duration:
                raise NotConvergedError(f"the time integration failed at {times[-1] / motion.duration:.3g} of the time")
            continue
        now = told(own, solved.x)
        if limit:
            thinner = thinnest(now, film_limit) / unit
            if thinner < limit * (1 - LIMIT_MET * tolerance):
                # Back to where the chord between both films passes the limit.
                step *= (least - limit) / (least - thinner)
                continue
            least = thinner
            ended_by = "film_limit" if thinner <= limit * (1 + LIMIT_MET * tolerance) else "duration"
        descent, height = (height - own.height(solved.x)) / step, own.height(solved.x)
        times.append(time)
        fields.append(now)
        states.append(solved.x)
        films.append(film_now)
        if judged:
            step *= min(LONGEST_GROWTH, SAFETY * (tolerance / max(error, 1e-12)) ** (1 / 3))
        if progress is not None:
            steps = len(times) - 1
            progress(Progress(f"sliding: {100 * time / motion.duration:.3g} % of the time, step {steps}", steps))
    return SlidingStart(np.array(times) / unit**1.5, tuple(fields), rejected, ended_by)
