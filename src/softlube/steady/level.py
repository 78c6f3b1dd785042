"""One grid of the ladder: the first guess, Newton's method, and what helps where it fails."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.discretization.measure import measure
from softlube.discretization.splines import Spline, bilinear
from softlube.discretization.system import ContactSystem
from softlube.discretization.unsteady import implicit_steps
from softlube.errors import NotConvergedError
from softlube.model.liquids import NewtonianLaw
from softlube.model.liquids.thinning import Tempered
from softlube.model.problem import Problem
from softlube.solvers.continuation import follow, settle
from softlube.solvers.newton import Iteration, newton
from softlube.steady.mesh import grid_for, with_trail
from softlube.steady.regime import Regime

Array = NDArray[np.floating]

TOLERANCE = 1e-6
"""Of Newton's method on every grid, the coarse ones too: results may be taken from them, and one more step there is cheap."""
STEPS, STEEP_STEPS = 40, 90
"""Steps of Newton's method at most on one grid, without and with a spike that must first move to its nodes."""
HELD_BETA = 1e3
"""β′ beyond which a load is first taken for an indentation."""
FIRST_RISE, SMALLEST_RISE = 2.0, 0.02
"""Steps of the largest ln η/η₀ in the continuation to the problem's liquid: the first, and the shortest before it gives up."""
SHORTEST_SHARE = 0.01
"""Step of the share of the liquid's thinning below which the continuation to all of it gives up."""
BLURRED_BETA, SKETCH_ANGLES = 50.0, 9
"""β′ up to which a contact on a substrate that remembers is solved from the first guess, and angular intervals of its sketch.

There the film is so thick that the contact's edge, whose place nobody knows beforehand, is broader than the cells."""
BETA_STEP, SHORTEST_BETA_STEP, BETA_GROWTH = 4.0, 1.1, 1.5
"""Factors of β in the march from there: the largest, the least before it gives up, and what it grows by after a step that did;
after one that did not its logarithm is halved.  A secant through the last two films is a worse start than the last one."""
FIRST_TIME, SHORTEST_TIME, LONGEST_TIME = 0.1, 1e-4, 300.0
"""Time steps over β of the film that settles: the first, the shortest before it gives up, and the length beyond which the
state is the steady one.  Liquid takes about 2β to pass through the contact."""


class Record(Protocol):
    """A piece of a method's history: a Newton step, a run of relaxation sweeps."""

    @property
    def count(self) -> int:
        """Number of steps or sweeps in it."""
        ...

    def summary(self) -> dict[str, Any]:
        """Plain values, ready for JSON."""
        ...


@dataclass(frozen=True)
class SavedRecord:
    """A record read back from a file, which keeps summaries only."""

    values: Mapping[str, Any]

    @property
    def count(self) -> int:
        """Number of steps or sweeps in it."""
        return int(self.values["sweeps"])

    def summary(self) -> dict[str, Any]:
        """The values."""
        return dict(self.values)


@dataclass(frozen=True)
class Level:
    """One grid on the way to the answer, as a solution remembers it.

    Attributes
    ----------
    n_r, n_theta : int
        Cells along r, and angular intervals.
    values : mapping of str to float
        The quantities on this grid.
    history : tuple of Record
        What the method did.
    seconds : float
        Time it took.
    fields : Fields or None
        Pressure and film; None where the level was read from a file.
    """

    n_r: int
    n_theta: int
    values: Mapping[str, float]
    history: tuple[Record, ...]
    seconds: float
    fields: Fields | None = None


@dataclass(frozen=True)
class Solved:
    """One solved grid, with all that the next grid starts from.

    Attributes
    ----------
    level : Level
        What a solution keeps of it.
    fields : Fields
        Pressure and film.
    x : ndarray
        The unknowns.
    grid : PolarGrid
        The grid.
    """

    level: Level
    fields: Fields
    x: Array
    grid: PolarGrid


def solve_level(regime: Regime, grid: PolarGrid, before: Solved | None = None) -> Solved:
    """Solve a contact on one grid.

    Parameters
    ----------
    regime : Regime
        The contact.
    grid : PolarGrid
        The grid.
    before : Solved, optional
        The solution on a coarser grid as first guess; without it the guess is formed from dry contacts.

    Raises
    ------
    NotConvergedError
        If Newton's method fails.
    """
    began = time.perf_counter()
    history: list[Iteration] = []
    x = _unknowns(regime, grid, None if before is None else prolong(before.x, before.grid, grid, regime), history)
    fields = ContactSystem(regime.problem, grid, regime.unit).fields(x)
    values = measure(fields, regime.edge_radius)
    level = Level(grid.n_r, grid.n_theta, values, tuple(history), time.perf_counter() - began, fields)
    return Solved(level, fields, x, grid)


