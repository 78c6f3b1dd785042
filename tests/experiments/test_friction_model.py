"""Friction of many contacts as a function of the parameters: solved contacts, powers, first guesses."""

import math
from dataclasses import replace

import numpy as np
import pytest

import softlube
from softlube import Measurements, fit
from softlube.experiments.friction_model import make_model, normalised_friction
from softlube.physical.rig import hertz_force

KNOWN = {"radius": "2 mm", "young_modulus": "3 MPa"}


VISCOSITY = 2.0


def test_the_model_is_the_friction_of_a_solved_contact(clean):
    """The link between a fit and a solution, for a row whose β is no node of the curve."""
    row = 30
    solution = softlube.Contact(**KNOWN, viscosity=VISCOSITY, speed=clean.speed[row], load=clean.load[row]).solve()
    assert clean.friction[row] == pytest.approx(solution.dimensional["friction_total"], rel=1e-3)


def test_speeds_of_both_surfaces(clean):
    """Half the sliding at the same entrainment: half the Couette part at the same β."""
    half = replace(clean, slide_to_roll=np.ones(len(clean)))
    model = make_model(half, **KNOWN, viscosity=VISCOSITY, force="couette")
    values = {"viscosity": VISCOSITY, "young_modulus": 3e6, "friction_offset": 0.0}
    master = model.cover(values, 2.0, None)
    whole = replace(master, data=clean)
    np.testing.assert_allclose(master.friction(values), whole.friction(values) / 2, rtol=1e-12)


def test_too_few_rows_and_friction_that_is_not_positive(clean):
    with pytest.raises(softlube.InputError, match="2 rows are too few"):
        fit(clean.take(np.arange(2)), **KNOWN)
    negative = replace(clean, friction=np.where(np.arange(72) == 3, -1e-5, clean.friction))
    with pytest.raises(softlube.InputError, match="line 4: the friction is not positive"):
        fit(negative, **KNOWN)
    assert fit(negative, **KNOWN, noise="absolute", compare=False).values["viscosity"] == pytest.approx(VISCOSITY, rel=0.05)


def small(friction=(1e-4, 2e-4, 3e-4, 4e-4), **changed):
    data = Measurements.from_arrays([0.05, 0.05, 0.1, 0.1], [1e-4, 1e-3, 1e-4, 1e-3], friction)
    return make_model(data, **{"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": 2.0} | changed)


VALUES = {"viscosity": VISCOSITY, "young_modulus": 3e6, "friction_offset": 0.0}


def test_beta_and_the_unit_of_friction_are_those_of_a_contact():
    model = small()
    for row, (load, speed) in enumerate(zip(model.data.load, model.data.speed, strict=True)):
        contact = softlube.Contact(**KNOWN, viscosity=VISCOSITY, speed=speed, load=load)
        assert model.beta(VALUES)[row] == pytest.approx(contact.problem().beta_load, rel=1e-12)
        assert model.unit(VALUES)[row] == pytest.approx(hertz_force(contact), rel=1e-12)


def test_the_vector_that_is_fitted_holds_logarithms_and_a_relative_offset():
    model = replace(small(), free=("viscosity", "young_modulus", "friction_offset"))
    values = {"viscosity": 0.5, "young_modulus": 2e6, "friction_offset": -5e-5}
    x = model.vector(values)
    assert x == pytest.approx([math.log(0.5), math.log(2e6), -5e-5 / 2.5e-4])  # 2.5e-4 N is the median friction
    assert model.values(x) == pytest.approx(values)


def test_residuals():
    model = small()
    master = model.cover(VALUES, 2.0, None)
    exact = replace(master, data=replace(model.data, friction=master.friction(VALUES) * [1, 1.1, 1, 0.5]))
    assert exact.residuals(VALUES) == pytest.approx([0, math.log(1.1), 0, math.log(0.5)], abs=1e-12)
    absolute = replace(exact, noise="absolute")
    excess = exact.data.friction - exact.friction(VALUES)
    assert absolute.residuals(VALUES) == pytest.approx(excess / np.median(exact.data.friction))


def test_friction_beyond_the_curve_goes_on_with_its_last_slope():
    model = small().cover(VALUES, 2.0, None)
    low, high = model.family.low, model.family.high
    unit_beta = model.beta(VALUES)[0] * VISCOSITY
    for end, inner in ((low, 1.1 * low), (high, high / 1.1)):
        betas = np.array([inner, end, end**2 / inner])
        frictions = [float(model.friction(VALUES | {"viscosity": unit_beta / beta})[0]) for beta in betas]
        slopes = np.diff(np.log(frictions)) / np.diff(np.log(betas))
        assert slopes[1] == pytest.approx(slopes[0], rel=1e-6)
        assert -0.6 < slopes[0] < -0.3  # Eq. (28) has −0.44


