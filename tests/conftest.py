"""Shared by all tests: NumPy raises where it would return nonsense, and one solution for many readers."""

from __future__ import annotations

import numpy as np
import pytest

import softlube


@pytest.fixture(autouse=True)
def _numpy_raises():
    with np.errstate(invalid="raise", divide="raise", over="raise"):
        yield


@pytest.fixture(scope="session")
def solution() -> softlube.Solution:
    """β = 1000 at the default accuracy."""
    return softlube.solve(beta=1000)


@pytest.fixture(scope="session")
def contact() -> softlube.Contact:
    """The README's ball on rubber."""
    return softlube.Contact(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", speed="0.1 mm/s", load="100 mN")


@pytest.fixture(scope="session")
def physical(contact) -> softlube.Solution:
    """The README's example, solved."""
    return contact.solve()
