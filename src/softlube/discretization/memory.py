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
from functools import lru_cache

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

FORGOTTEN = 40.0
"""Times after which e^(−s) is nothing."""
NEGLIGIBLE = 1e-12
"""Entries of the matrix that are left out; its rows sum to about one."""
BLOCK = 1_000_000
"""Entries of the matrix, zeros included, that are summed at a time."""
CUBIC = np.arange(4)
"""Nodes of a cubic."""
SHORT = 3.0
"""Length over L of an interval up to which Gauss's quadrature takes its integrals; beyond, integration by parts is exact."""
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
    analysis = angular_transform(grid)[1][:AHEAD_HARMONICS]
    for rows in np.array_split(np.arange(n), -(-n * n // BLOCK)):
        lines = _Lines.from_nodes(grid, rows, FORGOTTEN * float(np.max(length)))
        gradient = lines.gradient
        along, ahead = np.zeros((2, *lines.x.shape)), np.zeros((2, rows.size, len(analysis)))
        for j, each in zip(share, length, strict=True):
            weight, beyond = lines.weights(each)
            tail = beyond[:, None] * _ahead(grid, each, lines.exit_angle)
            for number, factor in enumerate((j, j / each)):
                along[number] += factor * weight
                ahead[number] += factor * tail
            along[1] -= j / (1 + each) * gradient
        column, cubic = _interpolation(grid, lines)
        place = (np.arange(rows.size)[:, None, None] * n + column).ravel()
        for weight, tail in zip(along, ahead, strict=True):
            dense = np.bincount(place, (weight[..., None] * cubic).ravel(), rows.size * n).reshape(rows.size, n)
            dense[:, n - grid.shape[1] :] += tail @ analysis
            dense[np.abs(dense) < NEGLIGIBLE] = 0
            blocks.append(Sparse(dense))
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

    @property
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
        own = np.arange(ahead.shape[1]) < self.intervals[:, None]
        row, interval = np.nonzero(own & ((ahead - origin[:, None]) < FORGOTTEN * length))
        low, width = ahead[row, interval], self.x[row, interval + 2] - ahead[row, interval]
        first = np.clip(interval, 1 - self.behind[row], self.intervals[row] - 2)
        knots = (self.x[row[:, None], first[:, None] + CUBIC] - low[:, None]) / width[:, None]
        moments = _moments(width / length) * np.exp(-(low - origin[row]) / length)
        place = row * n_points + first
        for node in CUBIC:
            others = np.delete(knots, node, axis=1).T
            below = np.prod(knots[:, node] - others, axis=0)
            pairs = others[0] * others[1] + others[0] * others[2] + others[1] * others[2]
            terms = moments[3] - others.sum(axis=0) * moments[2] + pairs * moments[1] - np.prod(others, axis=0) * moments[0]
            result += np.bincount(place + node, terms / below, result.size).reshape(result.shape)
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
    x, weight = leggauss(8)
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


def _interpolation(grid: PolarGrid, lines: _Lines) -> tuple[Index, Array]:
    """Nodes and weights of bicubic interpolation to the points of some lines, each of shape (rows, points, 16)."""
    y = lines.y[:, None]
    n_rings, n_angles = grid.shape
    across = grid.xi_of(np.hypot(lines.x, y)) / grid.d_xi - 0.5
    along = grid.s_of(np.arctan2(np.broadcast_to(y, lines.x.shape), lines.x)) / grid.d_s
    ring = np.minimum(np.floor(across).astype(np.intp) - 1, n_rings - 4)
    angle = np.floor(along).astype(np.intp) - 1
    over_ring, over_angle = _cubic(across - ring), _cubic(along - angle)
    ring, angle = ring[..., None] + CUBIC, angle[..., None] + CUBIC
    angle = np.abs(angle)
    angle = np.where(angle >= n_angles, 2 * (n_angles - 1) - angle, angle)
    opposite = ring[..., None] < 0  # beyond the centre
    node = np.where(opposite, -1 - ring[..., None], ring[..., None]) * n_angles
    node = node + np.where(opposite, n_angles - 1 - angle[..., None, :], angle[..., None, :])
    weight = over_ring[..., :, None] * over_angle[..., None, :]
    return node.reshape(*lines.x.shape, 16), weight.reshape(*lines.x.shape, 16)


def _cubic(t: Array) -> Array:
    """Weights of the values at 0, 1, 2, 3 in the cubic through them at t."""
    a, b, c = t - 1, t - 2, t - 3
    return np.stack([-a * b * c / 6, t * b * c / 2, -t * a * c / 2, t * a * b / 6], axis=-1)


def _ahead(grid: PolarGrid, length: float, angle: Array) -> Array:
    """∫₀^∞ e^(−s) (R/r)^(m+1) cos mθ ds along lines that leave a mesh of radius R under some angles, shape (angles, m)."""
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
    values = np.einsum("aqm,q->am", harmonics, decay)
    series = chebyshev.chebfit(4 / np.pi * leaving - 1, values, AHEAD_DEGREE)
    return chebyshev.chebvander(4 / np.pi * angle - 1, AHEAD_DEGREE) @ series
