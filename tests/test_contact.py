"""Units in, units out, and inputs that make no sense."""

import math

import pint
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import softlube
from softlube.contact import KINDS, UNITS, to_si

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}


@pytest.mark.parametrize(
    ("name", "spellings", "value"),
    [
        ("radius", ["2 mm", "0.2cm", "2e-3 m", "2 millimeter", "2000 µm", "2000 um", 0.002], 2e-3),
        ("young_modulus", ["3 MPa", "3e6 Pa", "3 N/mm^2", "3 N/mm**2", "30 bar", 3e6], 3e6),
        ("viscosity", ["2 Pa s", "2 Pa*s", "2000 cP", "20 poise", "2 kg/m/s", "2 pascal second"], 2.0),
        ("speed", ["0.1 mm/s", "100 um/s", "6 mm/min", "1e-4 m s^-1"], 1e-4),
        ("load", ["100 mN", "0.1 N", "0.1 kg m/s^2"], 0.1),
    ],
)
def test_units_in_any_spelling(name, spellings, value):
    for spelling in spellings:
        assert to_si(name, spelling) == pytest.approx(value, rel=1e-12)


def test_pint_quantities_are_taken():
    assert to_si("radius", pint.UnitRegistry().Quantity(2, "mm")) == pytest.approx(2e-3)


@given(
    value=st.floats(1e-6, 1e6),
    pair=st.sampled_from([("radius", "mm", 1e-3), ("load", "mN", 1e-3), ("speed", "m/s", 1.0), ("viscosity", "mPa s", 1e-3)]),
)
@settings(max_examples=50, deadline=None)
def test_units_round_trip(value, pair):
    name, unit, factor = pair
    assert to_si(name, f"{value!r} {unit}") == pytest.approx(value * factor, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"radius": None}, "radius: missing"),
        ({"viscosity": None}, "viscosity: missing"),
        ({"radius": "2"}, "radius: '2' has no unit; expected a length"),
        ({"radius": "-2 mm"}, "radius: expected a positive"),
        ({"radius": "0 mm"}, "radius: expected a positive"),
        ({"radius": "nan mm"}, "radius: "),
        ({"radius": "inf mm"}, "radius: "),
        ({"radius": float("nan")}, "radius: expected a positive"),
        ({"radius": True}, "radius: cannot read True"),
        ({"radius": "mm mm mm ("}, "radius: cannot read"),
        ({"radius": ""}, "radius: "),
        ({"radius": "2 furlongsss"}, "radius: .* unknown unit"),
        ({"radius": object()}, "radius: cannot read"),
        ({"young_modulus": "3 mm"}, "young_modulus: 3 mm has the wrong dimension; expected a pressure"),
        ({"young_modulus": None}, "young_modulus, shear_modulus: are both missing; give exactly one"),
        ({"shear_modulus": "1 MPa"}, "young_modulus, shear_modulus: are both given; give exactly one"),
        ({"load": None}, "load, indentation: are both missing; give exactly one"),
        ({"indentation": "5 um"}, "load, indentation: are both given; give exactly one"),
        ({"cavitation": "jfo"}, "cavitation: expected"),
        ({"roughness": "3 Pa"}, "roughness: 3 Pa has the wrong dimension"),
        ({"speed": "1e-320 m/s", "viscosity": "1e-5 Pa s"}, "check their units"),
    ],
)
def test_bad_input_names_the_parameter_and_what_is_expected(change, message):
    with pytest.raises(softlube.InputError, match=message):
        softlube.Contact(**(BALL | change)).problem()


def test_young_and_shear_modulus_are_the_same_input():
    young = softlube.Contact(**BALL)
    shear = softlube.Contact(**(BALL | {"young_modulus": None, "shear_modulus": "1 MPa"}))
    assert young == shear


def test_beta_is_equation_30(contact):
    viscosity, modulus, radius, speed, load = 2.0, 1e6, 2e-3, 1e-4, 0.1
    expected = (
        (2 * math.pi / 3) * (3 / 16) ** (4 / 3) * load ** (4 / 3) / (viscosity * modulus ** (1 / 3) * radius ** (5 / 3) * speed)
    )
    assert contact.problem().beta_load == pytest.approx(expected, rel=1e-12)


def test_physical_numbers_follow_from_the_dimensionless_ones(physical):
    """Eqs. (4), (5), (26), written out again in SI."""
    height, modulus, radius = physical.dimensional["indentation"], 1e6, 2e-3
    assert physical.dimensional["contact_radius"] == pytest.approx(math.sqrt(radius * height))
    for name, scale in {
        "film_min": height,
        "pressure_max": 4 * math.pi * modulus * math.sqrt(height / radius),
        "friction_contact": 2 * math.pi / 3 * modulus * height**2,
        "boundary_layer": math.sqrt(radius * height),
        "pressure_gradient_inlet": 4 * math.pi * modulus / radius,
        "shear_rate_max": 1e-4 / height,
    }.items():
        assert physical.dimensional[name] == pytest.approx(physical.quantities[name] * scale, rel=1e-12), name
    load = 4 * math.pi * modulus * height * math.sqrt(radius * height) * physical.quantities["load"]
    assert load == pytest.approx(0.1, rel=1e-12)
    assert physical.dimensional["load"] == 0.1
    assert physical.dimensional["friction_coefficient"] == pytest.approx(physical.dimensional["friction_domain"] / 0.1)
    assert (2 / 3) * height**2 / radius * math.pi * modulus / (2 * 1e-4) == pytest.approx(physical.beta, rel=1e-12)
    assert set(physical.dimensional) == set(UNITS)


def test_indentation_and_load_give_the_same_contact(physical):
    by_depth = softlube.Contact(**(BALL | {"load": None, "indentation": float(physical.dimensional["indentation"])})).solve()
    for name, value in physical.dimensional.items():
        other = by_depth.dimensional[name]
        assert abs(value - other) <= value.error + other.error + 1e-4 * abs(value), name
        assert other.unit == value.unit


@pytest.mark.parametrize(
    ("change", "fragment"),
    [
        ({"load": "20 N"}, "contact radius is"),
        ({"roughness": "1 um"}, "below the roughness"),
        ({"viscosity": "1 uPa s", "speed": "1 km/s"}, "Reynolds number"),
        ({"thickness": "2 mm"}, "the slab is 6 contact radii thick"),
    ],
)
def test_doubtful_physics_is_warned_of(physical, change, fragment):
    contact = softlube.Contact(**(BALL | change))
    assert any(fragment in doubt for doubt in contact.doubts(contact.dimensional(physical.quantities)))


def test_sound_physics_is_not_warned_of(physical):
    assert physical.warnings == ()
    careful = softlube.Contact(**BALL, roughness="1 nm", thickness="50 mm")
    assert careful.doubts(careful.dimensional(physical.quantities)) == ()


def test_every_physical_input_has_a_unit_and_an_example():
    for name, (_, example) in KINDS.items():
        assert to_si(name, example.split("'")[1]) > 0
