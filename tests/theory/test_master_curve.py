"""The master curve against the solver, the limits, and what it promises."""

import time

import numpy as np
import pytest

import softlube
from softlube import curve, limits
from softlube.errors import InputError
from softlube.model.problem import Problem
from softlube.model.quantities import STEADY

BETWEEN = [
    ({"beta": 1.7e-2}, "reynolds"),
    ({"beta": 770.0}, "none"),
    ({"beta_load": 0.55}, "reynolds"),
    ({"beta_load": 5.1e4}, "none"),
]


@pytest.mark.parametrize(("given", "cavitation"), BETWEEN)
def test_curve_agrees_with_the_solver_between_its_nodes(given, cavitation):
    solution = softlube.solve(**given, cavitation=cavitation)
    for name in curve.available("load" if "beta_load" in given else "indentation"):
        if name.startswith("film_min_"):
            continue
        value, error = curve.evaluate(name, **given, cavitation=cavitation)
        own = solution.quantities[name]
        assert abs(value - own) <= 1.5 * (error + own.error), name


def test_errors_are_small_where_they_should_be():
    beta = np.geomspace(1e-4, 1e8, 500)
    for name in ("film_center", "film_inlet", "friction_contact", "friction_domain"):
        value, error = curve.evaluate(name, beta)
        assert np.max(error / value) < 2e-4, name
    value, error = curve.film_min(beta)
    assert np.max(error / value) < 2e-3


@pytest.mark.parametrize("name", ["film_center", "film_min", "film_outlet_min", "friction_contact", "pressure_gradient_inlet"])
def test_local_exponents_are_smooth(name):
    """From 10⁴ to 10⁸, where no extremum changes its place, they are a polynomial of fifth degree in ln β within 0.001."""
    x = np.linspace(np.log(1e4), np.log(1e8), 400)
    exponents = curve.curve(name).exponent(np.exp(x))
    assert np.max(np.abs(np.polynomial.Polynomial.fit(x, exponents, 5)(x) - exponents)) < 1e-3


def test_a_kink_has_an_error_that_says_so():
    """Near h₀ = 0 the largest inlet gradient passes from one maximum to another; 0.0686735 is solved at β_load = 4.45."""
    value, error = curve.pressure_gradient_inlet(beta_load=4.45)
    assert 0.003 < abs(value - 0.0686735) < error


def test_bulk_evaluation_costs_less_than_a_microsecond_a_point():
    beta = 10 ** np.random.default_rng(1).uniform(-4, 8, 200_000)
    curve.film_center(beta)
    times = []
    for _ in range(5):
        began = time.process_time()
        curve.film_center(beta)
        times.append(time.process_time() - began)
    assert min(times) / beta.size < 1e-6


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_curve_joins_the_hertz_limit(cavitation):
    for beta in (1e8, 1e12):
        two_terms = limits.film_center_asymptote(beta)
        assert curve.film_center(beta, cavitation=cavitation)[0] == pytest.approx(two_terms, rel=3e-4)
        assert curve.friction_contact(beta, cavitation=cavitation)[0] == pytest.approx(
            limits.friction_contact_asymptote(beta), rel=3e-3
        )
    assert curve.film_min(1e12, cavitation=cavitation)[0] == pytest.approx(
        limits.film_min_asymptote(1e12, cavitation), rel=2e-3
    )
    assert curve.load(1e12, cavitation=cavitation)[0] == pytest.approx(limits.HERTZ_LOAD, rel=1e-4)


@pytest.mark.parametrize(
    ("name", "exponent"),
    [("film_center", -0.6), ("film_min", -0.75), ("friction_contact", -0.4), ("pressure_gradient_inlet", 0.2)],
)
def test_local_exponents_at_large_beta_are_the_theory_s(name, exponent):
    # Over half a decade, so that the errors of film_min's table do not count.
    before, after = (curve.evaluate(name, beta)[0] for beta in (10**7.5, 1e8))
    assert np.log(after / before) / np.log(10**0.5) == pytest.approx(exponent, abs=0.01)
    assert curve.curve(name).exponent(1e8) == pytest.approx(exponent, abs=0.01)


def test_rigid_limit_with_the_condition_and_without():
    """h₀ ~ β^(−2) where half the rigid sphere's pressure carries the load, β^(−4/5) where the deformation has to."""
    for cavitation, exponent in (("reynolds", -2.0), ("none", -0.8)):
        assert curve.curve("height", "load", cavitation).exponent(2e-4) == pytest.approx(exponent, abs=2e-3)
    height = float(curve.height(beta_load=1e-4)[0])
    # Half-Sommerfeld's load would lift the sphere to this; the pressure that spills over the axis carries 10 % more.
    half = (2 * np.pi / (5 * 1e-4 * limits.HERTZ_LOAD)) ** 2 / 2
    assert 1.05 < np.sqrt(height / half) < 1.15
    assert curve.film_center(beta_load=1e-4)[0] == pytest.approx(height, rel=1e-3)


def test_beyond_the_table_the_error_grows():
    for name in ("film_center", "friction_domain", "film_min"):
        inside, beyond, far = (np.divide(*curve.evaluate(name, beta)[::-1]) for beta in (1e8, 1e9, 1e12))
        assert inside < beyond < far < 0.2
    low, lower = (np.divide(*curve.film_center(beta)[::-1]) for beta in (1e-4, 1e-6))
    assert low < lower < 0.05


def test_arrays_keep_their_shape_and_scalars_are_scalars():
    value, error = curve.film_min(np.full((2, 3), 50.0))
    assert value.shape == error.shape == (2, 3)
    assert np.ndim(curve.film_min(50.0)[0]) == 0


def test_all_quantities_of_a_problem():
    quantities = curve.quantities(Problem(beta_load=1e3))
    assert list(quantities) == list(STEADY)
    assert float(quantities["load"]) == limits.HERTZ_LOAD
    assert quantities["load"].error == 0
    assert curve.quantities(Problem(beta=1e3))["height"] == -1


@pytest.mark.parametrize(
    ("call", "named"),
    [
        (lambda: curve.film_center(), "beta, beta_load"),
        (lambda: curve.film_center(1.0, beta_load=1.0), "beta, beta_load"),
        (lambda: curve.film_center([1.0, -1.0]), "beta"),
        (lambda: curve.film_center(np.nan), "beta"),
        (lambda: curve.film_center(1.0, cavitation="half"), "cavitation"),
        (lambda: curve.height(1.0), "quantity"),
        (lambda: curve.load(beta_load=1.0), "quantity"),
        (lambda: curve.evaluate("film", 1.0), "quantity"),
        (lambda: curve.curve("film_min", "gap"), "normalisation"),
        (lambda: curve.quantities(Problem(beta=1.0, height=1)), "indentation"),
    ],
)
def test_wrong_questions_are_refused(call, named):
    with pytest.raises(InputError, match=f"^{named}:"):
        call()


def test_a_quantity_younger_than_the_table_is_left_out(monkeypatch):
    from dataclasses import replace

    monkeypatch.setitem(STEADY, "film_mean", replace(STEADY["film_center"], name="film_mean"))
    quantities = curve.quantities(Problem(beta=100.0))
    assert "film_mean" not in quantities
    assert "film_center" in quantities
