"""The dry contact on a substrate that remembers against first-order perturbation, laws of slow and fast sliding, and the film's
limit.
"""

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.integrate import quad

import softlube
from softlube.errors import InputError
from softlube.model.exact import HERTZ_LOAD, hertz_displacement, hertz_pressure
from softlube.model.substrates import HalfSpaceKernel, ViscoelasticKernel
from softlube.steady.dry_sliding import dry_sliding


def remembered(x, y, length):
    """∫ e^(−s) wₑ(x + Ls, y) ds under a Hertz pressure."""

    def at(s):
        return np.exp(-s) * hertz_displacement(np.hypot(x + length * s, y))

    edge = min((np.sqrt(max(1 - y * y, 0)) - x) / length, 1.0)
    return quad(at, 0, 1, points=[edge], limit=200)[0] + quad(at, 1, 40, limit=200)[0]


def little_memory(length):
    """Friction coefficient over J₁ and a/R for J₁ → 0: the pressure stays Hertz's, and ∂w₁/∂x = (w₁ − wₑ)/L."""
    x, weight = leggauss(14)
    r, over_r = np.sin((x + 1) * np.pi / 4), weight * np.pi / 4 * np.cos((x + 1) * np.pi / 4)
    t, over_t = (x + 1) * np.pi / 2, weight * np.pi / 2
    total = 0.0
    for radius, part in zip(r, over_r, strict=True):
        slopes = [(remembered(radius * np.cos(a), radius * np.sin(a), length) - hertz_displacement(radius)) / length for a in t]
        total += 2 * part * radius * float(hertz_pressure(radius)) * float(over_t @ np.array(slopes))
    return total / HERTZ_LOAD


@pytest.mark.parametrize("length", [0.02, 1.0, 50.0])
def test_a_little_memory_is_a_perturbation_of_hertz(length):
    found = dry_sliding(ViscoelasticKernel((1e-3,), (length,)))
    assert found.friction_coefficient / 1e-3 == pytest.approx(little_memory(length), rel=2e-3)
    assert found.load == pytest.approx(HERTZ_LOAD, rel=2e-3)


@pytest.mark.parametrize("share", [1e-3, 0.5])
def test_slow_sliding(share):
    """μ = (1 − C_instant/C_relaxed) L/R; the next term is −4L/(πa) for a little memory, 2.5 % at L/a = 0.02."""
    length = 0.005
    found = dry_sliding(ViscoelasticKernel((share,), (length,)))
    assert found.friction_coefficient == pytest.approx(share * length, rel=0.01)
    less = dry_sliding(ViscoelasticKernel((1e-3,), (0.02,)))
    assert less.friction_coefficient == pytest.approx(1e-3 * 0.02 * (1 - 4 / np.pi * 0.02), rel=2e-3)


def test_fast_sliding():
    """μ = (4/5)(C_relaxed/C_instant − 1) δ/L; the next term is −5(ln(L/a) + 1.17)/(3πL/a), 5.4 % at L/a = 50."""
    share = 1e-3
    for length, tolerance in ((50.0, 0.06), (500.0, 0.01)):
        found = dry_sliding(ViscoelasticKernel((share,), (length,)))
        leading = 0.8 * (1 / (1 - share) - 1) / length
        assert found.friction_coefficient == pytest.approx(leading, rel=tolerance)
        next_term = 5 * (np.log(length) + 1.17) / (3 * np.pi * length)
        assert found.friction_coefficient == pytest.approx(leading * (1 - next_term), rel=2e-3)


@pytest.mark.parametrize(("length", "measured"), [(0.02, 0.981), (50.0, 0.906)])
def test_next_terms_where_the_modulus_halves(length, measured):
    """μ over the first term, in the table of docs/theory/viscoelastic.md."""
    found = dry_sliding(ViscoelasticKernel((0.5,), (length,)))
    first = 0.5 * length if length < 1 else 0.8 / length
    assert found.friction_coefficient / first == pytest.approx(measured, abs=1e-3)


def test_it_is_the_limit_of_lubricated_contacts():
    """The film adds to the hysteresis what goes like β^(−3/5)."""
    kernel = ViscoelasticKernel((0.5,), (1.0,))
    dry, lubricated = dry_sliding(kernel), softlube.solve(beta=3000.0, substrate=kernel, accuracy=3e-3)
    assert lubricated.friction_hysteresis == pytest.approx(dry.friction, rel=2e-3)
    assert lubricated.load == pytest.approx(dry.load, rel=0.02)


@pytest.mark.parametrize(("length", "shorter"), [(0.3, 1.2), (1.0, 2.0)])
def test_the_contact_is_no_circle(length, shorter):
    found = dry_sliding(ViscoelasticKernel((0.9,), (length,)))
    inlet, side, outlet = (found.edge(angle) for angle in (0.0, np.pi / 2, np.pi))
    assert inlet > side > shorter * outlet
    gap, pressure = found.fields.film, found.fields.pressure
    assert np.all(gap > -1e-9)
    assert np.max(np.abs(gap * pressure)) < 1e-7


def test_an_elastic_substrate_is_refused():
    with pytest.raises(InputError, match=r"it remembers nothing; softlube\.dry\.dry_contact"):
        dry_sliding(HalfSpaceKernel())
