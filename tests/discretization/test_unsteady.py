"""One implicit step in time: what the cells hold, the exact Jacobian, and the limits of short and long steps."""

import numpy as np
import pytest

from softlube.discretization.grid import PolarGrid
from softlube.discretization.system import ContactSystem
from softlube.discretization.unsteady import Step, mass_matrix
from softlube.model.problem import Problem
from softlube.solvers.newton import newton

GRID = PolarGrid(30, 12, edge_width=0.2)
PROBLEMS = [Problem(beta=50.0), Problem(beta_load=80.0), Problem(beta=50.0, cavitation="none")]


def step(problem, weight, known):
    system = ContactSystem(problem, GRID)
    return system, Step(system, mass_matrix(system), weight, known)


def test_the_cells_hold_the_plane():
    """The sum over the cells, times their size, is the integral of a rate over the half-plane: π/2 for r² e^{−r²}."""
    mass = mass_matrix(ContactSystem(PROBLEMS[0], GRID))
    x = GRID.r[:, None] * np.cos(GRID.theta)
    rate = np.broadcast_to(GRID.r[:, None] ** 2 * np.exp(-(GRID.r[:, None] ** 2)), GRID.shape)
    assert mass.shape == (GRID.n_unknown, rate.size)
    balance = (mass @ rate.ravel()).reshape(GRID.n_r, -1)
    cells = GRID.d_xi * np.full(GRID.shape[1], np.pi / GRID.n_theta)
    cells[[0, -1]] /= 2
    assert np.sum(balance * cells) == pytest.approx(np.pi / 2, rel=1e-3)
    odd = (mass @ (x * rate).ravel()).reshape(GRID.n_r, -1)
    assert np.sum(odd * cells) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("problem", PROBLEMS)
def test_the_jacobian_is_the_derivative_of_the_residual(problem):
    random = np.random.default_rng(2)
    system = ContactSystem(problem, GRID)
    _, one = step(problem, 7.0, random.random(GRID.shape).ravel())
    x = system.start()
    x[: GRID.n_unknown] += 0.002 * random.random(GRID.n_unknown)
    direction, d = random.normal(size=x.size), 1e-6
    numeric = (one.linearise(x + d * direction).residual - one.linearise(x - d * direction).residual) / (2 * d)
    exact = one.linearise(x).times(direction)
    assert exact == pytest.approx(numeric, abs=1e-6 * np.max(np.abs(numeric)))


def test_no_weight_on_the_rate_is_the_steady_contact():
    system, one = step(PROBLEMS[0], 0.0, np.zeros(GRID.r.size * GRID.shape[1]))
    x = system.start()
    assert one.linearise(x).residual == pytest.approx(system.linearise(x).residual, rel=1e-14)


def test_a_short_step_leaves_the_film_where_it_was_and_a_long_one_settles():
    """Backward Euler, (u − u₀)/τ: τ → 0 keeps u₀, τ → ∞ is the steady film."""
    system = ContactSystem(PROBLEMS[0], GRID)
    steady = newton(system, system.start())
    assert steady.converged
    film = system.linearise(steady.x).film
    other = film * (1 + 0.05 * np.exp(-np.repeat(GRID.r, GRID.shape[1])))

    def film_after(tau):
        _, one = step(PROBLEMS[0], 1 / tau, -other / tau)
        result = newton(one, steady.x)
        assert result.converged
        return system.linearise(result.x).film

    inner = np.repeat(GRID.r < 0.7, GRID.shape[1])  # a film that rises freely; farther out the rim holds it
    assert np.max(np.abs(film_after(1e6) / film - 1)) < 1e-5
    short = np.max(np.abs(film_after(1e-4) / other - 1)[inner])
    assert short < 1e-2 < np.max(np.abs(film_after(1e6) / other - 1)[inner])
