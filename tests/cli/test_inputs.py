"""The options that several commands share: which contact to read."""

import pytest

import softlube
from softlube.cli.inputs import Bodies, Sliding, Which

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}


def test_options_that_are_not_given_are_left_to_their_defaults():
    assert Bodies(**BALL).given() == BALL


def test_a_contact_is_solved_or_read(tmp_path):
    solved = Which(contact=Sliding(**BALL, speed="1 mm/s", load="50 mN")).get()
    again = softlube.Contact(**BALL, speed="1 mm/s", load="50 mN").solve()
    assert solved.dimensional["film_min"] == again.dimensional["film_min"]
    solved.save(tmp_path / "a.nc")
    assert Which(solution=str(tmp_path / "a.nc")).get().dimensional == solved.dimensional
    assert Which(beta=100.0, cavitation="none").get().problem == softlube.Problem(beta=100.0, cavitation="none")


@pytest.mark.parametrize(
    ("which", "message"),
    [
        (Which(), "solution: missing"),
        (Which(beta=1.0, contact=Sliding(radius="2 mm")), "beta, radius: give one contact"),
        (Which(solution="a.nc", cavitation="none"), "cavitation: the solution has its own"),
    ],
)
def test_contacts_that_are_not_said_clearly_are_refused(which, message):
    with pytest.raises(softlube.InputError, match=message):
        which.get()
