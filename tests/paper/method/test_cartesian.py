import numpy as np
import pytest

from softlube.model.exact import hertz_displacement, hertz_pressure
from softlube.paper.method.cartesian import CartesianMesh, CartesianScheme, DenseElasticity, FFTElasticity, rectangle_influence
from softlube.paper.method.cells import polygon_influence


def test_rectangle_equals_the_signed_triangles():
    """Love's closed form against Eq. (18), in and out of the rectangle, on its edges and at its corners."""
    rectangle = np.array([(-0.3, -0.2), (0.3, -0.2), (0.3, 0.2), (-0.3, 0.2)])
    for target in ((0, 0), (0.1, -0.15), (0.3, 0.05), (0.3, 0.2), (0.3, 0.9), (2, 0.2), (-1.3, 0.7)):
        assert rectangle_influence(*target, 0.6, 0.4) == pytest.approx(polygon_influence(target, rectangle), rel=1e-12)


def test_fft_equals_dense():
    mesh = CartesianMesh(14, 9)
    pressure = np.random.default_rng(0).random(mesh.shape)
    pressure[[0, -1]] = 0
    pressure[:, -1] = 0
    fft, dense = FFTElasticity(mesh).displacement(pressure), DenseElasticity(mesh).displacement(pressure)
    np.testing.assert_allclose(fft, dense, rtol=1e-12)


def test_hertz_displacement_on_the_grid():
    errors = []
    for n in (40, 80, 160):
        mesh = CartesianMesh(n, n // 2)
        r = np.hypot(mesh.x[:, None], mesh.y)
        errors.append(np.abs(FFTElasticity(mesh).displacement(hertz_pressure(r)) - hertz_displacement(r)).mean())
    # The grid knows nothing of the circle r = 1, where the pressure has an infinite slope: between first and second order.
    assert np.log2(errors[0] / errors[2]) / 2 > 1.3
    assert errors[1] < 2e-3


def manufactured(mesh):
    x, y = mesh.x[:, None], mesh.y
    u, u_x, u_y = 1 + 0.3 * x + 0.1 * x**2 + 0.2 * y**2, 0.3 + 0.2 * x, 0.4 * y
    p, p_x, p_y = np.sin(x + 0.3) * np.cos(y), np.cos(x + 0.3) * np.cos(y), -np.sin(x + 0.3) * np.sin(y)
    return p, u + 0 * y, u**3 * -2 * p + 3 * u**2 * (u_x * p_x + u_y * p_y), u_x + 0 * y


def test_the_sweep_solves_6a_at_second_order():
    """A sweep with a tiny factor shows the residual, change × centre coefficient / factor, at every node."""
    beta, errors = 7.0, []
    for n in (20, 40, 80):
        mesh = CartesianMesh(n, n // 2)
        p, u, operator, u_x = manufactured(mesh)
        factor = 1e-7  # so small that new values of the neighbours are as good as old ones
        new = CartesianScheme(mesh).sweep(p, u, beta, factor, floor=-np.inf)
        centre = -2 * u**3 * (1 / mesh.dx**2 + 1 / mesh.dy**2)
        residual = ((new - p) / factor * centre)[2:-2, :-2]
        errors.append(np.abs(residual - (-u_x / beta - operator)[2:-2, :-2]).max())
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(order > 1.8), (order, errors)


def test_unknown_elasticity_and_tiny_grids_are_refused():
    with pytest.raises(ValueError, match="fft"):
        CartesianScheme(CartesianMesh(20, 10), "fmm")
    with pytest.raises(ValueError, match="n_x"):
        CartesianMesh(4, 2)
