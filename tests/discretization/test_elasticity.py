"""The half-space operator against quadrature, closed forms and its own symmetry."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ive

from softlube.discretization.elasticity import angular_transform, elastic_operator
from softlube.discretization.grid import PolarGrid
from softlube.model.exact import far_field_profile


def gaussian_error(n_r, n_theta, offset, side_width=0.5):
    """Largest error of the displacement under exp(−|x − a|²), whose displacement is −π^{3/2} e^{−ρ²/2} I₀(ρ²/2)."""
    grid = PolarGrid(n_r, n_theta, edge_width=0.3, side_width=side_width)
    x, y = grid.r[:, None] * np.cos(grid.theta), grid.r[:, None] * np.sin(grid.theta)
    square = (x - offset) ** 2 + y**2
    exact = -(np.pi**1.5) * ive(0, square / 2)
    result = -elastic_operator(grid, "none").deflection(np.exp(-square).ravel()).reshape(grid.shape)
    return np.max(np.abs(result - exact)[grid.r < 5]), grid, np.exp(-square)


def test_displacement_under_a_gaussian_converges_at_high_order_in_r():
    n = np.array([24, 36, 54])
    errors = [gaussian_error(k, 16, 0.0)[0] for k in n]
    order = -np.polyfit(np.log(n), np.log(errors), 1)[0]
    assert errors[-1] < 2e-5
    assert order > 4.5


def test_displacement_off_centre_converges_geometrically_in_theta():
    errors = [gaussian_error(120, k, 0.7, side_width=0.2)[0] for k in (6, 9, 12)]
    assert errors[0] > 20 * errors[1] > 400 * errors[2]
    assert errors[2] < 1e-6


def test_load_weights_integrate_a_gaussian():
    for offset in (0.0, 0.5):
        _, grid, pressure = gaussian_error(80, 24, offset)
        assert elastic_operator(grid, "none").load_weights @ pressure.ravel() == pytest.approx(np.pi, rel=2e-7)


def test_reciprocity():
    # Work of one pressure on the other's displacement: ∫ p₁ w₂ dA = ∫ p₂ w₁ dA.
    grid = PolarGrid(80, 20, edge_width=0.3)
    x, y = grid.r[:, None] * np.cos(grid.theta), grid.r[:, None] * np.sin(grid.theta)
    first, second = np.exp(-((x - 0.4) ** 2) - y**2).ravel(), np.exp(-2 * (x + 0.5) ** 2 - y**2).ravel()
    operator = elastic_operator(grid, "none")
    work = [
        operator.load_weights @ (first * operator.deflection(second)),
        operator.load_weights @ (second * operator.deflection(first)),
    ]
    assert work[0] == pytest.approx(work[1], rel=1e-6)


def dense(operator, n):
    return np.stack([operator.deflection(unit) for unit in np.eye(n)], axis=1)


def test_deflection_is_made_of_its_couplings_between_rings():
    grid = PolarGrid(10, 6)
    operator, n_angles = elastic_operator(grid, "none"), grid.shape[1]
    matrix = dense(operator, grid.shape[0] * n_angles)
    for target, sources in ((0, slice(0, 3)), (4, slice(2, 7)), (11, slice(9, 12))):
        blocks = operator.ring_coupling(target, sources)
        expected = matrix[target * n_angles :][:n_angles, sources.start * n_angles : sources.stop * n_angles]
        assert np.hstack(list(blocks)) == pytest.approx(expected, rel=1e-12, abs=1e-13)


def test_rings_that_are_left_out_carry_no_pressure():
    grid = PolarGrid(10, 6)
    operator, pressure = elastic_operator(grid, "none"), np.random.default_rng(1).random(grid.shape)
    pressure[7:] = 0
    assert operator.deflection(pressure[:7].ravel()) == pytest.approx(operator.deflection(pressure.ravel()), rel=1e-13)


@pytest.mark.parametrize("side_width", [100.0, 0.5, 0.1])
def test_angular_transform_is_exact_for_low_harmonics(side_width):
    grid = PolarGrid(10, 32, side_width=side_width)
    synthesis, analysis = angular_transform(grid)
    for m in range(4):
        expected = np.zeros(analysis.shape[0])
        expected[m] = 1
        assert analysis @ np.cos(m * grid.theta) == pytest.approx(expected, abs=1e-12)
    assert synthesis.shape == analysis.T.shape


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_far_field_beyond_the_grid(cavitation):
    """Displacement at the centre and load of the tail, against direct integration of its profile."""
    grid = PolarGrid(30, 16)
    operator = elastic_operator(grid, cavitation)
    mean = quad(lambda t: 2 * far_field_profile(t, cavitation), 0, np.pi, points=[1.8924])[0]
    a = grid.r[-1]
    # ∫ f r⁻³ (1 − 4h₀/r²) r dr dθ, and at the centre the kernel 1/r makes it ∫ f r⁻³ (1 − 4h₀/r²) dr dθ.
    assert operator.far_load == pytest.approx(mean * np.array([1 / a, -4 / (3 * a**3)]), abs=1e-9)
    near_centre = operator.far_displacement.reshape(2, *grid.shape)[:, 0].mean(axis=1)
    assert near_centre == pytest.approx(mean * np.array([1 / (2 * a**2), -1 / a**4]), abs=2e-5)
