"""Errors from how quantities change over nested grids."""

import math

import numpy as np
import pytest

from softlube.model.problem import Problem
from softlube.model.quantities import STEADY
from softlube.model.substrates import LayerKernel, ViscoelasticKernel
from softlube.steady.error_estimate import (
    AT_THE_BOUNDARY,
    GRIDS,
    MEMORY_ORDER,
    PLACES,
    SAFETY,
    SCHEME_ORDER,
    VALLEY,
    Convergence,
    convergence_of,
    error_of,
    estimate_errors,
    looser,
    scheme_order,
    too_uncertain,
    unresolved,
    valley_error,
    yardstick,
)
from softlube.steady.ladder import Estimate, climb
from softlube.steady.regime import Regime

ANGLES = (11, 19, 27)


@pytest.mark.parametrize("order", [2, 3, 4])
def test_an_error_of_one_order_is_covered_and_not_by_much(order):
    """Values that converge like h² to h⁴ to 1."""
    values = [1 + n**-order for n in ANGLES]
    assert 1 < error_of(values, ANGLES) / (values[-1] - 1) < 2


def test_what_a_substrate_remembers_converges_more_slowly():
    """Changes of its own order are the error; read as of the fourth they would tell too little."""
    values = [1 + 1e-3 * (ANGLES[-1] / n) ** MEMORY_ORDER for n in ANGLES]
    error = error_of(values, ANGLES, smooth=MEMORY_ORDER)
    assert SAFETY * 1e-3 < error < 2e-3
    assert scheme_order(Regime.of(Problem(beta=100.0))) == SCHEME_ORDER
    remembering = Problem(beta=100.0, substrate=ViscoelasticKernel((0.5,), (1.0,)))
    assert scheme_order(Regime.of(remembering)) == MEMORY_ORDER


def test_frictions_that_a_substrate_makes_have_a_least_error():
    remembering = Problem(beta=100.0, substrate=ViscoelasticKernel((0.5,), (1.0,)))
    least = [convergence_of(Regime.of(problem))["friction_total"].least for problem in (Problem(beta=100.0), remembering)]
    assert least[0] < least[1] == 2e-5


def test_a_random_error_is_not_taken_for_a_smooth_one():
    """Changes that happen to lie like those of h⁴ are the size of an error of second order at the boundary."""
    values = [1 + n**-4 for n in ANGLES]
    far, near = ((27 / n) ** 2 for n in ANGLES[:2])
    error = values[-1] - 1
    assert error_of(values, ANGLES, AT_THE_BOUNDARY["shear_rate_max"]) == pytest.approx(
        SAFETY * error * max(near + 1, (far + 1) / 2)
    )


def test_on_the_outlet_axis_more_of_the_coarsest_change_belongs_to_the_boundary():
    """The film there has hardly a smooth part: where the last change is small by chance, 0.8 of the other is the boundary's."""
    far = (27 / 11) ** 2
    errors = [error_of([1.1, 1.0, 1.0], ANGLES, AT_THE_BOUNDARY[name]) for name in ("film_outlet_min", "shear_rate_max")]
    assert errors == pytest.approx([SAFETY * share * 0.1 / (far - 1) for share in (0.8, 0.5)])


def test_a_valley_tells_the_error_of_its_lowest_place():
    """At β = 9.8·10⁴ 17 and 29 angles agree by chance on the minimum film, which both have 6·10⁻⁴ too thin."""
    exact = 3.84578e-4  # on 90 angles
    regime, solved = Regime.of(Problem(beta_load=97457.92)), []
    for grid in climb(regime):
        solved.append(grid)
        if len(solved) == GRIDS:
            break
    values, angles = [each.level.values for each in solved], [each.grid.n_theta for each in solved]
    error = abs(values[-1]["film_min"] / exact - 1)
    assert error_of([each["film_min"] for each in values], angles) / exact < error / 2
    assert error < valley_error([each.fields for each in solved], values[-1], angles) < 5 * error
    estimate = Estimate.from_grids(regime, solved)
    assert all(estimate.errors[name] > error * estimate.values[name] for name in VALLEY)


