"""LU factors of a band matrix, by LAPACK."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.linalg import lapack

Array = NDArray[np.floating]


@dataclass(frozen=True)
class BandLU:
    """LU factors of a square band matrix with partial pivoting (LAPACK's gbtrf).

    Attributes
    ----------
    lu : ndarray, shape (3 width + 1, n)
        Factors in LAPACK's band storage.
    pivots : ndarray of int, shape (n,)
        Rows exchanged.
    width : int
        Largest distance of an entry from the diagonal.

    Examples
    --------
    >>> matrix = sparse.csr_array([[2.0, 1.0, 0.0], [1.0, 3.0, 1.0], [0.0, 1.0, 4.0]])
    >>> BandLU.of_sum(3, matrix).solve(matrix @ np.array([1.0, 2.0, 3.0]))
    array([1., 2., 3.])
    """

    lu: Array
    pivots: NDArray[np.intp]
    width: int

    @classmethod
    def of_sum(cls, size: int, *matrices: sparse.csr_array) -> BandLU:
        """Factorise the sum of sparse matrices of shape (size, size)."""
        entries = [matrix.tocoo() for matrix in matrices]
        width = max(int(np.max(np.abs(np.subtract(*entry.coords)), initial=0)) for entry in entries)
        # LAPACK's band, column after column; one index into it is much faster than two.
        height = 3 * width + 1
        band = np.zeros(size * height)
        for entry in entries:
            row, column = entry.coords
            band[column * height + (2 * width + row - column)] += entry.data
        lu, pivots, _ = lapack.dgbtrf(band.reshape(size, height).T, width, width, overwrite_ab=True)
        return cls(lu, pivots, width)

    def solve(self, right: Array) -> Array:
        """Solution for a right-hand side, shape (n,)."""
        return lapack.dgbtrs(self.lu, self.width, self.width, right, self.pivots)[0]
