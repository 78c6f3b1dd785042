"""LU factors of band matrices."""

import numpy as np
import pytest
from scipy import sparse

from softlube.solvers.band import BandLU


@pytest.mark.parametrize("offsets", [(-1, 0, 1), (-3, 0, 2), (0,), (-7, -1, 0, 1, 7)])
def test_a_sum_of_sparse_matrices_is_solved(offsets):
    """Against a dense solution; the diagonal is small, so that rows are exchanged."""
    rng = np.random.default_rng(1)
    n = 40
    parts = [
        sparse.csr_array(sparse.diags_array([rng.normal(size=n) for _ in offsets], offsets=offsets, shape=(n, n))) for _ in "ab"
    ]
    right = rng.normal(size=n)
    expected = np.linalg.solve(sum(part.toarray() for part in parts), right)
    assert BandLU.of_sum(n, *parts).solve(right) == pytest.approx(expected, rel=1e-9)
