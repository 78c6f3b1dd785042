"""What a viscoelastic surface remembers: averages of the elastic displacement along the way that it has come.

A part of the surface at x has come along a line from upstream, from +x, so

    w = J₀ wₑ + ΣJᵢ wᵢ,     wᵢ(x) = ∫₀^∞ e^(−s) wₑ(x + Lᵢ s) ds,

which solves wᵢ − Lᵢ ∂wᵢ/∂x = wₑ, bounded ahead.  All times together are one sparse matrix on the nodes: from each of them a
line goes upstream through the mesh, with points as dense as the nodes; on these the displacement is interpolated by cubics in ξ
and s, and between them by cubics in x, whose products with the exponential are integrated exactly.  Ahead of the mesh the
harmonics of the displacement fall like those of a potential, r^(−m−1).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.polynomial import chebyshev
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray
from scipy import sparse

from softlube.discretization.elasticity import angular_transform
from softlube.discretization.grid import PolarGrid
from softlube.discretization.reynolds import Sparse

Array = NDArray[np.floating]
Index = NDArray[np.intp]
Mask = NDArray[np.bool_]

FORGOTTEN = 40.0
"""Times after which e^(−s) is nothing."""
NEGLIGIBLE = 1e-12
"""Entries of the matrix that are left out; its rows sum to about one."""
ROWS = 512
"""Rows of the matrix that are summed at a time."""
CUBIC = np.arange(4, dtype=np.int32)
"""Nodes of a cubic."""
SHORT = 3.0
"""Length over L of an interval up to which Gauss's quadrature takes its integrals; beyond, integration by parts is exact."""
GAUSS = leggauss(8)
"""Its points and weights."""
AHEAD_HARMONICS, AHEAD_POINTS, AHEAD_DEGREE = 6, 64, 24
"""Harmonics of the displacement that are followed ahead of the mesh, quadrature points, and degree in the angle."""


@dataclass(frozen=True)
class MemoryOperator:
    """What a memory makes of an elastic displacement, node by node.

    Attributes
    ----------
    matrix : sparse matrix, shape (n, n)
        J₀ + ΣJᵢ (1 − Lᵢ∂ₓ)⁻¹: from wₑ to w.  By columns, a product takes a fifth less time than by rows.
    slope : sparse matrix, shape (n, n)
        ΣJᵢ {[(1 − Lᵢ∂ₓ)⁻¹ − 1]/Lᵢ − ∂ₓ/(1 + Lᵢ)}: from wₑ to the slope ∂w/∂x less a multiple of ∂wₑ/∂x, which no
        friction knows.  The multiple is such that little is left of a short memory and of a long one, as of their frictions.
    compliance : ndarray, shape (n,)
        About what the displacement of single nodes sees of the relaxed compliance, for preconditioning.
    """

    matrix: sparse.csc_array
    slope: Sparse
    compliance: Array


