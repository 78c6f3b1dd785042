"""The film at polar coordinates: heights, gradients, levels."""

import numpy as np
import pytest

import softlube
from softlube.readout.film import (
    driving_gradient,
    levels,
    pressure_gradient,
    sphere_height,
    substrate_height,
    viscosity_at_rest,
)


@pytest.fixture(scope="module")
def plain():
    return softlube.solve(beta=300, accuracy=0.01)


def test_the_film_is_what_the_heights_leave(plain):
    r, theta = np.array([0.0, 0.7, 1.5]), 0.4
    assert sphere_height(plain, r) - substrate_height(plain, r, theta) == pytest.approx(plain.fields.film_at(r, theta))


def test_gradients_are_those_of_differences(plain):
    step = 1e-6
    by_r, by_theta = pressure_gradient(plain, 0.8, 0.5)
    at = plain.fields.pressure_at
    assert by_r == pytest.approx((at(0.8 + step, 0.5) - at(0.8 - step, 0.5)) / (2 * step), rel=1e-6)
    assert by_theta == pytest.approx((at(0.8, 0.5 + step) - at(0.8, 0.5 - step)) / (2 * step * 0.8), rel=1e-6)
    assert driving_gradient(plain, 0.8, 0.5) == (by_r, by_theta)
    assert viscosity_at_rest(plain, 0.8, 0.5) == 1


def test_at_the_centre_the_gradient_is_one_vector(plain):
    """∂p/∂x there, whatever the angle; by symmetry there is no ∂p/∂y."""
    theta = np.linspace(-3, 3, 7)
    by_r, by_theta = pressure_gradient(plain, 0.0, theta)
    assert by_r == pytest.approx(by_r[3] * np.cos(theta), abs=5e-3 * abs(by_r[3]))
    assert by_theta == pytest.approx(-by_r[3] * np.sin(theta), abs=5e-3 * abs(by_r[3]))


def test_levels_end_on_the_walls(plain):
    below, above = levels(plain, 0.8, 0.5, substrate_height(plain, 0.8, 0.5), None)
    assert (float(below), float(above)) == (0.0, 1.0)
    assert np.isnan(levels(plain, 0.8, 0.5, 5.0, None)[0])
    with pytest.raises(softlube.InputError, match="z, level: give exactly one of them"):
        levels(plain, 0.8, 0.5, 0.0, 0.5)
