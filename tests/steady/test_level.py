"""One grid: the discrete equations to round-off, the ways to a solution, and a plain end where there is none."""

import numpy as np
import pytest

import softlube
from softlube.discretization.system import ContactSystem
from softlube.discretization.unsteady import implicit_steps
from softlube.errors import NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.problem import Problem
from softlube.model.substrates import LayerKernel, ViscoelasticKernel
from softlube.solvers.continuation import settle
from softlube.solvers.newton import newton
from softlube.steady.level import FIRST_TIME, LONGEST_TIME, SHORTEST_TIME, TOLERANCE, sketch, solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime


def solved(problem, n_theta=18):
    """The system of one grid and its solution, to round-off."""
    grid = grid_for(Regime.of(problem), n_theta)
    system = ContactSystem(problem, grid, Regime.of(problem).unit)
    level = solve_level(Regime.of(problem), grid)
    result = newton(system, level.x, tolerance=1e-12)
    assert np.max(np.abs(system.film_change(result.x - level.x)) / system.film(level.x)) < TOLERANCE
    return system, result.x


@pytest.mark.parametrize(
    "problem",
    [
        *(Problem(beta=beta) for beta in (1.0, 30.0, 1000.0, 3e4, 1e6)),
        Problem(beta=1.0, height=0),
        Problem(beta=100.0, height=1),
    ],
)
def test_complementarity_to_round_off(problem):
    system, x = solved(problem)
    residual = system.linearise(x).residual
    size = np.max(np.abs(residual))
    assert np.all(x >= 0)
    assert (x == 0).sum() > 50
    assert residual.min() > -1e-10 * size
    assert np.max(np.abs(x * residual)) < 1e-10 * size * x.max()


@pytest.mark.parametrize("problem", [Problem(beta=200.0, cavitation="none"), Problem(beta_load=200.0, cavitation="none")])
def test_global_mass_balance_to_round_off(problem):
    """Nothing is lost in the cells, so nothing leaves through the rim."""
    system, x = solved(problem)
    residual = system.linearise(x).residual[: system.grid.n_unknown].reshape(system.grid.n_r, -1).copy()
    residual[:, [0, -1]] /= 2
    through = np.abs(system.speed * system.reynolds.drag).sum()
    assert abs(residual.sum()) < 1e-11 * through


def test_cavitation_destroys_mass_only_where_the_film_is_ruptured():
    system, x = solved(Problem(beta=200.0))
    residual = system.linearise(x).residual
    wet = x[: system.grid.n_unknown] > 0
    assert np.max(np.abs(residual[wet])) < 1e-11 * np.max(np.abs(residual[~wet]))


@pytest.mark.parametrize("problem", [Problem(beta_load=500.0), Problem(beta_load=1.0), Problem(beta_load=1e-4)])
def test_load_is_met_to_round_off(problem):
    system, x = solved(problem)
    assert system.load(x) * system.scale**1.5 == pytest.approx(HERTZ_LOAD, rel=1e-12)


def test_a_very_large_beta_against_finer_grids():
    """β = 10⁶ on a small grid; the film is some 10⁻⁴ and the layer at the sides 10⁻³ wide."""
    problem = Problem(beta=1e6)
    values = solve_level(Regime.of(problem), grid_for(Regime.of(problem), 26)).level.values
    assert values["film_center"] == pytest.approx(2.71380e-4, abs=2e-7)
    assert values["film_outlet_min"] == pytest.approx(2.13633e-4, abs=2e-7)
    assert values["pressure_gradient_inlet"] == pytest.approx(1.91076, abs=1e-3)
    assert values["friction_domain"] == pytest.approx(0.0129230, abs=5e-6)
    assert values["film_min"] == pytest.approx(6.8487e-5, abs=2e-7)


def settled(system):
    """The states of a film that settles in time."""
    times = [system.beta * each for each in (FIRST_TIME, SHORTEST_TIME, LONGEST_TIME)]
    return list(settle(system, implicit_steps(system), system.start(), *times))


PROBLEMS = [Problem(beta=900.0), Problem(beta=2.0), Problem(beta_load=900.0), Problem(beta=30.0, height=0)]


@pytest.mark.parametrize(
    "problem", [*PROBLEMS, Problem(beta=100.0, cavitation="none"), Problem(beta=100.0, substrate=LayerKernel(0.5))]
)
def test_settles_at_the_direct_solution(problem):
    system = ContactSystem(problem, grid_for(Regime.of(problem), 12), Regime.of(problem).unit)
    states = settled(system)
    direct = newton(system, system.start())
    assert direct.converged
    assert all(state.converged for state in states)
    assert states[-1].x == pytest.approx(direct.x, abs=1e-8)


THIN = Problem(beta=30.0, substrate=LayerKernel(0.2))


@pytest.mark.slow
def test_where_newtons_method_goes_astray():
    """A layer a ninth of the contact's radius thick."""
    regime = Regime.of(THIN)
    system = ContactSystem(THIN, grid_for(regime, 18), regime.unit)
    assert not newton(system, system.start()).converged
    assert settled(system)[-1].converged
    solution = softlube.solve(beta=30.0, substrate=LayerKernel(0.2))
    assert solution.film_center.error < 1e-3 * solution.film_center
    finer = softlube.solve(beta=30.0, substrate=LayerKernel(0.2), accuracy=5e-4)
    for name in ("film_center", "film_min", "load", "friction_domain"):
        coarse, fine = solution.quantities[name], finer.quantities[name]
        assert abs(coarse - fine) <= 2 * (coarse.error + fine.error)  # an error covers in 95 of 100 values


def test_a_grid_without_a_solution_is_refused_with_a_diagnosis():
    problem = Problem(beta=100.0, substrate=LayerKernel(0.15))
    with pytest.raises(NotConvergedError, match=r"did not converge at beta = 100 on \d+ x 15 cells: after \d+ steps"):
        solve_level(Regime.of(problem), grid_for(Regime.of(problem), 15))


def test_a_sketch_of_a_gap_whose_outlet_is_all_suction():
    """The pressure rises to zero along the outlet's axis, and has no edge there."""
    remembers = ViscoelasticKernel((0.2,), (0.5,))
    sketched = sketch(Problem(beta=1000.0, height=1, cavitation="none", substrate=remembers))
    assert np.argmax(sketched.fields.pressure[:, -1]) == len(sketched.fields.r) - 1
