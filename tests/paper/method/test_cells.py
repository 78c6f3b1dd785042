from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from softlube.model.exact import hertz_displacement, hertz_pressure
from softlube.paper.method.cells import RingElasticity, cell_corners, polygon_influence
from softlube.paper.method.mesh import PaperMesh


def potential_by_quadrature(corners, target):
    """∫ dA/|x − x′| over a convex polygon: chords in closed form along x, adaptive quadrature along y."""
    p = np.asarray(corners, float) - target
    ring = np.concatenate([p, p[:1]])

    def chord(y):
        crossings = []
        for (x1, y1), (x2, y2) in pairwise(ring):
            if min(y1, y2) < y < max(y1, y2):
                crossings.append(x1 + (x2 - x1) * (y - y1) / (y2 - y1))
        if len(crossings) < 2 or y == 0:
            return 0.0
        return np.arcsinh(max(crossings) / abs(y)) - np.arcsinh(min(crossings) / abs(y))

    cuts = np.unique(np.append(p[:, 1], 0.0))
    cuts = cuts[(cuts >= p[:, 1].min()) & (cuts <= p[:, 1].max())]
    total = 0.0
    for low, high in pairwise(cuts):
        # y = low + (high − low) t²(3 − 2t) takes the logarithmic ends away.
        total += quad(
            lambda t, a=low, b=high: chord(a + (b - a) * t * t * (3 - 2 * t)) * (b - a) * 6 * t * (1 - t),
            0, 1, epsabs=1e-14, epsrel=1e-13, limit=400,
        )[0]  # fmt: skip
    return total


def convex_quadrilateral(rng):
    angle = np.sort(rng.uniform(0, 2 * np.pi, 4))
    while np.max(np.diff(np.append(angle, angle[0] + 2 * np.pi))) > np.pi:
        angle = np.sort(rng.uniform(0, 2 * np.pi, 4))
    return rng.uniform(-1, 1, 2) + np.stack([np.cos(angle), 0.6 * np.sin(angle)], axis=-1)


@pytest.mark.parametrize("seed", range(6))
def test_random_quadrilaterals_at_random_targets(seed):
    rng = np.random.default_rng(seed)
    corners = convex_quadrilateral(rng)
    inside = rng.dirichlet(np.ones(4)) @ corners
    for target in (inside, *rng.uniform(-2, 2, (3, 2))):
        assert polygon_influence(target, corners) == pytest.approx(potential_by_quadrature(corners, target), abs=1e-10)


def test_targets_on_corners_and_edges():
    corners = convex_quadrilateral(np.random.default_rng(42))
    after = np.roll(corners, -1, axis=0)
    on_line = corners + 1.5 * (after - corners)
    for target in (*corners, *(corners + 0.3 * (after - corners)), *on_line):
        assert polygon_influence(target, corners) == pytest.approx(potential_by_quadrature(corners, target), abs=1e-10)


def test_square_in_closed_form():
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    at_corner = 2 * np.log(1 + np.sqrt(2))
    assert polygon_influence((0, 0), square) == pytest.approx(at_corner, rel=1e-15)
    assert polygon_influence((0.5, 0.5), square) == pytest.approx(2 * at_corner, rel=1e-15)


def test_right_triangle_as_printed():
    """Eq. (18a) with its logarithm, for the leg 0.7 and the angle 0.9."""
    leg, phi = 0.7, 0.9
    corners = np.array([(0.0, 0.0), (leg, 0.0), (leg, leg * np.tan(phi))])
    printed = leg / 2 * np.log((1 + np.sin(phi)) / (1 - np.sin(phi)))
    assert polygon_influence((0.0, 0.0), corners) == pytest.approx(printed, rel=1e-14)


def test_cells_of_the_mesh_and_the_triangle_at_the_centre():
    mesh = PaperMesh(20, 6)
    corners = cell_corners(mesh)
    rng = np.random.default_rng(1)
    for j in (0, 1, 10, 19):
        for target in ((0.0, 0.0), (mesh.r[j], 0.0), *rng.uniform(-2, 2, (2, 2))):
            value = polygon_influence(target, corners[j])
            assert value == pytest.approx(potential_by_quadrature(corners[j], np.array(target)), abs=1e-10)


def test_cells_tile_the_polygon():
    mesh = PaperMesh(20, 6)
    x, y = cell_corners(mesh)[..., 0], cell_corners(mesh)[..., 1]
    area = (x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum() / 2
    rim = (mesh.r[-1] + mesh.r[-2]) / 2
    assert area == pytest.approx(rim**2 * np.sin(mesh.d_theta) / 2, rel=1e-13)


def test_the_ring_operator_equals_its_dense_form_and_direct_summation():
    mesh = PaperMesh(20, 6)
    elasticity = RingElasticity(mesh)
    rng = np.random.default_rng(3)
    pressure = rng.random(mesh.shape)
    pressure[0], pressure[-1] = 0.7, 0.0
    w = elasticity.displacement(pressure)
    np.testing.assert_allclose(w.ravel(), elasticity.dense() @ pressure[:-1].ravel(), rtol=1e-12)
    # Without symmetry: every cell of the whole plane, turned to its place, at one target.
    corners = cell_corners(mesh)
    target = 7, 2
    x = mesh.r[target[0]] * np.array([np.cos(mesh.theta[target[1]]), np.sin(mesh.theta[target[1]])])
    total = 0.0
    for k in range(2 * mesh.n_theta):
        c, s = np.cos(k * mesh.d_theta), np.sin(k * mesh.d_theta)
        turned = corners @ np.array([[c, s], [-s, c]])
        total -= polygon_influence(x, turned) @ pressure[:-1, min(k, 2 * mesh.n_theta - k)]
    assert w[target] == pytest.approx(total, rel=1e-12)


def test_memory_scales_with_rotational_symmetry():
    assert RingElasticity(PaperMesh(50, 30)).influence.shape == (31, 51, 50)


def test_hertz_displacement_at_second_order():
    errors = []
    for n in (25, 50, 100):
        mesh = PaperMesh(n, 3 * n // 5)
        pressure = np.repeat(hertz_pressure(mesh.r)[:, None], mesh.n_theta + 1, axis=1)
        error = np.abs(RingElasticity(mesh).displacement(pressure) - hertz_displacement(mesh.r)[:, None])
        errors.append((error.max(), error.mean()))
    order = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert errors[1][0] < 2.5e-3
    assert np.all(order > 1.85), order
    assert np.all(order < 2.2), order
