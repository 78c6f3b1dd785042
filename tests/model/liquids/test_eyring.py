"""Eyring's law against its formula."""

import numpy as np
import pytest

import softlube
from softlube.model.liquids import EyringLaw, NewtonianLaw


def test_the_rate_is_the_hyperbolic_sine_of_the_stress():
    law = EyringLaw(NewtonianLaw(), 0.3)
    stress = np.geomspace(1e-8, 50, 300)
    ln_psi, slope = law.fluidity_at(stress)
    assert np.exp(ln_psi) * stress == pytest.approx(0.3 * np.sinh(stress / 0.3), rel=1e-13)
    assert slope == pytest.approx(stress / 0.3 / np.tanh(stress / 0.3) - 1, abs=1e-13, rel=1e-9)
    assert np.all(np.isfinite(law.fluidity_at(np.array([1e9]))))


def test_from_inputs():
    ball = {"radius": "2 mm", "young_modulus": "3 MPa", "speed": "0.1 mm/s", "load": "100 mN"}
    contact = softlube.Contact(**ball, viscosity="2 Pa s", eyring_stress="5 kPa")
    assert contact.liquid == softlube.Eyring("2 Pa s", stress="5 kPa")
    friction, length = (contact.scales(contact.unit_height)[name][0] for name in ("friction", "length"))
    assert contact.problem().liquid.stress == pytest.approx(5e3 / (friction / length**2))
