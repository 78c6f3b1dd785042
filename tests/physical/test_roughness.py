"""The ratio of film to roughness, one rule for every command."""

import numpy as np
import pytest

import softlube
from softlube.model.quantities import Quantity
from softlube.physical.roughness import lambda_ratio, lubrication

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}


@pytest.mark.parametrize(
    ("ratio", "regime"), [(3.0, "full film"), (2.99, "mixed"), (1.0, "mixed"), (0.99, "boundary"), (np.nan, "")]
)
def test_regimes(ratio, regime):
    assert lubrication(ratio) == regime


def test_the_ratio_is_the_minimum_film_s_with_its_error():
    films = {"film_min": Quantity(2e-7, 1e-9, "m"), "film_outlet_min": Quantity(3e-7, 1e-9, "m")}
    assert lambda_ratio(films, 1e-7) == pytest.approx(2.0)
    assert lambda_ratio(films, 1e-7).error == pytest.approx(0.01)
    assert lambda_ratio(films | {"film_min": Quantity(np.nan)}, 1e-7) == pytest.approx(3.0)


def test_a_contact_says_its_ratio_and_doubts_a_film_that_is_not_full():
    with pytest.warns(softlube.ValidityWarning, match="1.6 times the roughness .mixed lubrication"):
        solution = softlube.Contact(**BALL, roughness="50 nm").solve(accuracy=1e-2)
    ratio = solution.dimensional["lambda_ratio"]
    assert ratio == pytest.approx(solution.dimensional["film_min"] / 50e-9)
    assert "Warning: the minimum film is 1.6 times" in repr(solution)
    assert "lambda_ratio" in solution.to_dict()["dimensional"]
    assert softlube.Contact(**BALL, roughness="5 nm").solve(accuracy=1e-2).warnings == ()
