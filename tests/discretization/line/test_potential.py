"""Logarithmic potentials: closed forms, quadrature, near and far."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import lqmn

from softlube.discretization.line.panels import Panels
from softlube.discretization.line.potential import log_moments, log_potential, second_kind


@pytest.mark.parametrize("z", [-0.7, 0.3, 0.999, 1.01, -1.01, 1.5, 40.0])
def test_legendre_functions_of_the_second_kind(z):
    found = second_kind(np.array([z]), 12)[:, 0]
    if abs(z) < 1:
        assert found == pytest.approx(lqmn(0, 12, z)[0][0], rel=1e-10, abs=1e-12)
    else:  # Neumann's integral, (1/2)∫ P_k(t)/(z − t) dt
        t, weight = np.polynomial.legendre.leggauss(400)
        vander = np.polynomial.legendre.legvander(t, 12)
        expected = (weight / (z - t)) @ vander / 2
        assert found[:7] == pytest.approx(expected[:7], rel=1e-9, abs=1e-14)


@pytest.mark.parametrize("z", [-1.0, -0.4, 0.0, 1.0, 1.2, 3.0])
def test_moments_against_quadrature(z):
    found = log_moments(np.array([z]), 5)[0]
    for k in range(6):
        p = np.polynomial.legendre.Legendre.basis(k)
        parts = [(-1, z), (z, 1)] if -1 < z < 1 else [(-1, 1)]
        expected = sum(quad(lambda t, p=p: p(t) * np.log(abs(z - t)), *part, epsabs=1e-12)[0] for part in parts)
        assert found[k] == pytest.approx(expected, abs=1e-10)


def test_a_parabola_on_panels_of_any_size():
    """∫ (1 − s²) ln|x − s| ds over −1 … 1 in closed form, on panels as short as 10⁻⁶ beside it."""
    panels = Panels(np.array([-1.0, -0.999999, -0.5, 0.0, 0.7, 1.0]), 3)
    x = np.array([-1.0, -0.9999995, 0.2, 1.0, 1.5, 50.0])
    coefficients = panels.coefficients(1 - panels.nodes**2)
    found = np.einsum("xpk,pk->x", log_potential(panels, x, 3)[:, :, :3], coefficients)

    def antiderivative(y):  # of (1 − (x − y)²) ln|y| with respect to y, y = x − s
        logarithm = np.log(np.maximum(np.abs(y), 1e-300))
        return (1 - x**2) * y * (logarithm - 1) + x * y**2 * (logarithm - 0.5) - y**3 * (logarithm / 3 - 1 / 9)

    assert found == pytest.approx(antiderivative(x + 1) - antiderivative(x - 1), abs=1e-10)
