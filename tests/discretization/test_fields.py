"""Fields between the nodes, against the functions that they are samples of."""

from dataclasses import replace

import numpy as np
import pytest

from softlube.discretization.chart import PolarChart
from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.model.liquids.barus import BarusLaw

GRID = PolarGrid(60, 24, edge_width=0.3)


X = GRID.r[:, None] * np.cos(GRID.theta)


Y = GRID.r[:, None] * np.sin(GRID.theta)


def fields(pressure, film, beta=100.0, load=1.0):
    return Fields(GRID, GRID.r, GRID.theta, pressure, film, beta, "none", load)


GAUSSIAN = np.exp(-2 * ((X + 0.2) ** 2 + Y**2))


def test_fields_are_even_and_periodic():
    at = fields(GAUSSIAN, 1 + X**2 + Y**2 + 0.1 * X)
    for angle in (0.3, 2.0):
        values = [float(at.film_at(0.7, a)) for a in (angle, -angle, angle + 2 * np.pi, 2 * np.pi - angle)]
        assert values == pytest.approx([values[0]] * 4, rel=1e-12)
        assert values[0] == pytest.approx(1 + 0.49 + 0.07 * np.cos(angle), rel=1e-5)


def test_gradients_between_the_nodes():
    """∇ exp(−2[(x + 0.2)² + y²]) = −4 (x + 0.2, y) exp(…)."""
    at = fields(GAUSSIAN, np.ones_like(X))
    r, theta = np.array([0.15, 0.6, 1.1]), np.array([0.2, 1.5, 2.7])
    along, across = at.gradient_on(at.mesh.places(GRID.xi_of(r), GRID.s_of(theta)))
    x, y = r[:, None] * np.cos(theta), r[:, None] * np.sin(theta)
    value = np.exp(-2 * ((x + 0.2) ** 2 + y**2))
    assert along == pytest.approx(-4 * (x + 0.2) * value, abs=1e-3)
    assert across == pytest.approx(-4 * y * value, abs=1e-3)


def test_a_thick_liquid_has_its_viscosity_and_its_reduced_pressure():
    at = replace(fields(GAUSSIAN, np.ones_like(X)), liquid=BarusLaw(3.0))
    xi, s = GRID.xi_of(np.array([0.5])), GRID.s_of(np.array([0.7]))
    pressure = float(at.pressure_at(0.5, 0.7))
    assert at.viscosity_on(at.mesh.places(xi, s))[0, 0] == pytest.approx(np.exp(3 * pressure), rel=1e-12)
    assert at.reduced_spline(xi, s)[0, 0] == pytest.approx((1 - np.exp(-3 * pressure)) / 3, rel=1e-4)
    thin = fields(GAUSSIAN, np.ones_like(X))
    assert thin.reduced_spline is thin.pressure_spline


def test_the_undershoot_at_a_free_boundary_is_cut_off_with_the_reynolds_condition_only():
    pressure = np.where(X > -0.4, GAUSSIAN, 0.0)
    behind = np.linspace(0.41, 0.8, 50)
    full = fields(pressure, np.ones_like(X))
    assert full.pressure_at(behind, np.pi).min() < 0
    assert replace(full, cavitation="reynolds").pressure_at(behind, np.pi).min() == 0


def test_a_place_beyond_the_grid_is_refused():
    at = fields(GAUSSIAN, np.ones_like(X))
    for r in (-0.1, 1000.0):
        with pytest.raises(ValueError, match="r: the solution reaches from 0 to"):
            at.pressure_at(r, 0.0)


def test_plain_polar_coordinates_serve_as_well():
    r, theta = np.linspace(0, 3, 121), np.linspace(0, np.pi, 61)
    x = r[:, None] * np.cos(theta)
    values = np.exp(-2 * ((x + 0.2) ** 2 + (r[:, None] * np.sin(theta)) ** 2))
    plain = Fields(PolarChart(), r, theta, values, np.ones_like(values), 100.0, "none", 1.0)
    ours = fields(GAUSSIAN, np.ones_like(X))
    place = np.array([0.05, 0.33, 1.2]), np.array([0.1, 1.0, 3.0])
    assert plain.pressure_at(*place) == pytest.approx(ours.pressure_at(*place), abs=2e-4)
