"""Least squares of the friction: the optimum, its covariance, outliers, and rows that the curves do not reach."""

import math
from dataclasses import replace

import numpy as np
import pytest

from softlube.errors import NotConvergedError
from softlube.experiments.friction_model import make_model
from softlube.experiments.optimum import optimise, solve_model

KNOWN = {"radius": "2 mm", "young_modulus": "3 MPa"}
VALUES = {"viscosity": 2.0, "young_modulus": 3e6, "friction_offset": 0.0}


def test_an_offset_alone_is_a_mean(clean):
    """With absolute noise the model is linear: the mean, its sum of squares, and its variance over the number of rows."""
    noise = 1e-5 * np.random.default_rng(0).standard_normal(len(clean))
    data = replace(clean, friction=clean.friction + noise)
    model = make_model(data, **KNOWN, viscosity=2.0, free=("offset",), noise="absolute").cover(VALUES, 2.0, None)
    found = optimise(model, VALUES)
    assert model.values(found.x)["friction_offset"] == pytest.approx(noise.mean(), abs=1e-10)
    scale = model.scale
    assert found.sum_of_squares == pytest.approx(np.sum((noise - noise.mean()) ** 2) / scale**2, rel=1e-6)
    assert found.covariance[0, 0] == pytest.approx(noise.var(ddof=1) / scale**2 / len(noise), rel=1e-6)


def test_outliers_hardly_move_a_robust_optimum(clean):
    spoilt = replace(clean, friction=np.where(np.arange(len(clean)) % 12 == 0, 4.0, 1.0) * clean.friction)
    model, plain = solve_model(make_model(spoilt, **KNOWN), 2.0)
    _, robust = solve_model(make_model(spoilt, **KNOWN), 2.0, robust=True)
    off = [abs(math.log(model.values(each.x)["viscosity"] / 2)) for each in (plain, robust)]
    assert off[0] > 0.2
    assert off[1] < 0.02


def test_rows_that_the_curves_do_not_reach_are_named(clean):
    friction = clean.friction.copy()
    friction[:] *= 1e-4  # so thin a liquid that beta is beyond 1e8
    with pytest.raises(NotConvergedError, match=r"line \d+: the fit puts it at beta|cannot be had"):
        solve_model(make_model(replace(clean, friction=friction), **KNOWN), 2.0)
