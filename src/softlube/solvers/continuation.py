"""Ways to a solution that Newton's method does not find from where it is started: in a parameter, or in time.

Both are iterators that yield the results of Newton's method, one for each step, each the start of the next.  They know
systems of equations only through `softlube.solvers.newton.System`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from softlube.solvers.newton import NewtonResult, System, newton

Array = NDArray[np.floating]

EASY = 6
"""Newton steps up to which a step of the continuation was easy, and the next may be longer."""
PARAMETER_ITERATIONS = 25
"""Newton steps at most in one step of the parameter; more mean that a shorter step is cheaper."""
PARAMETER_GROWTH, PARAMETER_SHORTENING = 1.5, 2.5
"""Factors of the parameter's step: after an easy step, and, as a divisor, after one that failed."""
TIME_GROWTH, SMALL_TIME_GROWTH, TIME_SHORTENING = 3.0, 1.5, 4.0
"""Factors of the time step: after an easy step, after another one, and, as a divisor, after one that failed."""
TIME_TOLERANCE, TIME_ITERATIONS, MOST_TIME_STEPS = 1e-2, 12, 30
"""Tolerance and steps of Newton's method in one time step, whose result only starts the next; and time steps at most."""


def follow(
    system_at: Callable[[float], System], start: Array, *, first_step: float, shortest_step: float
) -> Iterator[NewtonResult]:
    """Natural parameter continuation from t = 0 to t = 1, with the secant through the last two solutions as predictor.

    A constrained unknown that is zero stays zero in the prediction, and no prediction is negative.

    Parameters
    ----------
    system_at : callable
        The system of equations at a parameter t, 0 < t ≤ 1.
    start : ndarray
        The solution at t = 0.
    first_step, shortest_step : float
        Step of t to begin with, and below which the continuation gives up.

    Yields
    ------
    NewtonResult
        One for each step that converged; the last has t = 1, or has not converged.
    """
    here, before, state, behind = 0.0, 0.0, start, start
    step = first_step
    while here < 1:
        there = min(here + step, 1.0)
        system = system_at(there)
        guess = state
        if here > before:
            secant = state + (there - here) / (here - before) * (state - behind)
            guess = np.where(system.constrained, np.where(state > 0, np.maximum(secant, 0), 0), secant)
        result = newton(system, guess, max_iterations=PARAMETER_ITERATIONS)
        if result.converged:
            yield result
            before, behind, here, state = here, state, there, result.x
            step *= PARAMETER_GROWTH if len(result.history) <= EASY else 1.0
            continue
        step = (there - here) / PARAMETER_SHORTENING
        if step < shortest_step:
            yield result
            return


def settle(
    steady: System,
    step_system: Callable[[Array, float], System],
    start: Array,
    first_step: float,
    shortest_step: float,
    longest_step: float,
) -> Iterator[NewtonResult]:
    """Pseudo-transient continuation: implicit steps in time, growing until the state is nearly the steady one.

    Where Newton's method goes astray from afar, a short enough step in time does not.

    Parameters
    ----------
    steady : System
        The equations of the steady state, which Newton's method solves from the last state.
    step_system : callable
        The equations of one implicit step, from a state and a step length.
    start : ndarray
        The state at the beginning.
    first_step, shortest_step, longest_step : float
        Time step to begin with, below which the stepping gives up, and beyond which the state is nearly steady.

    Yields
    ------
    NewtonResult
        One for each step that converged; the last is the steady state's and may not have converged.
    """
    state, step = start, first_step
    for _ in range(MOST_TIME_STEPS):
        equations = step_system(state, step)
        with np.errstate(over="ignore", invalid="ignore"):  # of iterates that go astray; a shorter step follows
            result = newton(equations, state, tolerance=TIME_TOLERANCE, max_iterations=TIME_ITERATIONS)
        if result.converged:
            yield result
            state = result.x
            if step > longest_step:
                break
            step *= TIME_GROWTH if len(result.history) <= EASY else SMALL_TIME_GROWTH
        else:
            step /= TIME_SHORTENING
            if step < shortest_step:
                break
    yield newton(steady, state)
