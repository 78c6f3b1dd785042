"""Errors from how quantities change over nested grids."""

import math

import pytest

import softlube
from softlube.model.problem import Problem
from softlube.model.quantities import STEADY
from softlube.model.substrates import LayerKernel
from softlube.steady.error_estimate import (
    SMOOTH,
    Convergence,
    estimate_errors,
    floors_for,
    looser,
    too_uncertain,
    unresolved,
    yardstick,
)
from softlube.steady.regime import Regime


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


def test_a_quantity_that_converges_otherwise_has_its_own_error():
    same = dict.fromkeys(STEADY, 1.0)
    levels = [same | {"load": 1.5}, same | {"load": 1.1}, same]
    slow = Convergence(last=2.0, before=1 / 6, only=10 / 3, least=0.25)
    assert estimate_errors(levels, 27)["load"] == pytest.approx(SMOOTH.last * 0.1)
    assert estimate_errors(levels, 27, convergence={"load": slow})["load"] == pytest.approx(0.25)
    assert estimate_errors(levels[1:], 27, convergence={"load": slow})["load"] == pytest.approx(1 / 3)
    nothing = Convergence(last=2.0, before=0.2, only=3.0, least=math.inf)
    errors = estimate_errors(levels, 27, convergence={"load": nothing})
    assert errors["load"] == math.inf
    assert too_uncertain(["load", "film_min"], same, errors) == ("load",)


def test_what_is_not_accurate_enough_is_named():
    values = dict.fromkeys(STEADY, 1.0)
    errors = dict.fromkeys(STEADY, 1e-4) | {"load": 2e-3, "film_min": 2e-3, "film_min_radius": 1.0}
    assert unresolved(values, errors, 1e-3, looser(Regime.of(Problem(beta=100.0)))) == {"load": 2e-3}
    assert unresolved(values, errors | {"load": math.nan}, 1e-3, {}).keys() == {"load", "film_min"}


def test_the_layer_of_the_inlet_does_not_decide_on_a_layer():
    assert looser(Regime.of(Problem(beta=1e3, substrate=LayerKernel(0.5))))["boundary_layer"] == math.inf
    assert looser(Regime.of(Problem(beta=1e3))).get("boundary_layer") is None
    assert looser(Regime.of(Problem(beta=1e8)))["film_min"] > looser(Regime.of(Problem(beta=1e3)))["film_min"]
