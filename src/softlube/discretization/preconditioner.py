"""An approximate inverse of the coupled Jacobian, from neighbouring rings only.

The Jacobian J = L − D K of the Reynolds residual joins two differential operators, L = ∂R/∂p and −D = ∂R/∂u, by the elastic
one, δu = K δp, which is dense and decays like 1/r.  Its inverse S = K⁻¹ is much more local: a film's change at a point asks
for a pressure that decays like 1/r³.  So S is cut off beyond the next ring, and J S = L S + ∂R/∂u, the Jacobian with the film
as the unknown, becomes a band matrix whose factorisation costs next to nothing, all the less with differences of second order
and in single precision.  GMRES on the exact Jacobian, with this in front, takes some ten iterations for an accuracy of 10⁻⁴,
at every β.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from softlube.discretization.differences import Differences, Sparse
from softlube.discretization.elasticity import ElasticOperator
from softlube.discretization.grid import PolarGrid
from softlube.solvers.band import Band

Array = NDArray[np.floating]

RINGS = 1
"""Rings on each side that the local stiffness sees."""
SMALLEST = 0.01
"""Entries of the stiffness below this, relative to their diagonals, are left out: nine in ten, and GMRES does not notice."""


def local_stiffness(grid: PolarGrid, substrate: ElasticOperator) -> Sparse:
    """Pressure from film, δp ≈ S δu, each ring's from itself and its neighbours.

    Row block k of S is row block k of the inverse of K restricted to the rings k − 1 … k + 1.

    Returns
    -------
    sparse matrix, shape (n_unknown, n_unknown)
    """
    n_r, n_angles = grid.n_r, grid.shape[1]
    reach = 2 * RINGS
    starts = [max(0, k - reach) for k in range(n_r)]
    coupling = [substrate.ring_coupling(k, slice(starts[k], min(n_r, k + reach + 1))) for k in range(n_r)]
    blocks = np.zeros((n_r, 2 * RINGS + 1, n_angles, n_angles))  # of every ring, from itself and its neighbours
    for k in range(n_r):
        window = range(max(0, k - RINGS), min(n_r, k + RINGS + 1))
        parts = [coupling[i][window.start - starts[i] : window.stop - starts[i]] for i in window]
        local = np.concatenate([each.swapaxes(0, 1).reshape(n_angles, -1) for each in parts])
        own = np.zeros((local.shape[0], n_angles))
        place = (k - window.start) * n_angles
        own[place : place + n_angles] = np.eye(n_angles)
        rows = np.linalg.solve(local.T, own).T.reshape(n_angles, -1, n_angles)
        blocks[k, window.start - k + RINGS : window.stop - k + RINGS] = rows.swapaxes(0, 1)
    size = np.sqrt(np.abs(np.diagonal(blocks[:, RINGS], axis1=1, axis2=2)))
    around = np.pad(size, ((RINGS, RINGS), (0, 0)))
    other = np.stack([around[shift : shift + n_r] for shift in range(2 * RINGS + 1)], axis=1)
    kept = np.nonzero(np.abs(blocks) > SMALLEST * size[:, None, :, None] * other[:, :, None, :])
    ring, shift, row, column = kept
    places = ring * n_angles + row, (ring + shift - RINGS) * n_angles + column
    return Sparse((blocks[kept], places), (grid.n_unknown, grid.n_unknown))


@dataclass(frozen=True)
class Border:
    """The row and column that load control adds.

    Attributes
    ----------
    column, row, corner : ndarray, ndarray, float
        The height's effect on the balance, the load's weights, and the height's own effect on the load.
    unit : float
        Change of the height that weighs as much as a change of the film by itself.
    """

    column: Array
    row: Array
    corner: float
    unit: float


class FilmBalance:
    """The balance of the cells by the film alone, −div (P S + Q), with entries of P and Q that change in one pattern.

    Each entry of the sum is linear in those of P and Q, the derivatives of the fluxes by pressure and film: all are found by
    one product with a sparse matrix that is formed once.

    Parameters
    ----------
    differences : Differences
        Those of a low order make a narrow band.
    stiffness : sparse matrix, shape (n, n)
        S, see `local_stiffness`.
    """

    def __init__(self, differences: Differences, stiffness: Sparse) -> None:
        self.stiffness, n, self._node = stiffness, stiffness.shape[0], differences.node
        flux = np.flatnonzero(differences.node < n)
        spread = sparse.csc_array(-differences.divergence)
        every, place = _ragged(spread.indptr, differences.face[flux])  # each flux goes to some cells …
        flux, cell, weight = flux[every], spread.indices[place], spread.data[place]
        node = differences.node[flux]
        every, place = _ragged(stiffness.indptr, node)  # … and a pressure comes from the film at some nodes
        own, _ = _ragged(stiffness.indptr, np.arange(n))
        rows = np.concatenate([cell[every], cell, own])
        columns = np.concatenate([stiffness.indices[place], node, stiffness.indices])
        entry, row, column = _numbered(rows, columns, n)
        self.band = Band(row, column)
        self.diagonal = np.flatnonzero(row == column)
        n_by_pressure, n_fluxes = every.size, differences.node.size
        self._sum = Sparse(
            (
                np.concatenate([weight[every] * stiffness.data[place], weight]),
                (entry[: -own.size], np.concatenate([flux[every], n_fluxes + flux])),
            ),
            (row.size, 2 * n_fluxes),
        )
        self.held = np.zeros(row.size)
        self.held[entry[n_by_pressure + cell.size :]] = stiffness.data

    def stiffened(self, factor: Array) -> FilmBalance:
        """That of a substrate so many times as stiff at each node."""
        other = copy(self)
        other.stiffness, other.held = Sparse(sparse.diags_array(factor) @ self.stiffness), factor[self.band.row] * self.held
        of_pressures = np.append(factor, 1.0)[np.minimum(self._node, factor.size)]
        other._sum = Sparse(self._sum @ sparse.diags_array(np.append(of_pressures, np.ones(self._node.size))))
        return other

    def entries(self, by_pressure: Array, by_film: Array) -> Array:
        """Entries of the sum on `band`, from those of P and Q."""
        return self._sum @ np.concatenate([by_pressure, by_film])


def _ragged(pointers: NDArray[np.integer], rows: NDArray[np.integer]) -> tuple[NDArray[np.integer], NDArray[np.integer]]:
    """For some rows of a sparse matrix, one after the other: which of them each of their entries belongs to, and its place."""
    counts = np.diff(pointers)[rows]
    which = np.repeat(np.arange(rows.size), counts)
    return which, np.arange(which.size) + np.repeat(pointers[rows] - np.cumsum(counts) + counts, counts)


def _numbered(
    rows: NDArray[np.integer], columns: NDArray[np.integer], n: int
) -> tuple[NDArray[np.integer], NDArray[np.integer], NDArray[np.integer]]:
    """Numbers of entries of a band matrix, by rows, the rows and the columns of those that differ."""
    width = int(np.max(np.abs(rows - columns)))
    place = rows * (2 * width + 1) + (width + columns - rows)
    present = np.zeros(n * (2 * width + 1), dtype=bool)
    present[place] = True
    number = np.cumsum(present) - 1
    row, offset = np.divmod(np.flatnonzero(present), 2 * width + 1)
    return number[place], row, row + offset - width


class FilmEquation:
    """Newton's equation with the relative change of the film, δu/u, as the unknown.

    A `softlube.solvers.newton.LinearEquation`.

    Pressures follow by δp = S δu.  On held nodes the equation is (S δu)ᵢ = 0.  The approximate inverse is applied from the
    left, so residuals too are relative changes of the film, which is what the solution is wanted to: at large β a pressure
    that is right to 10⁻⁴ says nothing about a film of 10⁻⁵.

    Parameters
    ----------
    times : callable
        The exact Jacobian times a vector.
    balance : FilmBalance
        Pattern of the approximate Jacobian with the film as the unknown.
    entries : ndarray
        Its entries.
    free : ndarray of bool, shape (n,)
        Nodes whose pressure is unknown; the others are held.
    film : ndarray, shape (n,)
        u.
    border : Border, optional
        Under load control; vectors then have the height as last element.
    """

    def __init__(
        self,
        times: Callable[[Array], Array],
        balance: FilmBalance,
        entries: Array,
        free: NDArray[np.bool_],
        film: Array,
        border: Border | None = None,
    ) -> None:
        self._times, self._stiffness, self._free, self._film, self._border = times, balance.stiffness, free, film, border
        # Both kinds of rows to the same size, so that pivoting compares like with like.
        diagonal = balance.diagonal
        self._hold = float(np.median(np.abs(entries[diagonal])) / np.median(np.abs(balance.held[diagonal])))
        band = balance.band
        self._band = band.factors(np.where(free[band.row], entries, self._hold * balance.held) * film[band.column])
        if border is not None:
            self._weights = np.where(free, border.row, 0.0)
            self._lift = self._band.solve(np.where(free, border.column, 0.0))
            self._pivot = border.corner - self._weights @ (self._stiffness @ (self._lift * film))

    def at(self, times: Callable[[Array], Array]) -> FilmEquation:
        """The same equation with another exact Jacobian, close to the first; everything approximate is kept."""
        other = copy(self)
        other._times = times
        return other

    def right(self, residual: Array) -> Array:
        """Right-hand side from that of Newton's equation, zero where held: an approximate solution in units of the film."""
        n = self._free.size
        change = self._band.solve(residual[:n])
        if self._border is None:
            return change
        height = (residual[n] - self._weights @ (self._stiffness @ (change * self._film))) / self._pivot
        return np.append(change - height * self._lift, height / self._border.unit)

    def _pressure(self, unknown: Array) -> Array:
        n = self._free.size
        pressure = self._stiffness @ (unknown[:n] * self._film)
        return pressure if self._border is None else np.append(pressure, unknown[n] * self._border.unit)

    def operator(self, unknown: Array) -> Array:
        """Left-hand side, nearly the identity."""
        n = self._free.size
        step = self._pressure(unknown)
        # Taken out before J is applied: mixed into the balance, they would drown it in round-off at large β.
        held = np.where(self._free, 0.0, step[:n])
        step[:n] -= held
        result = self._times(step)
        result[:n] = np.where(self._free, result[:n], self._hold * held)
        return self.right(result)

    def step(self, unknown: Array) -> Array:
        """The step in pressures (and height), zero where held."""
        step = self._pressure(unknown)
        step[: self._free.size][~self._free] = 0.0
        return step
