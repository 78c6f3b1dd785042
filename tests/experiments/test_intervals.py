"""Intervals of fitted parameters against Student and against each other."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from softlube import fit

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


def test_the_bootstrap_agrees_with_the_profile(clean):
    data = noisy(clean, 11)
    profile, bootstrap = (
        fit(data, **KNOWN, interval=kind, compare=False).estimates["viscosity"] for kind in ("profile", "bootstrap")
    )
    assert bootstrap.value == profile.value
    assert (bootstrap.high - bootstrap.low) == pytest.approx(profile.high - profile.low, rel=0.35)
