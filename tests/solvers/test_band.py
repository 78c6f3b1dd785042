"""LU factors of band matrices."""

import numpy as np
import pytest
from scipy import sparse

from softlube.solvers.band import Band


def banded(rng, offsets, n=40):
    return sparse.csr_array(sparse.diags_array([rng.normal(size=n - abs(k)) for k in offsets], offsets=offsets))


@pytest.mark.parametrize(("precision", "tolerance"), [(np.float64, 1e-9), (np.float32, 2e-3)])
@pytest.mark.parametrize("offsets", [(-1, 0, 1), (-3, 0, 2), (0,), (-7, -1, 0, 1, 7)])
def test_a_band_matrix_is_solved(offsets, precision, tolerance, monkeypatch):
    """Against a dense solution; the diagonal is small, so that rows are exchanged."""
    monkeypatch.setattr("softlube.solvers.band.PRECISION", precision)
    rng = np.random.default_rng(1)
    matrix, right = banded(rng, offsets), rng.normal(size=40)
    expected = np.linalg.solve(matrix.toarray(), right)
    solution = Band(*matrix.nonzero()).factors(matrix.data).solve(right)
    assert solution == pytest.approx(expected, rel=tolerance, abs=tolerance * np.abs(expected).max())


def test_rows_of_very_different_size_lose_nothing():
    """Single precision has no number beyond 1e38, and rows of any size are one to another."""
    rng = np.random.default_rng(2)
    matrix, solution = banded(rng, (-2, -1, 0, 1, 2)), rng.normal(size=40)
    matrix.data += 9 * (np.subtract(*matrix.nonzero()) == 0)
    size = np.geomspace(1e-60, 1e60, 40)
    matrix.data *= size[matrix.nonzero()[0]]
    found = Band(*matrix.nonzero()).factors(matrix.data).solve(matrix @ solution)
    assert found == pytest.approx(solution, abs=1e-5)
