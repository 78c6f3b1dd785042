"""A sphere that starts to slide under a load: the transient in the plane, with the cavitation condition.

In the frame of the sphere, normalised as in `softlube.approach.rings` with the Hertz indentation of the load as unit,

    ∂u/∂t + R(p, u) ≥ 0,     p ≥ 0,     p (∂u/∂t + R) = 0,     R = −∇·(u³∇p) − (1/β) ∂u/∂x,

R being the residual of the steady solver.  A node changes from film to cavity at instants that are not known beforehand, so no
ODE is left that a library's integrator could take: each implicit step is a complementarity problem, solved by the steady
solver's own Newton method.  The steps are those of the two-step backward differentiation formula (BDF2) with variable length.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from softlube.approach.integrate import integrate
from softlube.approach.motion import Motion
from softlube.approach.rings import SqueezeFilm
from softlube.elasticity import rim_slice
from softlube.errors import InputError, NotConvergedError
from softlube.fields import Fields
from softlube.limits import HERTZ_LOAD
from softlube.meshing import grid_for
from softlube.newton import newton
from softlube.problem import Problem
from softlube.reynolds import Sparse
from softlube.solver import fields_of
from softlube.system import ContactSystem, LinearisedContact

Array = NDArray[np.floating]

MILNE = 2 / 11
"""Error of BDF2 over its difference from the quadratic extrapolation, for equal steps."""
FIRST_STEP = 1e-3
"""Of the time in which a rigid sphere sinks by its own height."""
LONGEST_GROWTH, SAFETY = 1.6, 0.85
JUDGED_RADIUS = 3.0
"""Radius, over the contact's, within which the error of a step is judged."""
NEWTON_TOLERANCE = 1e-2
"""Of Newton's method in a step, over the tolerance of the step."""


def mass_matrix(system: ContactSystem) -> Sparse:
    """What ∂u/∂t on all nodes adds to the balances of the cells, shape (n_unknown, n).

    The balance is taken per unit of ξ and s.  In the innermost ring it leaves out 1/12 of the mean flux through the ring's
    edge (see `softlube.reynolds`), so the same share of what that flux fills is left out here.
    """
    grid = system.grid
    n, n_angles = grid.n_unknown, grid.shape[1]
    r = grid.r[: grid.n_r]
    metric = np.outer(r * grid.dr_dxi(r), grid.dtheta_ds(grid.s))
    mean = np.full(n_angles, 1 / grid.n_theta)
    mean[[0, -1]] /= 2
    first = np.diag(metric[0]) - np.outer(np.ones(n_angles), mean * metric[0]) / 12
    inner = sparse.block_diag([first, sparse.diags_array(metric[1:].ravel())])
    return Sparse(sparse.hstack([inner, sparse.csr_array((n, grid.r.size * n_angles - n))]))


def descending(system: ContactSystem, speed: float, height: float) -> ContactSystem:
    """The system with what a descent adds to the far field: Taylor's p = V/(4h²) at the rim, its deflection, its load beyond.

    A sphere one unit of height above the surface has half a percent of its load beyond the steady solver's rim.
    """
    grid, rim = system.grid, rim_slice(system.grid)
    speed = max(speed, 0.0) if system.problem.cavitation == "reynolds" else speed
    taylor = np.repeat(speed / (4 * (height + grid.r[grid.n_r :] ** 2 / 2) ** 2), grid.shape[1])
    other = copy(system)
    other.rim_pressure = system.rim_pressure + np.outer([1, 0], taylor)
    deflection = system.substrate.deflection(np.concatenate([np.zeros(grid.n_unknown), taylor]))
    other.film_offset = system.film_offset + np.outer([1, 0], deflection)
    beyond = np.pi * speed / (2 * (height + grid.r[-1] ** 2 / 2))
    other.load_offset = system.load_offset + np.array([1, 0]) * (taylor @ system.substrate.load_weights[rim] + beyond)
    return other


@dataclass(frozen=True)
class LinearisedStep(LinearisedContact):
    """Residual and Jacobian of one implicit step, (∂u/∂t)ₙ₊₁ = weight uₙ₊₁ + known; see `softlube.newton.Linearised`."""

    mass: Sparse
    weight: float
    known: Array

    @cached_property
    def residual(self) -> Array:
        """Reynolds residual with the film's rate, then the load's defect."""
        growth = self.mass @ (self.weight * self.film + self.known)
        return super().residual + np.append(growth, 0.0)

    @cached_property
    def _derivatives(self) -> tuple[Sparse, Sparse]:
        by_pressure, by_film = super()._derivatives
        return by_pressure, Sparse(by_film + self.weight * self.mass)


