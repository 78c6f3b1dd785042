"""Units of the problem, β and Hertz's indentation in SI against formulas written for E* = E/(1 − ν²)."""

import math

import numpy as np
import pytest

import softlube
from softlube.errors import InputError
from softlube.model.dry import dry_contact_at
from softlube.model.exact import HERTZ_LOAD
from softlube.model.substrates import HalfSpaceKernel, LayerKernel
from softlube.physical.materials import dry_effect, layer_doubt

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}


@pytest.mark.parametrize("poisson_ratio", [0.3, 0.5])
def test_hertz(poisson_ratio):
    """δ = (9N²/(16 E*² R))^(1/3), the textbook's form, where the package computes with G/(2(1 − ν))."""
    contact = softlube.Contact(**BALL, poisson_ratio=poisson_ratio)
    reduced = 3e6 / (1 - poisson_ratio**2)
    assert contact.hertz_indentation(0.1) == pytest.approx((9 * 0.1**2 / (16 * reduced**2 * 2e-3)) ** (1 / 3), rel=1e-12)


def test_units_of_the_problem_make_up_hertz_s_contact():
    """The mean pressure and the load of a dry contact, and β with its definition in E*: (1/6)(h²/R) πE*/(ηv)."""
    contact = softlube.Contact(**BALL)
    depth = contact.hertz_indentation(0.1)
    units = {name: value for name, (value, _) in contact.scales(depth).items()}
    assert units["length"] == pytest.approx(math.sqrt(2e-3 * depth))
    assert units["load"] * 4 / (3 * math.pi) == pytest.approx(0.1, rel=1e-12)
    peak = 1.5 * 0.1 / (math.pi * 2e-3 * depth)
    assert units["pressure"] * 2 / math.pi**2 == pytest.approx(peak, rel=1e-12)
    assert units["volume"] == pytest.approx(2e-3 * depth**2)
    assert contact.beta(depth, 1e-4) == pytest.approx(depth**2 / 2e-3 * math.pi * 4e6 / (6 * 2 * 1e-4), rel=1e-12)


def test_a_beta_that_is_no_number_is_refused():
    contact = softlube.Contact(**BALL)
    with pytest.raises(InputError, match="beta = inf"):
        contact.beta(1e200, 1e-300)
    with pytest.raises(InputError, match="beta = 0"):
        contact.beta(1e-200, 1.0)


def test_inputs_of_parts_are_attributes_and_those_of_other_parts_are_none():
    contact = softlube.Contact(**BALL, pressure_viscosity="20 GPa^-1")
    assert (contact.radius, contact.viscosity, contact.pressure_viscosity) == (2e-3, 2.0, pytest.approx(2e-8))
    assert contact.thickness is None
    assert (contact.viscosity_law, contact.density_law) == ("barus", "constant")
    with pytest.raises(AttributeError, match="thicknes"):
        _ = contact.thicknes


def test_a_law_that_hardly_acts_is_told():
    """α p = 10⁻³ raises the viscosity by 0.1 %, α p = 1 by a factor of e."""
    contact = softlube.Contact(**BALL, pressure_viscosity="1 GPa^-1")
    (doubt,) = contact.thickening_doubt(1e6)
    assert "viscosity rises by 0.1 %" in doubt
    assert contact.thickening_doubt(1e9) == []
    assert softlube.Contact(**BALL).thickening_doubt(1e6) == []


def test_what_a_layer_does_to_the_dry_contact():
    """None on a half-space; on a thick layer the first term of the series of Dimitriadis et al. for a bonded layer, 1.133 χ."""
    for by_load in (True, False):
        _, changes = dry_effect(HalfSpaceKernel(), by_load=by_load)
        assert next(iter(changes.values())) == (pytest.approx(0, abs=1e-12), 0.0)
    thickness = 100.0
    _, changes = dry_effect(LayerKernel(thickness), by_load=False)
    share, _ = changes["load of a dry contact"]
    assert share == pytest.approx(1.133 / thickness, rel=0.03)


def test_a_layer_is_spoken_of_where_it_matters():
    substrate = LayerKernel(1.0)
    dry = dry_contact_at(substrate, indentation=1.0)
    assert layer_doubt(dry, substrate, {"film": (0.049, 0.0)}) == []
    (doubt,) = layer_doubt(dry, substrate, {"film": (0.12, 0.001), "friction": (1e-4, 1e-3)})
    assert f"{1 / dry.radius:.2g} radii of its dry contact thick" in doubt
    assert "film +12 % (± 0.1 %)" in doubt
    assert "friction less than 0.1 %" in doubt


def test_a_layer_under_a_compressible_liquid_of_constant_viscosity_is_solved():
    """Its warning compared with the master curve, which refuses such a liquid, after the contact had been solved."""
    contact = softlube.Contact(**BALL, thickness="0.5 mm", density_law="dowson-higginson")
    solution = contact.solve(accuracy=1e-2)
    assert np.isfinite(solution.dimensional["film_center"])
    assert any("dry contact thick" in warning for warning in solution.warnings)


