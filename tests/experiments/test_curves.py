"""Any quantity as a function of β, against solved contacts; what is refused."""

import numpy as np
import pytest

from softlube.errors import InputError, NotConvergedError
from softlube.experiments.curves import WIDEST, available, clipped, quantity_curves
from softlube.experiments.nodes import at
from softlube.model.problem import Problem
from softlube.model.substrates.layer import LayerKernel
from softlube.steady.solve import solve_problem

LAYER = LayerKernel(1.0, 0.5, "bonded")


@pytest.mark.parametrize("problem", [Problem(beta=1, substrate=LAYER), Problem(beta=1, height=1)], ids=["layer", "gap"])
def test_quantities_between_the_nodes(problem):
    names = ["film_center", "pressure_max", "friction_total"]
    seen = []
    curves = quantity_curves(problem, 20, 300, names, accuracy=0.02, progress=seen.append)
    solution = solve_problem(at(problem, 70.0), accuracy=3e-3)
    for name in names:
        value, error = curves[name](70.0)
        exact = solution.quantities[name]
        assert abs(value - exact) <= error + exact.error, name
    assert seen[-1].done == seen[-1].total >= 5


def test_what_is_prescribed_is_no_function():
    assert "load" not in available(Problem(beta_load=1))
    assert "height" not in available(Problem(beta=1))
    assert "film_min_angle_deg" not in available(Problem(beta=1))
    with pytest.raises(InputError, match="quantity: load is no function of beta here"):
        quantity_curves(Problem(beta_load=1), 1, 10, ["load"])
    with pytest.raises(InputError, match="accuracy: expected"):
        quantity_curves(Problem(beta_load=1), 1, 10, ["film_min"], accuracy=1.0)


def test_the_range():
    assert clipped(1e-9, 10) == (WIDEST[0], 10)
    assert clipped(1, 1e9) == (1, WIDEST[1])
    with pytest.raises(NotConvergedError, match="curves reach from"):
        clipped(1e9, 1e10)
    with pytest.raises(InputError, match="beta: expected a range"):
        clipped(np.nan, 1)
