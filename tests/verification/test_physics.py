"""The solver against the paper's fits, exact limits, and the law of similarity."""

from dataclasses import replace

import numpy as np
import pytest

import softlube
from softlube.discretization.system import ContactSystem
from softlube.model.exact import HERTZ_LOAD, HERTZ_PRESSURE, half_sommerfeld_load, hertz_pressure, kapitza_pressure
from softlube.model.problem import Problem
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime


@pytest.fixture(scope="module")
def march():
    """Default solutions over the range of the paper's fits and a decade beyond."""
    return {beta: softlube.solve(beta=beta) for beta in (100.0, 300.0, 1000.0, 3000.0, 1e4, 3e4)}


@pytest.mark.parametrize("beta", [100.0, 300.0, 1000.0, 3000.0])
def test_fits_of_the_paper(march, beta):
    solution = march[beta]
    # (20) is of the pressure over the Hertz maximum, not of p̄ as printed.
    assert solution.pressure_gradient_inlet / HERTZ_PRESSURE == pytest.approx(0.5352 * beta**0.2112, rel=0.06)
    assert solution.boundary_layer == pytest.approx(4.216 * beta**-0.5077, rel=0.06)
    assert solution.film_center == pytest.approx(0.9051 * beta**-0.5826, rel=0.06)
    assert solution.film_min == pytest.approx(0.9283 * beta**-0.6626, rel=0.06)


@pytest.mark.parametrize("beta", [1000.0, 3000.0])
def test_friction_fit_of_the_paper_is_over_its_whole_domain(march, beta):
    # (28) over r ≤ 2; over r ≤ 1, as (27a) is printed, the friction is some 15 % lower.
    assert march[beta].friction_domain == pytest.approx(4.806 * beta**-0.4398, rel=0.015)
    assert march[beta].friction_contact < 0.95 * 4.806 * beta**-0.4398


def test_load_tends_to_hertz(march):
    excess = np.array([solution.load - HERTZ_LOAD for solution in march.values()])
    assert np.all(excess > 0)
    assert np.all(np.diff(excess) < 0)
    assert excess[-1] < 4e-3 * HERTZ_LOAD
    assert march[3e4].pressure_center == pytest.approx(HERTZ_PRESSURE, rel=2e-3)


def test_local_exponents_approach_those_of_the_hertz_limit(march):
    low, high = march[1e4], march[3e4]

    def exponent(name):
        return np.log(high.quantities[name] / low.quantities[name]) / np.log(3)

    assert -0.6 < exponent("film_center") < -0.585
    assert -0.75 < exponent("film_min") < -0.70
    assert -0.41 < exponent("friction_contact") < -0.39
    assert 0.195 < exponent("pressure_gradient_inlet") < 0.215


def test_pressure_is_hertz_inside_a_heavily_loaded_contact(march):
    r = np.linspace(0, 0.9, 10)
    for theta in (0.0, np.pi / 2, np.pi):
        assert march[3e4].fields.pressure_at(r, theta) == pytest.approx(hertz_pressure(r), rel=0.01)


def test_minimum_film_moves_to_the_sides(march):
    angles = [solution.film_min_angle_deg for solution in march.values()]
    assert np.all(np.diff(angles) < 0)
    assert angles[0] == pytest.approx(126, abs=2)
    assert angles[2] == pytest.approx(108, abs=2)
    assert angles[4] == pytest.approx(98.5, abs=2)


def test_rigid_limit():
    """Light load, h₀ > 0: the film is the undeformed gap, and the load a little more than the half-Sommerfeld one."""
    solution = softlube.solve(beta_load=0.1)
    fields, gap = solution.fields, solution.height
    assert gap > 100
    assert fields.film == pytest.approx(gap + np.repeat(fields.r[:, None] ** 2 / 2, fields.theta.size, axis=1), rel=0.01)
    # The Reynolds condition lets the pressure spread behind the centre: some 10 % more load than its positive half alone.
    assert 1.05 < fields.load / half_sommerfeld_load(fields.beta, gap) < 1.15


