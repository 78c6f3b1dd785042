"""solve(): what it promises and what it refuses."""

import numpy as np
import pytest

import softlube
from softlube.limits import HERTZ_LOAD
from softlube.problem import Problem
from softlube.solver import LOOSER, REPORTED_ONLY, estimate_errors, grid_for, solve_level
from softlube.system import ContactSystem


def solved(problem, n_theta=18):
    grid = grid_for(problem, n_theta)
    level = solve_level(problem, grid, None)
    return ContactSystem(problem, grid), level.x


@pytest.mark.parametrize("beta", [1.0, 30.0, 1000.0, 3e4])
def test_complementarity_to_round_off(beta):
    system, x = solved(Problem(beta=beta))
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
    through = np.abs(system.speed * system.reynolds.drag[0]).sum()
    assert abs(residual.sum()) < 1e-11 * through


def test_cavitation_destroys_mass_only_where_the_film_is_ruptured():
    system, x = solved(Problem(beta=200.0))
    residual = system.linearise(x).residual
    wet = x[: system.grid.n_unknown] > 0
    assert np.max(np.abs(residual[wet])) < 1e-11 * np.max(np.abs(residual[~wet]))


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_load_control_is_indentation_control_turned_round(cavitation):
    by_load = softlube.solve(beta_load=500, cavitation=cavitation)
    by_depth = softlube.solve(beta=by_load.beta, cavitation=cavitation)
    assert by_depth.beta_load == pytest.approx(500, rel=2e-4)
    for name, value in by_load.quantities.items():
        other = by_depth.quantities[name]
        assert abs(value - other) <= value.error + other.error + 1e-4 * abs(value), name


def test_load_is_met_to_round_off():
    problem = Problem(beta_load=500.0)
    system, x = solved(problem)
    assert system.load(x) == pytest.approx(HERTZ_LOAD, rel=1e-13)


def test_without_cavitation_pressure_is_negative_behind(solution):
    full = softlube.solve(beta=1000, cavitation="none")
    assert full.fields.pressure.min() < -1e-3
    assert solution.fields.pressure.min() == 0
    assert full.film_outlet_min < solution.film_outlet_min


def test_a_quantity_is_a_float_with_an_error(solution):
    assert isinstance(solution.film_min, float)
    assert 0 < solution.film_min.error < 3e-3 * solution.film_min
    assert solution.film_min * 2 == 2 * solution.quantities["film_min"].value
    assert "film_min" in dir(solution)
    with pytest.raises(AttributeError, match="no_such"):
        _ = solution.no_such


def test_accuracy_is_kept_or_refused():
    loose, tight = softlube.solve(beta=100, accuracy=1e-2), softlube.solve(beta=100, accuracy=3e-4)
    assert len(loose.levels) < len(tight.levels)
    assert abs(loose.film_center - tight.film_center) < loose.film_center.error
    for name, quantity in tight.quantities.items():
        if name not in REPORTED_ONLY:
            assert quantity.error <= 3e-4 * abs(quantity) * LOOSER.get(name, 1), name


def test_an_accuracy_that_no_grid_reaches_is_refused_with_advice(monkeypatch):
    monkeypatch.setattr("softlube.solver.LADDER", (12, 18))
    with pytest.raises(softlube.NotConvergedError, match=r"does not reach the accuracy.*Try accuracy="):
        softlube.solve(beta=1000, accuracy=3e-4)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "beta, beta_load: give exactly one"),
        ({"beta": 1.0, "beta_load": 2.0}, "beta, beta_load: give exactly one"),
        ({"beta": -1.0}, "beta: expected a positive"),
        ({"beta": float("nan")}, "beta: expected a positive"),
        ({"beta": "10"}, "beta: expected a positive"),
        ({"beta_load": float("inf")}, "beta_load: expected a positive"),
        ({"beta": 10.0, "cavitation": "jfo"}, "cavitation: expected"),
        ({"beta": 10.0, "accuracy": 0.0}, "accuracy: expected"),
        ({"beta": 10.0, "accuracy": 1e-5}, "accuracy: expected a relative error between 0.00014 and 0.1"),
        ({"beta": 10.0, "accuracy": float("nan")}, "accuracy: expected"),
    ],
)
def test_bad_input(arguments, message):
    with pytest.raises(softlube.InputError, match=message):
        softlube.solve(**arguments)


@pytest.mark.parametrize("beta", [1e-3, 1e9])
def test_out_of_range_is_refused_with_the_range(beta):
    with pytest.raises(softlube.NotConvergedError, match="outside the range"):
        softlube.solve(beta=beta)


def test_a_sphere_nearly_lifted_off_is_out_of_range():
    with pytest.raises(softlube.NotConvergedError, match=r"beta = 0\.\d+ is outside the range.*larger load"):
        softlube.solve(beta_load=5.5)


@pytest.mark.parametrize("beta_load", [0.4, 1.0, 3.0])
def test_a_sphere_lifted_off_is_refused(beta_load):
    with pytest.raises(softlube.NotConvergedError, match=r"lifts the sphere above.*larger load"):
        softlube.solve(beta_load=beta_load)


def test_progress_is_reported_for_each_grid():
    lines = []
    result = softlube.solve(beta=50, progress=lines.append)
    assert len(lines) == len(result.levels)


def test_error_estimate_has_a_floor_where_two_grids_agree_by_chance():
    names = softlube.solve(beta=50).quantities
    same = dict.fromkeys(names, 1.0)
    estimate = estimate_errors([same, same, same], 27)
    assert all(value > 0 for value in estimate.values())
    finer = estimate_errors([same, same, same], 54)
    assert finer["film_min"] == pytest.approx(estimate["film_min"] / 4)
    jump = estimate_errors([same | {"load": 1.5}, same | {"load": 1.1}, same], 27)
    assert jump["load"] == pytest.approx(0.06)
