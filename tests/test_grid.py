"""The polar grid: its maps are each other's inverse, smooth and symmetric."""

import numpy as np
import pytest

from softlube.grid import PolarGrid

GRIDS = [PolarGrid(20, 10), PolarGrid(60, 24, layer=0.005, side_spacing=0.3), PolarGrid(30, 12, side_spacing=1.0, edge=1.7)]


@pytest.mark.parametrize("grid", GRIDS)
def test_radial_map_and_inverse(grid):
    r = np.concatenate([[0.0], np.geomspace(1e-6, grid.reach * grid.edge * 1.2, 500)])
    assert grid.r_of(grid.xi_of(r)) == pytest.approx(r, rel=1e-13, abs=1e-15)
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
    assert grid.theta[[0, -1]] == pytest.approx([0, np.pi], abs=1e-15)
    assert grid.dtheta_ds(np.pi / 2) == pytest.approx(grid.side_spacing)


def test_edge_has_the_finest_cells_and_scales():
    grid = PolarGrid(60, 24, layer=0.02)
    width = np.diff(grid.r_face)
    assert abs(grid.r_face[np.argmin(width)] - 1) < 0.02
    assert grid.scaled(3.0).r == pytest.approx(3 * grid.r, rel=1e-14)


@pytest.mark.parametrize(
    "bad", [{"n_r": 3}, {"n_theta": 2}, {"layer": 0.0}, {"side_spacing": 1.5}, {"reach": 0.5}, {"edge": -1.0}]
)
def test_impossible_grids_are_refused(bad):
    with pytest.raises(ValueError, match="polar grid needs"):
        PolarGrid(**({"n_r": 20, "n_theta": 10} | bad))