@pytest.mark.parametrize(("beta", "deformation"), [(1e3, 2e-3), (1e6, 2e-4), (1e9, 2e-4)])
def test_a_gap_prescribed_over_a_stiff_substrate_has_the_pressure_of_kapitza(beta, deformation):
    """Without the cavitation condition, at every node: to the deformation p ~ 1/β, then to the error of the grid."""
    problem = Problem(beta=beta, height=1, cavitation="none")
    fields = solve_level(Regime.of(problem), grid_for(Regime.of(problem), 24)).fields
    exact = kapitza_pressure(fields.r[:, None], fields.theta, beta, 1.0)
    assert np.abs(fields.pressure - exact).max() < deformation * exact.max()
    assert fields.film == pytest.approx(np.repeat(1 + fields.r[:, None] ** 2 / 2, fields.theta.size, axis=1), rel=1 / beta)


@pytest.mark.parametrize(("cavitation", "exponent"), [("reynolds", -2.0), ("none", -0.8)])
def test_height_under_a_light_load(cavitation, exponent):
    """N ~ 1/(β√h₀) if the pressure behind is cut off, and by the deformation, N ~ 1/(β²h₀^(5/2)), if it is not."""
    heights = []
    for beta in (1e-5, 1e-4, 1e-3):
        problem = Problem(beta_load=beta, cavitation=cavitation)
        heights.append(solve_level(Regime.of(problem), grid_for(Regime.of(problem), 18)).level.values["height"])
    assert np.diff(np.log(heights)) / np.log(10) == pytest.approx(exponent, abs=2e-4)


def test_two_thirds_of_a_rigid_sphere_s_pressure_centre():
    """The rigid pressure x/(5βu²) is largest at r = √(2h₀/3): position and height of the maximum on the inlet axis."""
    problem = Problem(beta=1e6, height=1, cavitation="none")
    solved = solve_level(Regime.of(problem), grid_for(Regime.of(problem), 24))
    peak = np.sqrt(2 / 3)
    assert solved.level.values["pressure_max"] == pytest.approx(peak / (5e6 * (1 + 1 / 3) ** 2), rel=3e-4)
    assert solved.level.values["pressure_center"] == pytest.approx(0, abs=1e-9)


def test_a_full_film_is_nearly_antisymmetric_when_nearly_rigid():
    solution = softlube.solve(beta=1000, cavitation="none")
    r = np.array([6.0, 10.0])
    ahead, behind = solution.fields.pressure_at(r, 0.0), solution.fields.pressure_at(r, np.pi)
    assert behind == pytest.approx(-ahead, rel=0.02)
    assert ahead == pytest.approx(0.8 / 1000 / r**3 * (1 + 4 / r**2), rel=0.02)


def test_the_answer_does_not_depend_on_the_grid_s_reach_or_grading():
    problem = Problem(beta=50.0)
    grid = grid_for(Regime.of(problem), 27)
    for other in (
        replace(grid, reach=40.0),
        replace(grid, side_width=2 * grid.side_width),
        replace(grid, edge_width=grid.edge_width * 1.4),
    ):
        other = other.resized(int(np.ceil(other.xi_of(other.reach) * 27 / 6)), 27)
        first, second = solve_level(Regime.of(problem), grid).level.values, solve_level(Regime.of(problem), other).level.values
        for name in ("load", "film_center", "film_inlet", "pressure_center", "friction_domain"):
            assert first[name] == pytest.approx(second[name], rel=5e-4), name


def test_fields_are_rescaled_consistently():
    """The two normalisations describe the same contact: (6a)-(6c) hold after rescaling from the load's units to |h₀|'s."""
    problem = Problem(beta_load=100.0)
    grid = grid_for(Regime.of(problem), 18)
    level = solve_level(Regime.of(problem), grid)
    system = ContactSystem(problem, grid)
    fields = system.fields(level.x)
    fields = fields.in_units(-fields.height)
    assert fields.height == -1
    again = ContactSystem(Problem(beta=fields.beta), grid.scaled((-system.height(level.x)) ** -0.5))
    x = fields.pressure[: grid.n_r].ravel()
    assert again.film(x) == pytest.approx(fields.film.ravel(), rel=1e-9)
    assert np.max(np.abs(again.linearise(x).residual[x > 0])) < 1e-9
