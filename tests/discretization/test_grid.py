"""The polar grid: its maps are each other's inverse, smooth and symmetric."""

import numpy as np
import pytest
from scipy.integrate import quad

from softlube.discretization.grid import PolarGrid

GRIDS = [
    PolarGrid(20, 10),
    PolarGrid(60, 24, edge_width=0.005, side_width=0.01),
    PolarGrid(30, 12, side_width=1.0, edge=1.7),
    PolarGrid(80, 12, edge_width=0.02, crest=0.9),
    PolarGrid(80, 12, crest=0.1, edge=1.7),
    PolarGrid(80, 12, edge_width=0.02, core=0.05, edge=0.7),
    PolarGrid(80, 12, edge_width=0.02, band=0.4, band_share=9.0, edge=0.7),
]


@pytest.mark.parametrize("grid", GRIDS)
def test_radial_map_and_inverse(grid):
    r = np.concatenate([[0.0], np.geomspace(1e-6, grid.reach * grid.edge * 1.2, 500)])
    # Near the centre the terms of ξ cancel, and leave their round-off.
    assert grid.r_of(grid.xi_of(r)) == pytest.approx(r, rel=1e-13, abs=1e-14)
    assert grid.xi_of(-r) == pytest.approx(-grid.xi_of(r), abs=1e-12)


@pytest.mark.parametrize("grid", GRIDS)
def test_radial_derivative_against_differences(grid):
    r, step = np.array([0.0, 0.3, 0.99, 1.0, 1.3, 8.0]), 1e-6
    slope = 2 * step / (grid.xi_of(r + step) - grid.xi_of(r - step))
    assert grid.dr_dxi(r) == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize("grid", GRIDS)
def test_angular_map_and_inverse(grid):
    theta = np.linspace(0, np.pi, 101)
    assert grid.theta_of(grid.s_of(theta)) == pytest.approx(theta, abs=1e-14)
    assert grid.theta[[0, -1]] == pytest.approx([0, np.pi], abs=1e-14)
    assert grid.theta + grid.theta[::-1] == pytest.approx(np.pi, abs=1e-14)


@pytest.mark.parametrize("grid", GRIDS)
def test_angular_map_is_the_integral_of_its_density(grid):
    def density(theta):
        return 1 + grid.side_clustering / np.hypot(grid.side_width, np.cos(theta))

    whole = 2 * quad(density, 0, np.pi / 2, points=[np.pi / 2 - grid.side_width], epsrel=1e-12)[0]
    for theta in (0.4, 1.5, 1.6, 2.9):
        points = [p for p in (np.pi / 2 - grid.side_width, np.pi / 2, np.pi / 2 + grid.side_width) if 0 < p < theta]
        part = quad(density, 0, theta, points=points or None, epsrel=1e-12)[0]
        assert grid.s_of(theta) == pytest.approx(np.pi * part / whole, rel=1e-10)
        assert grid.dtheta_ds(grid.s_of(theta)) == pytest.approx(whole / np.pi / density(theta), rel=1e-10)


def test_the_sides_have_the_finest_angles_at_a_logarithmic_price():
    for layer in (0.1, 0.001, 1e-5):
        grid = PolarGrid(20, 96, side_width=layer)
        interval = np.diff(grid.theta)
        # The measure of the quarter circle is π/2 + ½ ln(4/w) for a narrow layer: 48 intervals on each side share it.
        assert interval.min() == pytest.approx((np.pi / 2 + np.log(4 / layer) / 2) / 48 / (1 + 0.5 / layer), rel=0.3)
        assert interval[[47, 48]] == pytest.approx(interval.min())
        assert interval.max() < 2.2 * (np.pi / 2 + np.log(4 / layer) / 2) / 96


def test_a_crest_has_fine_cells():
    width = np.diff(PolarGrid(90, 24, edge_width=0.25, crest=0.6).r_face)
    r = PolarGrid(90, 24, edge_width=0.25, crest=0.6).r[:-1]
    assert width[np.argmin(np.abs(r - 0.6))] < width[np.argmin(np.abs(r - 0.3))] / 3
    assert width[np.argmin(np.abs(r - 0.6))] < width[np.argmin(np.abs(r - 1.0))] / 1.5


def test_a_core_has_fine_cells_and_adds_none_far_outside():
    plain, fine = PolarGrid(90, 24), PolarGrid(90, 24, core=0.1)
    assert fine.dr_dxi(0.0) < 0.2 * plain.dr_dxi(0.0)
    assert fine.dr_dxi(15.0) == pytest.approx(plain.dr_dxi(15.0), rel=0.02)


def test_a_band_has_even_cells_and_adds_none_elsewhere():
    plain, banded = PolarGrid(400, 24, edge_width=0.02), PolarGrid(400, 24, edge_width=0.02, band=0.4, band_share=12.0)
    r = np.linspace(0.5, 0.9, 9)
    added = 1 / banded.dr_dxi(r) - 1 / plain.dr_dxi(r)
    assert added == pytest.approx(12 / 0.6, rel=0.1)
    for r in (0.0, 0.1, 3.0):
        assert 1 / banded.dr_dxi(r) - 1 / plain.dr_dxi(r) == pytest.approx(0, abs=0.04 * 12 / 0.6)
    assert float(banded.xi_of(20.0) - plain.xi_of(20.0)) == pytest.approx(12, rel=1e-2)


def test_edge_has_the_finest_cells_and_scales():
    grid = PolarGrid(60, 24, edge_width=0.02)
    width = np.diff(grid.r_face)
    assert abs(grid.r_face[np.argmin(width)] - 1) < 0.02
    assert grid.scaled(3.0).r == pytest.approx(3 * grid.r, rel=1e-14)


@pytest.mark.parametrize(
    "bad",
    [
        {"n_r": 3},
        {"n_theta": 2},
        {"edge_width": 0.0},
        {"side_width": 0.0},
        {"reach": 0.5},
        {"edge": -1.0},
        {"crest": -0.1},
        {"core": 0.0},
        {"core": 3.0},
    ],
)
def test_impossible_grids_are_refused(bad):
    with pytest.raises(ValueError, match="polar grid needs"):
        PolarGrid(**({"n_r": 20, "n_theta": 10} | bad))