def prolong(x: Array, coarse: PolarGrid, fine: PolarGrid, regime: Regime) -> Array:
    """Interpolate unknowns from one grid to another."""
    problem = regime.problem
    values = x[: coarse.n_unknown].reshape(coarse.n_r, -1)
    mirrored = np.concatenate([values[:2][::-1, ::-1], values])
    xi = (np.arange(-2, coarse.n_r) + 0.5) * coarse.d_xi
    xi_fine, s_fine = np.minimum(coarse.xi_of(fine.r[: fine.n_r]), xi[-1]), coarse.s_of(fine.theta)
    if regime.thick:  # a cubic rings at a spike, and the viscosity with it
        result = bilinear(xi, coarse.s, mirrored, xi_fine[:, None], s_fine)
    else:
        result = Spline.through(xi, coarse.s, mirrored)(xi_fine, s_fine)
    if not regime.suction:
        result = np.maximum(result, 0)
    return np.append(result.ravel(), x[-1]) if problem.load_controlled else result.ravel()


def _unknowns(regime: Regime, grid: PolarGrid, start: Array | None, history: list[Iteration]) -> Array:
    """The converged unknowns; Newton's steps are added to `history`."""
    if start is None and regime.thick:
        return _thickened(regime, grid, history)
    if start is None and regime.problem.liquid.thins:
        return _thinned(regime, grid, history)
    if start is None and regime.problem.substrate.memory is not None and regime.beta > BLURRED_BETA:
        reached, arrived = _marched(regime, grid, sketch(regime.problem), history)
        return reached.x if arrived else _settled(regime, ContactSystem(regime.problem, grid, regime.unit), history)
    system = ContactSystem(regime.problem, grid, regime.unit)
    result = newton(
        system,
        _first_guess(regime, system, history) if start is None else start,
        tolerance=TOLERANCE,
        max_iterations=STEEP_STEPS if regime.thick else STEPS,
    )
    history += result.history
    if result.converged:
        return result.x
    if regime.thick:
        return _thickened(regime, grid, history)
    return _thinned(regime, grid, history) if regime.problem.liquid.thins else _settled(regime, system, history)


@lru_cache(maxsize=4)
def sketch(problem: Problem) -> Solved:
    """A contact on a substrate that remembers on the coarsest grid, which shows where its edge is.

    It begins with a film so thick that the grid need not know, and follows the contact as β grows to the problem's and the edge
    sharpens in its place; or until the grid is too coarse.

    Raises
    ------
    NotConvergedError
        If Newton's method fails for the thick film.
    """
    problem = replace(problem, liquid=NewtonianLaw())  # the law of the liquid hardly moves the edge
    target = Regime.of(problem)
    faster = _at_beta(problem, problem.parameter * min(1.0, BLURRED_BETA / target.beta))
    regime, history = Regime.of(faster), list[Iteration]()
    grid = grid_for(regime, SKETCH_ANGLES)
    system = ContactSystem(faster, grid, regime.unit)
    x = newton(system, system.start(regime.first_height / system.scale), tolerance=TOLERANCE, max_iterations=STEPS)
    if not x.converged:
        raise _not_converged(regime, grid, x.history)
    sketched = _drawn(system, x.x)
    fitted = grid_for(target, SKETCH_ANGLES, [lambda plain: with_trail(plain, sketched.fields, target.unit)])
    return _marched(target, fitted, sketched, history)[0]


def _drawn(system: ContactSystem, x: Array) -> Solved:
    return Solved(Level(system.grid.n_r, system.grid.n_theta, {}, (), 0.0), system.fields(x), x, system.grid)


def _at_beta(problem: Problem, beta: float) -> Problem:
    """The problem at another β; what its substrate remembers is not changed."""
    return replace(problem, beta_load=beta) if problem.load_controlled else replace(problem, beta=beta)