class Step:
    """One implicit step as a `softlube.newton.System`; see `LinearisedStep`."""

    def __init__(self, system: ContactSystem, mass: Sparse, weight: float, known: Array) -> None:
        self.system, self.mass, self.weight, self.known = system, mass, weight, known
        self.constrained = system.constrained

    def linearise(self, x: Array) -> LinearisedStep:
        """Residual and Jacobian at x."""
        return LinearisedStep(self.system, x, self.mass, self.weight, self.known)


@dataclass(frozen=True)
class SlidingStart:
    """Films and pressures in the plane as a function of time.

    Attributes
    ----------
    time : ndarray, shape (k,)
        Accepted steps, the start included.
    fields : tuple of Fields
        Normalised with the Hertz indentation of the load.
    rejected : int
        Steps that were taken back.
    """

    time: Array
    fields: tuple[Fields, ...]
    rejected: int

    @property
    def height(self) -> Array:
        """h₀ at every step."""
        return np.array([fields.height for fields in self.fields])

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


def start_sliding(
    beta_load: float,
    *,
    initial_height: float,
    duration: float,
    pressed: float = 0.0,
    cavitation: str = "reynolds",
    n_theta: int = 18,
    tolerance: float = 1e-3,
    progress: Callable[[str], None] | None = None,
) -> SlidingStart:
    """Follow a sphere that comes down under its load and slides from time 0 on, or from a later time.

    Parameters
    ----------
    beta_load : float
        β with the Hertz indentation of the load, Eq. (30); 1/β is the speed.
    initial_height : float
        Height over the undeformed surface at the start, over the Hertz indentation, positive.
    duration : float
        Of the sliding, in units of 16ηR²/(πN).  Liquid takes about 2β to pass through the contact.
    pressed : float
        How long the sphere is pressed without sliding before; time 0 is the start of the sliding.
    cavitation : {"reynolds", "none"}
        Reynolds condition, or negative pressures allowed.
    n_theta : int
        Angular intervals of the grid, that of the steady solver.
    tolerance : float
        Relative error of the film allowed in a time step.
    progress : callable, optional
        Called with a line of text after each step.

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
    problem = Problem(beta_load=beta_load, cavitation=cavitation)  # type: ignore[arg-type]
    if not 0 < tolerance <= 0.1:
        raise InputError(f"tolerance: expected a number from 0 to 0.1, got {tolerance!r}")
    motion = Motion("load", lambda _: HERTZ_LOAD, initial_height, duration)
    grid = grid_for(problem, n_theta)
    system = ContactSystem(problem, grid)
    mass = mass_matrix(system)
    rings, height = motion.first_pressure(SqueezeFilm.on(grid, "load")), initial_height
    if pressed:
        before = integrate(
            replace(motion, duration=pressed), rings=grid, tolerance=min(1e-3 * tolerance, 1e-6), progress=progress
        )
        rings, height = before.pressures[-1], float(before.heights[-1])
    x = np.append(np.repeat(rings[: grid.n_r], grid.shape[1]), height)
    descent = 4 * float(rings[-1]) * (height + grid.r[-1] ** 2 / 2) ** 2
    own = descending(system, descent, height)
    inside = np.repeat(grid.r < JUDGED_RADIUS, grid.shape[1])

    times, states, films, fields = [0.0], [x], [own.film(x)], [fields_of(own, x)]
    step, rejected = min(FIRST_STEP * initial_height, duration), 0
    while times[-1] < duration * (1 - 1e-12):
        step = min(step, duration - times[-1])
        time = times[-1] + step
        guess = _extrapolated(times, states, time)
        guess[system.constrained] = np.maximum(guess[system.constrained], 0.0)
        own = descending(system, descent, float(states[-1][-1]))
        if np.min(own.film(guess)) <= 0:
            guess = states[-1]
        solved = newton(Step(own, mass, *_difference(times, films, time)), guess, tolerance=NEWTON_TOLERANCE * tolerance)
        film = own.film(solved.x)
        error = MILNE * float(np.max(np.abs(film - _extrapolated(times, films, time))[inside] / film[inside]))
        # Without a past the extrapolation is too poor to judge by: the first two steps are short and taken as they are.
        judged = len(times) > 2
        if not solved.converged or (judged and error > tolerance):
            rejected += 1
            step *= 0.3 if not solved.converged else max(0.2, SAFETY * (tolerance / error) ** (1 / 3))
            if step < 1e-12 * duration:
                raise NotConvergedError(f"the time integration failed at {times[-1] / duration:.3g} of the time")
            continue
        descent = float(states[-1][-1] - solved.x[-1]) / step
        times.append(time)
        fields.append(fields_of(own, solved.x))
        states.append(solved.x)
        films.append(film)
        if judged:
            step *= min(LONGEST_GROWTH, SAFETY * (tolerance / max(error, 1e-12)) ** (1 / 3))
        if progress is not None:
            progress(f"sliding: {100 * time / duration:.3g} % of the time, step {len(times) - 1}")
    return SlidingStart(np.array(times), tuple(fields), rejected)
