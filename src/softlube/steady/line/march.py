"""The way to the solution of a line contact: from a thick film of constant viscosity, on meshes that follow the solution."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.line.displacement import displacement
from softlube.discretization.line.equations import LineEquations, LineState
from softlube.discretization.line.panels import Panels
from softlube.errors import NotConvergedError
from softlube.model.exact import LINE_LOAD
from softlube.model.liquids import Liquid
from softlube.model.liquids.thinning import ThinningLaw
from softlube.model.problem import Problem
from softlube.solvers.newton import Iteration, newton
from softlube.steady.line.spike import foreseen, moved, steepest

Array = NDArray[np.floating]

THICK = 10.0
"""β up to which Newton's method arrives from a bump of pressure."""
THINNEST_START = 1e-4
"""β down to which it is tried before it gives up."""
RIGID_HEIGHT = 1.632
"""Height of a rigid cylinder under the load, times β (Martin 1916); tests/steady/line/test_march.py measures it."""
REACH = 1e4
"""Where the mesh ends, over the width of the pressure; beyond it the pressure is 4/(3βx³)."""
FIRST_EDGES = (0.0, 0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, *np.geomspace(10.0, REACH, 10))
"""Edges of the first mesh upstream of the free boundary, over the width of the pressure."""
FIRST_FRONT, FIRST_FILM = -0.6, 0.5
"""Free boundary over the width of the pressure, and least film over its square, that Newton's method starts from."""
POINTS = 10
"""Points on a panel on the way."""
RESOLVED = 1e-5
"""What the end of the pressure's expansion may be on a panel that is fine enough, see `unresolved`."""
SPARE = 1e-3
"""Part of that below which panels are joined."""
SPIKE = (
    ": as the liquid thickens, the pressure spike becomes narrower than the mesh can follow. Take Roelands' law and a density "
    "that rises with the pressure, as oils have them, or a lower load"
)
"""What is said where the liquid's viscosity cannot be reached."""
ROUNDS, LARGEST_MESH = 40, 250
"""Times at most that panels are split where the solution is not resolved, and panels at most."""
TOLERANCE = 1e-9
"""Of Newton's method: the largest relative change of the film that the next step would make."""
FIRST_STEP, SHORTEST_STEP = math.log(10.0), 1e-3
"""Continuation in ln β, and in the largest ln η/η₀: the first step, and the shortest, over the first, before it gives up."""
FIRST_SHARE = 0.5
"""First step of the share of the thinning."""
GROWTH = 1.5
"""Factor of the step after one that arrived; one that did not is halved."""


@dataclass(frozen=True, eq=False)
class Stage:
    """A solved problem.

    Attributes
    ----------
    equations : LineEquations
        With the problem on the way and the mesh.
    state : LineState
        The solution.
    history : tuple of Iteration
        Newton's steps on the last mesh.
    """

    equations: LineEquations
    state: LineState
    history: tuple[Iteration, ...] = ()

    @property
    def problem(self) -> Problem:
        """What was solved."""
        return self.equations.problem

    @property
    def panels(self) -> Panels:
        """The mesh."""
        return self.equations.panels


def solve_on(problem: Problem, panels: Panels, near: LineState) -> Stage | None:
    """Newton's method on a mesh from a state that is near; None if it does not converge."""
    equations = LineEquations(problem, panels, near)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # of iterates that go astray
        try:
            result = newton(equations, equations.vector(near), tolerance=TOLERANCE)
        except ValueError:  # an iterate went so far astray that its Jacobian is not finite
            return None
    return Stage(equations, equations.state(result.x), result.history) if result.converged else None


def transferred(stage: Stage, panels: Panels) -> LineState:
    """The state of a stage on another mesh."""
    old = stage.panels
    return replace(stage.state, gradient=old.evaluate(old.coefficients(stage.state.gradient), panels.nodes))


def unresolved(stage: Stage) -> Array:
    """How much the last two terms of the expansion of p′ on each panel change the pressure, over the largest pressure, or the
    film, over the least film.
    """
    panels = stage.panels
    left = panels.half * np.abs(panels.coefficients(stage.state.gradient))[:, -2:].sum(axis=1)
    pressure = float(np.max(np.abs(stage.equations.pressure(stage.state))))
    film = float(np.min(stage.equations.film(stage.state)))
    return left * np.maximum(1 / pressure, panels.half / film)


def resolved(stage: Stage | None, tolerance: float = RESOLVED) -> Stage | None:
    """A stage on a mesh that resolves it, from one that need not; None if there is none."""
    for _ in range(ROUNDS):
        if stage is None:
            return None
        coarse = unresolved(stage) > tolerance
        if not coarse.any():
            return stage
        if stage.panels.number + np.count_nonzero(coarse) > LARGEST_MESH:
            return None
        finer = stage.panels.split(coarse)
        stage = solve_on(stage.problem, finer, transferred(stage, finer))
    return None


