"""Dry contacts against Hertz, thick and thin limits, and the lubricated contact at large β.

verification/test_dry_layer.py has finite elements and the series of Dimitriadis et al.
"""

import numpy as np
import pytest

import softlube
from softlube.model.dry import dry_contact, dry_contact_at, smeared_contact
from softlube.model.exact import HERTZ_LOAD, HERTZ_PRESSURE, hertz_pressure
from softlube.model.substrates import HalfSpaceKernel, LayerKernel


def test_half_space_is_hertz():
    contact = dry_contact(HalfSpaceKernel(), 1.5)
    assert contact.indentation == pytest.approx(1.5**2, rel=1e-14)
    assert contact.load == pytest.approx(HERTZ_LOAD * 1.5**3, rel=1e-13)
    assert contact.edge_rise == 1.0
    r = np.array([0.0, 0.7, 1.4, 1.6])
    assert contact.pressure(r) == pytest.approx(hertz_pressure(r, 1.5), rel=1e-6, abs=1e-8)
    assert contact.like_hertz(10.0) == pytest.approx(10.0 * 1.5**4)


def test_first_order_of_a_thick_layer():
    """δ = a² (1 + (4/3π) α₀ a/t) at a given radius and load/Hertz = 1 − (2/π) α₀ χ, with α₀ = ∫(C − 1)dκ."""
    for layer in (LayerKernel(1e3), LayerKernel(1e3, 0.2), LayerKernel(1e3, 0.5, "frictionless")):
        alpha = layer.spectrum()[1].sum() * layer.thickness
        ours = dry_contact_at(layer, indentation=1.0).load / HERTZ_LOAD
        assert ours == pytest.approx(1 - 2 / np.pi * alpha / layer.thickness, abs=5e-6)
    assert LayerKernel(1.0, 0.5, "frictionless").spectrum()[1].sum() == pytest.approx(-1.16758, abs=1e-5)


def test_third_order_of_a_thick_layer():
    """Load over Hertz's = 1 + bχ + (7/6)b²χ² + [(40/27)b³ + 8α₂/(15π)]χ³ + O(χ⁴), b = −(2/π)α₀, αₙ = ∫κⁿ(C − 1)dκ.

    The base lifts the surface by −α₀N/t − α₂⟨ρ²⟩N/(4t³): a shift of δ and a change of curvature, in Hertz's formulas.
    """
    layer = LayerKernel(1.0)
    kappa, defect = layer.spectrum()
    b, alpha = -2 / np.pi * defect.sum(), float((kappa**2 * defect).sum())
    second, third = 7 / 6 * b**2, 40 / 27 * b**3 + 8 / (15 * np.pi) * alpha
    left = []
    for chi in (0.02, 0.04):
        ours = dry_contact_at(LayerKernel(1 / chi), indentation=1.0).load / HERTZ_LOAD
        left.append(ours - (1 + b * chi + second * chi**2 + third * chi**3))
        # García & García (Biophys. J. 114, 2018, 2923) have 1.133, 1.497, 1.469, 0.755.
        theirs = 1 + 1.133 * chi + 1.497 * chi**2 + 1.469 * chi**3 + 0.755 * chi**4
        assert ours == pytest.approx(theirs, rel=6e-4)
    assert left[1] / left[0] == pytest.approx(16, rel=0.01)


def test_thin_compressible_layer_is_a_winkler_foundation():
    """Pressure δ(1 − r²/a²)/K with a² = 2δ and C = Kk/(2π): load πδ²/K."""
    for layer in (LayerKernel(0.02, 0.3), LayerKernel(0.02, 0.5, "frictionless")):
        slope = 0.5 if layer.base == "frictionless" else (1 - 0.6) / (2 * 0.7**2)
        modulus = 2 * np.pi * slope * layer.thickness
        contact = dry_contact_at(layer, indentation=1.0)
        assert contact.radius == pytest.approx(np.sqrt(2), rel=0.02)
        assert contact.load == pytest.approx(np.pi / modulus, rel=0.05)


def test_thin_incompressible_layer():
    """With C = 2κ³/3: (4π/3)t³ ∇²p = −(1 − r²/2), p and its slope zero at the edge: a² = 4δ and load 1/(2t³)."""
    thin, thinner = (dry_contact_at(LayerKernel(t), indentation=1.0) for t in (0.05, 0.025))
    assert thinner.radius == pytest.approx(2.0, rel=0.03)
    # p = (3/(4π t³)) (a² − r²)²/32 at a² = 4
    assert thinner.load == pytest.approx(0.5 / 0.025**3, rel=0.15)
    assert thinner.load / thin.load == pytest.approx(8, rel=0.1)


def test_lubricated_layer_at_large_beta_carries_the_dry_load():
    layer = LayerKernel(1.0)
    dry = dry_contact_at(layer, indentation=1.0)
    loads = [float(softlube.solve(beta=beta, substrate=layer).load) for beta in (1e4, 1e5)]
    excess = [load / dry.load - 1 for load in loads]
    assert 0 < excess[1] < 0.01
    assert excess[0] / excess[1] == pytest.approx(10**0.6, rel=0.15)  # β^(−3/5), as on the half-space


def test_smeared_contact_is_smooth_and_as_deep_as_asked():
    pressure = smeared_contact(HalfSpaceKernel(), 1.0, 0.1)
    assert pressure(0.0) == pytest.approx(HERTZ_PRESSURE, rel=0.01)
    assert pressure(1.2) == 0


def test_unique_input():
    with pytest.raises(ValueError, match="exactly one"):
        dry_contact_at(HalfSpaceKernel())
