"""Indenters."""

import pytest

from softlube.errors import InputError
from softlube.model.indenters import Sphere
from softlube.model.parts import resolve


def test_a_sphere_is_its_radius():
    assert Sphere("2 mm").radius == pytest.approx(2e-3)
    assert Sphere("2 mm") == Sphere(radius=2e-3)
    assert Sphere("2 mm").compliance == 0


def test_an_elastic_ball_has_names_of_its_own_among_the_inputs_of_an_experiment():
    glass = Sphere("2 mm", young_modulus="64 GPa", poisson_ratio=0.2)
    flat = {"radius": "2 mm", "ball_young_modulus": "64 GPa", "ball_poisson_ratio": 0.2, "young_modulus": "3 MPa"}
    assert resolve(["indenter"], flat)["indenter"] == glass
    assert glass.flat() == {"radius": 2e-3, "ball_young_modulus": 64e9, "ball_poisson_ratio": 0.2}
    # with G = E/(2(1 + ν)), the inverse of G/(2(1 − ν))
    assert 1 / glass.compliance == pytest.approx(64e9 / (2 * 1.2) / (2 * 0.8))


def test_a_ratio_means_nothing_without_a_modulus():
    with pytest.raises(InputError, match="ball_poisson_ratio, ball_young_modulus: the first means nothing without the second"):
        Sphere("2 mm", poisson_ratio=0.3)
    with pytest.raises(InputError, match=r"ball_young_modulus: .*expected a pressure such as '210 GPa'"):
        Sphere("2 mm", young_modulus="64 mm")