def first(problem: Problem) -> Stage | None:
    """A thick film, from a bump of pressure."""
    width = math.sqrt(problem.substrate.compliance(1.0) + 2 * RIGID_HEIGHT / problem.parameter)
    edges = width * np.array(FIRST_EDGES)
    panels = Panels(np.concatenate([-edges[:0:-1], edges]) if problem.cavitation == "none" else edges, POINTS)
    s = np.maximum(panels.nodes, 0.0) / width
    gradient = s * (2 - 3 * s**2) / (1 + s**2) ** 3.5  # of p = s²/(1 + s²)^(5/2), which falls like the pressure of an open film
    moved = displacement(problem.substrate, panels)
    gradient *= LINE_LOAD / (moved.load @ gradient)
    front, film = FIRST_FRONT * width, FIRST_FILM * width**2
    height = film - float(np.min((front + moved.places) ** 2 / 2 - moved.matrix @ gradient))
    return resolved(solve_on(problem, panels, LineState(gradient, height, film, front)))


def followed(
    stage: Stage,
    problem_at: Callable[[float], Problem],
    start: float,
    end: float,
    first: float,
    *,
    spike: bool = False,
) -> Iterator[Stage]:
    """Continuation in a parameter from a stage, on meshes that follow the solution.

    Parameters
    ----------
    stage : Stage
        The solution at the start.
    problem_at : callable
        The problem at a parameter.
    start, end : float
        Where the parameter starts and ends, start ≤ end.
    first : float
        Step of the parameter to begin with.
    spike : bool
        Whether the mesh goes along with the steepest pressure, see `softlube.steady.line.spike`.

    Yields
    ------
    Stage
        The last is the one at the end.

    Raises
    ------
    NotConvergedError
        If the steps become too short.
    """
    here, step, steps = start, first, list[tuple[float, float]]()
    while here < end:
        there = min(here + step, end)
        problem = problem_at(there)
        mesh = stage.panels.joined(unresolved(stage) < SPARE * RESOLVED)
        near = transferred(stage, mesh)
        if move := foreseen(steps, there):
            mesh = moved(mesh, steps[-1][1], move)
        found = resolved(solve_on(problem, mesh, near))
        if found is None:
            step = (there - here) / 2
            if step < SHORTEST_STEP * first:
                advice = SPIKE if spike else ""
                raise NotConvergedError(f"the continuation ended at beta_load = {stage.problem.parameter:.4g}{advice}")
            continue
        stage, here = found, there
        if spike:
            steps.append((here, steepest(stage.panels, stage.state.gradient)))
        step *= GROWTH
        yield stage


@dataclass(frozen=True)
class Tempered(ThinningLaw):
    """A liquid that thins with a share of the logarithm of its fluidity, on the way to the liquid itself.

    Parameters
    ----------
    liquid : Liquid
        The liquid.
    share : float
        0 to 1.
    """

    share: float

    def fluidity_at(self, stress: Array) -> tuple[Array, Array]:
        """The share of ln ψ and of its derivative."""
        value, slope = self.liquid.fluidity_at(stress)
        return self.share * value, self.share * slope

    def flow_curve(self, rate: Array) -> Array:
        """The rate, which is more than the stress where ψ ≥ 1: a first guess, no more."""
        return np.maximum(rate, self.liquid.flow_curve(rate))


def march(problem: Problem) -> Iterator[Stage]:
    """Solve a thick film of constant viscosity, then thinner ones, then let the liquid thin and thicken.

    Yields
    ------
    Stage
        The last is that of the problem.

    Raises
    ------
    NotConvergedError
        If the way ends before the problem.
    """
    weak = problem.liquid.weakened(0.0)
    plain = Tempered(weak, 0.0) if weak.thins else weak

    def at(logarithm: float, liquid: Liquid = plain) -> Problem:
        beta = problem.parameter if logarithm >= target else math.exp(logarithm)
        return replace(problem, beta_load=beta, liquid=liquid)

    target = math.log(problem.parameter)
    start = min(math.log(THICK / problem.substrate.compliance(1.0)), target)
    stage = first(at(start))
    while stage is None and start > math.log(THINNEST_START):
        start -= FIRST_STEP
        stage = first(at(start))
    if stage is None:
        raise NotConvergedError("no first solution of the line contact was found; report the input.")
    yield stage
    ways: list[tuple[Callable[[float], Problem], float, float, float]] = [(at, start, target, FIRST_STEP)]
    if weak.thins:
        ways.append((lambda share: at(target, weak if share >= 1 else Tempered(weak, share)), 0.0, 1.0, FIRST_SHARE))
    for problem_at, begin, end, step in ways:
        for nearer in followed(stage, problem_at, begin, end, step):
            stage = nearer
            yield stage
    if weak == problem.liquid:
        return
    highest = np.array([np.max(stage.equations.pressure(stage.state))])
    rise = float(np.log(problem.liquid.viscosity(highest))[0])
    share = min(1.0, FIRST_STEP / max(rise, FIRST_STEP))

    def thicker(part: float) -> Problem:
        return at(target, problem.liquid if part >= 1 else problem.liquid.weakened(part))

    yield from followed(stage, thicker, 0.0, 1.0, share, spike=True)
