"""The dry line contact: Hertz, limits of Hunter's solution, and the surface that it presses."""

import numpy as np
import pytest
from scipy.integrate import quad

from softlube.errors import InputError
from softlube.model.dry_line import dry_line
from softlube.model.substrates import HalfSpaceKernel, LayerKernel, ViscoelasticKernel


def test_hertz():
    dry = dry_line(HalfSpaceKernel())
    assert (dry.half_width, dry.middle, dry.friction_hysteresis) == (1, 0, 0)
    assert dry.pressure([-1.1, 0, 0.6]) == pytest.approx(np.array([0, 1, 0.8]) / (2 * np.pi))


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_slow_and_fast(share):
    """Slow: the friction coefficient (1 − C₀/C∞) L/R.  Fast: the instantaneous Hertz contact, b² as its compliance."""
    slow = dry_line(ViscoelasticKernel((share,), (1e-4,)))
    assert slow.friction_hysteresis / 6 / 0.25 == pytest.approx(share * 1e-4, rel=1e-3)
    assert slow.half_width == pytest.approx(1, abs=1e-4)
    fast = dry_line(ViscoelasticKernel((share,), (1e5,)))
    assert fast.half_width == pytest.approx(np.sqrt(1 - share), rel=1e-4)
    assert fast.pressure(fast.middle) == pytest.approx(1 / (2 * np.pi * np.sqrt(1 - share)), rel=1e-3)
    assert abs(fast.middle) < 1e-3


@pytest.mark.parametrize("length", [0.1, 1.0, 10.0])
def test_load_edges_and_the_surface_under_it(length):
    """By quadrature: the load, the moment that is the friction, and w′ = x at places of the contact."""
    instantaneous = 0.1
    dry = dry_line(ViscoelasticKernel((1 - instantaneous,), (length,)))
    left, right = dry.middle - dry.half_width, dry.middle + dry.half_width
    theta, weight = np.polynomial.legendre.leggauss(400)
    phi = np.pi * (theta + 1) / 2
    x = dry.middle + dry.half_width * np.cos(phi)
    rule = weight * np.pi / 2 * dry.half_width * np.sin(phi)
    p = dry.pressure(x)
    assert rule @ p == pytest.approx(0.25, rel=1e-8)
    assert 6 * rule @ (p * x) == pytest.approx(dry.friction_hysteresis, rel=1e-7)
    assert p.min() > -1e-9
    assert dry.pressure([left + 1e-6, right - 1e-6]) == pytest.approx([0, 0], abs=2e-2)

    def slope(place):  # of the elastic displacement, 2 pv∫ p/(x − x′) dx′, by subtracting the singularity
        if place >= right:
            return 2 * rule @ (p / (place - x))
        own = float(dry.pressure(place))
        return 2 * (rule @ ((p - own) / (place - x)) + own * np.log((place - left) / (right - place)))

    def faded(s, place):
        return np.exp(-(s - place) / length) / length * slope(s)

    for place in (left + 0.31 * dry.half_width, dry.middle + 0.123 * dry.half_width):
        ways = ((place, right), (right, np.inf))
        ahead = sum(quad(faded, *way, args=(place,), limit=400)[0] for way in ways)
        assert instantaneous * slope(place) + (1 - instantaneous) * ahead == pytest.approx(place, abs=2e-3)


def test_what_has_no_closed_form():
    for substrate in (LayerKernel(1.0), ViscoelasticKernel((0.3, 0.3), (1.0, 2.0))):
        with pytest.raises(InputError, match="closed form"):
            dry_line(substrate)
