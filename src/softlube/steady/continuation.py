"""Ways to a solution that Newton's method does not find at once: in time, or in the liquid's thickening.

Iterators that yield solved states, each the next one's first guess.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from softlube.discretization import unsteady
from softlube.discretization.grid import PolarGrid
from softlube.discretization.system import ContactSystem
from softlube.model.problem import Problem
from softlube.solvers.newton import NewtonResult, newton

Array = NDArray[np.floating]

FIRST_STEP, SHORTEST_STEP, LONGEST_STEP = 0.1, 1e-4, 300.0
"""Steps in time over β: to start with, where it is given up, and from where on the state is the steady one.  Liquid takes about
2β to pass through the contact."""
LARGE_GROWTH, SMALL_GROWTH, SHORTENING = 3.0, 1.5, 4.0
"""Of the steps in time, after one that was easy, one that was not, and one that failed."""
STEP_TOLERANCE, STEP_ITERATIONS, MOST_STEPS = 1e-2, 12, 30
"""Of Newton's method in a step in time, where only the end counts; and steps at most."""
FIRST_RISE, SMALLEST_RISE = 2.0, 0.02
"""Of the largest ln η/η₀ in a dry contact, in one step: to start with, and where it is given up."""
STEPS = 25
"""Newton's at most, in one step of the thickening; more mean that a shorter step is cheaper."""
EASY = 6
"""Newton's steps up to which the next step may be longer."""


def settle(system: ContactSystem, start: Array) -> Iterator[NewtonResult]:
    """Let the film settle in time, from any first guess under which it is positive, in implicit steps that grow.

    What a sphere does that starts to slide.  Where Newton's method goes astray from afar a short enough step of this does not.

    Parameters
    ----------
    system : ContactSystem
        What is solved in the end.
    start : ndarray
        The unknowns at the beginning.

    Yields
    ------
    NewtonResult
        One for each step that was taken; the last is the steady state's, if it has converged.
    """
    mass, state, step = unsteady.mass_matrix(system), start, FIRST_STEP * system.beta
    film, shortest, longest = system.film(state), SHORTEST_STEP * system.beta, LONGEST_STEP * system.beta
    for _ in range(MOST_STEPS):
        equations = unsteady.Step(system, mass, 1 / step, -film / step)
        with np.errstate(over="ignore", invalid="ignore"):  # of iterates that go astray; a shorter step follows
            result = newton(equations, state, tolerance=STEP_TOLERANCE, max_iterations=STEP_ITERATIONS)
        if result.converged:
            yield result
            state, film = result.x, system.film(result.x)
            if step > longest:
                break
            step *= LARGE_GROWTH if len(result.history) <= EASY else SMALL_GROWTH
        else:
            step /= SHORTENING
            if step < shortest:
                break
    yield newton(system, state)


def thicken(problem: Problem, grid: PolarGrid, start: Array, rise: float, *, scale: float) -> Iterator[NewtonResult]:
    """Solve on one grid from constant viscosity to the problem's own liquid, in steps of its pressure dependence.

    Parameters
    ----------
    problem : Problem
        What is solved in the end.
    grid : PolarGrid
        Where.
    start : ndarray
        The unknowns at constant viscosity.
    rise : float
        About the largest ln η/η₀ at the end; steps are measured in it.
    scale : float
        Unit of height over the problem's own.

    Yields
    ------
    NewtonResult
        One for each step; the last is the problem's own if it has converged.
    """
    here, before, state, behind = 0.0, 0.0, start, start
    step = min(1.0, FIRST_RISE / rise)
    while here < 1:
        there = min(here + step, 1.0)
        guess = state
        if here > before:
            # Along the secant, but nobody leaves or enters a cavity by it.
            guess = state + (there - here) / (here - before) * (state - behind)
            if problem.cavitation == "reynolds":
                n = grid.n_unknown
                guess[:n] = np.where(state[:n] > 0, np.maximum(guess[:n], 0), 0)
        system = ContactSystem(replace(problem, liquid=problem.liquid.weakened(there)), grid, scale)
        result = newton(system, guess, max_iterations=STEPS)
        if result.converged:
            yield result
            before, behind, here, state = here, state, there, result.x
            step *= 1.5 if len(result.history) <= EASY else 1.0
            continue
        step = (there - here) / 2.5
        if step * rise < SMALLEST_RISE:
            yield result
            return
