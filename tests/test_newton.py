"""Newton's method on problems whose solutions are known otherwise."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import nnls

from softlube.newton import newton


@dataclass
class Linear:
    """R(x) = A x − b + cubic x³."""

    matrix: np.ndarray
    right: np.ndarray
    constrained: np.ndarray
    cubic: float = 0.0

    def linearise(self, x):
        return LinearAt(self, x)


class LinearAt:
    def __init__(self, system, x):
        self.residual = system.matrix @ x - system.right + system.cubic * x**3
        self.jacobian = system.matrix + np.diag(3 * system.cubic * x**2)
        self.scale = np.diag(self.jacobian)

    def times(self, step):
        return self.jacobian @ step

    def dense(self, free):
        return np.asfortranarray(self.jacobian[np.ix_(free, free)])

    def longest_step(self, step):
        return 1.0


def random_system(seed, cubic=0.0, constrained=True):
    rng = np.random.default_rng(seed)
    factor = rng.normal(size=(30, 30))
    matrix = factor @ factor.T + 5 * np.eye(30)
    return Linear(matrix, rng.normal(size=30) * 10, np.full(30, constrained), cubic), factor


@pytest.mark.parametrize("seed", range(5))
def test_linear_complementarity_is_a_bounded_least_squares_problem(seed):
    system, _ = random_system(seed)
    root = np.linalg.cholesky(system.matrix).T
    expected, _ = nnls(root, np.linalg.solve(root.T, system.right))
    result = newton(system, np.ones(30))
    assert result.converged
    assert result.x == pytest.approx(expected, abs=1e-9)
    residual = system.linearise(result.x).residual
    assert np.all(result.x >= 0)
    assert residual.min() > -1e-10
    assert np.max(np.abs(result.x * residual)) < 1e-9


def test_convergence_is_quadratic_without_bounds():
    system, _ = random_system(7, cubic=3.0, constrained=False)
    result = newton(system, np.zeros(30))
    steps = [iteration.step for iteration in result.history]
    assert result.converged
    assert np.max(np.abs(system.linearise(result.x).residual)) < 1e-9
    assert steps[-1] < 10 * steps[-2] ** 1.8


def test_a_singular_matrix_is_reported_and_not_raised():
    system = Linear(np.ones((3, 3)), np.arange(3.0), np.zeros(3, dtype=bool))
    result = newton(system, np.ones(3))
    assert not result.converged


def test_running_out_of_iterations_is_reported():
    system, _ = random_system(7, cubic=3.0, constrained=False)
    result = newton(system, np.full(30, 50.0), max_iterations=2)
    assert not result.converged
    assert len(result.history) == 2
