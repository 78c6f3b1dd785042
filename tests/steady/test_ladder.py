"""solve(): what it promises and what it refuses."""

import numpy as np
import pytest

import softlube
from softlube.discretization.measure import measure
from softlube.discretization.system import ContactSystem
from softlube.model.exact import HERTZ_LOAD
from softlube.model.problem import Problem
from softlube.model.quantities import REPORTED_ONLY, STEADY
from softlube.solvers.newton import newton
from softlube.steady.error_estimate import LOOSER, estimate_errors, floors_for, yardstick
from softlube.steady.ladder import COARSE_TOLERANCE, solve_level, solve_problem
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime


def solved(problem, n_theta=18):
    """The system of one grid and its solution, to round-off."""
    grid = grid_for(Regime.of(problem), n_theta)
    system = ContactSystem(problem, grid, Regime.of(problem).unit)
    level = solve_level(Regime.of(problem), grid)
    result = newton(system, level.x, tolerance=1e-12)
    assert np.max(np.abs(system.film_change(result.x - level.x)) / system.film(level.x)) < COARSE_TOLERANCE
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
    assert by_load.beta == pytest.approx(by_load.height**2 * 500, rel=1e-12)
    assert by_depth.beta_load == pytest.approx(500, rel=2e-4)
    for normalisation in ("load", "indentation"):
        first, second = by_load.normalised(normalisation), by_depth.normalised(normalisation)
        assert first.keys() == second.keys() == by_load.quantities.keys()
        for name, value in first.items():
            other = second[name]
            assert abs(value - other) <= value.error + other.error + 1e-4 * abs(value), (normalisation, name)
    assert by_load.normalised("load") is by_load.quantities
    assert by_depth.normalised("indentation") is by_depth.quantities


@pytest.mark.parametrize("given", [{"beta": 500.0}, {"beta_load": 8.0}])
def test_the_two_normalisations_are_one_solution(given):
    """They are tied by s = |h₀|/δ, β = s²β_N; what is prescribed carries no error, whichever it is."""
    solution = softlube.solve(**given, accuracy=0.01)
    by_load, by_depth = solution.normalised("load"), solution.normalised("indentation")
    ratio = -by_load["height"]
    assert solution.beta == pytest.approx(ratio**2 * solution.beta_load, rel=1e-9)
    assert by_load["load"] == pytest.approx(HERTZ_LOAD, rel=1e-9)
    assert by_depth["load"] == pytest.approx(HERTZ_LOAD * ratio**-1.5, rel=1e-9)
    assert by_depth["height"] == -1
    assert by_load["load"].error == by_depth["height"].error == 0
    assert by_depth["film_min"] == pytest.approx(by_load["film_min"] / ratio, rel=1e-6)
    assert by_depth["pressure_max"] == pytest.approx(by_load["pressure_max"] * ratio**-0.5, rel=1e-6)
    assert by_depth["load_contact"] != pytest.approx(by_load["load_contact"] * ratio**-1.5, rel=1e-3)  # another disc


def test_a_normalisation_that_does_not_exist_is_refused():
    solution = softlube.solve(beta_load=1.0, accuracy=0.01)
    assert solution.height > 0
    assert solution.other_quantities == {}
    with pytest.raises(softlube.InputError, match=r"no normalisation by indentation.*h0 >= 0"):
        solution.normalised("indentation")
    with pytest.raises(softlube.InputError, match="by: expected 'indentation' or 'load', got 'height'"):
        solution.normalised("height")


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_load_control_is_gap_control_turned_round(cavitation):
    """Over the gap that a light load leaves, the same load and the same film."""
    beta_load = 2.0 if cavitation == "reynolds" else 0.1
    by_load = softlube.solve(beta_load=beta_load, cavitation=cavitation)
    gap = by_load.height
    assert gap > 0
    by_gap = solve_problem(Problem(beta=by_load.beta, height=1, cavitation=cavitation))
    assert by_gap.beta_load == pytest.approx(beta_load, rel=1e-3)
    again = measure(by_gap.fields.in_units(1 / gap))
    for name, value in by_load.quantities.items():
        other = by_gap.quantities[name]
        error = other.error * abs(again[name] / other if other else 1)
        assert abs(again[name] - value) <= value.error + 2 * error + 1e-4 * abs(value), name


def test_the_height_passes_through_zero_smoothly():
    """β_load = 4.45 lifts the sphere to the undeformed surface; the mesh changes at 4.49.  Neither is seen."""
    loads = np.array([4.40, 4.44, 4.46, 4.48, 4.50, 4.54])
    solutions = [softlube.solve(beta_load=load) for load in loads]
    heights = [solution.height for solution in solutions]
    assert heights[1] > 0 > heights[2]
    assert [bool(solution.other_quantities) for solution in solutions] == [False, False, True, True, True, True]
    for name in ("height", "film_center", "film_min", "pressure_max", "friction_domain", "load_contact", "film_inlet"):
        values = np.array([solution.quantities[name] for solution in solutions])
        errors = [solution.quantities[name].error for solution in solutions]
        smooth = np.polyval(np.polyfit(loads - 4.46, values, 2), loads - 4.46)
        assert np.all(np.abs(values - smooth) < errors), name
    touching = solve_problem(Problem(beta=4.45, height=0))
    assert touching.height == 0
    assert touching.beta == 0
    root = np.interp(0, -np.array(heights), loads)
    assert touching.beta_load == pytest.approx(root, rel=1e-3)


