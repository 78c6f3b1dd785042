"""Splines against SciPy's."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline, RectBivariateSpline, RegularGridInterpolator

from softlube.discretization.splines import Spline, Weights, bilinear, lowest, polynomial_weights, slope_matrix

X = np.sort(np.random.default_rng(0).random(12)) * 3
Y = np.linspace(-1, 2, 9)
VALUES = np.random.default_rng(1).normal(size=(12, 9))


@pytest.mark.parametrize("nodes", [X, Y, Y[:4]])
def test_the_slopes_are_those_of_the_cubic_spline(nodes):
    values = np.random.default_rng(2).normal(size=nodes.size)
    expected = CubicSpline(nodes, values)(nodes, 1)
    assert slope_matrix(nodes) @ values == pytest.approx(expected, rel=1e-10, abs=1e-9 * np.abs(expected).max())


def test_a_cubic_is_met_between_the_nodes_and_beyond():
    x = np.linspace(-0.5, 3.5, 50)
    at, values, slopes = Weights(X, x), X**3 - 2 * X, 3 * X**2 - 2
    for derivative, expected in enumerate((x**3 - 2 * x, 3 * x**2 - 2, 6 * x)):
        node, weights = at.node, at.of(derivative)
        found = (
            weights[0] * values[node]
            + weights[1] * values[node + 1]
            + weights[2] * slopes[node]
            + weights[3] * slopes[node + 1]
        )
        assert found == pytest.approx(expected, abs=1e-9)
        assert np.concatenate([values, slopes]) @ at.matrix(derivative) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("dx", "dy"), [(0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (1, 2)])
def test_values_and_derivatives_on_a_grid_and_at_points(dx, dy):
    ours, other = Spline.through(X, Y, VALUES), RectBivariateSpline(X, Y, VALUES, s=0)
    x, y = np.linspace(X[0], X[-1], 33), np.linspace(-1, 2, 21)
    expected = other(x, y, dx=dx, dy=dy)
    assert ours(x, y, dx=dx, dy=dy) == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())
    share = np.random.default_rng(3).random((2, 5, 4))
    x, y = X[0] + share[0] * np.ptp(X), Y[0] + share[1] * np.ptp(Y)
    expected = other(x, y, dx=dx, dy=dy, grid=False)
    assert ours(x, y, dx=dx, dy=dy, grid=False) == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


def test_all_derivatives_at_a_point():
    ours = Spline.through(X, Y, VALUES)
    found = ours.jet(1.1, 0.4)
    expected = [[float(ours(1.1, 0.4, dx=i, dy=j, grid=False)) for j in range(3)] for i in range(3)]
    assert found == pytest.approx(np.array(expected), rel=1e-12)
    assert (-ours).jet(1.1, 0.4) == pytest.approx(-found, rel=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_the_lowest_point_of_a_line(seed):
    nodes = np.cumsum(0.1 + np.random.default_rng(seed).random(8))
    values = np.random.default_rng(seed + 10).normal(size=8)
    spline = CubicSpline(nodes, values)
    sampled = spline(np.linspace(nodes[0], nodes[-1], 20001))
    place, value = lowest(nodes, np.stack([values, spline(nodes, 1)]))
    assert value == pytest.approx(sampled.min(), abs=1e-6)
    assert value <= sampled.min() + 1e-12
    assert value == pytest.approx(float(spline(place)), abs=1e-12)


@pytest.mark.parametrize(("count", "derivative"), [(6, 0), (7, 1)])
def test_a_polynomial_of_as_many_terms_as_nodes_is_met(count, derivative):
    polynomial = np.polynomial.Polynomial(np.random.default_rng(3).normal(size=count))
    x = np.concatenate([X, X[:-1] + np.diff(X) / 3, [X[0] - 0.1]])
    found = polynomial_weights(X, x, derivative, count) @ polynomial(X)
    assert found == pytest.approx(polynomial.deriv(derivative)(x), rel=1e-6, abs=1e-6)


def test_values_in_between_do_not_jump_at_a_node():
    """The six nodes change there: a slope taken from them would."""
    before, after = (polynomial_weights(X, X[3:-3] * (1 + side * 1e-12), 0, 6) for side in (-1, 1))
    assert before == pytest.approx(after, abs=1e-8)
    before, after = (polynomial_weights(X, X[3:-3] * (1 + side * 1e-12), 1, 6) for side in (-1, 1))
    assert np.max(np.abs(before - after)) > 1e-2


def test_the_lowest_point_of_straight_lines_and_parabolas():
    x = np.arange(5.0)
    assert lowest(x, np.stack([-x, -np.ones(5)])) == (4.0, -4.0)
    assert lowest(x, np.stack([x, np.ones(5)])) == (0.0, 0.0)
    assert lowest(x, np.stack([(x - 1.3) ** 2, 2 * (x - 1.3)])) == pytest.approx((1.3, 0.0))


def test_linear_in_between():
    x, y = np.random.default_rng(4).random((2, 30)) * 3
    other = RegularGridInterpolator((X, Y), VALUES, bounds_error=False, fill_value=None)
    assert bilinear(X, Y, VALUES, x, y) == pytest.approx(other(np.stack([x, y], axis=-1)), rel=1e-12)