def test_errors_of_two_orders_do_not_cancel():
    """Parts of both orders with one sign are covered, too; with two signs each counts."""
    smooth, rough = (np.array([n**-order for n in ANGLES]) for order in (4, 2))
    assert 1 < error_of(1 + smooth + rough, ANGLES) / (smooth[-1] + rough[-1]) < 2
    error = error_of(1 + smooth - 0.1 * rough, ANGLES)
    assert error > abs(smooth[-1] - 0.1 * rough[-1])


def test_an_error_covers_changes_that_are_small_by_chance():
    """The last change vanishes, or the one over two grids, or parts of both orders cancel in the last."""
    far, near = ((27 / n) ** 2 for n in ANGLES[:2])
    assert error_of([1.5, 1.0, 1.0], ANGLES) > 3 * SAFETY * 0.5 / (far**2 - 1)  # the reading of a smooth solution
    assert error_of([1.0, 1.5, 1.0], ANGLES) > SAFETY * 0.5 / (near - 1)
    smooth, rough = 0.001 * np.array([far**2, near**2, 1.0]), 0.002 * np.array([0.0, -near, 1.0])
    assert error_of(1 + smooth + rough, ANGLES) > smooth[-1] + rough[-1]


def test_an_error_is_bounded_where_readings_disagree_in_sign():
    """Such readings tell the size of an error and not more: how far the smaller one lies on the other side does not count."""
    same_sign, other_sign = error_of([1.5, 1.1, 1.0], ANGLES), error_of([0.5, 1.1, 1.0], ANGLES)
    assert same_sign < other_sign == error_of([0.6, 1.1, 1.0], ANGLES)


def test_a_prescribed_quantity_has_no_error():
    same = dict.fromkeys(STEADY, 1.0)
    levels = [same | {"load": 1.1}, same | {"load": 1.1}, same]
    assert estimate_errors(levels, ANGLES, exact="load")["load"] == 0
    assert estimate_errors(levels, ANGLES)["load"] == error_of([1.1, 1.1, 1.0], ANGLES)


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
    assert slow["load"] == error_of([1.1, 1.1, 1.0], ANGLES, Convergence(order=1)) > error_of([1.1, 1.1, 1.0], ANGLES)
    assert slow["film_min"] == 0
    moved = [same | {"film_min_radius": 1.1}, same | {"film_min_radius": 1.1}, same]  # a place, an order worse than a value
    assert estimate_errors(moved, ANGLES, convergence=PLACES)["film_min_radius"] == slow["load"]
    assert estimate_errors(levels, ANGLES, convergence={"load": Convergence(order=1, least=0.4)})["load"] == 0.4
    nothing = estimate_errors(levels, ANGLES, convergence={"load": Convergence(order=1, least=math.inf)})
    assert nothing["load"] == math.inf
    assert too_uncertain(["load", "film_min"], same, nothing) == ("load",)


def test_what_is_not_accurate_enough_is_named():
    values = dict.fromkeys(STEADY, 1.0)
    errors = dict.fromkeys(STEADY, 1e-4) | {"load": 2e-3, "film_min": 2e-3, "film_min_radius": 1.0}
    assert unresolved(values, errors, 1e-3, looser(Regime.of(Problem(beta=100.0)))) == {"load": 2e-3}
    assert unresolved(values, errors | {"load": math.nan}, 1e-3, {}).keys() == {"load", "film_min"}


@pytest.mark.parametrize("substrate", [LayerKernel(0.5), ViscoelasticKernel((0.5,), (1.0,))])
def test_the_layer_of_the_inlet_does_not_decide_where_the_contact_does_not_end_at_the_elastic_one(substrate):
    assert looser(Regime.of(Problem(beta=1e3, substrate=substrate)))["boundary_layer"] == math.inf


def test_a_deep_contact_may_have_larger_errors_of_its_extrema():
    assert looser(Regime.of(Problem(beta=1e3))).get("boundary_layer") is None
    assert looser(Regime.of(Problem(beta=1e8)))["film_min"] > looser(Regime.of(Problem(beta=1e3)))["film_min"]
