"""An approximate inverse of the coupled Jacobian, from neighbouring rings only.

The Jacobian J = L − D K of the Reynolds residual joins two differential operators, L = ∂R/∂p and −D = ∂R/∂u, by the elastic
one, δu = K δp, which is dense and decays like 1/r.  Its inverse S = K⁻¹ is much more local: a film's change at a point asks
for a pressure that decays like 1/r³.  So S is cut off beyond the next ring, and J S = L S + ∂R/∂u, the Jacobian with the film
as the unknown, becomes a band matrix whose factorisation costs next to nothing.  GMRES on the exact Jacobian, with this in
front, takes some ten iterations for an accuracy of 10⁻⁴, at every β.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from softlube.discretization.elasticity import ElasticOperator
from softlube.discretization.grid import PolarGrid
from softlube.discretization.reynolds import Sparse, scaled_rows
from softlube.solvers.band import BandLU

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
    n_angles = grid.shape[1]
    windows = [range(max(0, k - RINGS), min(grid.n_r, k + RINGS + 1)) for k in range(grid.n_r)]
    reach = 2 * RINGS
    starts = [max(0, k - reach) for k in range(grid.n_r)]
    coupling = [substrate.ring_coupling(k, slice(starts[k], min(grid.n_r, k + reach + 1))) for k in range(grid.n_r)]
    rows, columns, values = [], [], []
    row, column = np.indices((n_angles, n_angles)).reshape(2, -1)
    for k, window in enumerate(windows):
        blocks = [coupling[i][window.start - starts[i] : window.stop - starts[i]] for i in window]
        local = np.concatenate([each.swapaxes(0, 1).reshape(n_angles, -1) for each in blocks])
        own = np.zeros((local.shape[0], n_angles))
        place = (k - window.start) * n_angles
        own[place : place + n_angles] = np.eye(n_angles)
        inverse_rows = np.linalg.solve(local.T, own).T
        for j in window:
            rows.append(k * n_angles + row)
            columns.append(j * n_angles + column)
            values.append(inverse_rows[:, (j - window.start) * n_angles :][:, :n_angles].ravel())
    row, column, value = np.concatenate(rows), np.concatenate(columns), np.concatenate(values)
    size = np.empty(grid.n_unknown)
    size[row[row == column]] = np.sqrt(np.abs(value[row == column]))
    kept = np.abs(value) > SMALLEST * size[row] * size[column]
    return sparse.csr_array((value[kept], (row[kept], column[kept])), (grid.n_unknown, grid.n_unknown))


@dataclass(frozen=True)
class Border:
    """The row and column that load control adds: the height's effect on the balance, the load's weights, their corner."""

    column: Array
    row: Array
    corner: float


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
    by_pressure, by_film : sparse matrix, shape (n, n)
        ∂R/∂p at fixed film and ∂R/∂u.
    stiffness : sparse matrix, shape (n, n)
        See `local_stiffness`.
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
        by_pressure: Sparse,
        by_film: Sparse,
        stiffness: Sparse,
        free: NDArray[np.bool_],
        film: Array,
        border: Border | None = None,
    ) -> None:
        self._times, self._stiffness, self._free, self._film, self._border = times, stiffness, free, film, border
        balance = by_pressure @ stiffness
        # Both kinds of rows to the same size, so that pivoting compares like with like.
        self._hold = float(np.median(np.abs(balance.diagonal()))) / float(np.median(np.abs(stiffness.diagonal())))
        taken, held = free.astype(float), np.where(free, 0.0, self._hold)
        self._band = BandLU.of_sum(
            free.size, scaled_rows(balance, taken), scaled_rows(by_film, taken), scaled_rows(stiffness, held)
        )
        if border is not None:
            self._lift = self._band.solve(np.where(free, border.column, 0.0))
            self._pivot = border.corner - border.row @ (stiffness @ self._lift)

    def at(self, times: Callable[[Array], Array]) -> FilmEquation:
        """The same equation with another exact Jacobian, close to the first; everything approximate is kept."""
        other = copy(self)
        other._times = times
        return other

    def _inverse(self, residual: Array) -> Array:
        """Approximate solution in units of the film."""
        n = self._free.size
        change = self._band.solve(residual[:n])
        if self._border is None:
            return change / self._film
        height = (residual[n] - self._border.row @ (self._stiffness @ change)) / self._pivot
        return np.append((change - height * self._lift) / self._film, height / self._film[0])

    def _pressure(self, unknown: Array) -> Array:
        n = self._free.size
        pressure = self._stiffness @ (unknown[:n] * self._film)
        return pressure if self._border is None else np.append(pressure, unknown[n] * self._film[0])

    def right(self, residual: Array) -> Array:
        """Right-hand side from that of Newton's equation, zero where held."""
        return self._inverse(residual)

    def operator(self, unknown: Array) -> Array:
        """Left-hand side, nearly the identity."""
        n = self._free.size
        step = self._pressure(unknown)
        # Taken out before J is applied: mixed into the balance, they would drown it in round-off at large β.
        held = np.where(self._free, 0.0, step[:n])
        step[:n] -= held
        result = self._times(step)
        result[:n] = np.where(self._free, result[:n], self._hold * held)
        return self._inverse(result)

    def step(self, unknown: Array) -> Array:
        """The step in pressures (and height), zero where held."""
        step = self._pressure(unknown)
        step[: self._free.size][~self._free] = 0.0
        return step
