"""Units in, units out, and inputs that make no sense."""

import itertools
import math

import pint
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import softlube
from softlube.model.quantities import DERIVED, STEADY
from softlube.physical.inputs import declared
from softlube.physical.units import to_si

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
        ({"load": None, "indentation": "inf um"}, "indentation: cannot read 'inf um': expected a finite number"),
        ({"load": None, "indentation": float("inf")}, "indentation: expected a finite quantity"),
        ({"load": None, "indentation": float("nan")}, "indentation: expected a finite quantity"),
        ({"load": None, "indentation": "-5 N"}, "indentation: -5 N has the wrong dimension"),
        ({"load": None, "indentation": "-5"}, "indentation: '-5' has no unit"),
        ({"load": "0 N"}, "load: expected a positive"),
        ({"cavitation": "jfo"}, "cavitation: expected"),
        ({"roughness": "3 Pa"}, "roughness: 3 Pa has the wrong dimension"),
        ({"speed": "1e-320 m/s"}, "speed: cannot read '1e-320 m/s': the number is too small"),
        ({"speed": 1e-320, "viscosity": "1e-5 Pa s"}, r"speed: expected a magnitude from 1e-30 to 1e\+30 m/s; got 1e-320"),
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
    modulus, radius = 1e6, 2e-3
    height = (9 * 0.1**2 / (256 * modulus**2 * radius)) ** (1 / 3)  # the Hertz indentation of the load, Eq. (29)
    indentation = physical.dimensional["indentation"]
    assert indentation == pytest.approx(-physical.height * height, rel=1e-12)
    assert 0 < indentation < height
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
    assert physical.dimensional["friction_coefficient"] == pytest.approx(physical.dimensional["friction_total"] / 0.1)
    for unit, beta in ((indentation, physical.beta), (height, physical.beta_load)):
        assert (2 / 3) * unit**2 / radius * math.pi * modulus / (2 * 1e-4) == pytest.approx(beta, rel=1e-12)
    assert physical.dimensional["indentation"].error == pytest.approx(height * physical.height.error)
    assert set(physical.dimensional) == set(STEADY) - {"height", "film_min_angle_deg"} | set(DERIVED) - {"lambda_ratio"}


AT_THE_EDGE = (
    "load_contact",
    "film_inlet",
    "boundary_layer",
    "friction_total",
    "friction_contact",
    "friction_domain",
    "friction_coefficient",
    "contact_radius",
)
"""Quantities that depend on where r = a is, the edge of the dry contact under the load or at the indentation."""


@pytest.mark.parametrize("load", ["100 mN", "250 uN", "100 uN", "10 uN"])
def test_indentation_and_load_give_the_same_contact(load):
    """From a deep contact to a wide gap: the physical numbers know nothing of the normalisation."""
    by_load = softlube.Contact(**(BALL | {"load": load})).solve()
    depth = float(by_load.dimensional["indentation"])
    assert (depth > 0) == (load in ("100 mN", "250 uN"))
    by_depth = softlube.Contact(**(BALL | {"load": None, "indentation": depth})).solve()
    assert by_depth.dimensional["indentation"] == pytest.approx(depth, rel=1e-14)
    assert by_depth.beta == pytest.approx(by_load.beta, rel=1e-12)
    for name, value in by_load.dimensional.items():
        if name in AT_THE_EDGE or name.startswith("film_min_") or name == "indentation":
            continue
        other = by_depth.dimensional[name]
        assert other.unit == value.unit
        assert abs(value - other) <= value.error + other.error + 1e-4 * abs(value), name
    # A height near zero is relative to the film.
    error = by_load.dimensional["indentation"].error
    slack = abs(by_depth.dimensional["load"] / by_load.dimensional["load"] - 1) * by_load.dimensional["film_center"]
    assert slack <= 3 * (error + by_load.dimensional["film_center"].error)


