"""Indenters."""

import pytest

from softlube.model.indenters import Sphere


def test_a_sphere_is_its_radius():
    assert Sphere("2 mm").radius == pytest.approx(2e-3)
    assert Sphere("2 mm") == Sphere(radius=2e-3)
