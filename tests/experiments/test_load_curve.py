"""Film and friction at a given load as curves over β, against solved contacts."""

from dataclasses import replace

import numpy as np
import pytest

import softlube
from softlube.discretization.measure import integrate
from softlube.errors import InputError, NotConvergedError
from softlube.experiments.load_curve import MASTER, load_curve, load_curves, parse_region
from softlube.experiments.nodes import at
from softlube.model.liquids import BarusLaw, NewtonianLaw
from softlube.model.problem import Problem
from softlube.model.substrates import HalfSpaceKernel
from softlube.model.substrates.layer import LayerKernel
from softlube.steady.solve import solve_problem
from softlube.theory import master_curve

PAPER = Problem(beta_load=1.0)
LAYER = Problem(beta_load=1.0, substrate=LayerKernel(1.7, 0.5, "bonded"), liquid=BarusLaw(0.14))
"""A bonded layer under an oil."""
ACCURACY = 0.02


def test_the_poiseuille_part_is_the_moment_of_the_pressure(solution):
    """∫ u ∂p/∂x dA = −∫ p ∂u/∂x dA + boundary, and ∫ p ∂w/∂x dA = 0 for an elastic half-space: so only ∫ p x dA is left.

    This is what makes C − P the whole horizontal force.
    """
    fields = solution.fields
    reach = 0.8 * fields.r[-1]
    part = integrate(fields, lambda at: 3 * fields.film_on(at) * fields.gradient_on(at)[0], reach)
    moment = integrate(
        fields,
        lambda at: 3 * fields.pressure_on(at) * at.r[:, None] * at.cosine,
        reach,
    )
    angle = np.linspace(0, np.pi, 2001)
    rim = fields.film_at(reach, angle) * fields.pressure_at(reach, angle) * np.cos(angle) * reach
    boundary = 3 * 2 * np.trapezoid(rim, angle)
    assert part == pytest.approx(boundary - moment, rel=2e-3)
    assert part < 0


@pytest.mark.parametrize(
    "problem", [PAPER, LAYER, Problem(beta_load=1.0, cavitation="none")], ids=["paper", "layer", "full film"]
)
def test_a_curve_between_its_nodes(problem):
    """Within the errors of both, at β that are no nodes."""
    curve = load_curve(problem, 60, 2e3, accuracy=ACCURACY)
    for beta in (137.0, 1190.0):
        solution = solve_problem(at(problem, beta), accuracy=3e-3)
        for name, quantity in MASTER.items():
            value, error = curve.functions[name](np.array(beta))
            exact = solution.quantities[quantity]
            assert abs(value - exact) <= error + exact.error, name
            assert 0 < error < 0.03 * value
    assert np.isnan(curve.friction(1.0)[0])
    assert np.isnan(curve.film("film_min", 1e7)[1])


def test_at_the_ends_the_curve_is_the_solution():
    curve = load_curve(LAYER, 60, 2e3, accuracy=ACCURACY)
    solution = solve_problem(at(LAYER, 60.0), accuracy=ACCURACY)
    for name, quantity in MASTER.items():
        value, error = curve.functions[name](np.array(60.0))
        assert value == pytest.approx(float(solution.quantities[quantity]), rel=1e-12)
        assert error == pytest.approx(solution.quantities[quantity].error, rel=1e-9)


@pytest.mark.slow
def test_forty_values_lie_within_their_errors():
    """Of the curve behind a Stribeck curve of four decades, against separate solutions that are finer."""
    curve = load_curve(LAYER, 10, 1e5)
    for beta in np.exp(np.random.default_rng(1).uniform(np.log(10), np.log(1e5), 40)):
        solution = solve_problem(at(LAYER, float(beta)), accuracy=1e-3)
        for name, quantity in MASTER.items():
            value, error = curve.functions[name](beta)
            exact = solution.quantities[quantity]
            assert abs(value - exact) <= error + exact.error, (name, beta)


def test_the_master_curve_is_the_fast_path():
    """Where it has the curve, nothing is solved: its functions are taken."""
    if "friction_total" not in master_curve.available("load"):
        pytest.skip("the shipped table has no total friction yet")
    curve = load_curve(PAPER, 1e-3, 1e7)
    assert curve.functions["total"] is master_curve.curve("friction_total", "load", "reynolds")
    assert load_curve(PAPER, 50, 500, region="contact", accuracy=ACCURACY).functions["total"] is not curve.functions["total"]


def test_forces_and_ratios():
    """C S/2 ∓ P: total and sphere differ by 2P, Couette is their mean, and pure rolling leaves ∓P."""
    curve = load_curve(PAPER, 60, 2e3, accuracy=ACCURACY)
    total, sphere, couette = (curve.friction(200.0, force=force)[0] for force in ("total", "sphere", "couette"))
    assert couette == pytest.approx((total + sphere) / 2, rel=1e-12)
    assert curve.friction(200.0, force="couette", slide_to_roll=1.0)[0] == pytest.approx(couette / 2, rel=1e-12)
    rolling = [curve.friction(200.0, force=force, slide_to_roll=0.0)[0] for force in ("total", "sphere")]
    assert rolling[0] == pytest.approx((total - sphere) / 2, rel=1e-12)
    assert rolling[0] == -rolling[1] > 0
    solution = softlube.solve(beta_load=200.0)
    assert total == pytest.approx(solution.friction_total, rel=5e-3)
    assert sphere == pytest.approx(solution.friction_domain, rel=5e-3)


def test_a_problem_that_is_there_twice_has_one_curve():
    first, second = load_curves([(at(PAPER, 7.0), 100, 1e3), (PAPER, 300, 3e3)], accuracy=ACCURACY)
    assert first is second
    assert (first.low, first.high) == (100, 3e3)


def test_what_cannot_be_solved_is_said():
    steel = replace(PAPER, liquid=BarusLaw(500.0))
    with pytest.raises(NotConvergedError, match="cannot be had: "):
        load_curve(steel, 100, 1000, accuracy=ACCURACY)


def test_refusals():
    for low, high in ((10, 1), (0, 1), (1, np.inf)):
        with pytest.raises(InputError, match="beta: expected a range"):
            load_curve(PAPER, low, high)
    assert parse_region("1.5") == 1.5
    assert parse_region("contact") == "contact"
    with pytest.raises(InputError, match="region: expected"):
        parse_region("here")
    assert (PAPER.substrate, PAPER.liquid) == (HalfSpaceKernel(), NewtonianLaw())
