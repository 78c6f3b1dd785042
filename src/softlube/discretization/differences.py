"""Differences and values on the faces between the cells of a polar grid, and the balance of the cells, as sparse matrices.

In the uniform coordinates (ξ, s) every formula is one for a uniform mesh.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from softlube.discretization.grid import PolarGrid

Array = NDArray[np.floating]
Sparse = sparse.csr_array


@dataclass(frozen=True)
class Formulas:
    """Staggered formulas for a uniform mesh: weights of the nodes by their offsets from a face, which lies before node 0.

    Attributes
    ----------
    midpoint, slope : mapping of int to float
        Value and derivative on the face.
    upstream : mapping of int to float
        Added to `midpoint`, it gives a value from upstream, where the index is higher.
    """

    midpoint: dict[int, float]
    slope: dict[int, float]
    upstream: dict[int, float]


FOURTH = Formulas(
    midpoint={-2: -1 / 16, -1: 9 / 16, 0: 9 / 16, 1: -1 / 16},
    slope={-2: 1 / 24, -1: -27 / 24, 0: 27 / 24, 1: -1 / 24},
    # The value of the quadratic through two nodes upstream and one downstream: third order, as in QUICK (Leonard 1979).
    upstream={-2: 1 / 16, -1: -3 / 16, 0: 3 / 16, 1: -1 / 16},
)
"""Formulas of the equation that is solved, along r."""
SIXTH = Formulas(
    midpoint={-3: 3 / 256, -2: -25 / 256, -1: 150 / 256, 0: 150 / 256, 1: -25 / 256, 2: 3 / 256},
    slope={-3: -3 / 640, -2: 25 / 384, -1: -75 / 64, 0: 75 / 64, 1: -25 / 384, 2: 3 / 640},
    upstream={-3: 0.0, -2: 1 / 16, -1: -3 / 16, 0: 3 / 16, 1: -1 / 16, 2: 0.0},
)
"""Formulas of the equation along θ."""
CENTRAL = {-2: 1 / 12, -1: -2 / 3, 1: 2 / 3, 2: -1 / 12}
"""Derivative of fourth order on a node, by the offsets of its neighbours."""
SECOND = Formulas(midpoint={-1: 0.5, 0: 0.5}, slope={-1: -1.0, 0: 1.0}, upstream={-1: -0.5, 0: 0.5})
"""Formulas of second order from the nearest nodes only, for preconditioning, and at the rim."""


@dataclass(frozen=True)
class Differences:
    """Differences of one order on one grid, as sparse matrices; faces are the radial ones, then the angular ones.

    Attributes
    ----------
    slope, midpoint, upstream : sparse matrix, shape (faces, n)
        Difference and value on the faces, and what makes of the value the upwind-biased one; of one pattern.
    divergence : sparse matrix, shape (n_unknown, faces)
        From the fluxes to the balance of each cell.
    """

    slope: Sparse
    midpoint: Sparse
    upstream: Sparse
    divergence: Sparse

    @classmethod
    def on(cls, grid: PolarGrid, formulas: Formulas, angular: Formulas) -> Differences:
        """The differences on a grid by some formulas along r and along θ."""
        n_r, (n_nodes, n_angles), n_gaps = grid.n_r, grid.shape, grid.n_theta
        n_radial = (n_r + 2) * n_angles
        shape = n_radial + n_r * n_gaps, n_nodes * n_angles
        offsets, turns = np.array(list(formulas.slope)), np.array(list(angular.slope))
        # From the nodes to the radial faces but the outermost, through the centre to the opposite side, …
        i, k, o = (each.ravel() for each in np.indices((n_r + 1, n_angles, offsets.size)))
        ring = i + offsets[o]
        across = ring < 0
        places = [(i * n_angles + k, np.where(across, -1 - ring, ring) * n_angles + np.where(across, n_angles - 1 - k, k))]
        # … to that one, which has one node beyond it, not two, and where p is the far field's, …
        last = (n_r + 1) * n_angles + np.tile(np.arange(n_angles), 2)
        places.append((last, last - np.repeat([n_angles, 0], n_angles)))
        # … and to the angular faces, reflected at θ = 0 and π.
        gap_i, gap_k, gap_o = (each.ravel() for each in np.indices((n_r, n_gaps, turns.size)))
        angle = np.abs(gap_k + 1 + turns[gap_o])
        angle = np.where(angle > n_gaps, 2 * n_gaps - angle, angle)
        places.append((n_radial + gap_i * n_gaps + gap_k, gap_i * n_angles + angle))
        rows, columns = (np.concatenate(each) for each in zip(*places, strict=True))

        def matrix(name: str, radial: Array | float, outermost: Array | float, turned: float) -> Sparse:
            weights = np.array([getattr(formulas, name)[each] for each in offsets])
            around = np.array([getattr(angular, name)[each] for each in turns])
            end = np.repeat([getattr(SECOND, name)[-1], getattr(SECOND, name)[0]], n_angles)
            return Sparse(
                (np.concatenate([weights[o] * radial, end * outermost, around[gap_o] * turned]), (rows, columns)), shape
            )

        # The liquid comes from +x: upstream is at higher r in the inlet half, and at lower θ.
        inlet = np.sign(np.cos(grid.theta))[k]
        return cls(
            slope=matrix("slope", 1 / grid.d_xi, 1 / grid.d_xi, 1 / grid.d_s),
            midpoint=matrix("midpoint", 1.0, 1.0, 1.0),
            upstream=matrix("upstream", inlet, 0.0, -1.0),
            divergence=_divergence(grid, formulas.slope, angular.slope),
        )

    @cached_property
    def face(self) -> NDArray[np.integer]:
        """The face of each entry of the pattern."""
        return np.repeat(np.arange(self.slope.shape[0]), np.diff(self.slope.indptr))

    @property
    def node(self) -> NDArray[np.integer]:
        """The node of each entry of the pattern."""
        return self.slope.indices

    @cached_property
    def span(self) -> Sparse:
        """The divergence with every weight positive."""
        return abs(self.divergence)

    @cached_property
    def diagonal(self) -> Sparse:
        """From a matrix of the pattern to the diagonal of the divergence times it, shape (n_unknown, entries)."""
        number = self.with_entries(np.arange(1.0, self.slope.nnz + 1))
        cell, face = self.divergence.nonzero()
        entry = np.asarray(number[face, cell]).astype(int) - 1
        own = entry >= 0
        shape = self.divergence.shape[0], self.slope.nnz
        return Sparse((self.divergence.data[own], (cell[own], entry[own])), shape)

    def with_entries(self, entries: Array) -> Sparse:
        """The matrix of some entries in the pattern."""
        return Sparse((entries, self.slope.indices, self.slope.indptr), self.slope.shape)


def sloping(values: Array, formulas: Formulas) -> Array:
    """Differences of equidistant values, half-way between them."""
    n, first = values.size + 1 - len(formulas.slope), -min(formulas.slope)
    return np.sum([weight * values[first + offset :][:n] for offset, weight in formulas.slope.items()], axis=0)


def _divergence(grid: PolarGrid, slope: dict[int, float], turning: dict[int, float]) -> Sparse:
    """From the fluxes on the faces to the balance of each cell."""
    n_r, n_angles, n_gaps = grid.n_r, grid.shape[1], grid.n_theta
    n_radial = (n_r + 2) * n_angles
    offsets, weights = np.array(list(slope)), np.array(list(slope.values()))
    i, k, o = (each.ravel() for each in np.indices((n_r, n_angles, offsets.size)))
    circle = i + 1 + offsets[o]
    radial = np.abs(circle) * n_angles + np.where(circle < 0, n_angles - 1 - k, k)
    # Summed over a ring the fourth order leaves 1/12 of the flux through its first circle at the centre, where no liquid can
    # stay.  Without that mean the fluxes telescope exactly.
    ring = np.full(n_angles, 1 / n_gaps)
    ring[[0, -1]] /= 2
    lost = np.sum(weights[o][np.abs(circle) == 1]) / n_angles * ring
    centre, first = (each.ravel() for each in np.indices((n_angles, n_angles)))
    # Fluxes across θ = 0 and π change their sign with the side.
    cell, through = i * n_angles + k, weights[o] / grid.d_xi
    offsets, around = np.array(list(turning)), np.array(list(turning.values()))
    i, k, o = (each.ravel() for each in np.indices((n_r, n_angles, offsets.size)))
    gap = k + offsets[o]
    outside = (gap < 0) | (gap >= n_gaps)
    gap = np.where(gap < 0, -1 - gap, np.where(gap >= n_gaps, 2 * n_gaps - 1 - gap, gap))
    angular = np.where(outside, -around[o], around[o]) / grid.d_s
    entries = np.concatenate([through, -lost[first] / grid.d_xi, angular])
    rows = np.concatenate([cell, centre, i * n_angles + k])
    columns = np.concatenate([radial, n_angles + first, n_radial + i * n_gaps + gap])
    divergence = Sparse((entries, (rows, columns)), (grid.n_unknown, n_radial + n_r * n_gaps))
    divergence.eliminate_zeros()
    return divergence


@dataclass(frozen=True)
class Faces:
    """Faces as a law of the flux sees them, which has the physical gradient.

    Attributes
    ----------
    normal, tangent : ndarray, shape (2, faces)
        Cartesian unit vectors across and along the faces.
    across : ndarray, shape (faces,)
        ∂p across a face over its difference in ξ or s.
    along : sparse matrix, shape (faces, n)
        Derivative along the faces.
    """

    normal: Array
    tangent: Array
    across: Array
    along: Sparse

    @classmethod
    def on(cls, grid: PolarGrid) -> Faces:
        """The faces of a grid."""
        n_r, (n_nodes, n_angles), n_gaps = grid.n_r, grid.shape, grid.n_theta
        n_faces = n_r + 2
        r, r_face, theta_face = grid.r[:n_r], grid.r_face[:n_faces], grid.theta_of(grid.s_face)
        radial = np.tile(np.stack([np.cos(grid.theta), np.sin(grid.theta)]), n_faces)
        outwards = np.tile(np.stack([np.cos(theta_face), np.sin(theta_face)]), n_r)
        normal = np.concatenate([radial, np.stack([-outwards[1], outwards[0]])], axis=1)
        across = np.concatenate(
            [
                np.repeat(1 / grid.dr_dxi(r_face), n_angles),
                np.outer(1 / r, 1 / grid.dtheta_ds(grid.s_face)).ravel(),
            ]
        )
        # At the centre a face has no length: its flux is zero whatever the gradient.
        with np.errstate(divide="ignore"):
            turned = np.where(r_face > 0, 1 / r_face, 0.0)
        metric = np.concatenate(
            [np.outer(turned, 1 / grid.dtheta_ds(grid.s)).ravel() / grid.d_s, np.repeat(1 / grid.dr_dxi(r), n_gaps) / grid.d_xi]
        )
        rows, columns, entries = [], [], []
        ends = {-1: 0.5, 0: 0.5}  # the outermost radial face has one node beyond it
        for step, weight in CENTRAL.items():
            for offset, share in FOURTH.midpoint.items():
                i, k = (each.ravel() for each in np.indices((n_faces, n_angles)))
                last = i == n_faces - 1
                rows.append(i * n_angles + k)
                columns.append(_node(np.minimum(i + offset, n_nodes - 1), k + step, n_angles))
                entries.append(weight * np.where(last, ends.get(offset, 0.0), share))
                i, k = (each.ravel() for each in np.indices((n_r, n_gaps)))
                rows.append(n_faces * n_angles + i * n_gaps + k)
                columns.append(_node(i + step, k + 1 + offset, n_angles))
                entries.append(np.full(i.size, weight * share))
        row, column = np.concatenate(rows), np.concatenate(columns)
        along = Sparse((np.concatenate(entries) * metric[row], (row, column)), (metric.size, n_nodes * n_angles))
        # Tangents are e_θ on the radial faces, e_r on the angular ones.
        sign = np.repeat([1, -1], [n_faces * n_angles, n_r * n_gaps])
        return cls(normal, sign * np.stack([-normal[1], normal[0]]), across, along)


def _node(ring: NDArray[np.integer], angle: NDArray[np.integer], n_angles: int) -> NDArray[np.integer]:
    """Number of a node, through the centre to the opposite side, and reflected at θ = 0 and π."""
    last = n_angles - 1
    angle = np.where(ring < 0, last - angle, angle)
    angle = np.abs(angle)
    angle = np.where(angle > last, 2 * last - angle, angle)
    return np.where(ring < 0, -1 - ring, ring) * n_angles + angle
