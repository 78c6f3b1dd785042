"""Marching in β: an iterator that yields solved states, each the next one's first guess."""

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
