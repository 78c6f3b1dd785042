"""Newton's method on problems whose solutions are known otherwise."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.optimize import nnls

from softlube.solvers.newton import LINEAR_TOLERANCE, REUSE_BELOW, DenseEquation, newton


@dataclass
class Linear:
    """R(x) = A x − b + cubic x³."""

    matrix: np.ndarray
    right: np.ndarray
    constrained: np.ndarray
    cubic: float = 0.0
    exact: bool = False  # whether the preconditioner is the inverse itself

    def linearise(self, x):
        return LinearAt(self, x)


class LinearAt:
    def __init__(self, system, x):
        self.residual = system.matrix @ x - system.right + system.cubic * x**3
        self.jacobian = system.matrix + np.diag(3 * system.cubic * x**2)
        self.scale = np.diag(self.jacobian)
        self.exact = system.exact

    def times(self, step):
        return self.jacobian @ step

    def equation(self, free):
        return DenseEquation.of(self.jacobian, free) if self.exact else Scaled(self.times, free, self.scale[free])

    def reach(self, step):
        return float(np.max(np.abs(step))), 1.0


@dataclass
class Scaled:
    """J step = r on the free unknowns, divided by the diagonal."""

    times: Callable
    free: np.ndarray
    scale: np.ndarray

    def right(self, residual):
        assert np.all(residual[~self.free] == 0)
        return residual[self.free] / self.scale

    def operator(self, unknown):
        return self.times(self.step(unknown))[self.free] / self.scale

    def step(self, unknown):
        step = np.zeros(self.free.size)
        step[self.free] = unknown
        return step

    def at(self, times):
        return replace(self, times=times)


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
    result = newton(system, np.ones(30), tolerance=1e-13)
    assert result.converged
    assert result.x == pytest.approx(expected, abs=1e-9)
    residual = system.linearise(result.x).residual
    assert np.all(result.x >= 0)
    assert residual.min() > -1e-10
    assert np.max(np.abs(result.x * residual)) < 1e-9


@pytest.mark.parametrize("coupling", [1.5, 2.0, 4.0])
@pytest.mark.parametrize("start", [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]])
def test_a_circle_of_active_sets_is_left(coupling, start):
    """Whole steps never leave it for this P-matrix, whose solution is 1/(1 + a) everywhere (Ben Gharbia & Gilbert 2012)."""
    matrix = np.eye(3) + coupling * np.roll(np.eye(3), 2, axis=1)
    result = newton(Linear(matrix, np.ones(3), np.ones(3, dtype=bool), exact=True), np.array(start))
    assert result.converged
    assert result.x == pytest.approx(1 / (1 + coupling))
    assert len(result.history) < 12


def test_convergence_is_quadratic_where_the_linear_equations_are_solved_exactly():
    system, _ = random_system(7, cubic=3.0, constrained=False)
    system.exact = True
    result = newton(system, np.zeros(30), tolerance=1e-12)
    steps = [iteration.step for iteration in result.history]
    assert result.converged
    assert np.max(np.abs(system.linearise(result.x).residual)) < 1e-9
    assert steps[-1] < 10 * steps[-2] ** 1.8
    assert result.history[0].krylov == 1


def test_a_dense_equation_is_the_identity_and_gives_the_step():
    system, _ = random_system(4)
    at, free = system.linearise(np.ones(30)), np.arange(30) % 3 > 0
    equation, residual = DenseEquation.of(at.jacobian, free), np.where(free, np.arange(30.0), 0)
    unknown = np.random.default_rng(0).normal(size=free.sum())
    assert equation.operator(unknown) == pytest.approx(unknown, rel=1e-12)
    step = equation.step(equation.right(residual))
    assert np.all(step[~free] == 0)
    assert (at.jacobian @ step)[free] == pytest.approx(residual[free], abs=1e-11)
    # another Jacobian, old factors: the identity no more, but the same equation once GMRES has solved it
    other = equation.at(lambda x: 2 * (at.jacobian @ x))
    assert other.operator(unknown) == pytest.approx(2 * unknown, rel=1e-12)


@pytest.mark.parametrize("exact", [True, False])
def test_a_preconditioner_is_kept_while_the_steps_are_short(exact, monkeypatch):
    system, _ = random_system(7, cubic=3.0, constrained=False)
    system.exact = exact
    built = []
    linearise = system.linearise

    def counting(x):
        at = linearise(x)
        equation = at.equation
        at.equation = lambda free: built.append(1) or equation(free)
        return at

    system.linearise = counting
    result = newton(system, np.zeros(30), tolerance=1e-12)
    # Long steps, and the first short one, want their own.
    assert len(built) == 1 + sum(iteration.step >= REUSE_BELOW for iteration in result.history)
    assert len(built) < len(result.history)
    system.linearise = linearise
    # Linear equations are solved to 1e-3, so the last step of 1e-9 or less leaves this much.
    assert np.max(np.abs(system.linearise(result.x).residual)) < 1e-10


def test_otherwise_it_is_as_fast_as_they_are_solved_well():
    system, _ = random_system(7, cubic=3.0, constrained=False)
    result = newton(system, np.zeros(30), tolerance=1e-9)
    steps = [iteration.step for iteration in result.history]
    assert result.converged
    assert np.max(np.abs(system.linearise(result.x).residual)) < 1e-6
    assert steps[-1] < 30 * LINEAR_TOLERANCE * steps[-2]
    assert all(2 <= iteration.krylov <= 30 for iteration in result.history)


def test_the_tolerance_bounds_the_error():
    """It holds for the step that would come next, so the last one taken may be larger."""
    system, _ = random_system(7, cubic=3.0, constrained=False)
    exact = newton(system, np.zeros(30), tolerance=1e-14).x
    for tolerance in (1e-3, 1e-6):
        result = newton(system, np.zeros(30), tolerance=tolerance)
        assert np.max(np.abs(result.x - exact)) < tolerance < result.history[-1].step


def test_a_fraction_of_the_step_is_taken_where_the_whole_is_not_admissible():
    system, _ = random_system(3, constrained=False)

    class Careful(LinearAt):
        def reach(self, step):
            size = float(np.max(np.abs(step)))
            return size, min(1.0, 0.5 / size)

    system.linearise = lambda x: Careful(system, x)
    result = newton(system, np.zeros(30), tolerance=1e-9)
    taken = [iteration.fraction * iteration.step for iteration in result.history]
    assert result.converged
    assert result.x == pytest.approx(np.linalg.solve(system.matrix, system.right), abs=1e-8)
    assert result.history[0].fraction < 1
    assert result.history[-1].fraction == 1
    assert max(taken) <= 0.5 * (1 + 1e-12)


def test_a_singular_matrix_is_reported_and_not_raised():
    system = Linear(np.ones((3, 3)), np.arange(3.0), np.zeros(3, dtype=bool))
    result = newton(system, np.ones(3))
    assert not result.converged


def test_running_out_of_iterations_is_reported():
    system, _ = random_system(7, cubic=3.0, constrained=False)
    result = newton(system, np.full(30, 50.0), max_iterations=2)
    assert not result.converged
    assert len(result.history) == 2
