"""Surface displacement under cells of uniform pressure: the signed right triangles of Fig. 3, Eq. (18).

A polygon is the signed sum of the triangles that its edges make with the target point, and each triangle the difference of two
right triangles.  In normalised form a right triangle with the leg h₁ at the target, the right angle at the foot of the
perpendicular and the angle φ at the target displaces the target by

    w = −p (h₁/2) ln[(1 + sin φ)/(1 − sin φ)].                                                                            (18a)
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.fft import dct, idct

from softlube.paper.method.mesh import PaperMesh

Array = NDArray[np.float64]


def edge_influence(target: ArrayLike, start: ArrayLike, end: ArrayLike) -> Array:
    """−w at the target under unit pressure on the triangle (target, start, end), signed; Eq. (18b).

    Positive if the target lies to the left of the edge, so that the sum over a counter-clockwise polygon is the polygon's
    influence.  Exactly zero where the target lies on the line through the edge, its corners included.

    Parameters
    ----------
    target, start, end : array_like, shape (..., 2)
        Points of the plane, broadcast against each other.

    Returns
    -------
    ndarray, shape (...)
    """
    target, start, end = np.asarray(target, float), np.asarray(start, float), np.asarray(end, float)
    edge = end - start
    length = np.hypot(edge[..., 0], edge[..., 1])
    along = edge / np.where(length > 0, length, 1.0)[..., None]
    to_start, to_end = start - target, end - target
    # The leg h₁, positive on the left; the vertices' places on the edge, measured from the foot of the perpendicular.
    leg = to_start[..., 0] * along[..., 1] - to_start[..., 1] * along[..., 0]
    at_start = (to_start * along).sum(axis=-1)
    at_end = (to_end * along).sum(axis=-1)
    off_line = np.abs(leg) > 1e-15 * (np.abs(at_start) + np.abs(at_end))
    distance = np.where(off_line, np.abs(leg), 1.0)
    # ½ ln[(1 + sin φ)/(1 − sin φ)] = arsinh(tan φ), which keeps its digits as φ → ±90°.
    return np.where(off_line, leg * (np.arcsinh(at_end / distance) - np.arcsinh(at_start / distance)), 0.0)


def polygon_influence(target: ArrayLike, corners: ArrayLike) -> Array:
    """−w at the target under unit pressure on a polygon, ∫ dA/|x − x′|.

    Parameters
    ----------
    target : array_like, shape (..., 2)
        Point of the plane.
    corners : array_like, shape (..., k, 2)
        Counter-clockwise; repeated corners are edges of no length and add nothing.
    """
    target, corners = np.asarray(target, float), np.asarray(corners, float)
    k = corners.shape[-2]
    return sum((edge_influence(target, corners[..., i, :], corners[..., (i + 1) % k, :]) for i in range(k)), start=np.zeros(()))


def cell_corners(mesh: PaperMesh) -> Array:
    """Corners of the cells around the nodes with θ = 0, counter-clockwise; shape (n_r, 4, 2).

    Cells are straight-sided quadrilaterals with edges half-way between the nodes; the innermost, at r = 0, degenerates to a
    triangle, a 1/(2 n_theta) share of the centre's polygon.  The nodes r = 2 have p = 0 and no cell.
    """
    middle = (mesh.r[1:] + mesh.r[:-1]) / 2
    inner, outer = np.concatenate([[0.0], middle[:-1]]), middle
    c, s = np.cos(mesh.d_theta / 2), np.sin(mesh.d_theta / 2)
    corner = [(inner * c, -inner * s), (outer * c, -outer * s), (outer * c, outer * s), (inner * c, inner * s)]
    return np.moveaxis(np.array(corner), -1, 0)


@dataclass(frozen=True)
class RingElasticity:
    """Displacement at every node from pressure at every node, Eq. (6b) by (18), with the rotational symmetry of the mesh.

    Turning target and cell together changes nothing, so only targets on θ = 0 are needed: n_r² n_theta coefficients instead
    of (n_r n_theta)², and along θ a circulant operator, which the cosine transform makes diagonal.
    """

    mesh: PaperMesh

    @cached_property
    def influence(self) -> Array:
        """−w at (r_i, 0) under unit pressure on the cell of (r_j, θ_k), shape (n_theta + 1, n_r + 1, n_r)."""
        mesh = self.mesh
        corners = cell_corners(mesh)
        # The target turns instead of the cell: the same by symmetry, and the corners stay small.
        x = mesh.r * np.cos(mesh.theta)[:, None]
        y = -mesh.r * np.sin(mesh.theta)[:, None]
        return polygon_influence(np.stack([x, y], axis=-1)[:, :, None, :], corners)

    @cached_property
    def _modes(self) -> Array:
        return dct(self.influence, type=1, axis=0)

    def displacement(self, pressure: Array) -> Array:
        """Displacement w on the nodes from p on the nodes, both of shape (n_r + 1, n_theta + 1).

        The last row of p, at r = 2, counts as zero.
        """
        modes = dct(pressure[:-1], type=1, axis=1).T[:, :, None]
        return -idct(np.matmul(self._modes, modes)[:, :, 0].T, type=1, axis=1)

    def dense(self) -> Array:
        """Pressure → displacement as a full matrix over the half domain; shape ((n_r+1)(n_theta+1), n_r (n_theta+1))."""
        m = self.mesh.n_theta
        i, k = np.arange(m + 1)[:, None], np.arange(m + 1)
        direct, image = np.abs(i - k), np.minimum(i + k, 2 * m - i - k)
        # The nodes on the axis are their own mirror images.
        matrix = self.influence[direct] + np.where((k == 0) | (k == m), 0.0, 1.0)[..., None, None] * self.influence[image]
        n = self.mesh.n_r
        return -matrix.transpose(2, 0, 3, 1).reshape((n + 1) * (m + 1), n * (m + 1))
