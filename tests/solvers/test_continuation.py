"""Letting the film settle in time: the same solution as a direct start, one where there was none, and a plain end."""

import numpy as np
import pytest
from softlube.steady.continuation import settle

import softlube
from softlube.discretization.system import ContactSystem
from softlube.errors import NotConvergedError
from softlube.model.problem import Problem
from softlube.model.substrates import LayerKernel
from softlube.solvers.newton import newton
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime

PROBLEMS = [Problem(beta=900.0), Problem(beta=2.0), Problem(beta_load=900.0), Problem(beta=30.0, height=0)]


@pytest.mark.parametrize(
    "problem", [*PROBLEMS, Problem(beta=100.0, cavitation="none"), Problem(beta=100.0, substrate=LayerKernel(0.5))]
)
def test_settles_at_the_direct_solution(problem):
    system = ContactSystem(problem, grid_for(Regime.of(problem), 12), Regime.of(problem).unit)
    states = list(settle(system, system.start()))
    direct = newton(system, system.start())
    assert direct.converged
    assert all(state.converged for state in states)
    assert states[-1].x == pytest.approx(direct.x, abs=1e-8)


THIN = Problem(beta=30.0, substrate=LayerKernel(0.2))


def test_where_newtons_method_goes_astray():
    """A layer a ninth of the contact's radius thick."""
    grid = grid_for(THIN, 18)
    system = ContactSystem(THIN, grid, Regime.of(THIN).unit)
    assert not newton(system, system.start()).converged
    assert list(settle(system, system.start()))[-1].converged
    solution = softlube.solve(beta=30.0, substrate=LayerKernel(0.2))
    assert solution.film_center.error < 1e-3 * solution.film_center
    finer = softlube.solve(beta=30.0, substrate=LayerKernel(0.2), accuracy=5e-4)
    for name in ("film_center", "film_min", "load", "friction_domain"):
        coarse, fine = solution.quantities[name], finer.quantities[name]
        assert abs(coarse - fine) <= coarse.error + fine.error


def test_a_grid_without_a_solution_is_refused_with_a_diagnosis():
    problem = Problem(beta=100.0, substrate=LayerKernel(0.2))
    with pytest.raises(NotConvergedError, match=r"did not converge at beta = 100 on \d+ x 15 cells: after \d+ steps"):
        solve_level(Regime.of(problem), grid_for(Regime.of(problem), 15))


def test_a_minimum_film_at_a_front():
    solution = softlube.solve(beta=50.0, substrate=LayerKernel(0.2))
    assert solution.film_center == pytest.approx(0.0112645, rel=2e-4)
    assert abs(solution.film_min - 0.007386) < solution.film_min.error < 0.05 * solution.film_min  # on 310 x 124 cells
    (said,) = solution.warnings
    assert "film_min is known to" in said


@pytest.mark.slow
def test_a_front_that_no_grid_resolves():
    lines = []
    solution = softlube.solve(beta=100.0, substrate=LayerKernel(0.2), progress=lines.append)
    assert "too few: no solution" in str(lines[0])  # and the next grid is taken
    assert solution.film_center == pytest.approx(0.0078797, rel=1e-4)  # the same on 336 x 124 cells
    assert np.isnan(solution.film_min)
    assert np.isnan(solution.film_min_radius)
    (said,) = solution.warnings
    assert "film_min is not given" in said
