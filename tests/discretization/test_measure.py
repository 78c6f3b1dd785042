"""Quantities of fields whose loads, minima and frictions are known exactly."""

from dataclasses import replace

import numpy as np
import pytest

from softlube.discretization import measure as quantities
from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.model.exact import HERTZ_LOAD, hertz_pressure
from softlube.model.liquids import BarusLaw

GRID = PolarGrid(60, 24, edge_width=0.3)
X = GRID.r[:, None] * np.cos(GRID.theta)
Y = GRID.r[:, None] * np.sin(GRID.theta)


def fields(pressure, film, beta=100.0, load=1.0):
    return Fields(GRID, GRID.r, GRID.theta, pressure, film, beta, "none", load)


GAUSSIAN = np.exp(-2 * ((X + 0.2) ** 2 + Y**2))


def test_extrema_between_the_nodes():
    # Film with its minima at (−0.3, ±0.62), pressure with its maximum at (−0.2, 0).
    film = 0.3 + (X + 0.3) ** 2 + (Y**2 - 0.62**2) ** 2
    measured = quantities.measure(fields(GAUSSIAN, film))
    assert measured["film_min"] == pytest.approx(0.3, rel=2e-4)
    assert measured["film_min_radius"] == pytest.approx(np.hypot(0.3, 0.62), abs=2e-3)
    assert measured["film_min_angle_deg"] == pytest.approx(np.degrees(np.arctan2(0.62, -0.3)), abs=0.2)
    assert measured["pressure_max"] == pytest.approx(1, rel=1e-4)
    assert measured["pressure_center"] == pytest.approx(np.exp(-2 * 0.04), rel=1e-4)
    assert measured["film_center"] == pytest.approx(0.3 + 0.09 + 0.62**4, rel=1e-4)
    assert measured["film_inlet"] == pytest.approx(0.3 + 1.69 + 0.62**4, rel=1e-4)
    assert measured["film_outlet_min"] == pytest.approx(0.3 + 0.62**4, rel=1e-4)


def test_the_minimum_film_is_found_wherever_it_is():
    # Beyond the domain of the friction, where a light load leaves it.
    film = 0.3 + 0.1 * ((X + 3.4) ** 2 + Y**2)
    measured = quantities.measure(fields(GAUSSIAN, film))
    assert measured["film_min"] == pytest.approx(0.3, rel=2e-3)
    assert measured["film_min_radius"] == pytest.approx(3.4, abs=2e-2)
    assert measured["film_min_angle_deg"] == pytest.approx(180, abs=1)


def test_no_pressure_at_the_centre_is_above_the_maximum():
    """A liquid that thickens steeply makes the grid coarse for its pressure, so that the maximum is taken from the nodes."""
    at = replace(fields(np.exp(-2 * (X**2 + Y**2)), np.ones_like(X)), liquid=BarusLaw(40.0))
    measured = quantities.measure(at)
    assert at.is_sharp
    assert np.max(at.pressure) < measured["pressure_center"] == pytest.approx(1, abs=2e-5)
    assert measured["pressure_max"] == measured["pressure_center"]


def test_a_boundary_layer_inside_the_contact_is_negative():
    narrow = np.exp(-8 * (X**2 + Y**2))
    measured = quantities.measure(fields(narrow, np.ones_like(X)))
    assert measured["boundary_layer"] == pytest.approx(np.sqrt(np.log(20) / 8) - 1, abs=1e-3)


@pytest.mark.parametrize("unit", [0.5, 3.0])
def test_another_unit_of_height_measures_the_same_contact(unit):
    """Eq. (4): what is a length, a pressure, … scales as such, and what depends on the place r = 1 is that of the new unit."""
    at = replace(fields(GAUSSIAN, 0.3 + (X + 0.3) ** 2 + (Y**2 - 0.62**2) ** 2), height=0.1)
    other = at.in_units(unit)
    first, second = quantities.measure(at), quantities.measure(other)
    assert other.beta == at.beta * unit**2
    powers = {
        "load": -1.5,
        "height": -1,
        "film_center": -1,
        "film_min": -1,
        "film_min_radius": -0.5,
        "film_min_angle_deg": 0,
        "film_outlet_min": -1,
        "pressure_center": -0.5,
        "pressure_max": -0.5,
        "pressure_gradient_inlet": 0,
    }
    for name, power in powers.items():
        assert second[name] == pytest.approx(first[name] * unit**power, rel=1e-6), name
    assert (1 + second["boundary_layer"]) * unit**0.5 == pytest.approx(1 + first["boundary_layer"], rel=1e-6)
    assert second["load_contact"] == pytest.approx(quantities.load_within(at, unit**0.5) * unit**-1.5, rel=1e-6)
    assert second["friction_contact"] == pytest.approx(quantities.friction_within(at, unit**0.5) * unit**-2, rel=1e-6)
    assert second["friction_domain"] == pytest.approx(quantities.friction_within(at, 2 * unit**0.5) * unit**-2, rel=1e-6)
    assert second["film_inlet"] == pytest.approx(at.film_at(unit**0.5, 0.0) / unit, rel=1e-9)
    assert other.in_units(1 / unit).film == pytest.approx(at.film, rel=1e-14)


