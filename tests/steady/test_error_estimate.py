"""Errors from how quantities change over nested grids."""

import math

import numpy as np
import pytest

from softlube.model.problem import Problem
from softlube.model.quantities import STEADY
from softlube.model.substrates import LayerKernel
from softlube.steady.error_estimate import (
    SAFETY,
    Convergence,
    error_of,
    estimate_errors,
    looser,
    too_uncertain,
    unresolved,
    yardstick,
)
from softlube.steady.regime import Regime

ANGLES = (11, 19, 27)


@pytest.mark.parametrize(("order", "least", "most"), [(2, 1.0, 1.5), (4, 1.5, 5.0)])
def test_an_error_covers_both_orders_of_the_scheme(order, least, most):
    """Values that converge like h² or h⁴ to 1: the error is known."""
    values = [1 + n**-order for n in ANGLES]
    assert least < error_of(values, ANGLES) / (values[-1] - 1) < most


def test_an_error_covers_changes_that_are_small_by_chance():
    """The last change vanishes, or the one over two grids, or parts of both orders cancel in the last."""
    far, near = ((27 / n) ** 2 for n in ANGLES[:2])
    assert error_of([1.5, 1.0, 1.0], ANGLES) >= SAFETY * 0.25 / (far - 1)
    assert error_of([1.0, 1.5, 1.0], ANGLES) == pytest.approx(SAFETY * 0.5 / (near - 1))
    smooth, rough = 0.001 * np.array([far**2, near**2, 1.0]), 0.002 * np.array([0.0, -near, 1.0])
    assert error_of(1 + smooth + rough, ANGLES) > smooth[-1] + rough[-1]


def test_a_prescribed_quantity_has_no_error():
    same = dict.fromkeys(STEADY, 1.0)
    levels = [same | {"load": 1.1}, same | {"load": 1.1}, same]
    assert estimate_errors(levels, ANGLES, exact="load")["load"] == 0
    assert estimate_errors(levels, ANGLES)["load"] == pytest.approx(SAFETY * 0.1 / ((27 / 19) ** 2 - 1))


def test_errors_are_compared_with_what_cannot_vanish():
    values = dict.fromkeys(STEADY, 0.0) | {"height": -0.001, "film_center": 0.4, "boundary_layer": -0.00125, "load": 2.0}
    assert yardstick("height", values) == pytest.approx(0.401)
    assert yardstick("boundary_layer", values) == pytest.approx(0.0025)
    assert yardstick("film_min_radius", values) == yardstick("film_min_angle_deg", values) == 1
    assert yardstick("load", values) == 2


def test_a_quantity_that_converges_otherwise_has_its_own_error():
    same = dict.fromkeys(STEADY, 1.0)
    levels = [same | {"load": 1.1}, same | {"load": 1.1}, same]
    slow = estimate_errors(levels, ANGLES, convergence={"load": Convergence(order=1)})
    assert slow["load"] == pytest.approx(SAFETY * 0.1 / (27 / 19 - 1))
    assert slow["film_min"] == 0
    assert estimate_errors(levels, ANGLES, convergence={"load": Convergence(order=1, least=0.4)})["load"] == 0.4
    nothing = estimate_errors(levels, ANGLES, convergence={"load": Convergence(order=1, least=math.inf)})
    assert nothing["load"] == math.inf
    assert too_uncertain(["load", "film_min"], same, nothing) == ("load",)


def test_what_is_not_accurate_enough_is_named():
    values = dict.fromkeys(STEADY, 1.0)
    errors = dict.fromkeys(STEADY, 1e-4) | {"load": 2e-3, "film_min": 2e-3, "film_min_radius": 1.0}
    assert unresolved(values, errors, 1e-3, looser(Regime.of(Problem(beta=100.0)))) == {"load": 2e-3}
    assert unresolved(values, errors | {"load": math.nan}, 1e-3, {}).keys() == {"load", "film_min"}


def test_the_layer_of_the_inlet_does_not_decide_on_a_layer():
    assert looser(Regime.of(Problem(beta=1e3, substrate=LayerKernel(0.5))))["boundary_layer"] == math.inf
    assert looser(Regime.of(Problem(beta=1e3))).get("boundary_layer") is None
    assert looser(Regime.of(Problem(beta=1e8)))["film_min"] > looser(Regime.of(Problem(beta=1e3)))["film_min"]