def test_the_first_guess_solves_eq_28():
    """Data on Eq. (28) itself give their own viscosity."""
    model = small()
    friction = model.unit(VALUES) * 4.806 * model.beta(VALUES) ** -0.4398
    guess = make_model(replace(model.data, friction=friction), radius="2 mm", young_modulus="3 MPa").first_guess()
    assert guess["viscosity"] == pytest.approx(VISCOSITY, rel=1e-9)
    assert small(viscosity=None, young_modulus=None, free=("viscosity", "modulus")).first_guess()["young_modulus"] == 1e6


def test_the_points_of_fig_13_have_no_offset():
    model = small()
    beta, friction = normalised_friction(model, VALUES | {"friction_offset": 1e-4})
    assert beta == pytest.approx(model.beta(VALUES))
    assert friction * model.unit(VALUES) == pytest.approx(model.data.friction - 1e-4)


def test_short_names_and_double_ones():
    assert small(free=("modulus", "offset", "modulus")).free == ("young_modulus", "friction_offset")


CARREAU = {"relaxation_time": 1e-3, "index": 0.5}


@pytest.mark.parametrize(
    ("liquid", "free", "acts_like_load", "numbers"),
    [
        ({"viscosity": 2.0} | CARREAU, ("relaxation_time",), True, []),
        ({"viscosity": 2.0} | CARREAU, ("viscosity", "index"), True, ["index"]),
        ({"viscosity": 2.0, "infinite_viscosity": 0.1} | CARREAU, ("viscosity",), True, ["infinite"]),
        (
            {"viscosity": 2.0, "infinite_viscosity": 0.1} | CARREAU,
            ("infinite_viscosity", "index"),
            False,
            ["index", "infinite"],
        ),
        ({"consistency": 2.0, "index": 0.8}, ("consistency",), True, []),
        ({"viscosity": 2.0, "limiting_stress": 1e4}, ("limiting_stress",), True, []),
        ({"viscosity": 2.0}, ("viscosity",), False, []),
    ],
)
def test_what_parameters_of_liquids_change(liquid, free, acts_like_load, numbers):
    """Times and stresses act like another load; an index, and a ratio of viscosities, need curves of their own."""
    model = small(free=free, **({"viscosity": None} | liquid))
    start = model.first_guess()
    model = replace(model, start=start)
    factor, apart = model.moved(start | {name: 0.9 * start[name] for name in free})
    assert sorted(path[-1] for path in apart) == numbers
    assert (factor != 1) == acts_like_load


def test_what_parameters_change_on_a_substrate_that_remembers():
    """Its time and the viscosity act like another load; a modulus that changes how much it stiffens has no curves."""
    solid = {"stiffening": 3.0, "substrate_relaxation_time": 0.1}
    model = small(free=("viscosity", "substrate_relaxation_time"), viscosity=2.0, **solid)
    assert not model.plain
    assert model.limited
    start = model.first_guess()
    model = replace(model, start=start)
    assert model.moved(start | {"viscosity": 4.0}) == (pytest.approx(0.5), {})
    assert model.moved(start | {"substrate_relaxation_time": 0.3}) == (pytest.approx(3), {})
    assert small(free=("young_modulus",), viscosity=2.0, **solid).free == ("young_modulus",)
    with pytest.raises(softlube.InputError, match="young_modulus change how much the substrate stiffens"):
        small(free=("young_modulus",), viscosity=2.0, prony="6 MPa @ 0.1 s")


def test_rows_of_several_slide_to_roll_ratios():
    """A liquid that thins, or a substrate that remembers, has another film at each."""
    data = Measurements.from_arrays([0.05, 0.05, 0.1, 0.1], [1e-4, 1e-3, 1e-4, 1e-3], [1e-4, 2e-4, 3e-4, 4e-4])
    several = replace(data, slide_to_roll=np.array([2.0, 2.0, 0.5, 0.5]))
    with pytest.raises(softlube.InputError, match="slide-to-roll ratio, and the rows have several"):
        make_model(several, **KNOWN, viscosity=2.0, **CARREAU)
    with pytest.raises(softlube.InputError, match="slide-to-roll ratio, and the rows have several"):
        make_model(several, **KNOWN, viscosity=2.0, prony="6 MPa @ 0.1 s")
    make_model(replace(data, slide_to_roll=np.full(4, 0.5)), **KNOWN, viscosity=2.0, **CARREAU)
    make_model(several, **KNOWN, viscosity=2.0)
