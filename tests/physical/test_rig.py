"""Two elastic bodies and two moving surfaces, against the formulas they stand for."""

import math

import pytest

import softlube
from softlube import Rig
from softlube.physical.rig import hertz_force

SOFT = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}
LOAD = {"load": "100 mN", "entrainment_speed": "0.05 mm/s"}


def test_a_rigid_ball_on_a_flat_is_the_paper_s_contact(contact):
    assert Rig(**SOFT).contact(**LOAD).problem().beta_load == pytest.approx(contact.problem().beta_load, rel=1e-14)
    assert Rig(**SOFT).contact(**LOAD).shear_modulus == pytest.approx(contact.shear_modulus, rel=1e-14)


def test_two_bodies_become_the_rigid_sphere_as_one_modulus_grows():
    rigid = Rig(**SOFT)
    off = []
    for modulus in (3e7, 3e8, 3e9, 3e10):
        both = Rig(**SOFT, ball_young_modulus=modulus, ball_poisson_ratio=0.3)
        off.append(1 - both.reduced_modulus / rigid.reduced_modulus)
        # 1/E* adds: what is missing is (1 − 0.3²)/(1 − 0.5²) E₂/E₁ to first order
        assert off[-1] == pytest.approx((0.91 / 0.75) * 3e6 / modulus, rel=0.15)
    assert off == sorted(off, reverse=True)
    assert off[-1] < 2e-4


def test_equal_bodies():
    both = Rig(**SOFT, ball_young_modulus="3 MPa", substrate_radius="2 mm")
    assert both.reduced_modulus == pytest.approx(Rig(**SOFT).reduced_modulus / 2)
    assert both.reduced_radius == pytest.approx(1e-3)
    swapped = Rig(
        radius="5 mm",
        young_modulus="1 MPa",
        poisson_ratio=0.4,
        ball_young_modulus="7 MPa",
        ball_poisson_ratio=0.2,
        viscosity=1.0,
        substrate_radius="2 mm",
    )
    other = Rig(
        radius="2 mm",
        young_modulus="7 MPa",
        poisson_ratio=0.2,
        ball_young_modulus="1 MPa",
        ball_poisson_ratio=0.4,
        viscosity=1.0,
        substrate_radius="5 mm",
    )
    assert swapped.reduced_modulus == pytest.approx(other.reduced_modulus)
    assert swapped.reduced_radius == pytest.approx(other.reduced_radius)


def test_the_paper_s_pair_has_four_times_g():
    assert Rig(**SOFT).reduced_modulus == pytest.approx(4 * 1e6)


def test_hersey_number_and_unit_of_friction():
    rig = Rig(**SOFT)
    assert rig.hersey(0.1, 5e-5) == pytest.approx(2 * 5e-5 * 2e-3 / 0.1)
    contact = rig.contact(**LOAD)
    # N = (16/3) G √R δ^(3/2), so that (2π/3) G δ² = (π/8) N √(δ/R)
    assert hertz_force(contact) == pytest.approx(math.pi / 8 * 0.1 * math.sqrt(contact.unit_height / 2e-3))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"radius": None}, "radius: missing"),
        ({"poisson_ratio": 0.6}, "poisson_ratio: expected"),
        ({"ball_poisson_ratio": "half"}, "ball_poisson_ratio: expected"),
        ({"ball_young_modulus": "3 mm"}, "ball_young_modulus: 3 mm has the wrong dimension"),
        ({"substrate_radius": "-1 mm"}, "substrate_radius: expected a positive"),
        ({"viscosity": "2 Pa"}, "viscosity: 2 Pa has the wrong dimension"),
    ],
)
def test_bad_input(change, message):
    with pytest.raises(softlube.InputError, match=message):
        Rig(**SOFT | change)
