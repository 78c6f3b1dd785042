"""The options that several commands share: inputs as they are declared, and which contact to read."""

from inspect import signature

import pytest

import softlube
from softlube.cli.inputs import PHYSICAL, one_contact, takes
from softlube.physical.inputs import SLIDING_BODIES, Loading

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "1 mm/s", "load": "50 mN"}


def test_a_command_takes_what_is_declared_and_its_own_options_stand():
    @takes((PHYSICAL, SLIDING_BODIES, Loading))
    def command(*, cavitation: int = 3, **physical: str) -> int:
        """Count."""
        return len(physical)

    arguments = signature(command).parameters
    assert arguments["cavitation"].default == 3
    assert {"radius", "thickness", "viscosity_law", "density_law", "speed", "indentation"} <= set(arguments)
    assert arguments["radius"].annotation.__metadata__[0].help == 'Radius of the sphere, such as "2 mm".'
    assert command(radius="2 mm", speed="1 m/s") == 2
    assert command.__doc__ == "Count."


def test_a_contact_is_solved_or_read(tmp_path):
    solved = one_contact(BALL)
    again = softlube.Contact(**BALL).solve()
    assert solved.dimensional["film_min"] == again.dimensional["film_min"]
    solved.save(tmp_path / "a.nc")
    assert one_contact({}, solution=str(tmp_path / "a.nc")).dimensional == solved.dimensional
    assert one_contact({}, beta=100.0, cavitation="none").problem == softlube.Problem(beta=100.0, cavitation="none")


@pytest.mark.parametrize(
    ("physical", "others", "message"),
    [
        ({}, {}, "solution: missing"),
        ({"radius": "2 mm"}, {"beta": 1.0}, "beta, radius: give one contact"),
        ({}, {"solution": "a.nc", "cavitation": "none"}, "cavitation: the solution has its own"),
    ],
)
def test_contacts_that_are_not_said_clearly_are_refused(physical, others, message):
    with pytest.raises(softlube.InputError, match=message):
        one_contact(physical, **others)
