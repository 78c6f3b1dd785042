"""What a feature changes, beside the contact without it on the master curve."""

import pytest

import softlube
from softlube.physical.effects import thinning_effect

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "speed": "0.1 mm/s", "load": "100 mN"}


def test_thinning_is_told_in_shares_that_the_newtonian_contact_confirms():
    contact = softlube.Contact(**BALL, viscosity="2 Pa s", relaxation_time="10 ms", index=0.5)
    solution, plain = (each.solve() for each in (contact, softlube.Contact(**BALL, viscosity="2 Pa s")))
    share = solution.dimensional["film_center"] / plain.dimensional["film_center"] - 1
    (said,) = solution.warnings
    assert said.startswith("the liquid thins with shear; compared with a constant viscosity of 2 Pa s that changes: film at")
    assert f"film at the centre {100 * share:+.2g} %" in said


@pytest.mark.parametrize(
    "liquid",
    [
        softlube.Newtonian("2 Pa s"),
        softlube.Carreau("2 Pa s", relaxation_time="10 us", index=0.5),  # hardly thins
        softlube.PowerLaw("2 Pa s^0.5", index=0.5),  # has no viscosity at rest
    ],
)
def test_where_it_does_not_matter_or_is_not_known_nothing_is_said(liquid):
    contact = softlube.Contact(**BALL, liquid=liquid)
    assert thinning_effect(contact, contact.solve(accuracy=0.01).dimensional) == []
