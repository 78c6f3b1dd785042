"""A limiting stress on top of any liquid."""

import numpy as np
import pytest

import softlube
from softlube import Barus, Carreau, LimitingStress
from softlube.model.liquids import BarusLaw, CarreauYasudaLaw, LimitingStressLaw, NewtonianLaw, from_plain, to_plain

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "speed": "0.1 mm/s", "load": "100 mN"}


def test_the_stress_goes_to_its_limit():
    law = LimitingStressLaw(NewtonianLaw(), 0.2, 0.5)
    stress, pressure = np.array([-1e3, 0.0, 1e-9, 0.2, 1e3]), np.array([0.4, 0.4, 0.4, 0.0, 0.4])
    expected = [-0.4, 0.0, 1e-9, 0.2 * (1 - np.exp(-1)), 0.4]
    assert law.limited(stress, pressure) == pytest.approx(expected, rel=1e-8)


def test_the_flux_is_that_of_the_law_underneath():
    law = LimitingStressLaw(CarreauYasudaLaw(BarusLaw(2.0), 3.0, 0.5), 0.2, 0.5)
    stress = np.geomspace(1e-3, 10, 5)
    assert np.array_equal(law.fluidity_at(stress), law.liquid.fluidity_at(stress))
    assert law.thins
    assert not LimitingStressLaw(NewtonianLaw(), 0.2, 0.5).thins
    assert not LimitingStressLaw(NewtonianLaw(), 0.2, 0.5).linear
    assert from_plain(to_plain(law)) == law


def test_another_unit_of_height_is_the_same_liquid():
    law, unit = LimitingStressLaw(NewtonianLaw(), 0.2, 0.5), 3.0
    stress, pressure = np.array([0.1, 1.0]), np.array([0.2, 0.7])
    other = law.in_units(unit).limited(stress / unit, pressure / np.sqrt(unit))
    assert other == pytest.approx(law.limited(stress, pressure) / unit)


def test_from_parts_and_from_inputs():
    whole = softlube.Contact(
        **BALL, liquid=LimitingStress(Barus("2 Pa s", pressure_viscosity="20 GPa^-1"), stress="5 MPa", coefficient=0.05)
    )
    flat = softlube.Contact(
        **BALL, viscosity="2 Pa s", pressure_viscosity="20 GPa^-1", limiting_stress="5 MPa", limiting_coefficient=0.05
    )
    assert whole == flat
    assert softlube.Contact.from_inputs(whole.inputs()) == whole
    assert (flat.viscosity, flat.limiting_coefficient, flat.viscosity_law, flat.index) == (2.0, 0.05, "barus", None)
    law = flat.problem().liquid
    pressure, friction, length = (flat.scales(flat.unit_height)[name][0] for name in ("pressure", "friction", "length"))
    limit = law.limited(np.array([1e9]), np.array([1e6 / pressure])) * friction / length**2
    assert limit == pytest.approx(5e6 + 0.05 * 1e6)
    thin = LimitingStress(Carreau("2 Pa s", relaxation_time="1 ms", index=0.5), stress="1 kPa")
    assert softlube.Contact(**BALL, liquid=thin).given["limiting_stress"] == 1e3


def test_what_means_nothing_is_refused():
    with pytest.raises(softlube.InputError, match="limiting_coefficient, limiting_stress: the first means nothing"):
        softlube.Contact(**BALL, viscosity=2.0, limiting_coefficient=0.05)
    with pytest.raises(softlube.InputError, match=r"liquid: expected Barus or .* or LimitingStress, got '2 Pa s'"):
        LimitingStress("2 Pa s", stress="5 MPa")
    with pytest.raises(softlube.InputError, match="stress: expected a positive"):
        LimitingStressLaw(NewtonianLaw(), 0.0, 0.1)