def test_inlet_gradient_and_boundary_layer():
    measured = quantities.measure(fields(GAUSSIAN, np.ones_like(X)))
    # d/dx exp(−2s²) is steepest at s = 1/2, and exp(−2s²) = 0.05 at s = √(ln 20/2); s = x + 0.2.
    assert measured["pressure_gradient_inlet"] == pytest.approx(2 * np.exp(-0.5), rel=1e-3)
    assert measured["boundary_layer"] == pytest.approx(np.sqrt(np.log(20) / 2) - 0.2 - 1, abs=1e-3)


def test_maximum_on_the_outlet_side_of_the_centre():
    """At the centre all angles coincide; the search must not be trapped on the wrong one."""
    for shift in (-0.01, 0.01):
        measured = quantities.measure(fields(np.exp(-((X - shift) ** 2) - Y**2), np.ones_like(X)))
        assert measured["pressure_max"] == pytest.approx(1, abs=2e-5)


@pytest.mark.parametrize("cutoff", [0.5, 1.0, 2.0, 5.0])
def test_couette_friction_of_a_parabolic_gap(cutoff):
    # ∫ dA/(βu) with u = g + r²/2 is (2π/β) ln(1 + r²/2g): it grows without bound with the region.
    gap = 0.4
    at = fields(np.zeros_like(X), gap + GRID.r[:, None] ** 2 / 2 + 0 * X, beta=7.0)
    assert quantities.friction_within(at, cutoff) == pytest.approx(2 * np.pi / 7 * np.log1p(cutoff**2 / (2 * gap)), rel=1e-5)


def test_poiseuille_friction_of_a_uniform_gradient_cancels_and_shear_adds():
    # u = 1: ∫ 3 p_x dA = 0 by symmetry; wall shear is |1 ± 3β p_x| at its largest, where x² = 10 − √68.
    at = fields(X**2 * np.exp(-(X**2) / 8), np.ones_like(X), beta=2.0)
    assert quantities.friction_within(at, 1.0) == pytest.approx(np.pi / 2, rel=1e-4)
    steepest = np.sqrt(10 - np.sqrt(68))
    slope = (2 * steepest - steepest**3 / 4) * np.exp(-(steepest**2) / 8)
    assert quantities.measure(at)["shear_rate_max"] == pytest.approx(1 + 3 * 2 * slope, rel=1e-3)


def test_load_of_a_disc():
    at = fields(GAUSSIAN, np.ones_like(X))
    centred = fields(np.exp(-2 * (X**2 + Y**2)), np.ones_like(X))
    assert quantities.load_within(centred, 1.0) == pytest.approx(np.pi / 2 * (1 - np.exp(-2)), rel=1e-5)
    assert quantities.load_within(at, 10.0) == pytest.approx(np.pi / 2, rel=1e-5)
    assert isinstance(quantities.load_within(at, 10.0), float)


def test_hertz_load_within_the_contact():
    grid = PolarGrid(200, 12, edge_width=0.01)
    pressure = np.repeat(hertz_pressure(grid.r)[:, None], 13, axis=1)
    at = Fields(grid, grid.r, grid.theta, pressure, np.ones_like(pressure), 1.0, "none", 1.0)
    assert quantities.load_within(at, 1.0) == pytest.approx(HERTZ_LOAD, rel=1e-4)


def test_a_region_beyond_the_grid_is_refused():
    at = fields(GAUSSIAN, np.ones_like(X))
    with pytest.raises(ValueError, match="cutoff"):
        quantities.friction_within(at, 1000.0)
    with pytest.raises(ValueError, match="r: the solution reaches"):
        at.film_at(1000.0, 0.0)


def test_the_friction_within_every_node_s_radius(solution):
    """The cumulated integral is that over each disc."""
    couette, poiseuille = quantities.friction_profile(solution.fields)
    assert couette[0] == poiseuille[0] == 0
    for node in (4, 17, solution.fields.r.size):
        within = quantities.friction_parts(solution.fields, float(solution.fields.r[node - 1]))
        assert (couette[node], poiseuille[node]) == pytest.approx(within, rel=1e-12)
