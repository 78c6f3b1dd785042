"""What substrates have in common: two moduli for one, and names in files."""

import pytest

from softlube.errors import InputError
from softlube.model.parts import resolve
from softlube.model.substrates import HalfSpace, Layer, from_plain


def test_either_modulus():
    by_young, by_shear = Layer("3 MPa", thickness=1e-3), Layer(shear_modulus="1 MPa", thickness="1 mm")
    assert by_young == by_shear
    assert by_shear.young_modulus == pytest.approx(3e6)
    assert "young_modulus" not in by_young.flat()
    for moduli in ({}, {"young_modulus": 3e6, "shear_modulus": 1e6}):
        with pytest.raises(
            InputError, match=r"young_modulus, shear_modulus: are both .*; give exactly one, a pressure such as"
        ):
            HalfSpace(**moduli)


def test_unknown_kinds_are_refused():
    known = "'creeping' or 'half-space' or 'layer' or 'viscoelastic'"
    with pytest.raises(InputError, match=f"substrate: no 'jelly' is known; expected {known}"):
        from_plain({"kind": "jelly"})


def test_a_substrate_may_be_a_ball_or_a_cup():
    assert HalfSpace(3e6).curvature == 0
    ball = HalfSpace(3e6, radius="5 mm")
    assert ball.curvature == pytest.approx(200)
    assert resolve(["substrate"], {"young_modulus": 3e6, "substrate_radius": "5 mm", "radius": "2 mm"})["substrate"] == ball
    assert HalfSpace(3e6, radius="-5 mm").curvature == pytest.approx(-200)
    with pytest.raises(InputError, match="substrate_radius: zero; expected a length such as '5 mm', or '-5 mm' for a cup"):
        HalfSpace(3e6, radius=0)
