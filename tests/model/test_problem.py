"""The dimensionless problem: exactly one parameter, one kind of control."""

import pytest

from softlube.errors import InputError
from softlube.model.problem import Problem


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"beta": 1.0, "height": 2}, r"height: expected -1 \(indentation\), 0 or 1 \(gap\), got 2"),
        ({"beta": 1.0, "height": None}, "height: expected -1"),
        ({"beta_load": 1.0, "height": 1}, "height, beta_load: under a prescribed load the height is an unknown"),
        ({"beta_load": 1.0, "height": 0}, "height, beta_load: "),
        ({"height": 1}, "beta, beta_load: give exactly one"),
    ],
)
def test_contradictory_problems_are_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        Problem(**arguments)


@pytest.mark.parametrize("height", [-1, 0, 1])
def test_a_height_is_prescribed_with_beta(height):
    problem = Problem(beta=2.0, height=height)
    assert not problem.load_controlled
    assert problem.parameter == 2.0
    assert Problem(beta_load=3.0).load_controlled
    assert Problem(beta_load=3.0).parameter == 3.0
