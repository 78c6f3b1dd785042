"""Closed forms against independent integration and differentiation."""

import itertools

import numpy as np
import pytest
from scipy.integrate import dblquad, quad
from scipy.special import ellipk

from softlube.model import exact


def ring_potential(r, source):
    """∫ dφ/|x − x′| over a ring, by the complete elliptic integral."""
    return 4 / (r + source) * ellipk(4 * r * source / (r + source) ** 2)


def axisymmetric_displacement(pressure, r, radius):
    """−∫ p dA/|x − x′| over a disc by adaptive quadrature, Eq. (6b)."""

    def integrand(source):
        return pressure(source) * ring_potential(r, source) * source

    points = sorted({0.0, min(r, radius), radius})
    return -sum(quad(integrand, low, high, limit=200)[0] for low, high in itertools.pairwise(points))


@pytest.mark.parametrize("r", [0.1, 0.6, 0.999, 1.001, 1.5, 4.0])
def test_hertz_pressure_gives_hertz_displacement(r):
    expected = axisymmetric_displacement(exact.hertz_pressure, r, 1.0)
    assert exact.hertz_displacement(r) == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("radius", [0.7, 1.3])
def test_hertz_of_another_radius(radius):
    expected = axisymmetric_displacement(lambda s: exact.hertz_pressure(s, radius), 0.9, radius)
    assert exact.hertz_displacement(0.9, radius) == pytest.approx(expected, rel=1e-7)


def test_hertz_load():
    load = quad(lambda r: 2 * np.pi * r * exact.hertz_pressure(r), 0, 1)[0]
    assert load == pytest.approx(exact.HERTZ_LOAD, rel=1e-10)


def test_hertz_indentation():
    """N = (4/3) E* √R δ^(3/2) with E* = 4G (Johnson 1985, Eq. 4.23), from floats and from arrays."""
    radius, shear_modulus, depth = 2e-3, np.array([1e6, 3e5]), np.array([2e-5, 1e-4])
    load = 4 / 3 * 4 * shear_modulus * np.sqrt(radius) * depth**1.5
    assert exact.hertz_indentation(load, radius, shear_modulus) == pytest.approx(depth, rel=1e-14)
    assert exact.hertz_indentation(load, radius, shear_modulus, power=2) == pytest.approx(depth**2, rel=1e-14)
    assert exact.hertz_indentation(float(load[0]), radius, 1e6) == pytest.approx(2e-5, rel=1e-14)


@pytest.mark.parametrize("r", [0.0, 0.4, 0.95, 1.2, 3.0])
def test_uniform_pressure_on_a_disc(r):
    expected = axisymmetric_displacement(lambda s: 1.0, r, 1.0) if r else -2 * np.pi
    assert exact.disc_displacement(r) == pytest.approx(expected, rel=1e-7)


def test_kapitza_solves_reynolds():
    beta, gap = 3.0, 0.2

    def pressure(x, y):
        return exact.kapitza_pressure(np.hypot(x, y), np.arctan2(y, x), beta, gap)

    def film(x, y):
        return gap + (x**2 + y**2) / 2

    x, y, d = 0.4, 0.3, 1e-3

    def flux(x, y, dx, dy):
        at = x + dx / 2, y + dy / 2
        slope = (pressure(x + dx, y + dy) - pressure(x, y)) / (dx + dy)
        return film(*at) ** 3 * slope + (film(*at) / beta if dx else 0.0)

    balance = (flux(x, y, d, 0) - flux(x - d, y, d, 0) + flux(x, y, 0, d) - flux(x, y - d, 0, d)) / d
    assert abs(balance) < 1e-5
    assert abs(flux(x, y, d, 0)) > 0.1


def test_half_sommerfeld_load_is_the_positive_half_of_kapitza():
    beta, gap = 7.0, 0.3
    half, _ = dblquad(
        lambda r, theta: r * exact.kapitza_pressure(r, theta, beta, gap), -np.pi / 2, np.pi / 2, 0, np.inf, epsabs=1e-11
    )
    assert exact.half_sommerfeld_load(beta, gap) == pytest.approx(half, rel=1e-8)


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_far_field_solves_its_equation(cavitation):
    theta, d = np.linspace(0.1, 1.8, 20), 1e-4
    f = [exact.far_field_profile(theta + k * d, cavitation) for k in (-1, 0, 1)]
    assert (f[0] - 2 * f[1] + f[2]) / d**2 - 9 * f[1] == pytest.approx(-8 * np.cos(theta), abs=1e-5)


def test_far_front_has_no_pressure_and_no_gradient():
    front, d = exact.far_front_angle(), 1e-5
    assert np.degrees(front) == pytest.approx(108.43, abs=0.01)
    assert exact.far_field_profile(front) == pytest.approx(0, abs=1e-14)
    assert exact.far_field_profile(front - d) == pytest.approx(0, abs=1e-8)
    assert exact.far_field_profile(front + 0.1) == 0
    assert exact.far_field_profile(front - 0.2) > 0.01
