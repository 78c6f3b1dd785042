"""Marching in β, or in the liquid's thickening: iterators that yield solved states, each the next one's first guess."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from softlube.grid import PolarGrid
from softlube.newton import NewtonResult, newton
from softlube.problem import Problem
from softlube.system import ContactSystem

SMALLEST_RATIO = 1.02
FIRST_RISE, SMALLEST_RISE = 2.0, 0.02
"""Of the largest ln η/η₀ in a dry contact, in one step of the march: to start with, and where it is given up."""
STEPS = 25
"""Newton's at most, in one step of the march; more mean that a shorter march is cheaper."""
EASY = 6
"""Newton's steps up to which the march may go on in longer steps."""


def march(
    problem: Problem, grid: PolarGrid, *, scale: float = 1.0, first: float = 30.0, ratio: float = 3.0
) -> Iterator[NewtonResult]:
    """Solve on one grid from β = `first` (or its like under load control) to the problem's own, in geometric steps.

    For contacts, h₀ < 0, where one unit of height, `scale` times the problem's own, serves all β.

    A step that fails is halved (in ln β); the iterator ends, unconverged result last, when the ratio would fall below
    `SMALLEST_RATIO`.

    Yields
    ------
    NewtonResult
        One for each β; the last is the problem's own if it has converged.
    """
    target = np.log(problem.parameter)
    here = np.log(first)
    step = np.log(ratio) * np.sign(target - here)

    def attempt(log_beta: float, start: NDArray[np.floating] | None) -> NewtonResult:
        beta = float(np.exp(log_beta))
        there = replace(problem, beta_load=beta) if problem.load_controlled else replace(problem, beta=beta)
        system = ContactSystem(there, grid, scale)
        return newton(system, system.start() if start is None else start)

    result = attempt(here, None)
    yield result
    while result.converged and here != target:
        there = target if abs(target - here) <= abs(step) else here + step
        trial = attempt(there, result.x)
        if trial.converged:
            here, result = there, trial
            yield trial
        elif abs(step) / 2 < np.log(SMALLEST_RATIO):
            yield trial
            return
        else:
            step /= 2


def thicken(
    problem: Problem, grid: PolarGrid, start: NDArray[np.floating], rise: float, *, scale: float
) -> Iterator[NewtonResult]:
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
        system = ContactSystem(replace(problem, fluid=problem.fluid.weakened(there)), grid, scale)
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
