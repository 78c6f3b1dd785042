"""The flux along a line and what lies beyond the mesh."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from softlube.discretization.line.flow import beyond, driven, largest_shear_rate, mean_stress
from softlube.model.liquids import BarusLaw, EyringLaw, NewtonianLaw, OstwaldLaw
from softlube.model.problem import Problem

FILM, GRADIENT, PRESSURE = np.array([0.1, 0.5]), np.array([-0.3, 0.2]), np.array([0.2, 0.0])


@pytest.mark.parametrize("liquid", [BarusLaw(5.0), EyringLaw(BarusLaw(5.0), 0.03), OstwaldLaw(NewtonianLaw(), 0.1, 0.6)])
def test_derivatives(liquid):
    problem = Problem(beta_load=50.0, liquid=liquid, slide_to_roll=1.5)
    found, h = driven(problem, FILM, GRADIENT, PRESSURE), 1e-6
    for name, change in (("by_film", (h, 0, 0)), ("by_gradient", (0, h, 0)), ("by_pressure", (0, 0, h))):
        up, down = (
            driven(problem, FILM + s * change[0], GRADIENT + s * change[1], PRESSURE + s * change[2]).flux for s in (1, -1)
        )
        assert getattr(found, name) == pytest.approx((up - down) / (2 * h), rel=1e-5, abs=1e-8)


def test_constant_viscosity():
    problem = Problem(beta_load=50.0)
    assert driven(problem, FILM, GRADIENT, PRESSURE).flux == pytest.approx(50 * FILM**3 * GRADIENT)
    assert mean_stress(problem, FILM, GRADIENT, PRESSURE) == pytest.approx(1 / (50 * FILM))
    assert largest_shear_rate(problem, FILM, GRADIENT, PRESSURE) == pytest.approx(1 / FILM + 150 * FILM * np.abs(GRADIENT))
    # A law that hardly thins takes the other way.
    same = Problem(beta_load=50.0, liquid=EyringLaw(NewtonianLaw(), 1e5))
    for function in (mean_stress, largest_shear_rate):
        assert function(same, FILM, GRADIENT, PRESSURE) == pytest.approx(function(problem, FILM, GRADIENT, PRESSURE))


@pytest.mark.parametrize("x", [1e3, -1e3])
@pytest.mark.parametrize("index", [1.0, 0.8])
def test_beyond_the_mesh(x, index):
    """By quadrature over a film x²/2 whose pressure drives the flux −x²/2."""
    problem = Problem(beta_load=7.0, liquid=OstwaldLaw(NewtonianLaw(), 1e-4, index))
    found = beyond(problem, x)
    gradient = -(2 * index + 1) * found.pressure / x  # at the end
    assert driven(problem, np.array([x**2 / 2]), np.array([gradient]), np.zeros(1)).flux == pytest.approx(-(x**2) / 2)
    further = beyond(problem, 2 * x)
    there = -(2 * index + 1) * further.pressure / (2 * x)
    assert there / gradient == pytest.approx(2 ** (-2 * index - 2), rel=1e-9)
    power = quad(lambda s: s ** (-2 * index - 1), 1, np.inf)[0]
    assert found.load == pytest.approx(found.pressure * abs(x) * power, rel=1e-6)
    stress = mean_stress(problem, np.array([x**2 / 2]), np.array([gradient]), np.zeros(1))[0]
    assert found.couette == pytest.approx(stress * abs(x) * quad(lambda s: s ** (-2 * index), 1, np.inf)[0], rel=1e-6)
    if index == 1:
        assert found == pytest.approx((4 / (21 * x**3), np.sign(x) * 2 / (21 * x**2), 2 / 7e3, -6 / 7e3), rel=1e-6)


def test_a_friction_without_end():
    assert math.isinf(beyond(Problem(beta_load=7.0, liquid=OstwaldLaw(NewtonianLaw(), 1e-4, 0.4)), 1e3).couette)
