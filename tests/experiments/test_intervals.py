"""Intervals of fitted parameters against Student and against each other."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from softlube import fit
from softlube.experiments.friction_model import make_model
from softlube.experiments.intervals import Estimate, bootstrap, profile
from softlube.experiments.optimum import solve_model

KNOWN = {"radius": "2 mm", "young_modulus": "3 MPa"}


VISCOSITY = 2.0


def noisy(data, seed, noise=0.05):
    return replace(data, friction=data.friction * np.exp(noise * np.random.default_rng(seed).standard_normal(len(data))))


def test_the_profile_of_a_linear_model_is_student_s_interval(clean):
    """With absolute noise and the offset alone free the model is a mean, whose interval is in every textbook."""
    random = np.random.default_rng(5)
    data = replace(clean, friction=clean.friction + 1e-5 * random.standard_normal(len(clean)))
    found = fit(data, **KNOWN, viscosity=VISCOSITY, free=("offset",), noise="absolute")
    differences = data.friction - clean.friction
    half = stats.t.ppf(0.975, 71) * differences.std(ddof=1) / math.sqrt(72)
    estimate = found.estimates["friction_offset"]
    assert estimate.value == pytest.approx(differences.mean(), abs=1e-3 * half)
    assert estimate.low == pytest.approx(differences.mean() - half, abs=1e-2 * half)
    assert estimate.high == pytest.approx(differences.mean() + half, abs=1e-2 * half)


@pytest.mark.slow
def test_the_bootstrap_agrees_with_the_profile(clean):
    data = noisy(clean, 11)
    profile, bootstrap = (
        fit(data, **KNOWN, interval=kind, compare=False).estimates["viscosity"] for kind in ("profile", "bootstrap")
    )
    assert bootstrap.value == profile.value
    assert (bootstrap.high - bootstrap.low) == pytest.approx(profile.high - profile.low, rel=0.35)


@pytest.mark.parametrize(
    ("low", "high", "unit", "determined"),
    [
        (1.0, 1.9, "Pa s", True),
        (1.0, 2.1, "Pa s", False),
        (0.0, 1.0, "Pa s", False),
        (0.0, math.inf, "Pa s", False),
        (1.0, math.inf, "Pa", False),
        (-1e-5, 3e-5, "N", True),
        (1e-6, 9e-5, "N", True),
        (-math.inf, 3e-5, "N", False),
    ],
)
def test_what_counts_as_determined(low, high, unit, determined):
    assert Estimate(1.0, low, high, unit).determined is determined


def test_the_ends_of_a_profile_are_where_the_sum_of_squares_is(clean):
    model, optimum = solve_model(make_model(noisy(clean, 4), **KNOWN), 2.0)
    estimate = profile(model, optimum, "viscosity", 0.9)
    level = optimum.sum_of_squares * (1 + stats.t.ppf(0.95, 71) ** 2 / 71)
    for end in (estimate.low, estimate.high):
        residuals = model.residuals(model.fixed | {"viscosity": end})
        assert residuals @ residuals == pytest.approx(level, rel=1e-4)
    wider = profile(model, optimum, "viscosity", 0.99)
    assert wider.low < estimate.low < estimate.value < estimate.high < wider.high


def test_a_bootstrap_tells_its_progress(clean):
    model, optimum = solve_model(make_model(noisy(clean, 4), **KNOWN), 2.0)
    seen = []
    estimates, covariance = bootstrap(model, optimum, 0.95, np.random.default_rng(0), False, seen.append)
    assert [(news.done, news.total) for news in seen[:2]] == [(0, 400), (20, 400)]
    assert covariance.shape == (1, 1)
    # The interval of a single parameter, in logarithm, is about four of its standard deviations.
    width = math.log(estimates["viscosity"].high / estimates["viscosity"].low)
    assert width == pytest.approx(2 * 1.96 * math.sqrt(covariance[0, 0]), rel=0.15)


def test_an_estimate_for_people_and_for_programs():
    open_above = Estimate(2.0, 1.9, math.inf, "Pa s")
    assert open_above.row("second_viscosity")[0::3] == ("second viscosity", "Pa s")
    assert open_above.row("viscosity")[2].endswith(" to open")
    assert open_above.to_dict() == {"value": 2.0, "low": 1.9, "high": None, "unit": "Pa s", "determined": False}
