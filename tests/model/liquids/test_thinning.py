"""What all liquids that thin with shear have in common."""

import numpy as np
import pytest

import softlube
from softlube.model.liquids import (
    BarusLaw,
    CarreauYasudaLaw,
    DowsonHigginsonLaw,
    EyringLaw,
    NewtonianLaw,
    OstwaldLaw,
    RoelandsLaw,
    from_plain,
    to_plain,
)

LAWS = [
    OstwaldLaw(BarusLaw(2.0), 0.3, 0.6),
    CarreauYasudaLaw(NewtonianLaw(), 10.0, 0.5),
    CarreauYasudaLaw(RoelandsLaw(3.0, 0.6, 0.4), 10.0, 0.35, 0.02, 0.8),
    EyringLaw(NewtonianLaw(), 0.2),
]


@pytest.mark.parametrize("law", LAWS)
def test_the_flow_curve_is_the_inverse_of_the_fluidity(law):
    rate = np.geomspace(1e-5, 1e3, 200)
    stress = law.flow_curve(rate)
    ln_psi, slope = law.fluidity_at(stress)
    assert stress * np.exp(ln_psi) == pytest.approx(rate, rel=1e-9)
    step = 1e-4
    difference = (law.fluidity_at(stress * np.exp(step))[0] - law.fluidity_at(stress * np.exp(-step))[0]) / (2 * step)
    assert slope == pytest.approx(difference, rel=2e-6, abs=1e-7)


@pytest.mark.parametrize("law", LAWS)
def test_another_unit_of_height_changes_the_numbers_and_not_the_liquid(law):
    """Stresses scale with the unit of height, shear rates with it, too: τ over its unit at the same physical rate."""
    rate, unit = np.geomspace(1e-3, 1e2, 9), 7.0
    assert law.in_units(unit).flow_curve(rate / unit) == pytest.approx(law.flow_curve(rate) / unit, rel=1e-12)


@pytest.mark.parametrize("law", LAWS)
def test_it_stands_on_top_of_the_liquid_at_rest_and_under_a_density(law):
    p = np.array([0.0, 0.1, 0.4])
    assert np.array_equal(law.viscosity(p), law.liquid.viscosity(p))
    assert np.array_equal(law.reduced_pressure(p), law.liquid.reduced_pressure(p))
    assert law.thins
    assert not law.linear
    dense = DowsonHigginsonLaw(law, 0.5)
    assert dense.thins
    assert np.array_equal(dense.fluidity_at(p + 1)[0], law.fluidity_at(p + 1)[0])
    assert from_plain(to_plain(dense)) == dense
    assert law.weakened(0.0).viscosity(p) == pytest.approx(1)


def test_on_top_of_barus_and_roelands_from_inputs():
    thin = {"viscosity": "1 Pa s", "infinite_viscosity": "10 mPa s", "relaxation_time": "1 ms", "index": 0.5}
    ball = {"radius": "2 mm", "young_modulus": "3 MPa", "speed": "0.1 mm/s", "load": "100 mN"}
    plain, pressed, roelands = (
        softlube.Contact(**ball, **thin, **more)
        for more in ({}, {"pressure_viscosity": "20 GPa^-1"}, {"pressure_viscosity": "20 GPa^-1", "pressure_law": "roelands"})
    )
    assert plain.liquid == softlube.Carreau("1 Pa s", infinite_viscosity="10 mPa s", relaxation_time="1 ms", index=0.5)
    assert isinstance(plain.problem().liquid.liquid, NewtonianLaw)
    assert isinstance(pressed.problem().liquid.liquid, BarusLaw)
    assert isinstance(roelands.problem().liquid.liquid, RoelandsLaw)
    for each in (plain, pressed, roelands):
        assert softlube.Contact.from_inputs(each.inputs()) == each


@pytest.mark.parametrize("index", [0.0, -1.0, 1.2, float("nan")])
def test_an_index_above_one_or_not_above_zero_is_refused(index):
    for make in (lambda: OstwaldLaw(NewtonianLaw(), 1.0, index), lambda: CarreauYasudaLaw(NewtonianLaw(), 1.0, index)):
        with pytest.raises(softlube.InputError, match="index: expected a number above 0 and up to 1"):
            make()
