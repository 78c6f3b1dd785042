"""Friction of many contacts as a function of the parameters: solved contacts, powers, first guesses."""

import math
from dataclasses import replace

import numpy as np
import pytest

import softlube
from softlube import fit
from softlube.experiments.friction_model import make_model

KNOWN = {"radius": "2 mm", "young_modulus": "3 MPa"}


VISCOSITY = 2.0


def test_the_model_is_the_friction_of_a_solved_contact(clean):
    """The link between a fit and a solution, for a row whose β is no node of the curve."""
    row = 30
    solution = softlube.Contact(**KNOWN, viscosity=VISCOSITY, speed=clean.speed[row], load=clean.load[row]).solve()
    radius = math.sqrt(2e-3 * solution.contact.unit_height)
    within = solution.friction_within(2 * radius / solution.dimensional["contact_radius"])
    friction = within / solution.friction_domain * solution.dimensional["friction_domain"]
    assert clean.friction[row] == pytest.approx(friction, rel=1e-3)


def test_speeds_of_both_surfaces(clean):
    """Half the sliding at the same entrainment: half the Couette part at the same β."""
    half = replace(clean, slide_to_roll=np.ones(len(clean)))
    model = make_model(half, **KNOWN, viscosity=VISCOSITY, force="couette")
    values = {"viscosity": VISCOSITY, "young_modulus": 3e6, "friction_offset": 0.0}
    master = model.cover(values, 2.0, None)
    whole = replace(master, data=clean)
    np.testing.assert_allclose(master.friction(values), whole.friction(values) / 2, rtol=1e-12)


def test_too_few_rows_and_friction_that_is_not_positive(clean):
    with pytest.raises(softlube.InputError, match="2 rows are too few"):
        fit(clean.take(np.arange(2)), **KNOWN)
    negative = replace(clean, friction=np.where(np.arange(72) == 3, -1e-5, clean.friction))
    with pytest.raises(softlube.InputError, match="line 4: the friction is not positive"):
        fit(negative, **KNOWN)
    assert fit(negative, **KNOWN, noise="absolute", compare=False).values["viscosity"] == pytest.approx(VISCOSITY, rel=0.05)
