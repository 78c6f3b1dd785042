"""The remainder of a layer's kernel along a line: quadrature, and a layer so thin that it is a row of springs."""

import numpy as np
import pytest

from softlube.discretization.line.displacement import displacement
from softlube.discretization.line.panels import Panels
from softlube.discretization.line.remainder import remainder_potential
from softlube.model.substrates import HalfSpaceKernel, LayerKernel


@pytest.mark.parametrize("base", ["bonded", "frictionless"])
def test_against_a_sum_over_waves(base):
    """A pressure cos(Kx) over many waves makes the displacement −2πC(K)/K cos(Kx)."""
    layer, wave = LayerKernel(0.5, 0.4, base), 3.0
    panels = Panels(np.linspace(-20 * np.pi / wave, 20 * np.pi / wave, 161), 8)
    at = np.array([0.0, 0.1, 0.4])
    rows = -remainder_potential(layer, panels, at, 8)
    found = np.einsum("xpk,pk->x", rows[:, :, :8], panels.coefficients(np.cos(wave * panels.nodes)))
    k, weight = layer.spectrum(100.0)
    compliance = 1 + np.interp(wave, k, weight / np.gradient(k))
    kappa = wave * 0.5
    if base == "frictionless":
        compliance = (np.cosh(2 * kappa) - 1) / (np.sinh(2 * kappa) + 2 * kappa)
    else:
        nu = 0.4
        compliance = ((3 - 4 * nu) * np.sinh(2 * kappa) - 2 * kappa) / (
            (3 - 4 * nu) * np.cosh(2 * kappa) + 2 * kappa**2 + 5 - 12 * nu + 8 * nu**2
        )
    # Differences between places: a constant is free.  The ends of the waves are far, their kernel smooth.
    expected = -2 * np.pi * (compliance - 1) / wave * np.cos(wave * at)
    assert found - found[0] == pytest.approx(expected - expected[0], abs=3e-3)


def test_a_thin_compressible_layer_is_a_row_of_springs():
    """Long waves on a bonded layer: C → κ(1 − 2ν)/(2(1 − ν)²), so w = −2πt (1 − 2ν)/(2(1 − ν)²) p."""
    thickness, nu = 0.02, 0.2
    layer = LayerKernel(thickness, nu)
    panels = Panels(np.linspace(0, 8, 161), 8)
    pressure = panels.coefficients(np.exp(-((panels.nodes - 4) ** 2)))
    rows = displacement(layer, panels).by_pressure[:, :, :8]
    moved = np.einsum("xpk,pk->x", rows, pressure)[:-1]
    at = (panels.nodes > 3) & (panels.nodes < 5)
    spring = -2 * np.pi * thickness * (1 - 2 * nu) / (2 * (1 - nu) ** 2) * np.exp(-((panels.nodes - 4) ** 2))
    shift = (moved - spring)[at].mean()
    assert (moved - shift)[at] == pytest.approx(spring[at], abs=0.03 * abs(spring).max())


def test_a_thick_layer_is_a_half_plane():
    panels = Panels(np.array([0.0, 0.5, 1.0, 2.0]), 6)
    thick, half = (displacement(each, panels).matrix for each in (LayerKernel(1e4), HalfSpaceKernel()))
    assert thick == pytest.approx(half, abs=1e-6)
