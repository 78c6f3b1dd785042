"""The coupled equations: exact Jacobian, far field, first guess."""

import numpy as np
import pytest

from softlube.grid import PolarGrid
from softlube.limits import far_field_profile
from softlube.problem import Problem
from softlube.system import ContactSystem

GRID = PolarGrid(20, 10, layer=0.1)
PROBLEMS = [
    Problem(beta=50.0),
    Problem(beta=50.0, cavitation="none"),
    Problem(beta_load=80.0),
    Problem(beta_load=80.0, cavitation="none"),
]


def state(problem):
    """A point near a solution, perturbed so that nothing vanishes by chance."""
    system = ContactSystem(problem, GRID)
    rng = np.random.default_rng(3)
    x = system.start()
    x[: GRID.n_unknown] += 0.002 * rng.random(GRID.n_unknown)
    return system, x, rng.normal(size=x.size)


@pytest.mark.parametrize("problem", PROBLEMS)
def test_jacobian_against_complex_step(problem):
    system, x, direction = state(problem)
    step = 1e-25
    height = x + 1j * step * direction
    # The film and the residual are analytic in x, so the complex step differentiates the whole chain to round-off.
    n = GRID.n_unknown
    h0 = height[-1] if problem.load_controlled else -1.0
    pressure = np.concatenate([height[:n], system.rim_pressure[0] + h0 * system.rim_pressure[1]])
    film = system.influence @ height[:n] + system.film_offset[0] + h0 * system.film_offset[1]
    numeric = system.reynolds.residual(pressure, film, system.speed).imag / step
    at = system.linearise(x)
    assert at.film == pytest.approx(film.real, rel=1e-13)
    assert at.times(direction)[:n] == pytest.approx(numeric, rel=1e-9, abs=1e-11)


@pytest.mark.parametrize("problem", PROBLEMS)
def test_dense_jacobian_is_the_same_operator(problem):
    system, x, direction = state(problem)
    at = system.linearise(x)
    free = np.flatnonzero(np.random.default_rng(4).random(x.size) < 0.6)
    if problem.load_controlled:
        free = np.append(free[free < x.size - 1], x.size - 1)
    masked = np.zeros(x.size)
    masked[free] = direction[free]
    assert at.dense(free) @ direction[free] == pytest.approx(at.times(masked)[free], rel=1e-10, abs=1e-12)


@pytest.mark.parametrize("problem", PROBLEMS)
def test_longest_step_keeps_the_film(problem):
    system, x, direction = state(problem)
    at = system.linearise(x)
    for size in (1e-3, 1.0, 1e3):
        fraction = at.longest_step(size * direction)
        assert system.film(x + fraction * size * direction).min() >= 0.19 * at.film.min()
    assert at.longest_step(1e-9 * direction) == 1


@pytest.mark.parametrize("problem", PROBLEMS)
def test_rim_carries_the_far_field(problem):
    system, x, _ = state(problem)
    h0 = system.height(x)
    rim = system.pressure(x).reshape(GRID.shape)[-2:]
    r = GRID.r[-2:, None]
    expected = far_field_profile(GRID.theta, problem.cavitation) / problem.parameter * r**-3 * (1 - 4 * h0 / r**2)
    assert rim == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("beta", [0.5, 3.0, 100.0, 1e5])
def test_first_guess_has_a_positive_film(beta):
    system = ContactSystem(Problem(beta=beta), PolarGrid(40, 12, layer=0.02))
    film = system.film(system.start())
    assert film.min() > 0
    assert film[0] == pytest.approx(beta**-0.6 if beta > 1 else 1, rel=0.2)
