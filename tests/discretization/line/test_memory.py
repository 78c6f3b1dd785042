"""The convolution with a memory: exponentials, lengths from nothing to without end."""

import numpy as np
import pytest

from softlube.discretization.line.memory import remembered
from softlube.discretization.line.panels import Panels

PANELS = Panels(np.array([0.0, 1e-3, 0.2, 1.0, 3.0, 10.0, 40.0]), 10)
PLACES = np.append(PANELS.nodes, 0.0)


@pytest.mark.parametrize("length", [1e-6, 1e-2, 1.0, 30.0, 1e6])
def test_an_exponential(length):
    """wₑ = e^(−x) gives wᵢ = e^(−x)/(1 + L)."""
    matrix, left = remembered(PANELS, length)
    exact = np.exp(-PLACES) / (1 + length)
    found = matrix @ np.exp(-PANELS.nodes) + left * np.exp(-40.0) / (1 + length)
    assert found == pytest.approx(exact, abs=3e-6 / (1 + length))  # the polynomials on the longest panels
    near = PLACES < 3
    assert found[near] == pytest.approx(exact[near], abs=1e-7 / (1 + length))


@pytest.mark.parametrize("length", [1e-3, 1.0, 1e3])
def test_a_polynomial_exactly(length):
    """wₑ = x² gives wᵢ = x² + 2Lx + 2L²."""
    matrix, left = remembered(PANELS, length)
    found = matrix @ PANELS.nodes**2 + left * (40.0**2 + 2 * length * 40 + 2 * length**2)
    assert found == pytest.approx(PLACES**2 + 2 * length * PLACES + 2 * length**2, rel=1e-12, abs=1e-12)


def test_times_that_differ_much_are_as_good_together():
    short, long = remembered(PANELS, 1e-12)[0], remembered(PANELS, 1e12)
    assert short[:-1] == pytest.approx(np.eye(PANELS.size), abs=1e-6)
    assert long[1] == pytest.approx(np.ones(PLACES.size), abs=1e-10)
    assert np.abs(long[0]).max() < 1e-10
