"""What a contact says of itself: the sphere's and the cylinder's alike."""

import pytest

from softlube import Contact, LineContact

INPUTS = {"radius": "2 mm", "shear_modulus": "1 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s"}


@pytest.mark.parametrize(
    ("contact", "headline"),
    [
        (Contact(**INPUTS, load="100 mN"), "Contact: sphere on half-space, newtonian liquid, sliding"),
        (LineContact(**INPUTS, load_per_length="1 kN/m"), "Line contact: cylinder on half-space, newtonian liquid, sliding"),
    ],
)
def test_a_contact_can_be_made_again(contact, headline):
    assert contact.headline == headline
    assert eval(repr(contact)) == contact
    assert type(contact).from_inputs(contact.inputs()) == contact
    assert contact.summary().rows[0] == ("radius", "2 mm", contact.to_dataframe().loc["radius", "words"])
    assert (contact.speed_sum, contact.substrate_speed, contact.slide_to_roll) == (1e-4, 1e-4, 2)