def test_depths_of_either_sign_are_one_family():
    """Load and film go on smoothly where the sphere's lowest point passes the undeformed surface."""
    depths = ["-2 um", "-0.5 um", "-1 nm", "0 um", "1 nm", "0.5 um", "2 um"]
    found = [softlube.Contact(**(BALL | {"load": None, "indentation": depth})).solve().dimensional for depth in depths]
    load = [one["load"] for one in found]
    film = [one["film_center"] for one in found]
    assert all(low < high for low, high in itertools.pairwise(load))
    assert all(low > high for low, high in itertools.pairwise(film))
    for values in (load, film):
        below, zero, above = values[2:5]
        assert abs(above - below) < 1e-2 * zero
        assert abs((above + below) / 2 - zero) <= (above.error + below.error) / 2 + zero.error
    assert [float(one["indentation"]) for one in found] == pytest.approx([-2e-6, -5e-7, -1e-9, 0, 1e-9, 5e-7, 2e-6], abs=1e-22)


@pytest.mark.parametrize(("indentation", "height"), [("5 um", -1), ("-5 um", 1), ("0 um", 0), (-5e-6, 1), (0, 0)])
def test_an_indentation_may_be_zero_or_a_gap(indentation, height):
    contact = softlube.Contact(**(BALL | {"load": None, "indentation": indentation}))
    assert contact.problem().height == height
    beta = (2 / 3) * (5e-6) ** 2 / 2e-3 * math.pi * 1e6 / (2.0 * 1e-4)
    assert contact.problem().beta == pytest.approx(beta if height else 1, rel=1e-12)
    assert contact.unit_length == pytest.approx(math.sqrt(2e-3 * contact.unit_height))


@pytest.mark.parametrize(
    ("change", "fragment"),
    [
        ({"load": "20 N"}, "contact radius is"),
        ({"roughness": "1 um"}, "0.079 times the roughness (boundary lubrication"),
        ({"viscosity": "1 uPa s", "speed": "1 km/s"}, "Reynolds number"),
        ({"thickness": "2 mm"}, "compared with a half-space that changes: indentation of a dry contact -12 %"),
    ],
)
def test_doubtful_physics_is_warned_of(physical, change, fragment):
    contact = softlube.Contact(**(BALL | change))
    assert any(fragment in doubt for doubt in contact.doubts(contact.dimensional(physical.quantities)))


def test_over_a_gap_the_doubt_is_about_the_width_of_the_pressure(physical):
    """√(2Rh₀) in place of the contact radius; a slab is stiffer only under a contact."""
    wide = softlube.Contact(**(BALL | {"load": None, "indentation": "-0.2 mm", "thickness": "0.1 mm"}))
    quantities = physical.quantities | {"height": softlube.Quantity(1.0, 0.0)}
    doubts = wide.doubts(wide.dimensional(quantities))
    assert any("the pressure reaches 0.45 R" in doubt for doubt in doubts)
    assert not any("slab" in doubt for doubt in doubts)
    narrow = softlube.Contact(**(BALL | {"load": None, "indentation": "-5 um"}))
    assert not any("pressure reaches" in doubt for doubt in narrow.doubts(narrow.dimensional(quantities)))


def test_sound_physics_is_not_warned_of(physical):
    assert physical.warnings == ()
    careful = softlube.Contact(**BALL, roughness="1 nm", thickness="50 mm")
    assert careful.doubts(careful.dimensional(physical.quantities)) == ()


def test_a_contact_wider_than_the_sphere_is_refused():
    wide = softlube.Contact(**BALL | {"load": "2 kN"})
    with pytest.raises(softlube.InputError, match=r"load: makes a contact of radius .* R, wider than the sphere"):
        wide.problem()
    with pytest.raises(softlube.InputError, match="indentation: makes a contact"):
        softlube.Contact(**BALL | {"load": None, "indentation": "3 mm"}).solve()


