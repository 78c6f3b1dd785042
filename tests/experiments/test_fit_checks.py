"""Checks of a fit: the order of residuals, and rows that it has not seen."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from softlube import fit
from softlube.errors import InputError
from softlube.experiments.fit_checks import check_held_out, order_of_residuals, runs
from softlube.experiments.friction_model import make_model

KNOWN = {"radius": "2 mm", "young_modulus": "3 MPa"}
VALUES = {"viscosity": 2.0, "young_modulus": 3e6, "friction_offset": 0.0}


def noisy(data, seed, noise=0.05):
    return replace(data, friction=data.friction * np.exp(noise * np.random.default_rng(seed).standard_normal(len(data))))


def test_rows_left_out_are_predicted_or_not(clean):
    data = noisy(clean, 1)
    good = fit(data, **KNOWN, hold_out=0.25, seed=4, compare=False)
    assert len(good.hold_out.lines) == 18
    assert len(good.model.data) == 54
    assert not set(good.hold_out.lines) & set(good.model.data.lines.tolist())
    assert good.hold_out.probability > 0.01
    assert good.hold_out.covered > 0.8
    friction = data.friction.copy()
    friction[np.array(good.hold_out.lines) - 1] *= 1.3
    bad = fit(replace(data, friction=friction), **KNOWN, hold_out=0.25, seed=4, compare=False)
    assert bad.hold_out.lines == good.hold_out.lines
    assert bad.hold_out.probability < 1e-6
    assert any("worse than those fitted" in text for text in bad.verdicts)


def test_fewruns_are_improbable_and_many_are_not():
    """All below, then all above: 2 runs of 20, whose exact probability is 2/C(20, 10)."""
    order = np.arange(20.0)
    assert runs(order, order) == pytest.approx(2 / math.comb(20, 10), abs=1e-4)
    assert runs(order, (-1.0) ** order) > 0.999
    assert math.isnan(runs(order[:8], order[:8]))  # too few to say
    shuffled = np.random.default_rng(1).permutation(20)
    assert runs(order[shuffled], order[shuffled]) == runs(order, order)


def test_few_rows_tell_nothing_of_an_order(clean):
    """Nine rows: no claim that the residuals are in order or not; ten: there is one."""
    nine, ten = (fit(noisy(clean, 3).take(np.arange(count) * 7), **KNOWN, compare=False) for count in (9, 10))
    assert nine.trend[0] == ""
    assert math.isnan(nine.trend[1])
    assert any(text.startswith("9 rows are too few to tell") for text in nine.verdicts)
    assert nine.to_dict()["trend"] == {"along": None, "probability": None}
    assert 0 < ten.trend[1] <= 1
    assert not any("too few to tell" in text for text in ten.verdicts)


def test_chance_is_seldom_called_an_order():
    """By Wald & Wolfowitz: of random residuals about one in twenty has a probability below 0.05."""
    random = np.random.default_rng(7)
    order = np.arange(60.0)
    small = np.mean([runs(order, random.normal(size=60)) < 0.05 for _ in range(2000)])
    assert 0.03 < small < 0.06


def test_the_trend_is_found_along_what_it_follows(clean):
    model = make_model(clean, **KNOWN, viscosity=2.0).cover(VALUES, 2.0, None)
    along, probability = order_of_residuals(model, VALUES, np.log(clean.speed))
    assert (along, probability < 1e-6) == ("speed", True)
    along, probability = order_of_residuals(model, VALUES, np.log(clean.load))
    assert (along, probability < 1e-6) == ("load", True)
    random = np.random.default_rng(3).normal(size=len(clean))
    assert order_of_residuals(model, VALUES, random)[1] > 0.05


def test_rows_with_the_scatter_of_the_fit_are_covered(clean):
    model = make_model(clean, **KNOWN, viscosity=2.0).cover(VALUES, 2.0, None)
    held = noisy(clean, 5)
    found = check_held_out(model, VALUES, held, 0.05, 60, 0.95)
    residuals = np.log(held.friction / clean.friction)
    assert found.scatter == pytest.approx(math.sqrt(np.mean(residuals**2)), rel=1e-6)
    assert found.probability == pytest.approx(stats.f.sf((found.scatter / 0.05) ** 2, 72, 60), rel=1e-6)
    assert found.covered == np.mean(np.abs(residuals) <= stats.t.ppf(0.975, 60) * 0.05)
    assert check_held_out(model, VALUES, held, 0.02, 60, 0.95).probability < 1e-6
    with pytest.raises(InputError, match="line 1: the friction is not positive"):
        check_held_out(model, VALUES, replace(held, friction=-held.friction), 0.05, 60, 0.95)
