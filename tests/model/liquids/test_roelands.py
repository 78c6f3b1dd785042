"""Roelands' law: its limits, and as published."""

import math

import numpy as np
import pytest

from softlube.model.liquids import BarusLaw, Roelands, RoelandsLaw


def test_roelands_starts_like_barus_and_is_it_for_z_1():
    p = np.array([1e-4, 0.3])
    assert RoelandsLaw(3.0, 0.6, 0.4).viscosity(p[:1]) == pytest.approx(BarusLaw(3.0).viscosity(p[:1]), rel=1e-7)
    assert RoelandsLaw(3.0, 1.0, 0.4).viscosity(p) == pytest.approx(BarusLaw(3.0).viscosity(p))


def test_roelands_from_physical_values():
    """Ln η = ln η₀ + (ln η₀ + 9.67)[(1 + 5.1e-9 p)^z − 1], as published."""
    alpha, viscosity, pressure = 2e-8, 0.1, 5e8
    law = RoelandsLaw.of(alpha, viscosity, 1e9)
    z = alpha / (5.1e-9 * (math.log(viscosity) + 9.67))
    expected = math.exp((math.log(viscosity) + 9.67) * ((1 + 5.1e-9 * pressure) ** z - 1))
    assert law.viscosity(np.array([pressure / 1e9])) == pytest.approx(expected, rel=5e-3)


def test_the_part_is_the_law_in_si():
    part = Roelands("0.1 Pa s", pressure_viscosity="20 GPa^-1")
    assert part.law(1e9) == RoelandsLaw.of(part.pressure_viscosity, 0.1, 1e9)
    assert part.pressure_viscosity == pytest.approx(2e-8)
