"""A solution: quantities as attributes, two normalisations, plain values."""

import json
import pickle

import pytest

import softlube
from softlube.model.exact import HERTZ_LOAD


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


def test_a_quantity_is_a_float_with_an_error(solution):
    assert isinstance(solution.film_min, float)
    assert 0 < solution.film_min.error < 3e-3 * solution.film_min
    assert solution.film_min * 2 == 2 * solution.quantities["film_min"].value
    assert "film_min" in dir(solution)
    with pytest.raises(AttributeError, match="no_such"):
        _ = solution.no_such


def test_a_solution_travels_between_processes_with_both_normalisations(solution):
    again = pickle.loads(pickle.dumps(solution))
    assert again.quantities == solution.quantities
    assert again.normalised("load") == solution.normalised("load")


def test_plain_values_are_json(solution):
    plain = json.loads(json.dumps(solution.to_dict(), allow_nan=False))
    assert plain["beta"] == solution.beta
    assert plain["quantities"]["film_min"] == {"value": solution.film_min.value, "error": solution.film_min.error}
    assert "converged" not in plain  # a result that has not converged is refused
