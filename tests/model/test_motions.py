"""Motions."""

import pytest

from softlube.errors import InputError
from softlube.model.motions import Rolling, Sliding
from softlube.model.parts import resolve


def motion(**given):
    return resolve(["motion"], given)["motion"]


def test_sliding_has_a_speed():
    assert Sliding("6 mm/min").speed == pytest.approx(1e-4)
    with pytest.raises(InputError, match=r"speed: missing; expected a speed such as '0\.1 mm/s'"):
        Sliding()


def test_rolling_is_known_by_its_entrainment_speed():
    assert motion(speed="0.1 mm/s") == Sliding("0.1 mm/s")
    assert motion(entrainment_speed="0.05 mm/s") == Rolling(5e-5, slide_to_roll=2.0)
    assert motion(entrainment_speed=5e-5, slide_to_roll="-0.4") == Rolling(5e-5, slide_to_roll=-0.4)


def test_reynolds_equation_sees_the_sum_of_the_surface_speeds():
    assert Rolling(5e-5).speed_sum == Sliding(1e-4).speed_sum == 1e-4
    assert Rolling(5e-5).slide_to_roll == Sliding(1e-4).slide_to_roll == 2


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({}, r"speed: missing; expected a speed such as '0\.1 mm/s'"),
        ({"slide_to_roll": 0.5}, "slide_to_roll, entrainment_speed: the first means nothing without the second"),
        ({"speed": 1e-4, "entrainment_speed": 5e-5}, "speed, entrainment_speed: no motion has both"),
        ({"speed": 1e-4, "slide_to_roll": 0.5}, "speed, slide_to_roll: no motion has both"),
        ({"entrainment_speed": 5e-5, "slide_to_roll": "much"}, "slide_to_roll: "),
    ],
)
def test_motions_that_are_none(given, message):
    with pytest.raises(InputError, match=message):
        motion(**given)
