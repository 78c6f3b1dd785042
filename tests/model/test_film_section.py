"""The flow across the film against closed forms, quadrature and differences."""

import numpy as np
import pytest
from scipy.integrate import quad

from softlube.model.film_section import EXACT, USUAL, film_section, viscosity_at
from softlube.model.liquids import CarreauYasudaLaw, EyringLaw, NewtonianLaw, OstwaldLaw

REST = NewtonianLaw()
CARREAU = CarreauYasudaLaw(REST, 3.0, 0.4, 0.01)
LAWS = [OstwaldLaw(REST, 0.7, 0.8), OstwaldLaw(REST, 0.7, 0.35), CARREAU, EyringLaw(REST, 0.8)]


def places(seed=1, n=400, decades=2):
    rng = np.random.default_rng(seed)
    size, angle = 10 ** rng.uniform(-decades, 1, n), rng.uniform(0, 2 * np.pi, n)
    return size * np.stack([np.cos(angle), np.sin(angle)]), 10 ** rng.uniform(-decades, 1, n)


def test_constant_viscosity_is_the_parabola():
    difference, drag = places()
    section = film_section(REST, difference, drag)
    assert section.moment == pytest.approx(difference, rel=1e-13)
    assert section.mean == pytest.approx(np.stack([drag, np.zeros_like(drag)]), rel=1e-12, abs=1e-12)
    assert section.by_difference == pytest.approx(np.eye(2)[:, :, None] * np.ones(drag.size), abs=1e-12)
    assert section.by_drag == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("index", [1.0, 0.8, 0.5, 0.35])
def test_plane_flow_of_a_power_law(index):
    """Rolling: q = −(2n/(2n+1)) (u/2)^((2n+1)/n) |∇p|^(1/n−1) ∇p/K^(1/n), here for m = 12∫ζψτ dζ, in any direction."""
    law, (difference, drag) = OstwaldLaw(REST, 0.7, index), places()
    section = film_section(law, difference, np.zeros_like(drag))
    wall = np.hypot(*difference) / 2
    closed = 12 * index / (2 * index + 1) * difference / 4 * (wall / 0.7) ** (1 / index - 1)
    assert np.all(np.hypot(*(section.moment - closed)) <= 1e-10 * np.hypot(*closed))
    assert section.mean == pytest.approx(0, abs=1e-14)


@pytest.mark.parametrize("law", LAWS)
def test_a_film_that_is_sheared_only(law):
    _, drag = places()
    section = film_section(law, np.zeros((2, drag.size)), drag)
    assert section.mean[0] == pytest.approx(law.flow_curve(drag), rel=1e-9)
    assert np.all(section.moment == 0)


def test_eyring_along_the_sliding_by_hyperbolic_functions():
    """∫ sinh has a closed form: b c/τe² = cosh(τ₂/τe) − cosh(τ₁/τe) gives τm, and m follows by parts."""
    tau, (_, drag) = 0.8, places()
    b = np.geomspace(0.01, 12, drag.size)
    section = film_section(EyringLaw(REST, tau), np.stack([b, np.zeros_like(b)]), drag, EXACT)
    half = b / 2 / tau
    mean = tau * np.arcsinh(drag / tau * half / np.sinh(half))
    moment = 12 * tau**3 / b * np.cosh(mean / tau) * (np.cosh(half) - np.sinh(half) / half) / tau
    assert section.mean[0] == pytest.approx(mean, rel=1e-10)
    assert section.moment[0] == pytest.approx(moment, rel=1e-10)


@pytest.mark.parametrize("law", LAWS)
def test_plane_flow_by_rabinowitsch(law):
    """In rolling m = (24/b²) ∫ τ² ψ dτ up to the wall stress b/2: one integral over the flow curve."""
    for b in (0.02, 0.5, 8.0):
        section = film_section(law, np.array([[0.0], [b]]), np.zeros(1), EXACT)
        expected, _ = quad(lambda t: t * t * np.exp(law.fluidity_at(np.array([t]))[0][0]), 0, b / 2, epsrel=1e-12, epsabs=0)
        assert section.moment[1, 0] == pytest.approx(24 * expected / b**2, rel=1e-10)


@pytest.mark.parametrize(("precision", "error"), [(USUAL, 3e-5), (EXACT, 1e-9)])
@pytest.mark.parametrize("law", LAWS)
def test_both_conditions_hold_by_an_independent_quadrature(law, precision, error):
    """400 points over the whole film, which feel the kink of a power law themselves."""
    error = max(error, 2e-5) if isinstance(law, OstwaldLaw) else error
    difference, drag = places(n=60)
    section = film_section(law, difference, drag, precision)
    x, weight = np.polynomial.legendre.leggauss(400)
    stress = section.mean[:, :, None] + difference[:, :, None] * x / 2
    rate = stress * np.exp(law.fluidity_at(np.hypot(*stress))[0])
    assert (rate @ weight / 2)[0] == pytest.approx(drag, rel=error)
    assert np.all(np.abs((rate @ weight / 2)[1]) <= error * drag)
    moment = 12 * (rate * x / 2) @ weight / 2
    assert np.all(np.hypot(*(section.moment - moment)) <= error * np.hypot(*moment))


@pytest.mark.parametrize("law", LAWS)
def test_derivatives_are_those_of_differences(law):
    difference, drag = places(n=100)
    section, step = film_section(law, difference, drag), 1e-5
    for axis in (0, 1):
        change = step * np.hypot(*difference)
        shift = np.zeros_like(difference)
        shift[axis] = change
        ahead, behind = (film_section(law, difference + sign * shift, drag).moment for sign in (1, -1))
        size = np.abs(section.by_difference).max(axis=(0, 1))
        assert np.all(np.abs((ahead - behind) / (2 * change) - section.by_difference[:, axis]) < 1e-4 * size)
    ahead, behind = (film_section(law, difference, drag * (1 + sign * step)).moment for sign in (1, -1))
    size = np.hypot(*section.moment) + drag * np.hypot(*section.by_drag)
    assert np.all(np.abs((ahead - behind) / (2 * step) - drag * section.by_drag) < 1e-4 * size)


def test_the_viscosity_at_a_rate_is_that_of_the_law():
    rate = np.geomspace(1e-3, 1e3, 7)
    expected = 0.01 + 0.99 * (1 + (3 * rate) ** 2) ** ((0.4 - 1) / 2)
    assert viscosity_at(CARREAU, rate) == pytest.approx(expected, rel=1e-12)
    assert viscosity_at(REST, 0.0) == 1
