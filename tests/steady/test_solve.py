"""solve(): what it promises and what it refuses."""

import time

import numpy as np
import pytest

import softlube
from softlube.discretization.measure import measure
from softlube.model.liquids import BarusLaw
from softlube.model.problem import Problem
from softlube.model.quantities import REPORTED_ONLY
from softlube.model.substrates import LayerKernel
from softlube.steady.error_estimate import LOOSER, yardstick
from softlube.steady.solve import solve_problem


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
    # Normalised with |h₀| where all grids have h₀ < 0; at 4.46 it is −0.0022, on the coarsest grid 0.0016.
    assert [bool(solution.other_quantities) for solution in solutions] == [False, False, False, True, True, True]
    for name in ("height", "film_center", "film_min", "pressure_max", "friction_domain", "load_contact", "film_inlet"):
        values = np.array([solution.quantities[name] for solution in solutions])
        error = max(solution.quantities[name].error for solution in solutions)  # that of the curve through them
        smooth = np.polyval(np.polyfit(loads - 4.46, values, 2), loads - 4.46)
        assert np.all(np.abs(values - smooth) < error), name
    touching = solve_problem(Problem(beta=4.45, height=0))
    assert touching.height == 0
    assert touching.beta == 0
    root = np.interp(0, -np.array(heights), loads)
    assert touching.beta_load == pytest.approx(root, rel=1e-3)


def test_without_cavitation_pressure_is_negative_behind(solution):
    full = softlube.solve(beta=1000, cavitation="none")
    assert full.fields.pressure.min() < -1e-3
    assert solution.fields.pressure.min() == 0
    assert full.film_outlet_min < solution.film_outlet_min


def test_accuracy_is_kept_or_refused():
    loose, tight = softlube.solve(beta=100, accuracy=1e-2), softlube.solve(beta=100, accuracy=3e-4)
    assert len(loose.levels) < len(tight.levels)
    assert abs(loose.film_center - tight.film_center) < loose.film_center.error
    for name, quantity in tight.quantities.items():
        if name not in REPORTED_ONLY:
            assert quantity.error <= 3e-4 * yardstick(name, tight.quantities) * LOOSER.get(name, 1), name
    assert tight.height.error == 0


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
        ({"beta": 10.0, "accuracy": 1e-5}, "accuracy: expected a relative error between 0.0001 and 0.1"),
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


def test_a_liquid_that_thickens_beyond_all_bounds_is_refused():
    with pytest.raises(softlube.NotConvergedError, match=r"viscosity would rise by a factor of e\^101"):
        softlube.solve(beta_load=100.0, liquid=BarusLaw(500.0))


def test_an_unknown_method_is_refused():
    with pytest.raises(softlube.InputError, match="method: expected 'newton', 'relaxation' or 'cartesian', got 'jacobi'"):
        softlube.solve(beta=100.0, method="jacobi")
    with pytest.raises(softlube.InputError, match="has one mesh and takes no accuracy"):
        softlube.solve(beta=100.0, method="relaxation", accuracy=1e-2)


def test_a_solve_gives_up_when_its_budget_is_spent():
    with pytest.raises(softlube.NotConvergedError, match=r"beta = 1e\+06: it would take more than 0.01 s .* Try budget=0.03"):
        softlube.solve(beta=1e6, budget=0.01)
    for budget in (0, -1, float("nan"), True, "60 s"):
        with pytest.raises(softlube.InputError, match="budget: expected a number of seconds"):
            softlube.solve(beta=100, budget=budget)


@pytest.mark.parametrize(
    ("problem", "message"),
    [
        (Problem(beta_load=5e-5, substrate=LayerKernel(0.1, base="frictionless")), "has the film of a rigid sphere"),
        (Problem(beta_load=1e4, substrate=LayerKernel(1e-3)), "the layer is too thin beside its contact"),
    ],
)
def test_layers_that_grids_do_not_resolve_are_refused_at_once(problem, message):
    began = time.process_time()
    with pytest.raises(softlube.NotConvergedError, match=message):
        solve_problem(problem)
    assert time.process_time() - began < 1
