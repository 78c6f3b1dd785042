"""Continuation in a parameter and in time, on systems whose solutions are known."""

from dataclasses import dataclass

import numpy as np
import pytest

from softlube.solvers.continuation import follow, settle
from softlube.solvers.newton import DenseEquation


@dataclass
class Scalar:
    """One equation R(x) = 0 with its derivative, by functions."""

    function: object
    derivative: object
    longest: float = np.inf

    constrained = np.zeros(1, dtype=bool)

    def linearise(self, x):
        return ScalarAt(self, x)


class ScalarAt:
    def __init__(self, system, x):
        self.residual = np.array([system.function(x[0])])
        self.jacobian = np.array([[system.derivative(x[0])]])
        self.scale = np.ones(1)
        self.longest = system.longest

    def times(self, step):
        return self.jacobian @ step

    def equation(self, free):
        return DenseEquation.of(self.jacobian, free)

    def reach(self, step):
        size = float(np.max(np.abs(step)))
        return size, min(1.0, self.longest / max(size, 1e-300))


def test_a_solution_is_followed_to_where_newton_would_not_find_it():
    """X = tan(1.5 t): from x = 0 Newton's method diverges for arctan x = 1.5, and the path leads there."""
    results = list(
        follow(
            lambda t: Scalar(lambda x: np.arctan(x) - 1.5 * t, lambda x: 1 / (1 + x**2)),
            np.zeros(1),
            first_step=0.2,
            shortest_step=1e-4,
        )
    )
    assert all(result.converged for result in results)
    assert results[-1].x[0] == pytest.approx(np.tan(1.5), rel=1e-5)
    assert len(results) > 3


def test_a_path_that_ends_is_given_up():
    """x² = 1 − 2t has no solution beyond t = 1/2: the last result has not converged, all before it have."""
    results = list(
        follow(lambda t: Scalar(lambda x: x**2 - 1 + 2 * t, lambda x: 2 * x), np.ones(1), first_step=0.2, shortest_step=1e-3)
    )
    assert not results[-1].converged
    assert all(result.converged for result in results[:-1])
    assert results[-2].x[0] == pytest.approx(0.0, abs=0.2)


def test_a_state_settles_at_the_steady_one():
    """dx/dt = −arctan x, in implicit Euler steps, settles at x = 0 from where Newton's method diverges."""

    def step(state, length):
        return Scalar(lambda x: (x - state[0]) / length + np.arctan(x), lambda x: 1 / length + 1 / (1 + x**2))

    steady = Scalar(np.arctan, lambda x: 1 / (1 + x**2))
    results = list(settle(steady, step, np.array([20.0]), 0.1, 1e-4, 30.0))
    assert results[-1].converged
    assert results[-1].x[0] == pytest.approx(0.0, abs=1e-6)
    states = [result.x[0] for result in results]
    assert states == sorted(states, reverse=True)
