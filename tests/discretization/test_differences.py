"""Differences on the faces: their order, in both directions and through the centre."""

import numpy as np
import pytest

from softlube.discretization.differences import FOURTH, SECOND, SIXTH, Differences, Faces
from softlube.discretization.grid import PolarGrid


def bump(x, y):
    """A smooth function without symmetry about 90°, and its gradient."""
    value = np.exp(-((x - 0.3) ** 2 + y**2) / 2)
    return value, -(x - 0.3) * value, -y * value


def faces_of(grid):
    """Cartesian places of the faces."""
    radial, angle = grid.r_face[: grid.n_r + 2], grid.theta_of(grid.s_face)
    inner = grid.r[: grid.n_r]
    return (
        np.concatenate([np.outer(radial, np.cos(grid.theta)).ravel(), np.outer(inner, np.cos(angle)).ravel()]),
        np.concatenate([np.outer(radial, np.sin(grid.theta)).ravel(), np.outer(inner, np.sin(angle)).ravel()]),
    )


@pytest.mark.parametrize("direction", ["across", "along"])
def test_gradients_on_the_faces_are_of_fourth_order(direction):
    errors = []
    for n in (2, 3, 4):
        grid = PolarGrid(30 * n, 16 * n, edge_width=0.25)
        faces, differences = Faces.on(grid), Differences.on(grid, FOURTH, SIXTH)
        nodes = bump(grid.r[:, None] * np.cos(grid.theta), grid.r[:, None] * np.sin(grid.theta))[0].ravel()
        x, y = faces_of(grid)
        _, by_x, by_y = bump(x, y)
        way = faces.normal if direction == "across" else faces.tangent
        found = faces.across * (differences.slope @ nodes) if direction == "across" else faces.along @ nodes
        error = np.abs(found - by_x * way[0] - by_y * way[1])
        errors.append(np.max(error[grid.theta.size :]))  # at the centre a face has no length
    assert -np.polyfit(np.log([2, 3, 4]), np.log(errors), 1)[0] == pytest.approx(4, abs=0.3)


def test_normals_and_tangents_are_perpendicular_units():
    faces = Faces.on(PolarGrid(12, 8))
    assert np.sum(faces.normal * faces.tangent, axis=0) == pytest.approx(0, abs=1e-15)
    assert np.hypot(*faces.normal) == pytest.approx(1)
    assert np.hypot(*faces.tangent) == pytest.approx(1)


@pytest.mark.parametrize("formulas", [(FOURTH, SIXTH), (SECOND, SECOND)])
def test_a_constant_has_its_value_and_no_slope(formulas):
    differences = Differences.on(PolarGrid(12, 8), *formulas)
    ones = np.ones(differences.slope.shape[1])
    assert differences.midpoint @ ones == pytest.approx(1)
    assert differences.slope @ ones == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("what", ["slope", "midpoint", "divergence"])
def test_formulas_along_the_angle_are_of_sixth_order(what):
    errors, counts = [], np.array([12, 16, 24])
    for n in counts:
        grid = PolarGrid(8, int(n))
        differences = Differences.on(grid, FOURTH, SIXTH)
        even, odd = np.exp(np.cos(grid.s)), np.sin(grid.s_face) * np.exp(np.cos(grid.s_face))
        if what == "divergence":  # of a flux that turns with its side of the axis
            flux = np.concatenate([np.zeros((grid.n_r + 2) * grid.shape[1]), np.tile(odd, grid.n_r)])
            found, exact = differences.divergence @ flux, np.tile((np.cos(grid.s) - np.sin(grid.s) ** 2) * even, grid.n_r)
        else:
            found = (getattr(differences, what) @ np.tile(even, grid.shape[0]))[(grid.n_r + 2) * grid.shape[1] :]
            exact = np.tile(-odd if what == "slope" else np.exp(np.cos(grid.s_face)), grid.n_r)
        errors.append(np.max(np.abs(found - exact)))
    assert -np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(6, abs=0.4)
