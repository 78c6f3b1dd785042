"""The power law, and consistencies whose unit has the index in it."""

import numpy as np
import pytest

import softlube
from softlube import PowerLaw
from softlube.model.liquids import NewtonianLaw, OstwaldLaw

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "speed": "0.1 mm/s", "load": "100 mN"}


def test_the_stress_is_a_power_of_the_rate():
    law = OstwaldLaw(NewtonianLaw(), 0.4, 0.7)
    assert law.flow_curve(np.array([0.4, 4.0])) == pytest.approx([0.4, 0.4 * 10**0.7])


@pytest.mark.parametrize(
    "text", ["0.5 Pa s^0.8", "500 mPa s^0.8", "0.5 Pa·s^(0.8)", "0.5 Pa s**0.8", "0,5 Pa s^0,8", "0.5 Pa s^n", 0.5]
)
def test_a_consistency_is_read(text):
    liquid = PowerLaw(consistency=text, index=0.8)
    assert liquid == PowerLaw(0.5, index=0.8)
    assert liquid.reference_viscosity == 0.5


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0.5 Pa s^0.7", "consistency, index: a unit of Pa s.0.7 goes with the index 0.7, not with 0.8"),
        ("0.5 Pa s", "consistency, index: a unit of Pa s.1 goes with the index 1, not with 0.8"),
        ("0.5 Pa", "consistency: cannot read '0.5 Pa'; expected a consistency such as '0.5 Pa s.0.8'"),
        ("0.5 m s^0.8", "consistency: 0.5 m has the wrong dimension; expected a consistency"),
        ("-0.5 Pa s^0.8", "consistency: expected a positive, finite quantity"),
    ],
)
def test_another_is_refused(text, message):
    with pytest.raises(softlube.InputError, match=message):
        PowerLaw(consistency=text, index=0.8)


def test_the_unit_of_a_column_is_read():
    declared = PowerLaw.inputs["consistency"]
    assert declared.factor("mPa s^n") == pytest.approx(1e-3)
    with pytest.raises(softlube.InputError, match="cannot read the unit 'mPa'"):
        declared.factor("mPa")


def test_from_inputs_and_normalised():
    contact = softlube.Contact(**BALL, consistency="0.5 Pa s^0.8", index=0.8)
    assert contact.liquid == PowerLaw("0.5 Pa s^0.8", index=0.8)
    assert contact.viscosity == 0.5
    law = contact.problem().liquid
    friction, length = (contact.scales(contact.unit_height)[name][0] for name in ("friction", "length"))
    # At the shear rate 1000/s the stress is K 1000^n.
    rate = 1000 * 0.5 / (friction / length**2)
    assert law.flow_curve(np.array(rate)) * friction / length**2 == pytest.approx(0.5 * 1000**0.8)
    with pytest.raises(softlube.InputError, match="consistency, index: the first means nothing without the second"):
        softlube.Contact(**BALL, consistency="0.5 Pa s^0.8")
    with pytest.raises(softlube.InputError, match="no liquid has both"):
        softlube.Contact(**BALL, consistency="0.5 Pa s^0.8", index=0.8, viscosity=1.0)
