"""The line contact in SI: scales, motions, doubts, refusals."""

import math

import pytest

from softlube import Barus, Cylinder, HalfSpace, LineContact, Newtonian, Rolling, StandardLinearSolid, line
from softlube.errors import InputError, ValidityWarning

WIPER = {"radius": "10 mm", "young_modulus": "3 MPa", "viscosity": "1 Pa s", "speed": "10 mm/s", "load_per_length": "1 N/mm"}
ROLLER = {
    "cylinder": Cylinder("10 mm", young_modulus="210 GPa", poisson_ratio=0.3),
    "substrate": HalfSpace("210 GPa", poisson_ratio=0.3),
    "liquid": Newtonian("0.1 Pa s"),
    "load_per_length": "100 N/mm",
}


def test_hertz_in_si():
    """B = √(4N′R/(πE*)), p = 2N′/(πb) (Johnson 1985, §4.2(c))."""
    contact = LineContact(**ROLLER, motion=Rolling("0.1 m/s", slide_to_roll=0))
    modulus = 210e9 / (2 * (1 - 0.09))
    b = math.sqrt(4 * 1e5 * 0.01 / (math.pi * modulus))
    assert contact.unit_length == pytest.approx(b)
    scales = contact.scales(contact.unit_height)
    assert scales["pressure"][0] / (2 * math.pi) == pytest.approx(2 * 1e5 / (math.pi * b))
    assert scales["line_load"][0] / 4 == pytest.approx(1e5)
    # β = (2/3)(H²/R) πG/(ηv) with H = b²/R, G = E*/4 and v the sum of the speeds
    assert contact.problem().beta_load == pytest.approx(math.pi / 6 * b**4 * modulus / (0.01**3 * 0.1 * 0.2))


def test_quantities_in_si_are_those_of_the_problem():
    contact = LineContact(**WIPER)
    solution = contact.solve()
    alone = line.solve(contact.problem().beta_load)
    assert solution.dimensional["film_min"] == pytest.approx(alone.film_min * contact.unit_height, rel=1e-9)
    # friction: ηv∫dx/u over the film, in N/m
    assert solution.dimensional["friction_couette"] == pytest.approx(
        alone.friction_couette * 1 * 0.01 / contact.unit_height * contact.unit_length * alone.beta_load, rel=1e-9
    )
    assert solution.dimensional["friction_coefficient"] == pytest.approx(solution.dimensional["friction_total"] / 1000)


def test_slide_to_roll():
    """C S/2 − P and C S/2 + P; a cylinder that rolls without sliding is driven by the pressure alone."""
    sliding = LineContact(**WIPER).solve().dimensional
    inputs = {name: value for name, value in WIPER.items() if name != "speed"}
    rolling = LineContact(**inputs, entrainment_speed="5 mm/s", slide_to_roll=0).solve().dimensional
    assert rolling["film_min"] == pytest.approx(sliding["film_min"], rel=1e-9)
    assert rolling["friction_total"] == pytest.approx(-sliding["friction_poiseuille"], rel=1e-9)
    assert rolling["friction_shear"] == pytest.approx(sliding["friction_poiseuille"], rel=1e-9)
    assert math.isnan(rolling["shear_rate_max"])


def test_a_substrate_that_remembers():
    rubber = StandardLinearSolid("3 MPa", stiffening=10, relaxation_time="10 ms")
    inputs = {name: value for name, value in WIPER.items() if name != "young_modulus"}
    found = LineContact(**inputs, substrate=rubber).solve().dimensional
    assert found["friction_total"] == pytest.approx(found["friction_viscous"] + found["friction_hysteresis"], rel=1e-12)
    assert found["friction_hysteresis"] > 3 * found["friction_viscous"]
    # A surface at rest, seen from the contact, remembers nothing: the cylinder turns on it.
    del inputs["speed"]
    still = LineContact(**inputs, substrate=rubber, entrainment_speed="5 mm/s", slide_to_roll=-2).solve().dimensional
    assert "friction_hysteresis" not in still


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"load": "1 N"}, "load: no input; expected load_per_length"),
        ({"load_per_length": None}, "load_per_length: missing; expected a force per length such as '5 N/mm'"),
        ({"load_per_length": "5 N"}, "load_per_length: 5 N has the wrong dimension"),
        ({"indentation": "1 um"}, "indentation: no input"),
        ({"substrate_radius": "-9 mm"}, "substrate_radius: a cup must be wider"),
    ],
)
def test_refusals(given, message):
    with pytest.raises(InputError, match=message):
        LineContact(**WIPER | given)


def test_a_contact_wider_than_the_cylinder():
    with pytest.raises(InputError, match="load_per_length: makes a contact of radius"):
        LineContact(**WIPER | {"load_per_length": "1 kN/mm"}).solve()


def test_doubts():
    with pytest.warns(ValidityWarning, match="half-width is"):
        LineContact(**WIPER | {"load_per_length": "10 N/mm"}).solve()
    with pytest.warns(ValidityWarning, match="asperities"):
        LineContact(**WIPER, roughness="3 um").solve()
    with pytest.warns(ValidityWarning, match="inertia"):
        LineContact(**WIPER | {"viscosity": "1 mPa s", "speed": "20 m/s", "load_per_length": "10 N/m"}).solve()
    steel = ROLLER | {"liquid": Barus("0.1 Pa s", pressure_viscosity="10 GPa^-1")}
    with pytest.warns(ValidityWarning, match="limiting stress"):
        LineContact(**steel, speed="1 m/s").solve()
