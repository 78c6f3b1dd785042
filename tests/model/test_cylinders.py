"""The cylinder as a part."""

import pytest

import softlube
from softlube.errors import InputError
from softlube.model.cylinders import Cylinder


def test_a_steel_roller():
    roller = Cylinder("10 mm", young_modulus="210 GPa", poisson_ratio=0.3)
    assert roller.compliance == pytest.approx(4 * (1 - 0.09) / 210e9)
    assert Cylinder(0.01).compliance == 0
    assert roller.flat() == {"radius": 0.01, "cylinder_young_modulus": 210e9, "cylinder_poisson_ratio": 0.3}
    assert softlube.Cylinder is Cylinder


def test_a_ratio_without_a_modulus():
    with pytest.raises(InputError, match="cylinder_poisson_ratio, cylinder_young_modulus"):
        Cylinder("10 mm", poisson_ratio=0.3)
