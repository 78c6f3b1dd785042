"""Product integration along r: a closed form, orders that are interpolated, remainders that are sampled."""

import numpy as np
import pytest
from scipy.special import ive

from softlube.discretization.elasticity import elastic_operator
from softlube.discretization.grid import PolarGrid
from softlube.discretization.radial import radial_operators, sampled_orders
from softlube.model.substrates import LayerKernel


def test_orders_left_out_are_interpolated():
    """Quintic in m, against kernels that are all computed; near the centre there is no pressure of such orders."""
    grid = PolarGrid(40, 20, edge_width=0.05, side_width=0.07, side_clustering=1.5)
    operator = elastic_operator(grid, "none")
    n_modes = operator.analysis.shape[0]
    exact, _ = radial_operators(grid, np.arange(n_modes))
    orders, weights = sampled_orders(n_modes)
    assert orders.size < 0.7 * n_modes
    assert weights.sum(axis=1) == pytest.approx(1, abs=1e-12)
    n_low = len(operator.radial)
    assert operator.radial == pytest.approx(exact[:n_low], rel=1e-12, abs=1e-12)
    high = np.stack([operator.radial_high.row(ring) for ring in range(grid.shape[0])])
    for m in range(n_low, n_modes):
        own = np.abs(exact[m, 4:, 4:]).sum(axis=1)
        assert np.all(np.abs(high[4:, m - n_low, 4:] - exact[m, 4:, 4:]).sum(axis=1) < 6e-5 * own), m


@pytest.mark.parametrize("thickness", [0.15, 0.6, 3.0])
def test_a_remainder_is_sampled_finely_enough(thickness):
    """Against the same remainder on every point of every element, near ones graded."""
    grid, layer, orders = PolarGrid(40, 12, edge_width=0.05), LayerKernel(thickness), np.arange(9)

    class Rough:
        smooth_over = 1e-9  # all elements are long to it
        ring_remainder = staticmethod(layer.ring_remainder)

    half_space, _ = radial_operators(grid, orders)
    ours, plain = (radial_operators(grid, orders, each)[0] - half_space for each in (layer, Rough()))
    pressure = np.sqrt(np.maximum(1 - grid.r**2, 0)) + grid.r**-3 * (grid.r > 1)
    assert ours @ pressure == pytest.approx(plain @ pressure, abs=2e-6 * np.max(np.abs(plain @ pressure)))


def test_operator_shapes():
    grid = PolarGrid(12, 8)
    kernels, weights = radial_operators(grid, np.arange(5))
    assert kernels.shape == (5, *[grid.shape[0]] * 2)
    assert weights.shape == (grid.shape[0],)


def test_the_displacement_under_a_gaussian_in_closed_form():
    """∫ e^{−r′²} k₀ r′ dr′ = π^{3/2} e^{−r²/2} I₀(r²/2), and ∫ e^{−r²} r dr = 1/2."""
    grid = PolarGrid(60, 8, edge_width=0.3)
    kernels, weights = radial_operators(grid, np.arange(1))
    pressure = np.exp(-(grid.r**2))
    inner = grid.r < 5
    exact = np.pi**1.5 * ive(0, grid.r**2 / 2)
    assert (kernels[0] @ pressure)[inner] == pytest.approx(exact[inner], rel=2e-6)
    assert weights @ pressure == pytest.approx(0.5, rel=1e-6)


def test_few_orders_are_all_computed():
    orders, weights = sampled_orders(20)
    assert orders.tolist() == list(range(20))
    assert weights == pytest.approx(np.eye(20), abs=1e-14)


def test_orders_that_are_taken_get_their_own_kernels():
    orders, weights = sampled_orders(200)
    assert orders[-1] >= 199
    assert np.all(orders[orders > 24] % 2 == 0)
    taken = orders[orders < 200]
    assert weights[taken] == pytest.approx(np.eye(orders.size)[: taken.size], abs=1e-13)
