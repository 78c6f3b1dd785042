"""Motions."""

import pytest

from softlube.errors import InputError
from softlube.model.motions import Sliding


def test_sliding_has_a_speed():
    assert Sliding("6 mm/min").speed == pytest.approx(1e-4)
    with pytest.raises(InputError, match=r"speed: missing; expected a speed such as '0\.1 mm/s'"):
        Sliding()