@pytest.mark.parametrize("problem", [Problem(beta_load=500.0), Problem(beta_load=1.0), Problem(beta_load=1e-4)])
def test_load_is_met_to_round_off(problem):
    system, x = solved(problem)
    assert system.load(x) * system.scale**1.5 == pytest.approx(HERTZ_LOAD, rel=1e-12)


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
@pytest.mark.parametrize(("beta_load", "within"), [(1e-4, 0.01), (0.1, 0.06), (1e4, 0.05)])
def test_the_first_height_is_near(beta_load, within, cavitation):
    problem = Problem(beta_load=beta_load, cavitation=cavitation)
    values = solve_level(Regime.of(problem), grid_for(Regime.of(problem), 12)).level.values
    assert Regime.of(problem).first_height == pytest.approx(
        values["height"], abs=within * max(abs(values["height"]), values["film_center"], 1)
    )


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
            assert quantity.error <= 3e-4 * yardstick(name, tight.quantities) * LOOSER.get(name, 1), name
    assert tight.height.error == 0


def test_an_accuracy_that_no_grid_reaches_is_refused_with_advice(monkeypatch):
    monkeypatch.setattr("softlube.steady.ladder.LADDER", (12, 18))
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
        ({"beta": 0.0}, "beta: expected a positive"),
        ({"beta": 10.0, "accuracy": 0.0}, "accuracy: expected"),
        ({"beta": 10.0, "accuracy": 1e-5}, "accuracy: expected a relative error between 0.00014 and 0.1"),
        ({"beta": 10.0, "accuracy": float("nan")}, "accuracy: expected"),
    ],
)
def test_bad_input(arguments, message):
    with pytest.raises(softlube.InputError, match=message):
        softlube.solve(**arguments)


@pytest.mark.parametrize("name", ["beta", "beta_load"])
@pytest.mark.parametrize("value", [0.9e-6, 1.1e9])
def test_out_of_range_is_refused_with_the_range(name, value):
    with pytest.raises(softlube.NotConvergedError, match=rf"^{name} = .* outside the range .*, 1e-06 to 1e\+09"):
        softlube.solve(**{name: value})


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
@pytest.mark.parametrize("given", [{"beta": 1e-6}, {"beta_load": 1e-6}, {"beta_load": 4.45}])
def test_the_light_end_of_the_range_is_solved_at_the_default_accuracy(given, cavitation):
    solution = softlube.solve(**given, cavitation=cavitation)
    for name, quantity in solution.quantities.items():
        if name not in REPORTED_ONLY:
            assert quantity.error <= 1e-3 * yardstick(name, solution.quantities) * LOOSER.get(name, 1), name


def test_a_very_large_beta_against_finer_grids():
    """β = 10⁶ on a small grid; the film is some 10⁻⁴ and the layer at the sides 10⁻³ wide."""
    problem = Problem(beta=1e6)
    values = solve_level(Regime.of(problem), grid_for(Regime.of(problem), 26)).level.values
    assert values["film_center"] == pytest.approx(2.71380e-4, abs=2e-7)
    assert values["film_outlet_min"] == pytest.approx(2.13633e-4, abs=2e-7)
    assert values["pressure_gradient_inlet"] == pytest.approx(1.91076, abs=1e-3)
    assert values["friction_domain"] == pytest.approx(0.0129230, abs=5e-6)
    assert values["film_min"] == pytest.approx(6.8487e-5, abs=2e-7)


@pytest.mark.slow
def test_a_very_large_beta_at_the_default_accuracy():
    solution = softlube.solve(beta=1e6)
    for name, value, uncertainty in (
        ("film_center", 2.71380e-4, 2e-7),
        ("film_min", 6.8487e-5, 2e-7),
        ("film_outlet_min", 2.13633e-4, 2e-7),
        ("pressure_gradient_inlet", 1.91076, 1e-3),
        ("friction_domain", 0.0129230, 5e-6),
    ):
        assert abs(solution.quantities[name] - value) < uncertainty, name


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
    assert estimate_errors([same | {"load": 1.5}, same], 27, exact="load")["load"] == 0
    assert estimate_errors([same | {"load": 1.5}, same], 27)["load"] == 0.5


def test_every_problem_has_a_floor_for_every_quantity():
    for problem in (
        Problem(beta=10.0),
        Problem(beta=1e6),
        Problem(beta=1.0, height=0),
        Problem(beta=1.0, height=1),
        Problem(beta_load=1.0),
        Problem(beta=10.0, cavitation="none"),
        Problem(beta_load=1.0, cavitation="none"),
    ):
        assert set(floors_for(Regime.of(problem))) == set(STEADY)


def test_errors_are_compared_with_what_cannot_vanish():
    values = dict.fromkeys(STEADY, 0.0) | {"height": -0.001, "film_center": 0.4, "boundary_layer": -0.00125, "load": 2.0}
    assert yardstick("height", values) == pytest.approx(0.401)
    assert yardstick("boundary_layer", values) == pytest.approx(0.0025)
    assert yardstick("film_min_radius", values) == yardstick("film_min_angle_deg", values) == 1
    assert yardstick("load", values) == 2


def test_grids_too_coarse_to_be_judged_are_no_solution(monkeypatch):
    """Where a spike forbids a verdict on every grid, nothing has accepted the result, and it is refused."""
    monkeypatch.setattr("softlube.steady.ladder.LADDER", (12, 18, 26))
    monkeypatch.setattr("softlube.steady.ladder.spike_bound", lambda fields: {"pressure_max": 0.0})
    with pytest.raises(softlube.NotConvergedError, match="no grid is fine enough"):
        softlube.solve(beta=100)
