"""The way to the solution of a line contact: from a thick film of constant viscosity, on meshes that follow the solution."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from softlube.discretization.line.displacement import displacement
from softlube.discretization.line.equations import LineEquations, LineState
from softlube.discretization.line.panels import Panels
from softlube.errors import NotConvergedError
from softlube.model.problem import Problem
from softlube.solvers.newton import Iteration, newton

Array = NDArray[np.floating]

THICK = 10.0
"""β up to which Newton's method arrives from a bump of pressure."""
RIGID_HEIGHT = 1.633
"""Height of a rigid cylinder under the load times β: 4.896 ηŨR/N, Martin 1916."""
REACH = 1e4
"""Where the mesh ends, over the width of the pressure; beyond it the pressure is 4/(3βx³)."""
FIRST_EDGES = (0.0, 0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, *np.geomspace(10.0, REACH, 10))
"""Edges of the first mesh, from the free boundary, over the width of the pressure."""
POINTS = 10
"""Points on a panel."""
STEP = math.log(10.0)
"""First step of the continuation in ln β."""
FIRST_RISE, SMALLEST_STEP = 2.0, 1e-2
"""First step of the largest ln η/η₀, and smallest step of either continuation before it gives up."""
ROUNDS = 40
"""Times at most that panels are split where the solution is not resolved."""
LARGEST_MESH = 200
"""Panels at most."""
RESOLVED = 1e-5
"""What is left of the pressure at the end of its expansion on a panel that is fine enough."""
SPARE = 1e-3
"""Part of that below which panels may be joined."""
TOLERANCE = 1e-9
"""Of Newton's method: change of the film that the next step would make."""


@dataclass(frozen=True, eq=False)
class Stage:
    """A solved problem on the way.

    Attributes
    ----------
    equations : LineEquations
        With the mesh.
    state : LineState
        The solution.
    history : tuple of Iteration
        Newton's steps on the last mesh.
    """

    equations: LineEquations
    state: LineState
    history: tuple[Iteration, ...] = ()


def equations_for(problem: Problem, panels: Panels, near: LineState) -> LineEquations:
    """The equations of a problem on a mesh, near a state."""
    return LineEquations(
        panels,
        problem.parameter,
        problem.liquid,
        displacement(problem.substrate, panels),
        problem.cavitation == "reynolds",
        near,
    )


def solve_on(problem: Problem, panels: Panels, near: LineState) -> Stage | None:
    """Newton's method on a mesh from a state that is near; None if it does not converge."""
    equations = equations_for(problem, panels, near)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        result = newton(equations, equations.vector(near), tolerance=TOLERANCE)
    if not result.converged:
        return None
    return Stage(equations, equations.state(result.x), result.history)


def transferred(panels: Panels, state: LineState, new: Panels) -> LineState:
    """A state on another mesh."""
    return replace(state, gradient=panels.evaluate(panels.coefficients(state.gradient), new.nodes))


def unresolved(stage: Stage) -> Array:
    """What the last two terms of the pressure's expansion on each panel change, over the pressure and over the film it bears."""
    panels, gradient = stage.equations.panels, stage.state.gradient
    left = panels.half * np.abs(panels.coefficients(gradient))[:, -2:].sum(axis=1)
    pressure = float(np.max(np.abs(stage.equations.pressure(stage.state))))
    film = float(np.min(stage.equations.film(stage.state)))
    return left * np.maximum(1 / pressure, panels.half / film)


def resolved(problem: Problem, stage: Stage | None, tolerance: float = RESOLVED) -> Stage | None:
    """A stage on a mesh that resolves it, from one that need not; None if there is none."""
    for _ in range(ROUNDS):
        if stage is None:
            return None
        panels = stage.equations.panels
        coarse = unresolved(stage) > tolerance
        if not coarse.any():
            return stage
        if panels.number + np.count_nonzero(coarse) > LARGEST_MESH:
            return None
        finer = panels.split(coarse)
        stage = solve_on(problem, finer, transferred(panels, stage.state, finer))
    return None


def thinned(stage: Stage, tolerance: float = RESOLVED) -> tuple[Panels, LineState]:
    """Mesh and state of a stage without the panels that it does not need."""
    panels = stage.equations.panels
    joined = panels.joined(unresolved(stage) < SPARE * tolerance)
    return joined, transferred(panels, stage.state, joined)


def first(problem: Problem) -> Stage | None:
    """A thick film, from a bump of pressure."""
    width = math.sqrt(1 + 2 * RIGID_HEIGHT / problem.parameter)
    edges = width * np.array(FIRST_EDGES)
    if problem.cavitation == "none":
        edges = np.concatenate([-edges[:0:-1], edges])
    panels = Panels(edges, POINTS)
    s = np.maximum(panels.nodes, 0.0) / width
    gradient = (s - s**2) * np.exp(-2 * s)
    moved = displacement(problem.substrate, panels)
    gradient *= 0.25 / (moved.load @ gradient)
    front = -0.6 * width
    film = (front + moved.places) ** 2 / 2 - moved.matrix @ gradient
    thickness = 0.5 * width**2
    return resolved(problem, solve_on(problem, panels, LineState(gradient, thickness - np.min(film), thickness, front)))


def march(problem: Problem) -> Iterator[Stage]:
    """Solve a thick film of constant viscosity, then thinner ones, then thicken the liquid.

    Raises
    ------
    NotConvergedError
        If the way ends before the problem.
    """
    target = math.log(problem.parameter)
    here, share, step, rise = min(math.log(THICK), target), 0.0, STEP, 0.0
    weak = problem.liquid.weakened(0.0)

    def at(place: float, part: float) -> Problem:
        liquid = problem.liquid if part == 1 else problem.liquid.weakened(part) if part else weak
        return replace(problem, beta_load=math.exp(place) if place < target else problem.parameter, liquid=liquid)

    stage = first(at(here, 0.0))
    if stage is None:
        raise NotConvergedError("Newton's method found no first solution; report the input.")
    yield stage
    if weak == problem.liquid:
        share = 1.0
    rise = 0.0
    while here < target or share < 1:
        if here < target:
            there, part = min(here + step, target), share if share == 1 else 0.0
        else:
            if not rise:
                highest = np.max(stage.equations.pressure(stage.state))
                rise = min(1.0, FIRST_RISE / max(float(np.log(problem.liquid.viscosity(np.array([highest]))[0])), 1e-9))
            there, part = here, min(share + rise, 1.0)
        new = at(there, part)
        found = resolved(new, solve_on(new, *thinned(stage)))
        if found is None:
            if here < target:
                step = (there - here) / 2
            else:
                rise = (part - share) / 2
            if max(step, rise) < SMALLEST_STEP or (here >= target and rise < 1e-3):
                raise NotConvergedError("no way to the solution")
            continue
        stage, here = found, there
        if there >= target and part:
            share = part
            rise *= 1.5
        yield stage
