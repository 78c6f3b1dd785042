"""Carreau, Yasuda and Cross: the law against its formula, its table, and what is refused."""

import numpy as np
import pytest

import softlube
from softlube import Carreau, CarreauYasuda, Cross
from softlube.model.liquids import CarreauYasudaLaw, NewtonianLaw

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "speed": "0.1 mm/s", "load": "100 mN"}
GIVEN = {"infinite_viscosity": "20 mPa s", "relaxation_time": "5 ms", "index": 0.4}


@pytest.mark.parametrize(
    ("index", "infinite", "transition"),
    [
        (0.5, 0.0, 2.0),
        (0.35, 1e-3, 2.0),
        (0.9, 0.1, 1.0),
        (0.5, 0.0, 0.5),
        (0.99, 0.01, 2.0),
        (0.4, 0.01, 0.6),
        (1.0, 0.5, 2.0),
    ],
)
def test_the_table_is_as_good_as_it_says(index, infinite, transition):
    law = CarreauYasudaLaw(NewtonianLaw(), 3.0, index, infinite, transition)
    rate = np.geomspace(1e-9, 1e12, 20001)
    ratio = infinite + (1 - infinite) * (1 + (3 * rate) ** transition) ** ((index - 1) / transition)
    assert law.flow_curve(rate) == pytest.approx(rate * ratio, rel=1e-12)
    assert law.fluidity_at(rate * ratio)[0] == pytest.approx(-np.log(ratio), abs=2e-10)


def test_limits_are_the_plateaus():
    rate = np.geomspace(1e-3, 1e3, 9)
    assert CarreauYasudaLaw(NewtonianLaw(), 0.0, 0.4, 0.1).flow_curve(rate) == pytest.approx(rate, rel=1e-14)
    assert CarreauYasudaLaw(NewtonianLaw(), 1e-12, 0.4, 0.1).flow_curve(rate) == pytest.approx(rate, rel=1e-14)
    assert CarreauYasudaLaw(NewtonianLaw(), 1e30, 0.4, 0.1).flow_curve(rate) == pytest.approx(0.1 * rate, rel=1e-14)


def test_cross_has_its_own_form():
    contact = softlube.Contact(**BALL, liquid=Cross("2 Pa s", **GIVEN))
    law = contact.problem().liquid
    rate = np.geomspace(1e-3, 1e3, 9)
    expected = 0.01 + 0.99 / (1 + (law.time * rate) ** 0.6)
    assert law.flow_curve(rate) == pytest.approx(rate * expected)


def test_the_kinds_from_inputs():
    assert softlube.Contact(**BALL, viscosity=2.0, **GIVEN).liquid == Carreau("2 Pa s", **GIVEN)
    assert softlube.Contact(**BALL, viscosity=2.0, **GIVEN, viscosity_law="cross").liquid == Cross("2 Pa s", **GIVEN)
    yasuda = softlube.Contact(**BALL, viscosity=2.0, **GIVEN, transition=0.8)
    assert yasuda.liquid == CarreauYasuda("2 Pa s", **GIVEN, transition=0.8)
    assert yasuda.problem().liquid.transition == 0.8
    with pytest.raises(softlube.InputError, match="viscosity_law, transition: 'cross' has no such input"):
        softlube.Contact(**BALL, viscosity=2.0, **GIVEN, transition=0.8, viscosity_law="cross")


def test_what_does_not_thin_is_refused():
    with pytest.raises(softlube.InputError, match="infinite_viscosity: expected less than the viscosity at rest"):
        Carreau("1 mPa s", **GIVEN)
    with pytest.raises(softlube.InputError, match="index: Cross's law needs an index below 1"):
        Cross("2 Pa s", **(GIVEN | {"index": 1.0}))
    with pytest.raises(softlube.InputError, match="infinite: expected a viscosity ratio"):
        CarreauYasudaLaw(NewtonianLaw(), 1.0, 0.5, 1.5)
    with pytest.raises(softlube.InputError, match="transition: expected a positive number"):
        CarreauYasudaLaw(NewtonianLaw(), 1.0, 0.5, 0.5, 0.0)
