"""Frictions at any slide-to-roll ratio, from the Couette and Poiseuille parts that make them up."""

import math

import numpy as np
import pytest

import softlube
from softlube import friction
from softlube.physical.rolling import at_slide_to_roll

BODIES = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "load": "100 mN"}


def rolling(slide_to_roll):
    return softlube.Contact(**BODIES, entrainment_speed="0.05 mm/s", slide_to_roll=slide_to_roll)


def test_a_ball_that_does_not_turn_slides(physical, contact):
    motion = rolling(2.0)
    assert motion.problem() == contact.problem()
    assert motion.dimensional(physical.quantities) == contact.dimensional(physical.quantities)


@pytest.mark.parametrize("slide_to_roll", [-2.0, 0.0, 0.3, 1.0])
def test_the_parts_make_up_the_frictions(physical, slide_to_roll):
    """From the parts that are read off the fields by another way, over the same disc."""
    motion = rolling(slide_to_roll)
    assert motion.problem() == physical.problem
    ours, parts = motion.dimensional(physical.quantities), friction.split(physical, 2.0)
    unit = physical.contact.scales(physical.contact.unit_height)["friction"][0]
    couette, poiseuille = parts.couette * unit * slide_to_roll / 2, parts.poiseuille * unit
    assert ours["friction_total"] == pytest.approx(couette - poiseuille, rel=1e-9)
    assert ours["friction_domain"] == pytest.approx(couette + poiseuille, rel=1e-9)
    assert ours["friction_coefficient"] == pytest.approx(ours["friction_total"] / 0.1, rel=1e-9)
    assert math.isnan(ours["friction_contact"])
    assert math.isnan(ours["shear_rate_max"])
    for name in ("film_min", "pressure_max", "indentation"):
        assert ours[name] == physical.dimensional[name]


def test_pure_rolling_has_no_couette_friction(physical):
    """What is left is the Poiseuille part, opposite on the two surfaces, and both oppose the rolling."""
    ours = rolling(0).dimensional(physical.quantities)
    assert ours["friction_total"] == pytest.approx(-ours["friction_domain"], rel=1e-12)
    assert 0 < ours["friction_total"] < 0.1 * physical.dimensional["friction_total"]


def test_errors_add_up(physical):
    given = physical.dimensional
    ours = at_slide_to_roll(given, 0.0)
    assert ours["friction_total"].error == pytest.approx((given["friction_total"].error + given["friction_domain"].error) / 2)
    assert ours["friction_total"].unit == "N"
    assert np.isfinite(ours["film_min"].error)


def test_a_rolling_contact_is_solved_and_saved(tmp_path):
    solution = rolling(0).solve(accuracy=1e-2)
    solution.save(tmp_path / "rolling.nc")
    again = softlube.load(tmp_path / "rolling.nc")
    assert again.contact == rolling(0)
    assert again.dimensional["friction_total"] == solution.dimensional["friction_total"]
    assert solution.to_dict()["dimensional"]["friction_contact"]["value"] is None