def test_doubts_are_heard():
    with pytest.warns(softlube.ValidityWarning, match="beyond 0.3 R linear elasticity"):
        softlube.Contact(**BALL | {"load": "20 N"}).solve(accuracy=1e-2)


def test_a_shear_stress_that_no_liquid_bears_is_said_to_be_unphysical():
    """Steel on steel with Roelands' oil, in pure sliding: the Newtonian friction coefficient is above 1."""
    steel = softlube.Contact(
        radius="10 mm", young_modulus="115 GPa", poisson_ratio=0.3, viscosity="0.1 Pa s", speed="1 m/s", load="50 N",
        pressure_viscosity="20 GPa^-1", viscosity_law="roelands", density_law="dowson-higginson",
    )  # fmt: skip
    solution = steel.solve(accuracy=1e-2)
    assert solution.dimensional["friction_coefficient"] > 0.1
    assert any("no liquid stays Newtonian" in doubt for doubt in solution.warnings)
    soft = softlube.Contact(**BALL | {"load": "100 uN"}).solve(accuracy=1e-2)  # a thick film under kilopascals
    assert soft.dimensional["friction_coefficient"] > 0.005
    assert not any("Newtonian" in doubt for doubt in soft.warnings)


@pytest.mark.parametrize("thickness", ["2 mm", "0.3 mm"])
def test_the_radius_is_that_of_the_dry_contact_on_the_substrate(thickness):
    """Quantities at r = a agree between a load and the indentation that it makes, but for the film under the sphere."""
    by_load = softlube.Contact(**BALL, thickness=thickness).solve()
    depth = float(by_load.dimensional["indentation"])
    by_depth = softlube.Contact(**BALL | {"load": None, "indentation": depth}, thickness=thickness).solve()
    half_space = softlube.Contact(**BALL).solve()
    assert by_load.dimensional["contact_radius"] < half_space.dimensional["contact_radius"]
    for name in ("contact_radius", "friction_total", "friction_contact", "friction_domain", "load_contact"):
        assert by_depth.dimensional[name] == pytest.approx(float(by_load.dimensional[name]), rel=1e-2), name


def test_every_physical_input_has_a_unit_and_an_example():
    for name, each in declared().items():
        if not each.is_text:
            assert to_si(name, each.example) > 0


def test_two_bodies_and_rolling_as_parts_as_inputs_and_from_a_file(tmp_path):
    by_inputs = softlube.Contact(
        radius="2 mm",
        ball_young_modulus="5 MPa",
        ball_poisson_ratio=0.3,
        substrate_radius="-5 mm",
        young_modulus="3 MPa",
        thickness="0.4 mm",
        viscosity="2 Pa s",
        entrainment_speed="0.5 mm/s",
        slide_to_roll=-0.5,
        load="100 mN",
    )
    by_parts = softlube.Contact(
        indenter=softlube.Sphere("2 mm", young_modulus="5 MPa", poisson_ratio=0.3),
        substrate=softlube.Layer("3 MPa", thickness="0.4 mm", radius="-5 mm"),
        liquid=softlube.Newtonian("2 Pa s"),
        motion=softlube.Rolling("0.5 mm/s", slide_to_roll=-0.5),
        load="100 mN",
    )
    assert by_inputs == by_parts == softlube.Contact.from_inputs(by_parts.inputs())
    assert (by_parts.speed, by_parts.slide_to_roll, by_parts.speed_sum) == (None, -0.5, 1e-3)
    assert (by_parts.radius, by_parts.substrate_radius, by_parts.ball_young_modulus) == (2e-3, -5e-3, 5e6)
    solution = by_parts.solve(accuracy=1e-2)
    solution.save(tmp_path / "rig.nc")
    again = softlube.load(tmp_path / "rig.nc")
    assert again.contact == by_parts
    assert again.problem == solution.problem
    assert again.problem.substrate.share == by_parts.substrate_share