def test_a_sphere_that_just_touches_a_layer_is_solved():
    """There is no dry contact, so nothing is said of what the thickness does to it; the master curve was asked all the same."""
    contact = softlube.Contact(**{**BALL, "load": None, "indentation": 0.0}, thickness="2 mm")
    assert contact.solve(accuracy=1e-2).dimensional["film_center"] > 0


# --- two bodies -------------------------------------------------------------------------------------------------------


def dry(contact):
    """Radius [m] and indentation [m] of the dry contact, on whatever the bodies are."""
    found = dry_contact_at(contact.substrate_for(contact.unit_height), load=HERTZ_LOAD)
    return found.radius * contact.unit_length, found.indentation * contact.unit_height


def test_two_half_spaces_and_two_curvatures_are_hertz_s():
    """a³ = 3NR/(4E*) and δ = a²/R, Johnson 1985, Eqs. (4.22) and (4.23)."""
    contact = softlube.Contact(
        **BALL | {"young_modulus": "64 GPa"},
        poisson_ratio=0.2,
        ball_young_modulus="210 GPa",
        ball_poisson_ratio=0.3,
        substrate_radius="5 mm",
    )
    modulus = 1 / ((1 - 0.3**2) / 210e9 + (1 - 0.2**2) / 64e9)
    radius = 1 / (1 / 2e-3 + 1 / 5e-3)
    assert 4 * contact.contact_modulus == pytest.approx(modulus, rel=1e-14)
    assert contact.reduced_radius == pytest.approx(radius, rel=1e-14)
    width = (3 * 0.1 * radius / (4 * modulus)) ** (1 / 3)
    assert dry(contact) == pytest.approx((width, width**2 / radius), rel=1e-12)


def test_bodies_may_be_swapped():
    one = {"young_modulus": "1 MPa", "poisson_ratio": 0.4, "ball_young_modulus": "7 MPa", "ball_poisson_ratio": 0.2}
    two = {"young_modulus": "7 MPa", "poisson_ratio": 0.2, "ball_young_modulus": "1 MPa", "ball_poisson_ratio": 0.4}
    first = softlube.Contact(**BALL | one | {"radius": "2 mm", "substrate_radius": "5 mm"})
    second = softlube.Contact(**BALL | two | {"radius": "5 mm", "substrate_radius": "2 mm"})
    assert first.problem().beta_load == pytest.approx(second.problem().beta_load, rel=1e-13)


@pytest.mark.parametrize("thickness", [None, "0.2 mm"])
def test_a_ball_of_growing_modulus_is_the_rigid_one(thickness):
    layer = {"thickness": thickness, "poisson_ratio": 0.45}
    rigid = dry(softlube.Contact(**BALL, **layer))
    off = [
        dry(softlube.Contact(**BALL, **layer, ball_young_modulus=modulus))[1] / rigid[1] - 1 for modulus in (3e9, 3e12, 3e17)
    ]
    assert off[0] > 5e-4  # by the ratio of the compliances
    assert off[1] == pytest.approx(off[0] / 1e3, rel=0.01)
    assert abs(off[2]) < 1e-10


def test_a_growing_thickness_gives_two_half_spaces():
    balls = BALL | {"ball_young_modulus": "5 MPa", "ball_poisson_ratio": 0.3}
    two = dry(softlube.Contact(**balls))
    off = [dry(softlube.Contact(**balls, thickness=thickness))[1] / two[1] - 1 for thickness in (1e2, 1e4, 1e8)]
    assert off[1] == pytest.approx(off[0] / 100, rel=0.01)
    assert abs(off[2]) < 1e-10


def test_a_soft_ball_on_a_thin_layer_hardly_feels_it():
    """Share → 0: the layer's compliance is the small one, and the ball's Hertz contact on a rigid flat is left."""
    contact = softlube.Contact(**BALL | {"young_modulus": "3 GPa"}, thickness="20 um", ball_young_modulus="3 MPa")
    mirrored = softlube.Contact(**BALL)
    assert contact.substrate_share == pytest.approx(1e-3, rel=2e-3)
    assert dry(contact) == pytest.approx(dry(mirrored), rel=1e-3)


def test_a_sphere_must_fit_into_its_cup():
    cup = softlube.Contact(**BALL, substrate_radius="-4 mm")
    assert cup.reduced_radius == pytest.approx(4e-3)
    assert cup.steepness(1e-3) == pytest.approx(1e-3 / 2e-3)
    for radius in ("-2 mm", "-1 mm"):
        with pytest.raises(InputError, match=r"substrate_radius: a cup must be wider than the sphere, of 0\.002 m; got -0\.00"):
            softlube.Contact(**BALL, substrate_radius=radius)
