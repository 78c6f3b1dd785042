"""The start of sliding's own inputs: SI and normalised."""

import math

import pytest

from softlube.errors import InputError
from softlube.physical.sliding import read_sliding
from softlube.physical.squeeze import read_motion

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}
FALL = BALL | {"load": "100 mN", "initial_height": "100 um", "duration": "0.1 s"}


def test_speed_and_time_pressed():
    setup, _ = read_motion(FALL)
    sliding, normalised = read_sliding(setup, FALL | {"speed": "0.1 mm/s", "pressed": "3 ms"})
    assert sliding == {"speed": pytest.approx(1e-4), "pressed": pytest.approx(3e-3), "cavitation": "reynolds"}
    beta = 2 / 3 * setup.unit_height**2 / 2e-3 * math.pi * 1e6 / (2 * 1e-4)  # Eq. (30)
    assert normalised["beta"] == pytest.approx(beta, rel=1e-13)
    assert normalised["pressed"] * setup.units["time"][0] == pytest.approx(3e-3, rel=1e-13)


def test_refused():
    setup, _ = read_motion(FALL)
    for change, message in (
        ({}, "speed: missing"),
        ({"speed": "1 mm/s", "pressed": "-1 s"}, "pressed: expected a positive time"),
        ({"entrainment_speed": "1 mm/s"}, "entrainment_speed: a start of rolling is not solved; give the speed"),
        ({"speed": "1 mm/s", "cavitation": "jfo"}, "cavitation: expected 'reynolds' or 'none'"),
    ):
        with pytest.raises(InputError, match=message):
            read_sliding(setup, FALL | change)
    remembering = FALL | {"prony": "6 MPa @ 20 ms"}
    with pytest.raises(InputError, match="substrate: a start of sliding on one that remembers is not solved, as what"):
        read_sliding(read_motion(remembering)[0], remembering | {"speed": "1 mm/s"})
