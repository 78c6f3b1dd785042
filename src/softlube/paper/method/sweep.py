"""One Gauss-Seidel sweep over a rectangular array of nodes, by wavefronts.

The sweep (19) takes the new values at i − 1 and j − 1, so that all nodes with the same i + j can be updated at once.  That
keeps the order of the paper to round-off, node by node truncation included, at the speed of array operations.
"""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import as_strided
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Wavefront:
    """Forward substitution x[j, i] = g[j, i] − a[j, i] x[j, i − 1] − b[j, i] x[j − 1, i] on one shape of array.

    Holds the work space of one sweep, in which row k is the front i + j = k.

    Parameters
    ----------
    shape : tuple of int
        Rows j and columns i; fastest if the columns are fewer.
    """

    def __init__(self, shape: tuple[int, int]) -> None:
        rows, columns = shape
        fronts = rows + columns - 1
        coefficients = np.zeros((3, fronts, columns))
        # A first front and a first column of zeros stand for the nodes before the array.
        values = np.zeros((fronts + 1, columns + 1))
        self._work = np.empty(columns), np.empty(columns)
        self._fronts = [(*coefficients[:, k], values[k, :-1], values[k, 1:], values[k + 1, 1:]) for k in range(fronts)]
        # The same memory seen as [j, i]: a step in j moves one front on, a step in i one front and one column.
        c, front, column = coefficients.strides
        self._skewed = as_strided(coefficients, (3, rows, columns), (c, front, front + column))
        front, column = values.strides
        self._result = as_strided(values[1:, 1:], (rows, columns), (front, front + column))

    def solve(self, g: Array, a: Array, b: Array, *, floor: float) -> Array:
        """The substitution; a value below the floor is set to it before its neighbours see it.

        Parameters
        ----------
        g, a, b : ndarray, shape `shape`
            a[:, 0] and b[0] meet zeros and do not matter.
        floor : float
            Zero or negative; −∞ for none.
        """
        self._skewed[0], self._skewed[1], self._skewed[2] = g, a, b
        first, second = self._work
        for g_k, a_k, b_k, left, below, new in self._fronts:
            np.multiply(a_k, left, out=first)
            np.multiply(b_k, below, out=second)
            np.add(first, second, out=first)
            np.subtract(g_k, first, out=new)
            np.maximum(new, floor, out=new)
        return self._result.copy()
