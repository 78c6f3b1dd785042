"""Files that contradict themselves: every number that is changed is found, by its name."""

import json

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import softlube
from softlube.discretization.grid import PolarGrid
from softlube.files.consistency import check_grid
from softlube.files.netcdf import contents, load
from softlube.files.reading import Damaged
from softlube.files.writing import netcdf


@pytest.fixture(scope="module")
def data(physical):
    return physical.dataset


def changed(data, name, place, value):
    values = data[name].to_numpy().copy()
    values[place] = value
    return netcdf(data.assign({name: (data[name].dims, values, data[name].attrs)}))


@pytest.mark.parametrize(
    ("name", "place", "value", "message"),
    [
        ("film", (3, 4), -1.0, "film: expected finite and positive numbers, got -1"),
        ("film", (3, 4), 0.5, r"film: at \[3, 4\] 0.5 is not the gap over the displaced surface"),
        ("pressure", (3, 4), 1e6, "load_contact: the fields say"),
        ("pressure", (3, 4), float("nan"), "pressure: expected finite numbers, got nan"),
        ("pressure", (3, 4), -1e-3, "pressure: expected none below zero"),
        ("displacement", (70, 1), 1.0, r"film: at \[70, 1\]"),
        ("r", 5, 0.0, "r: expected numbers that increase"),
        ("film_min", (), 0.5, "film_min: the fields say"),
        ("film_min_SI", (), 1e-3, "film_min_SI: expected"),
        ("film_min_other", (), 0.5, "film_min_other: the fields say"),
        ("load", (), float("inf"), "load: expected finite numbers"),
        ("film_min_error", (), -1.0, "film_min: expected an error of 0 or more"),
        ("film_min_error", (), 0.5, "film_min_SI: expected"),
        ("film_min_error_SI", (), 1e-3, "film_min_SI: expected"),
        ("film_SI", (3, 4), 1e-3, "film_SI: does not follow from the other numbers"),
        ("x", (3, 4), 1e-3, "x: does not follow from the other numbers"),
        ("y_SI", (3, 4), 1e-3, "y_SI: does not follow from the other numbers"),
    ],
)
def test_a_number_that_was_changed(data, name, place, value, message):
    with pytest.raises(softlube.InputError, match=f"^fields: what the store has, {message}"):
        load(changed(data, name, place, value))


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("problem", "[" * 900 + "]" * 900, "problem: holds what"),
        ("problem", '{"beta": 1e9999}', "problem: holds what"),
        ("problem", f'{{"beta": 1{"0" * 5000}}}', "problem: holds what"),
        ("problem", '{"beta_load": 5.0}', "beta: expected"),
        ("grid", '{"n_r": 1000000000, "n_theta": 26}', "grid: it has 1000000002 × 27 nodes"),
        ("grid", "[1]", "grid: holds what"),
        ("levels", "[]", "levels: expected one"),
        ("levels", "[{}]", "levels: holds what"),
        ("inputs_SI", '{"radius": "2 mm"}', "inputs_SI: holds what"),
        ("height", "high", "height: holds what"),
        ("height", 1e300, "height: expected a finite number"),
        ("height", -0.9, "beta: expected"),
        ("method", "guess", "method: 'guess' is none"),
        ("warnings", "3", "warnings: holds what"),
    ],
)
def test_an_attribute_that_was_changed(data, name, value, message):
    with pytest.raises(softlube.InputError, match=f"^fields: what the store has, {message}"):
        load(netcdf(data.assign_attrs({name: value})))


def test_levels_without_a_quantity(data):
    levels = json.loads(data.attrs["levels"])
    del levels[-1]["values"]["friction_contact"]
    with pytest.raises(softlube.InputError, match="levels: expected friction_contact among the values"):
        load(netcdf(data.assign_attrs(levels=json.dumps(levels))))


def test_the_input_of_another_problem(data):
    inputs = json.loads(data.attrs["inputs_SI"]) | {"load": 0.2}
    with pytest.raises(softlube.InputError, match="inputs_SI: is the input of another problem"):
        load(netcdf(data.assign_attrs(inputs_SI=json.dumps(inputs))))


def test_a_variable_that_is_not_there(data):
    for name in ("film", "displacement", "load", "film_center", "film_min", "x", "film_SI"):
        with pytest.raises(softlube.InputError, match=f"{name}: missing"):
            load(netcdf(data.drop_vars(name)))
    with pytest.raises(softlube.InputError, match="film_min_error: missing"):
        load(netcdf(data.drop_vars("film_min_error")))


@settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    name=st.sampled_from(["pressure", "film", "displacement"]),
    i=st.integers(0, 50),  # within twice the contact radius, where the quantities count
    k=st.integers(0, 26),
    factor=st.floats(-1e9, 1e9).filter(lambda factor: abs(factor - 1) > 0.01),
)
def test_no_changed_cell_is_taken(data, name, i, k, factor):
    value = float(data[name][i, k])
    if abs(value) > 1e-3:
        with pytest.raises(softlube.InputError):
            load(changed(data, name, (i, k), value * factor))


def test_every_sort_of_solution_is_consistent():
    """Loads, indentations, gaps, layers, oils, two bodies and the paper's methods."""
    ball = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s"}
    for more in (
        {"load": "100 mN", "thickness": "1 mm"},
        {"load": "100 mN", "cavitation": "none"},
        {"load": "50 mN", "pressure_viscosity": "1 MPa^-1", "density_law": "dowson-higginson"},
        {"indentation": "20 um", "ball_young_modulus": "5 MPa", "ball_poisson_ratio": 0.4},
        {"indentation": "-1 um"},
    ):
        solution = softlube.Contact(**ball, **more).solve(accuracy=0.05)
        assert set(load(contents(solution)).quantities) == set(solution.quantities)
    for method in ("relaxation", "cartesian"):
        assert load(contents(softlube.solve(beta=10, method=method))).method == method


def test_a_grid_of_other_fields():
    check_grid(PolarGrid(8, 6), (10, 7))
    with pytest.raises(Damaged, match="grid: it has 10 × 7 nodes, and the fields 10 × 8"):
        check_grid(PolarGrid(8, 6), (10, 8))
    with pytest.raises(Damaged, match="grid: edge: expected a finite number"):
        check_grid(PolarGrid(8, 6, edge=float("inf")), (10, 7))
