"""What is said of indenters: a true sphere's difference, a profile's smoothing, the reference radius."""

import numpy as np
import pytest

import softlube
from softlube.model.indenters import SphereShape
from softlube.physical.indenter_effect import effect, notes, notes_in_time

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}


def test_the_true_sphere_of_a_wide_contact():
    """Load and depth of the dry sphere to the next order: a³ and δ change with (a/R)² (Sneddon 1965)."""
    contact = softlube.Contact(**BALL)
    (note,) = notes(contact)
    assert note.sentence().startswith("The contact's radius is 0.17 R, and the sphere is taken for its paraboloid")
    assert "film at the centre -1.3 % (± 0.2 %)" in note.text
    changes = effect(contact, SphereShape(contact.unit_height / 2e-3, 1.0))
    assert note.changes == changes
    told = note.plain()["relative_changes"]["minimum film"]
    assert (told["value"], told["error"]) == changes["minimum film"]
    share = float(contact.dry_radius) / 2e-3
    # N ~ a³ (1 + (2/5)(a/R)²) and δ ~ a² (1 + (a/R)²/3)
    radius = -2 / 15 * share**2
    assert changes["contact radius"] == (pytest.approx(radius, rel=0.05), 0.0)
    assert changes["indentation of a dry contact"] == (pytest.approx(2 * radius + share**2 / 3, rel=0.05), 0.0)
    true, plain = softlube.Contact(**BALL, true_shape=True).solve(), contact.solve()
    assert notes(true.contact) == []
    for name, words in (("film_center", "film at the centre"), ("friction_contact", "friction over the contact")):
        change, error = changes[words]
        assert true.dimensional[name] / plain.dimensional[name] - 1 == pytest.approx(change, abs=error + 5e-4)


def test_narrow_and_light_contacts():
    assert notes(softlube.Contact(**BALL | {"load": "1 mN"})) == []
    light = softlube.Contact(**BALL | {"speed": "100 mm/s"})
    assert "film" not in notes(light)[0].text
    gap = softlube.Contact(**{name: value for name, value in BALL.items() if name != "load"}, indentation="-1 um")
    assert notes(gap) == []


def test_a_measured_profile_says_what_its_smoothing_does(tmp_path):
    rng = np.random.default_rng(5)
    r = np.linspace(0, 1e-3, 300)
    z = 2e-3 - np.sqrt(4e-6 - r**2) + rng.normal(0, 3e-8, r.size)
    path = tmp_path / "ball.csv"
    path.write_text("r [m], z [m]\n" + "\n".join(f"{a:.9g}, {b:.9g}" for a, b in zip(r, z, strict=True)))
    rest = {name: value for name, value in BALL.items() if name != "radius"}
    reference, smoothing = (
        note.text for note in notes(softlube.Contact(profile=str(path), profile_tolerance="29.5 nm", **rest))
    )
    assert reference.startswith("lengths are normalised with the reference radius of the indenter, 1.8")
    assert "root mean square" in smoothing
    assert "film at the centre" in smoothing


def test_a_squeeze_film_says_it_of_its_deepest_contact():
    rest = {name: value for name, value in BALL.items() if name != "speed"} | {"initial_height": "50 um", "duration": "1 ms"}
    fall = softlube.squeeze(**rest)
    (note,) = notes_in_time(fall.setup, fall.motion)
    assert "0.17 R" in note.text
    assert "indentation of a dry contact +0.19 %" in note.text
    true = softlube.squeeze(**rest, true_shape=True)
    assert notes_in_time(true.setup, true.motion) == []
