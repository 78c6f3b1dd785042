"""The memory's operator against averages along lines, taken by quadrature of closed forms."""

import numpy as np
import pytest
from scipy.integrate import quad

from softlube.discretization.grid import PolarGrid
from softlube.discretization.memory import memory_operator
from softlube.model.exact import hertz_displacement

LENGTHS = (0.02, 0.3, 1.0, 50.0, 3000.0)


def grid_of(n_theta):
    plain = PolarGrid(8, n_theta, edge_width=0.05)
    return plain.resized(int(np.ceil(plain.xi_of(20.0) * n_theta / 5.2)), n_theta)


def nodes(grid):
    r, theta = np.meshgrid(grid.r, grid.theta, indexing="ij")
    return r * np.cos(theta), r * np.sin(theta)


def averaged(f, x, y, length):
    """∫ e^(−s) f(x + Ls, y) ds; past s = 1 over ln x, where f falls like 1/x."""
    places = sorted({min(max(-(x + each) / length, 0.0), 1.0) for each in (1.0, 0.0, -1.0)})
    near, _ = quad(lambda s: np.exp(-s) * f(x + length * s, y), 0, 1, points=places, limit=400, epsabs=1e-12)
    far, _ = quad(lambda s: np.exp(-s) * f(x + length * s, y), 1, 45, limit=400, epsabs=1e-12)
    return near + far


def smooth(x, y):
    """The displacement of a pressure that a point load at unit depth leaves on the surface, and a dipole's."""
    r = np.sqrt(1 + x**2 + y**2)
    return 1 / r + 0.3 * x / r**3


def worst(grid, f, length, samples=40):
    x, y = nodes(grid)
    found = (memory_operator(grid, (1.0,), (length,)).matrix @ f(x, y).ravel()).reshape(x.shape)
    random = np.random.default_rng(0)
    places = zip(random.integers(0, x.shape[0], samples), random.integers(0, x.shape[1], samples), strict=True)
    return max(abs(found[at] - averaged(f, x[at], y[at], length)) for at in places)


@pytest.mark.parametrize("length", LENGTHS)
def test_it_averages_a_smooth_displacement(length):
    """Far field ahead of the mesh included: with L = 3000 nearly all of it lies there."""
    assert worst(grid_of(31), smooth, length) < 5e-5


@pytest.mark.parametrize("length", [0.1, 1.0])
def test_its_order_is_four(length):
    coarse, fine = (worst(grid_of(n), smooth, length, 150) for n in (31, 43))
    assert np.log(coarse / fine) / np.log(43 / 31) > 3.5


def test_it_averages_a_displacement_with_a_kink_in_its_curvature():
    """Under a Hertz pressure."""
    for length in (0.1, 1.0):
        assert worst(grid_of(29), lambda x, y: -hertz_displacement(np.hypot(x, y)), length) < 2e-4


def test_short_and_long_memories():
    """L → 0 gives the displacement itself, exactly at L = 0; L → ∞ that far ahead, which is none."""
    grid = grid_of(15)
    x, y = nodes(grid)
    field = smooth(x, y).ravel()
    assert memory_operator(grid, (0.7,), (1e-9,)).matrix @ field == pytest.approx(field, rel=1e-8)
    both, one = memory_operator(grid, (0.2, 0.5), (0.0, 1.0)), memory_operator(grid, (0.5,), (1.0,))
    assert both.matrix @ field == pytest.approx(one.matrix @ field, rel=1e-14)
    assert memory_operator(grid, (0.7,), (1e9,)).matrix @ field == pytest.approx(0.3 * field, abs=1e-7)


def test_times_add():
    """Equal times are one, and several are the sum of each."""
    grid = grid_of(11)
    whole, split = memory_operator(grid, (0.6,), (2.0,)), memory_operator(grid, (0.2, 0.4), (2.0, 2.0))
    for one, other in ((whole.matrix, split.matrix), (whole.slope, split.slope)):
        assert abs(one - other).max() < 1e-10
    both = memory_operator(grid, (0.6, 0.3), (2.0, 7.0))
    second = memory_operator(grid, (0.3,), (7.0,))
    identity = np.eye(both.matrix.shape[0])
    assert abs((both.matrix - whole.matrix - second.matrix) + identity).max() < 1e-10
    assert abs(both.slope - whole.slope - second.slope).max() < 1e-10


def test_slope_is_that_of_the_average():
    """∂wᵢ/∂x less ∂wₑ/∂x/(1 + L), against differences of the quadrature."""
    grid, length, step = grid_of(31), 0.7, 1e-4
    x, y = nodes(grid)
    found = (memory_operator(grid, (0.5,), (length,)).slope @ smooth(x, y).ravel()).reshape(x.shape)
    for at in ((3, 2), (10, 7), (20, 15), (30, 21), (40, 12)):
        low, high = (averaged(smooth, x[at] + each, y[at], length) for each in (-step, step))
        below, above = (smooth(x[at] + each, y[at]) for each in (-step, step))
        assert found[at] == pytest.approx(0.5 * (high - low - (above - below) / (1 + length)) / (2 * step), abs=3e-4)


def test_short_and_long_memories_leave_no_slope():
    """Of the order of L, and of 1/L."""
    grid = grid_of(15)
    x, y = nodes(grid)
    inside = x**2 + y**2 < 100
    for length in (1e-4, 1e4):
        slope = (memory_operator(grid, (0.5,), (length,)).slope @ smooth(x, y).ravel()).reshape(x.shape)
        assert np.max(np.abs(slope[inside])) < 3e-4


def test_the_mesh_may_have_a_second_zone():
    grid = PolarGrid(90, 21, edge_width=0.05, crest=0.4, crest_width=0.15)
    assert worst(grid, smooth, 1.0) < 5e-5
