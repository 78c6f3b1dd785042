"""LU factors of a band matrix, by LAPACK, in single precision: what a preconditioner needs at half the cost."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

Array = NDArray[np.floating]
Places = NDArray[np.integer]

PRECISION: type = np.float32
"""Type of the factors.  Rows are brought to one size before, and columns should be."""


@dataclass(frozen=True)
class BandLU:
    """LU factors of a square band matrix with partial pivoting (LAPACK's gbtrf).

    Attributes
    ----------
    lu : ndarray, shape (3 width + 1, n)
        Factors in LAPACK's band storage, of the matrix with its rows scaled.
    pivots : ndarray of int, shape (n,)
        Rows exchanged.
    width : int
        Largest distance of an entry from the diagonal.
    scale : ndarray, shape (n,)
        Factors of the rows.
    """

    lu: Array
    pivots: Places
    width: int
    scale: Array

    def solve(self, right: Array) -> Array:
        """Solution for a right-hand side, shape (n,)."""
        solver = lapack.sgbtrs if self.lu.dtype == np.float32 else lapack.dgbtrs
        scaled = (right * self.scale).astype(self.lu.dtype)
        return solver(self.lu, self.width, self.width, scaled, self.pivots, overwrite_b=True)[0].astype(float)


class Band:
    """Places of the entries of a square band matrix, by rows.

    Parameters
    ----------
    row, column : ndarray of int, shape (entries,)
        Rows ascending from 0, each with an entry.

    Examples
    --------
    >>> band = Band(np.array([0, 0, 1, 1, 1, 2, 2]), np.array([0, 1, 0, 1, 2, 1, 2]))
    >>> band.factors(np.array([2.0, 1, 1, 3, 1, 1, 4])).solve(np.array([4.0, 10.0, 14.0])).round(6)
    array([1., 2., 3.])
    """

    def __init__(self, row: Places, column: Places) -> None:
        self.row, self.column, self.size = row, column, int(row[-1]) + 1
        self.width = width = int(np.max(np.abs(row - column)))
        # LAPACK's band, column after column; one index into it is much faster than two.
        self._height = 3 * width + 1
        self._place = column * self._height + (2 * width + row - column)
        self._first = np.searchsorted(row, np.arange(self.size))

    def factors(self, entries: Array) -> BandLU:
        """LU factors of the matrix of some entries."""
        scale = 1 / np.maximum.reduceat(np.abs(entries), self._first)
        band = np.zeros(self.size * self._height, PRECISION)
        band[self._place] = entries * scale[self.row]
        factorise = lapack.sgbtrf if band.dtype == np.float32 else lapack.dgbtrf
        lu, pivots, _ = factorise(band.reshape(self.size, self._height).T, self.width, self.width, overwrite_ab=True)
        return BandLU(lu, pivots, self.width, scale)
