"""Parts of the friction, and forces that must balance."""

import numpy as np
import pytest

import softlube
from softlube import friction


@pytest.fixture(scope="module")
def solutions():
    return [
        softlube.solve(beta=beta, cavitation=condition, accuracy=0.01)
        for beta, condition in ((10, "reynolds"), (300, "none"), (1e4, "reynolds"))
    ]


def test_the_sphere_s_shear_is_the_solution_s_friction(solution):
    assert friction.split(solution, 2.0).sphere == pytest.approx(solution.friction_domain, rel=1e-12)
    assert friction.split(solution, 1.0).sphere == pytest.approx(solution.friction_contact, rel=1e-12)


def test_horizontal_forces_on_the_film_balance_at_every_cutoff(solution, solutions):
    for case in (solution, *solutions):
        for part in friction.against_cutoff(case, [0.7, 1.0, 2.0, 10.0]):
            assert abs(part.imbalance) < 1e-6


def test_the_half_space_does_not_drag_itself(solution, solutions):
    """∫p ∂w/∂x dA = 0 by the symmetry of (2): joins the solver's elasticity with its pressure."""
    for case in (solution, *solutions):
        whole = friction.split(case, float(case.fields.r[-1]))
        assert abs(whole.substrate_pressure) < 3e-5 * whole.drag
        assert whole.drag == pytest.approx(whole.substrate + whole.edge_force, rel=1e-4)
        # what balances is no matter of smallness: the contact alone does drag itself
        assert abs(friction.split(case, 1.0).substrate_pressure) > 0.03 * whole.drag


BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "load": "100 mN"}
RIGS = {
    "layer": {"thickness": "0.4 mm", "poisson_ratio": 0.45, "speed": "1 mm/s"},
    "oil": {"pressure_viscosity": "4 MPa^-1", "speed": "0.3 mm/s"},
    "two bodies": {"ball_young_modulus": "5 MPa", "ball_poisson_ratio": 0.3, "substrate_radius": "-5 mm", "speed": "1 mm/s"},
    "all": {
        "thickness": "0.2 mm",
        "ball_young_modulus": "5 MPa",
        "ball_poisson_ratio": 0.3,
        "substrate_radius": "5 mm",
        "pressure_viscosity": "4 MPa^-1",
        "entrainment_speed": "0.5 mm/s",
        "slide_to_roll": 0.4,
    },
}


@pytest.mark.parametrize("rig", RIGS)
def test_forces_on_the_ball_balance_whatever_the_bodies_and_the_liquid(rig):
    """The shear on the ball with the pressure's push is the shear on the substrate, because neither body drags itself."""
    solution = softlube.Contact(**BALL | RIGS[rig]).solve(accuracy=1e-2)
    whole = friction.split(solution, float(solution.fields.r[-1]))
    assert abs(whole.imbalance) < 1e-6
    assert abs(whole.substrate_pressure) < 1e-4 * whole.drag
    assert whole.drag == pytest.approx(whole.substrate + whole.edge_force, rel=1e-4)
    # each part is much larger than what is left
    assert abs(whole.sphere_pressure) > 0.01 * whole.drag


def test_edge_force_of_the_far_field(solutions):
    """Far out p = (4/5β) cos θ/r³ and u = r²/2 leave 6∮pu cos θ ds = 2.4π/β, without decay."""
    full = solutions[1]
    part = friction.split(full, 15.0)
    assert part.edge_force == pytest.approx(2.4 * np.pi / 300, rel=0.03)


def test_couette_part_is_that_of_a_flat_film_in_the_hertz_limit(solutions):
    """Under a Hertz contact u depends on y alone, so that ∫dA/u over the core follows from the film on the y axis."""
    heavy = solutions[2]
    y, weight = np.polynomial.legendre.leggauss(40)
    y, weight = 0.5 * y, 0.5 * weight
    film = heavy.fields.film_at(np.abs(y), np.pi / 2)
    chord = 2 * np.sqrt(0.25 - y**2)
    assert friction.split(heavy, 0.5).couette == pytest.approx(np.sum(weight * chord / film) / 1e4, rel=0.01)


def test_vertical_forces_balance(solution, solutions):
    for case in (solution, *solutions):
        balance = friction.vertical_balance(case)
        assert balance.load == case.load
        assert balance.imbalance < 1.5e-4


def test_a_cutoff_beyond_the_solution_is_refused(solution):
    with pytest.raises(ValueError, match="cutoff: expected a radius between 0 and"):
        friction.split(solution, 1e3)


def test_the_vertical_balance_is_that_of_a_half_space():
    layered = softlube.solve(beta=50, substrate=softlube.substrates.LayerKernel(1.0), accuracy=0.05)
    with pytest.raises(softlube.InputError, match="vertical balance"):
        friction.vertical_balance(layered)
