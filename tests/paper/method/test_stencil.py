import numpy as np
import pytest

from softlube.paper.method.mesh import PaperMesh
from softlube.paper.method.stencil import centre_pressure, d2_dr2, d2_dtheta2, d_dr, d_dtheta, reynolds_stencil

BETA = 7.0


def nodes(mesh):
    return mesh.r[:, None] * np.cos(mesh.theta), mesh.r[:, None] * np.sin(mesh.theta)


def film_and_derivatives(x, y):
    """A smooth film, even in y, with ∂u/∂x and ∂u/∂y."""
    return 1 + 0.3 * x + 0.1 * x**2 + 0.2 * y**2 + 0.1 * x * y**2, 0.3 + 0.2 * x + 0.1 * y**2, 0.4 * y + 0.2 * x * y


def reynolds(x, y):
    """∇·(u³∇p) for p = sin(x + 0.3) cos(y) and the film above, by hand."""
    u, u_x, u_y = film_and_derivatives(x, y)
    p_x, p_y = np.cos(x + 0.3) * np.cos(y), -np.sin(x + 0.3) * np.sin(y)
    laplacian = -2 * np.sin(x + 0.3) * np.cos(y)
    return u**3 * laplacian + 3 * u**2 * (u_x * p_x + u_y * p_y)


def test_differences_are_exact_on_quadratics():
    mesh = PaperMesh(24, 8)
    r = mesh.r[:, None] + 0 * mesh.theta
    f = 2 - 3 * r + 5 * r**2
    np.testing.assert_allclose(d_dr(f, mesh), -3 + 10 * r[1:-1], atol=1e-10)
    np.testing.assert_allclose(d2_dr2(f, mesh), 10 + 0 * r[1:-1], rtol=1e-9)


def test_angular_differences_of_a_cosine():
    """For cos kθ the centred differences (10) are known in closed form, at the mirror angles as well."""
    mesh, k = PaperMesh(20, 12), 3
    f = np.cos(k * mesh.theta) + 0 * mesh.r[:, None]
    h = mesh.d_theta
    np.testing.assert_allclose(d_dtheta(f, mesh), -np.sin(k * mesh.theta) * np.sin(k * h) / h + 0 * f[1:-1], atol=1e-13)
    np.testing.assert_allclose(d2_dtheta2(f, mesh), f[1:-1] * (2 * np.cos(k * h) - 2) / h**2, atol=1e-11)


def test_coefficients_equal_the_differences_of_6a_term_by_term():
    """(6a) by the product rule, u³p_rr + (u³/r + 3u²u_r)p_r + (u³p_θθ + 3u²u_θp_θ)/r², with one node's pressure at a time."""
    mesh = PaperMesh(20, 8)
    rng = np.random.default_rng(0)
    u = 0.5 + rng.random(mesh.shape)
    at = reynolds_stencil(u, mesh, BETA)
    r, inner = mesh.r[1:-1, None], u[1:-1]

    def operator(p):
        along = inner**3 * d2_dr2(p, mesh) + (inner**3 / r + 3 * inner**2 * d_dr(u, mesh)) * d_dr(p, mesh)
        around = (inner**3 * d2_dtheta2(p, mesh) + 3 * inner**2 * d_dtheta(u, mesh) * d_dtheta(p, mesh)) / r**2
        return along + around

    for j in range(2, mesh.n_r - 1):
        for i in range(2, mesh.n_theta - 1):  # away from the axis, where mirror images fall together
            unit = np.zeros(mesh.shape)
            unit[j, i] = 1
            image = operator(unit)
            found = [image[j - 1, i + 1], image[j, i], image[j - 1, i], image[j - 2, i], image[j - 1, i - 1]]
            expected = [at.A[j - 1, i + 1], at.B[j, i], at.C[j - 1, i], at.D[j - 2, i], at.E[j - 1, i - 1]]
            np.testing.assert_allclose(found, expected, rtol=1e-9, err_msg=f"A, B, C, D, E of node r_{j}, θ_{i}")
    cos, sin = np.cos(mesh.theta), np.sin(mesh.theta)
    np.testing.assert_allclose(at.F, -(cos * d_dr(u, mesh) - sin / r * d_dtheta(u, mesh)) / BETA, rtol=1e-9, atol=1e-12)


def test_the_residual_mirrors_the_pressure_on_the_axis():
    mesh = PaperMesh(20, 8)
    x, y = nodes(mesh)
    at = reynolds_stencil(film_and_derivatives(x, y)[0], mesh, BETA)
    p = np.sin(x) + y**2
    whole = np.concatenate([p[:, 1:2], p, p[:, -2:-1]], axis=1)
    by_hand = at.A * whole[1:-1, :-2] + at.B * p[:-2] + at.C * p[1:-1] + at.D * p[2:] + at.E * whole[1:-1, 2:]
    np.testing.assert_allclose(at.residual(p), at.F - by_hand, atol=1e-12)


def test_second_order_on_the_graded_mesh():
    errors = []
    for n in (50, 100, 200):
        mesh = PaperMesh(n, n)
        x, y = nodes(mesh)
        u, u_x, _ = film_and_derivatives(x, y)
        exact = -u_x / BETA - reynolds(x, y)
        found = reynolds_stencil(u, mesh, BETA).residual(np.sin(x + 0.3) * np.cos(y))
        # Not at the first circles, where (10) is first order only, its error being Δθ²/r, nor at the rim, where the largest
        # error moves outwards with the last node.
        away = (mesh.r[1:-1] > 0.2) & (mesh.r[1:-1] <= 1.6)
        errors.append(np.abs(found - exact[1:-1])[away].max())
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(order > 1.9), order
    assert np.all(order < 2.3), order


def centre_errors(formula):
    """Errors of a centre formula for u = 1 + g x and a pressure that satisfies (6a) at the origin."""
    g, c, p00 = 0.4, 0.3, 0.8
    k = -(g / BETA + 3 * g * c) / 2
    errors = []
    for n in (25, 50, 100):
        mesh = PaperMesh(n, n)
        x, _ = nodes(mesh)
        errors.append(abs(formula(p00 + c * x + k * x**2, 1 + g * x, mesh) - p00))
    return np.array(errors)


def test_the_centre_node_balances_the_flux():
    errors = centre_errors(lambda p, u, mesh: centre_pressure(p, u, mesh, BETA))
    assert np.all(np.log2(errors[:-1] / errors[1:]) > 3.5), errors


def test_the_centre_formula_as_printed_does_not():
    """Eq. (16) letter by letter: an error in proportion to the disc's area, as if the film's slope drove 3/2 of its flux."""

    def printed(p, u, mesh):
        weight = u[0, 0] ** 3 + u[1] ** 3
        bracket = np.cos(mesh.theta) @ (u[1] - u[0, 0])
        bracket -= np.sin(mesh.theta[1:-1]) @ (u[1, 2:] - u[1, :-2]) / mesh.d_theta
        return weight @ p[1] / weight.sum() + mesh.r[1] / (2 * BETA * weight.sum()) * bracket

    errors = centre_errors(printed)
    assert np.all(np.log2(errors[:-1] / errors[1:]) < 2.5), errors
    assert errors[0] > 10 * centre_errors(lambda p, u, mesh: centre_pressure(p, u, mesh, BETA))[0]


def test_a_film_at_rest_takes_the_mean_pressure():
    mesh = PaperMesh(20, 8)
    x, _ = nodes(mesh)
    assert centre_pressure(1 + x, np.full(mesh.shape, 0.3), mesh, BETA) == pytest.approx(1, abs=1e-14)