def _marched(regime: Regime, grid: PolarGrid, start: Solved, history: list[Iteration]) -> tuple[Solved, bool]:
    """Follow a contact on another grid, from its β to the problem's as far as it goes; and whether it arrived."""
    problem = regime.problem
    # The contact at the start has a unit of length of its own, with which pressures scale, too, and heights with its square.
    unit = start.fields.r[-1] / start.grid.r[-1] / np.sqrt(regime.unit)
    scaled = start.x * unit
    if problem.load_controlled:
        scaled[-1] *= unit
    x, beta, reached = prolong(scaled, start.grid.scaled(unit), grid, regime), start.fields.beta, start
    there, factor = beta, BETA_STEP
    while True:
        system = ContactSystem(_at_beta(problem, there), grid, regime.unit)
        result = newton(system, x, tolerance=TOLERANCE, max_iterations=STEPS)
        history += result.history
        if result.converged:
            x, beta, reached = result.x, there, _drawn(system, result.x)
            if beta == problem.parameter:
                return reached, True
            factor = min(BETA_GROWTH * factor, BETA_STEP)
        elif there == start.fields.beta or factor < SHORTEST_BETA_STEP:
            return reached, False
        else:
            factor **= 0.5
        there = min(factor * beta, problem.parameter)


def _first_guess(regime: Regime, system: ContactSystem, history: list[Iteration]) -> Array:
    """Unknowns from dry contacts; under a load beyond `HELD_BETA`, from the contact with the dry contact's height.

    The step from a guess is safer with the height held, and the height is the dry contact's but for β^(−3/5).
    """
    problem = system.problem
    start = system.start(regime.first_height / system.scale, regime.viscosity)
    if not (problem.load_controlled and regime.beta > HELD_BETA):
        return start
    depth = regime.dry.indentation
    pressed = replace(
        problem,
        beta=problem.parameter * depth**2,
        beta_load=None,
        substrate=problem.substrate.in_units(depth),
        liquid=problem.liquid.in_units(depth),
        indenter=problem.indenter.in_units(depth),
    )
    held = newton(ContactSystem(pressed, system.grid, system.scale / depth), start[:-1])
    history += held.history
    return np.append(held.x, -depth / system.scale)


def _thickened(regime: Regime, grid: PolarGrid, history: list[Iteration]) -> Array:
    """Solve with constant viscosity, then follow the solution as the liquid's pressure dependence grows to its own."""
    problem, liquid = regime.problem, regime.problem.liquid

    def system_at(share: float) -> ContactSystem:
        return ContactSystem(replace(problem, liquid=liquid.weakened(share)), grid, regime.unit)

    plain = _unknowns(Regime.of(replace(problem, liquid=liquid.weakened(0.0))), grid, None, history)
    step = min(1.0, FIRST_RISE / regime.thickening)
    result = None
    for result in follow(system_at, plain, first_step=step, shortest_step=SMALLEST_RISE / regime.thickening):
        history += result.history
    if result is None or not result.converged:
        raise _not_converged(regime, grid, history)
    return result.x


def _thinned(regime: Regime, grid: PolarGrid, history: list[Iteration]) -> Array:
    """Solve with the viscosity of the inlet everywhere, then follow the solution as the liquid thins more and more."""
    problem = regime.problem

    def system_at(share: float) -> ContactSystem:
        return ContactSystem(replace(problem, liquid=Tempered(problem.liquid, share, 1 / regime.viscosity)), grid, regime.unit)

    constant = _at_beta(replace(problem, liquid=NewtonianLaw()), problem.parameter / regime.viscosity)
    plain = _unknowns(Regime.of(constant), grid, None, history)
    result = None
    for result in follow(system_at, plain, first_step=1.0, shortest_step=SHORTEST_SHARE):
        history += result.history
    if result is None or not result.converged:
        return _settled(regime, ContactSystem(problem, grid, regime.unit), history)
    return result.x


def _settled(regime: Regime, system: ContactSystem, history: list[Iteration]) -> Array:
    """Let the film settle in time, as under a sphere that starts to slide, where the direct start failed."""
    result = None
    start = system.start(regime.first_height / system.scale, regime.viscosity)
    times = [system.beta * each for each in (FIRST_TIME, SHORTEST_TIME, LONGEST_TIME)]
    for result in settle(system, implicit_steps(system), start, *times):
        history += result.history
    if result is None or not result.converged:
        raise _not_converged(regime, system.grid, history)
    return result.x


def _not_converged(regime: Regime, grid: PolarGrid, history: Sequence[Iteration]) -> NotConvergedError:
    last = history[-1] if history else Iteration(np.nan, np.nan, 0, 0)
    name = "beta_load" if regime.problem.load_controlled else "beta"
    return NotConvergedError(
        f"Newton's method did not converge at {name} = {regime.problem.parameter:.4g} on {grid.n_r} x {grid.n_theta} cells: "
        f"after {len(history)} steps the last was {last.step:.1e} (fraction {last.fraction:.2g})."
    )