@lru_cache(maxsize=8)
def memory_operator(grid: PolarGrid, shares: tuple[float, ...], lengths: tuple[float, ...]) -> MemoryOperator:
    """Assemble the operator of a memory on a grid.

    Parameters
    ----------
    grid : PolarGrid
        Whose nodes carry the displacements.
    shares, lengths : tuple of float
        Jᵢ over the relaxed compliance, and Lᵢ; see `softlube.model.substrates.Memory`.
    """
    kept = np.array(lengths) > 0
    share, length = np.array(shares)[kept], np.array(lengths)[kept]
    n = grid.shape[0] * grid.shape[1]
    blocks = []
    ahead = [_ahead(grid, each) for each in length]
    beyond = np.zeros((AHEAD_HARMONICS, n))
    beyond[:, n - grid.shape[1] :] = angular_transform(grid)[1][:AHEAD_HARMONICS]
    for rows in np.array_split(np.arange(n), -(-n // ROWS)):
        lines = _Lines.from_nodes(grid, rows, FORGOTTEN * float(np.max(length)))
        leaving = chebyshev.chebvander(4 / np.pi * lines.exit_angle - 1, AHEAD_DEGREE)
        weights = np.zeros((2, rows.size, lines.x.shape[1] + AHEAD_HARMONICS))  # of the points, and of the harmonics ahead
        for j, each, series in zip(share, length, ahead, strict=True):
            weight, left = lines.weights(each)
            weight = np.concatenate([weight, left[:, None] * (leaving @ series)], axis=1)
            weights += np.array([j, j / each])[:, None, None] * weight
            weights[1, :, :-AHEAD_HARMONICS] -= j / (1 + each) * lines.gradient
        own = np.concatenate([lines.own, np.ones((rows.size, AHEAD_HARMONICS), dtype=bool)], axis=1)
        place = np.zeros(own.shape, dtype=np.intp)
        place[:, :-AHEAD_HARMONICS][lines.own] = np.arange(np.count_nonzero(lines.own))
        place[:, -AHEAD_HARMONICS:] = np.count_nonzero(lines.own) + np.arange(AHEAD_HARMONICS)
        values = sparse.vstack([_interpolation(grid, lines), Sparse(beyond)])
        pointers = np.append(0, np.cumsum(np.count_nonzero(own, axis=1)))
        for weight in weights:
            block = Sparse((weight[own], place[own], pointers), (rows.size, values.shape[0])) @ values
            block.data[np.abs(block.data) < NEGLIGIBLE] = 0
            block.eliminate_zeros()
            blocks.append(block)
    matrix, slope = (Sparse(sparse.vstack(blocks[number::2])) for number in (0, 1))
    rest = 1 - float(np.sum(share))
    diagonal = sparse.eye_array(n)
    r, theta = (each.ravel() for each in np.meshgrid(grid.r, grid.theta, indexing="ij"))
    spacing = _spacing(grid, r * np.cos(theta), r * np.sin(theta))
    return MemoryOperator(
        matrix=sparse.csc_array(matrix + rest * diagonal),
        slope=Sparse(slope - float(np.sum(share / length)) * diagonal),
        compliance=rest + np.sum(share / (1 + length / spacing[:, None]), axis=1),
    )


@dataclass(frozen=True)
class _Lines:
    """Lines y = const from some nodes upstream, each with its points.

    Attributes
    ----------
    y : ndarray, shape (rows,)
    x : ndarray, shape (rows, points)
        Increasing: a point behind the node, the node, and those ahead; the last one is repeated where a line has fewer points
        than others.
    behind : ndarray of int, shape (rows,)
        1 where the point behind the node lies in the mesh; 0 where not, and the node takes its place.
    intervals : ndarray of int, shape (rows,)
        Number of intervals of each line, at least three; 0 for a node on the rim, which the line leaves at once.
    exit_angle : ndarray, shape (rows,)
        Angle under which the line leaves the mesh.
    """

    y: Array
    x: Array
    behind: Index
    intervals: Index
    exit_angle: Array

    @classmethod
    def from_nodes(cls, grid: PolarGrid, rows: Index, reach: float) -> _Lines:
        """Lines from some nodes, as far as the mesh or a distance reaches."""
        ring, angle = np.divmod(rows, grid.shape[1])
        r, theta, rim = grid.r[ring], grid.theta[angle], grid.r[-1]
        y, start = r * np.sin(theta), r * np.cos(theta)
        leaving = np.sqrt(np.maximum(rim**2 - y**2, 0))
        leaving = np.where((ring == grid.shape[0] - 1) & (theta <= np.pi / 2), start, np.maximum(leaving, start))
        end = np.minimum(leaving, start + reach)
        here, points = start, [start]
        while np.any(here < end):
            here = np.minimum(here + _spacing(grid, here, y), end)
            points.append(here)
        x = np.stack(points + [end] * (4 - len(points)), axis=1)
        intervals = np.sum(x < end[:, None], axis=1)
        # The last two intervals are made equal, lest the last one be tiny; a line has at least three.
        few = (intervals > 0) & (intervals < 3)
        x[few] = end[few, None]
        x[few, :3] = start[few, None] + (end - start)[few, None] * np.arange(3) / 3
        intervals[few] = 3
        many = np.flatnonzero(intervals)
        last = intervals[many]
        x[many, last - 1] = (x[many, last - 2] + end[many]) / 2
        last = start - _spacing(grid, start, y)
        behind = np.hypot(last, y) < rim
        x = np.concatenate([np.where(behind, last, start)[:, None], x], axis=1)
        return cls(y, x, behind.astype(np.intp), intervals, np.arcsin(np.clip(y / rim, 0, 1)))

    @cached_property
    def own(self) -> Mask:
        """Which of the points are its own, shape (rows, points)."""
        return np.arange(self.x.shape[1]) < np.where(self.intervals > 0, self.intervals + 2, 0)[:, None]

    @cached_property
    def gradient(self) -> Array:
        """Weights of the points in ∂wₑ/∂x at the node; none where a line leaves the mesh at once."""
        result = np.zeros_like(self.x)
        row = np.flatnonzero(self.intervals)
        column = 1 - self.behind[row, None] + CUBIC
        knots = self.x[row[:, None], column] - self.x[row, 1:2]
        for node in CUBIC:
            others = np.delete(knots, node, axis=1).T
            pairs = others[0] * others[1] + others[0] * others[2] + others[1] * others[2]
            result[row, column[:, node]] = pairs / np.prod(knots[:, node] - others, axis=0)
        return result

    def weights(self, length: float) -> tuple[Array, Array]:
        """Weights of the points in ∫ e^(−s) wₑ(x + Ls) ds up to the end of the line, and what is left of e^(−s) there."""
        n_rows, n_points = self.x.shape
        result = np.zeros((n_rows, n_points))
        origin, ahead = self.x[:, 1], self.x[:, 1:-1]
        inside = np.arange(ahead.shape[1]) < self.intervals[:, None]
        row, interval = np.nonzero(inside & ((ahead - origin[:, None]) < FORGOTTEN * length))
        low, width = ahead[row, interval], self.x[row, interval + 2] - ahead[row, interval]
        first = np.clip(interval, 1 - self.behind[row], self.intervals[row] - 2)
        knots = (self.x[row[:, None], first[:, None] + CUBIC] - low[:, None]) / width[:, None]
        moments = _moments(width / length) * np.exp(-(low - origin[row]) / length)
        place = row * n_points + first
        for node in CUBIC:
            a, b, c = np.delete(knots, node, axis=1).T
            own = knots[:, node]
            terms = moments[3] - (a + b + c) * moments[2] + (a * b + a * c + b * c) * moments[1] - a * b * c * moments[0]
            terms /= (own - a) * (own - b) * (own - c)
            result += np.bincount(place + node, terms, result.size).reshape(result.shape)
        return result, np.exp(-(self.x[:, -1] - origin) / length)


def _spacing(grid: PolarGrid, x: Array, y: Array) -> Array:
    """Distance of neighbouring points on a line: that over which the mesh changes by a cell, across or along its rings."""
    r = np.hypot(x, y)
    cell = grid.dr_dxi(r) * grid.d_xi
    turn = grid.slope(np.arctan2(y, x)) * grid.d_s
    radius = np.maximum(r, 1e-300)
    return 1 / np.hypot(x / radius / cell, y / radius / np.maximum(r * turn, cell))


def _moments(length: Array) -> Array:
    """ε∫₀¹ e^(−ετ) τ^k dτ for k = 0 … 3 and some ε, shape (4, …)."""
    result = np.empty((4, length.size))
    short = length < SHORT
    x, weight = GAUSS
    tau = (x + 1) / 2
    within = length[short, None]
    decay = within * np.exp(-within * tau) * weight / 2
    for k in CUBIC:
        result[k, short] = decay @ tau**k
    long, end = length[~short], np.exp(-length[~short])
    result[0, ~short] = 1 - end
    for k in CUBIC[1:]:
        result[k, ~short] = k * result[k - 1, ~short] / long - end
    return result


def _interpolation(grid: PolarGrid, lines: _Lines) -> Sparse:
    """Bicubic interpolation from the nodes to the own points of some lines, one line after the other, shape (points, n)."""
    n_rings, n_angles = grid.shape
    x, y = lines.x[lines.own], np.broadcast_to(lines.y[:, None], lines.x.shape)[lines.own]
    across = grid.xi_of(np.hypot(x, y)) / grid.d_xi - 0.5
    along = grid.s_of(np.arctan2(y, x)) / grid.d_s
    ring = np.minimum(np.floor(across).astype(np.int32) - 1, n_rings - 4)
    angle = np.floor(along).astype(np.int32) - 1
    over_ring, over_angle = _cubic(across - ring), _cubic(along - angle)
    ring, angle = ring[:, None] + CUBIC, angle[:, None] + CUBIC
    angle = np.abs(angle)
    angle = np.where(angle >= n_angles, 2 * (n_angles - 1) - angle, angle)
    opposite = ring[:, :, None] < 0  # beyond the centre
    node = np.where(opposite, -1 - ring[:, :, None], ring[:, :, None]) * n_angles
    node = node + np.where(opposite, n_angles - 1 - angle[:, None, :], angle[:, None, :])
    weight = over_ring[:, :, None] * over_angle[:, None, :]
    return Sparse((weight.ravel(), node.ravel(), np.arange(0, 16 * x.size + 1, 16)), (x.size, n_rings * n_angles))


def _cubic(t: Array) -> Array:
    """Weights of the values at 0, 1, 2, 3 in the cubic through them at t."""
    a, b, c = t - 1, t - 2, t - 3
    return np.stack([-a * b * c / 6, t * b * c / 2, -t * a * c / 2, t * a * b / 6], axis=-1)


def _ahead(grid: PolarGrid, length: float) -> Array:
    """∫₀^∞ e^(−s) (R/r)^(m+1) cos mθ ds along lines that leave a mesh of radius R, over the angle under which they do.

    Returns
    -------
    ndarray, shape (degree + 1, m)
        Chebyshev series in the angle from 0 to π/2.
    """
    rim = grid.r[-1]
    x, weight = leggauss(AHEAD_POINTS)
    top = np.log1p(FORGOTTEN * length / rim)
    t = top * (x + 1) / 2
    distance = rim * np.expm1(t)
    decay = np.exp(-distance / length) * (distance + rim) / length * top * weight / 2
    leaving = np.pi / 4 * (1 + chebyshev.chebpts1(AHEAD_DEGREE + 1))
    place = rim * np.cos(leaving[:, None]) + distance + 1j * rim * np.sin(leaving[:, None])
    order = np.arange(AHEAD_HARMONICS)
    waves = (rim / place[..., None]) ** (order + 1)
    # (R/z)^(m+1) has the magnitude wanted, and turns by one angle too many.
    harmonics = (waves * (place / np.abs(place))[..., None]).real
    return chebyshev.chebfit(4 / np.pi * leaving - 1, np.einsum("aqm,q->am", harmonics, decay), AHEAD_DEGREE)
