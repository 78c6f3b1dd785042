"""What a substrate has taken up of a pressure or a load whose course is known, in closed form."""

import numpy as np
import pytest
from scipy.special import expn

from softlube.model.creep import ELASTIC, Creep, Term
from softlube.transient.creep import relaxed_loads, taken_up

TERMS = (Term(0.2, 0.05), Term(0.3, 1.0), Term(0.1, 20.0))
CREEP = Creep(0.4, TERMS)
SHAPE = np.array([0.0, 0.3, 2.0, 50.0])


def test_at_a_constant_speed_it_is_an_exponential_integral():
    """∫ e^(−s) (u/(u + bs))² ds = x² eˣ (E₂(x)/x − E₂(x + S)/(x + S)) with x = u/b, from 0 to bS = 9h₀."""
    shares = taken_up(CREEP, "height", 0.7, 2.0, SHAPE)
    for term, share in zip(TERMS, shares, strict=True):
        x, end = np.minimum((2.0 + SHAPE) / (0.7 * term.time), 500.0), 9 * 2.0 / (0.7 * term.time)
        known = x < 500
        exact = x**2 * np.exp(x) * (expn(2, x) / x - expn(2, x + end) / (x + end))
        assert share[known] == pytest.approx(exact[known], rel=1e-10)
        assert share[~known] == pytest.approx(1, abs=4e-3)


def test_under_a_constant_load_it_keeps_its_part_of_the_load():
    """On the axis ∫ e^(−s) e^(−bs) ds with b = τV/h₀, from 0 to bS = ln 10; over the plane ∫ e^(−s) ds of the load."""
    speed, height = 0.5, 2.0
    f = np.geomspace(1e-6, 1e12, 40001)
    shares = taken_up(CREEP, "load", speed, height, np.append(0.0, f))
    for term, share in zip(TERMS, shares, strict=True):
        b = term.time * speed / height
        assert share[0] == pytest.approx((1 - np.exp(-(1 + b) * np.log(10) / b)) / (1 + b), rel=1e-10)
        taylor = f / (height + f) ** 2  # dA p goes like df/u²
        part = np.trapezoid(share[1:] * taylor, np.log(f)) / np.trapezoid(taylor, np.log(f))
        assert part == pytest.approx(1 - np.exp(-np.log(10) / b), rel=1e-5)


def test_who_does_not_come_down_has_left_nothing():
    assert not np.any(taken_up(CREEP, "height", -0.1, 1.0, SHAPE))
    assert taken_up(ELASTIC, "load", 1.0, 1.0, SHAPE).shape == (0, 4)


def test_a_load_that_steps_creeps_like_the_compliance():
    step = 1e-3
    times = step * np.arange(5001)
    creep = 1 - sum(term.weight * np.exp(-times / term.time) for term in TERMS)
    assert relaxed_loads(CREEP, np.zeros(3), np.ones(5001), step) == pytest.approx(creep, rel=1e-12)
    assert relaxed_loads(CREEP, np.ones(3), np.ones(5001), step) == pytest.approx(1)
    assert np.array_equal(relaxed_loads(ELASTIC, np.zeros(0), times, step), times)


def test_a_load_that_grows_exponentially():
    """∫J(t − s) dN(s) of N = eᵗ from the past on: J₀ + ΣJᵢ/(1 + τᵢ) times it."""
    first = np.array([1 / (1 + term.time) for term in TERMS])
    times = np.linspace(0, 3, 3001)
    expected = (0.4 + np.array([term.weight for term in TERMS]) @ first) * np.exp(times)
    assert relaxed_loads(CREEP, first, np.exp(times), 1e-3) == pytest.approx(expected, rel=1e-6)
