"""Cubic splines on a product of two axes, made for being evaluated at many places soon after they are made.

A spline is kept as values and slopes on its nodes, from which a cubic follows between two of them (Hermite).  The slopes are a
fixed matrix times the values, kept for axes that come again.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.floating]


@lru_cache(maxsize=32)
def _slopes_of(steps: tuple[float, ...]) -> Array:
    """Matrix from the values on nodes to the slopes of the cubic spline through them, not-a-knot, shape (n, n).

    Parameters
    ----------
    steps : tuple of float
        Distances of the nodes, at least three.
    """
    h = np.array(steps)
    n = h.size + 1
    system, right = np.zeros((2, n, n))
    k = np.arange(1, n - 1)
    before, after = h[:-1], h[1:]
    # The second derivative is continuous at the inner nodes …
    system[k, k - 1], system[k, k], system[k, k + 1] = after, 2 * (before + after), before
    right[k, k - 1], right[k, k + 1] = -3 * after / before, 3 * before / after
    right[k, k] = -right[k, k - 1] - right[k, k + 1]
    # … and the third at the first and the last of them.
    for node, inward, a, b in ((0, 1, h[0], h[1]), (n - 1, -1, h[-1], h[-2])):
        system[node, [node, node + inward]] = b, a + b
        first, second = (3 * a + 2 * b) * b / (a * (a + b)), a**2 / (b * (a + b))
        right[node, [node, node + inward, node + 2 * inward]] = np.array([-first, first - second, second]) * inward
    return np.linalg.solve(system, right)


def slope_matrix(nodes: Array) -> Array:
    """Matrix from the values on increasing nodes to the slopes of the cubic spline through them (not-a-knot)."""
    steps = np.diff(nodes)
    unit = float(np.mean(steps))
    return _slopes_of(tuple(np.round(steps / unit, 12).tolist())) / unit


class Weights:
    """Weights of the cubics at points of an axis: of the values and slopes on the nodes on either side.

    Parameters
    ----------
    nodes : ndarray, shape (n,)
        Increasing.
    x : array_like
        Points; beyond the ends the outermost cubics go on.
    """

    def __init__(self, nodes: Array, x: ArrayLike) -> None:
        x, self._n = np.asarray(x, dtype=float), nodes.size
        self.node = np.searchsorted(nodes[1:-1], x, side="right")
        self._width = nodes[self.node + 1] - nodes[self.node]
        self._t = (x - nodes[self.node]) / self._width
        self._known: dict[int, tuple[Array, ...]] = {}
        self._matrices: dict[int, Array] = {}

    def of(self, derivative: int) -> tuple[Array, ...]:
        """Weights for the value (0), the first or the second derivative, four arrays.

        Of the values on the lower and the upper node of each point's interval, then of the slopes on them.
        """
        if derivative not in self._known:
            t, width, left = self._t, self._width, 1 - self._t
            if derivative == 0:
                rise = t * t * (3 - 2 * t)
                weights = 1 - rise, rise, width * t * left * left, -width * t * t * left
            elif derivative == 1:
                rise = 6 * t * left / width
                weights = -rise, rise, left * (1 - 3 * t), t * (3 * t - 2)
            else:
                rise = 6 * (1 - 2 * t) / (width * width)
                weights = -rise, rise, (6 * t - 4) / width, (6 * t - 2) / width
            self._known[derivative] = tuple(np.asarray(each) for each in weights)
        return self._known[derivative]

    def matrix(self, derivative: int) -> Array:
        """The weights of all nodes, shape (2n, points): of the values, then of the slopes."""
        if derivative not in self._matrices:
            matrix = np.zeros((2 * self._n, self.node.size))
            point = np.arange(self.node.size)
            for weight, (part, up) in zip(self.of(derivative), _CORNERS, strict=True):
                matrix[part * self._n + up + self.node, point] = weight
            self._matrices[derivative] = matrix
        return self._matrices[derivative]


@dataclass(frozen=True)
class Spline:
    """A bicubic spline f(x, y).

    Attributes
    ----------
    x, y : ndarray, shape (n,) and (m,)
        Nodes, increasing.
    table : ndarray, shape (2, n, 2, m)
        ∂f/∂x and ∂f/∂y as often as the first and the third index say.
    """

    x: Array
    y: Array
    table: Array

    @classmethod
    def through(cls, x: Array, y: Array, values: Array) -> Spline:
        """The spline through values on the product of nodes (not-a-knot)."""
        along = np.stack([values, slope_matrix(x) @ values])
        return cls(x, y, np.stack([along, along @ slope_matrix(y).T], axis=2))

    def __neg__(self) -> Spline:
        """−f."""
        return Spline(self.x, self.y, -self.table)

    def on(self, across: Weights, along: Weights, dx: int = 0, dy: int = 0) -> Array:
        """Values or derivatives on the product of points of either axis, shape (points of x, points of y)."""
        terms = [
            weight[:, None] * self.table[part, across.node + up].reshape(weight.size, -1)
            for weight, (part, up) in zip(across.of(dx), _CORNERS, strict=True)
        ]
        return sum(terms[1:], terms[0]) @ along.matrix(dy)

    def __call__(self, x: ArrayLike, y: ArrayLike, dx: int = 0, dy: int = 0, grid: bool = True) -> Array:
        """Values or derivatives.

        Parameters
        ----------
        x, y : array_like
            Arrays of one dimension, of whose product the values are taken; with ``grid=False`` points, which broadcast.
        dx, dy : {0, 1, 2}
            Order of the derivatives.
        grid : bool
            Whether x and y span a grid.
        """
        if grid:
            return self.on(Weights(self.x, np.atleast_1d(x)), Weights(self.y, np.atleast_1d(y)), dx, dy)
        across, along = Weights(self.x, x), Weights(self.y, y)
        terms = [
            a * b * self.table[part, across.node + up, other, along.node + ahead]
            for a, (part, up) in zip(across.of(dx), _CORNERS, strict=True)
            for b, (other, ahead) in zip(along.of(dy), _CORNERS, strict=True)
        ]
        return sum(terms[1:], terms[0])

    def jet(self, x: float, y: float) -> Array:
        """Derivatives ∂ⁱ⁺ʲf/∂xⁱ∂yʲ for i, j = 0, 1, 2 at a point, shape (3, 3)."""
        across, along = Weights(self.x, x), Weights(self.y, y)
        near = self.table[:, across.node : across.node + 2, :, along.node : along.node + 2].reshape(4, 4)
        return np.array([across.of(d) for d in range(3)]) @ near @ np.array([along.of(d) for d in range(3)]).T


def polynomial_weights(nodes: Array, x: Array, derivative: int, count: int) -> Array:
    """Weights of values on nodes in the value (0) or slope (1) of polynomials at points, shape (points, nodes).

    Each polynomial runs through the six or seven nodes (the count) about its point.  Six are as many on either side of a point
    in between, seven on either side of a node.
    """
    first = np.clip(np.searchsorted(nodes, x) - 3, 0, nodes.size - count)
    near = first[:, None] + np.arange(count)
    unit = (nodes[near[:, -1]] - nodes[first]) / (count - 1)
    powers = ((nodes[near] - x[:, None]) / unit[:, None])[:, None, :] ** np.arange(count)[:, None]
    taylor = np.eye(count)[:, derivative, None]
    weights = np.zeros((x.size, nodes.size))
    found = np.linalg.solve(powers, taylor)[:, :, 0] / unit[:, None] ** derivative
    np.put_along_axis(weights, near, found, axis=1)
    return weights


def bilinear(x_nodes: Array, y_nodes: Array, values: Array, x: Array, y: Array) -> Array:
    """Linear in between: values at points, which broadcast, from values on the product of nodes.

    Beyond the ends the outermost pieces go on.
    """
    i, k = (np.searchsorted(nodes[1:-1], at, side="right") for nodes, at in ((x_nodes, x), (y_nodes, y)))
    t = (x - x_nodes[i]) / (x_nodes[i + 1] - x_nodes[i])
    u = (y - y_nodes[k]) / (y_nodes[k + 1] - y_nodes[k])
    low, high = ((1 - u) * values[row, k] + u * values[row, k + 1] for row in (i, i + 1))
    return (1 - t) * low + t * high


def lowest(x: Array, line: Array) -> tuple[Array, Array]:
    """Places and values of the minima of cubic splines between their outermost nodes.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Nodes.
    line : ndarray, shape (2, ..., n)
        Values and slopes on them.
    """
    width = np.diff(x)
    low, high = line[0, ..., :-1], line[0, ..., 1:]
    start, end = line[1, ..., :-1] * width, line[1, ..., 1:] * width
    # f(t) = low + start t + b t² + c t³ between two nodes, with its minimum where f′ passes from − to +.
    b, c = 3 * (high - low) - 2 * start - end, 2 * (low - high) + start + end
    square = b * b - 3 * c * start
    root = np.sqrt(np.maximum(square, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.where(b >= 0, -start / (b + root), (root - b) / (3 * c))
    t = np.where((t > 0) & (t < 1) & (square > 0), t, 0.0)
    values = np.concatenate([low + t * (start + t * (b + t * c)), line[0, ..., -1:]], axis=-1)
    places = np.concatenate([x[:-1] + t * width, np.broadcast_to(x[-1], (*t.shape[:-1], 1))], axis=-1)
    least = np.expand_dims(np.argmin(values, axis=-1), -1)
    return np.take_along_axis(places, least, -1)[..., 0], np.take_along_axis(values, least, -1)[..., 0]


_CORNERS = ((0, 0), (0, 1), (1, 0), (1, 1))
"""Value or slope, on the lower or the upper node, in the order of the weights of `Weights.of`."""
