"""solve(): what is refused, and budgets."""

import pytest

from softlube import line
from softlube.errors import InputError, NotConvergedError
from softlube.model.problem import Problem
from softlube.model.substrates import LayerKernel
from softlube.steady.line.solve import solve_problem


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"beta_load": -1}, "beta_load: expected a positive"),
        ({"beta_load": 1, "accuracy": 1e-12}, "accuracy: expected a relative error between 1e-07 and 0.1"),
        ({"beta_load": 1, "budget": 0}, "budget: expected a number of seconds"),
        ({"beta_load": 1, "cavitation": "some"}, "cavitation"),
    ],
)
def test_refusals(given, message):
    with pytest.raises(InputError, match=message):
        line.solve(**given)


def test_no_depth():
    with pytest.raises(InputError, match="half-plane yields without end"):
        solve_problem(Problem(beta=100.0))


def test_beyond_what_is_resolved():
    with pytest.raises(NotConvergedError, match="outside the range"):
        line.solve(1e12)
    with pytest.raises(NotConvergedError, match="the layer is"):
        line.solve(1e3, substrate=LayerKernel(1e-4))
    with pytest.raises(NotConvergedError, match="no solution within 1e-06 s"):
        line.solve(1e3, budget=1e-6)
