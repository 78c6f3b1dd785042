"""Profiles across the film of a liquid that thins: walls, averages, derivatives, the Newtonian limit."""

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

import softlube
from softlube import flow
from softlube.model.liquids import CarreauYasudaLaw, NewtonianLaw

R, THETA = np.meshgrid([0.0, 0.3, 0.9, 1.0, 1.2, 2.5], [0.0, 0.8, 2.0, -2.6, np.pi], indexing="ij")


@pytest.fixture(scope="module", params=[0.0, 0.5, 2.0])
def thinning(request):
    law = CarreauYasudaLaw(NewtonianLaw(), 100.0, 0.5)
    return softlube.solve(beta=300, liquid=law, slide_to_roll=request.param, accuracy=0.01)


@pytest.mark.parametrize("frame", ["substrate", "sphere"])
def test_no_slip_at_both_walls_exactly(thinning, frame):
    slip = thinning.problem.slide_to_roll / 2
    substrate = 0.0 if frame == "substrate" else -0.5 - slip / 2
    for level, wall in ((0.0, substrate), (1.0, substrate + slip)):
        v_r, v_t = flow.velocity(thinning, R, THETA, level=level, frame=frame)
        assert v_r == pytest.approx(wall * np.cos(THETA), abs=1e-15)
        assert v_t == pytest.approx(-wall * np.sin(THETA), abs=1e-15)


def test_the_velocity_has_no_jump_in_the_middle(thinning):
    below, above = (np.stack(flow.velocity(thinning, R, THETA, level=0.5 + side)) for side in (-1e-9, 1e-9))
    assert above == pytest.approx(below, abs=3e-6)


def test_average_is_the_integral_through_the_film(thinning):
    x, weight = leggauss(40)
    level = ((x + 1) / 2)[:, None, None]
    for got, want in zip(flow.velocity(thinning, R, THETA, level=level), flow.mean_velocity(thinning, R, THETA), strict=True):
        assert np.tensordot(weight / 2, got, 1) == pytest.approx(want, abs=3e-6)


def test_the_shear_rate_is_the_derivative_of_the_velocity(thinning):
    step, film = 1e-5, thinning.fields.film_at(R, THETA)
    ahead, behind = (flow.velocity(thinning, R, THETA, level=0.7 + side * step) for side in (1, -1))
    slope = [(one - two) / (2 * step) / film for one, two in zip(ahead, behind, strict=True)]
    rate_x, rate_y = flow.shear_rate(thinning, R, THETA, level=0.7)
    assert slope[0] * np.cos(THETA) - slope[1] * np.sin(THETA) == pytest.approx(rate_x, abs=1e-5 * np.abs(rate_x).max())
    assert slope[0] * np.sin(THETA) + slope[1] * np.cos(THETA) == pytest.approx(rate_y, abs=1e-5 * np.abs(rate_x).max())


def test_stress_is_viscosity_times_shear_rate(thinning):
    stress = flow.shear_stress(thinning, R, THETA, level=0.2)[0]
    viscosity = flow.viscosity(thinning, R, THETA, level=0.2)
    assert stress == pytest.approx(viscosity * flow.shear_rate(thinning, R, THETA, level=0.2)[0], rel=1e-9, abs=1e-9)
    assert np.all(viscosity <= 1 + 1e-12)


def test_without_thinning_they_are_the_parabola():
    plain, rest = (
        softlube.solve(beta=300, accuracy=0.01, liquid=law) for law in (None, CarreauYasudaLaw(NewtonianLaw(), 1e-9, 0.5))
    )
    for read in (flow.velocity, flow.shear_stress, flow.shear_rate):
        one, two = (np.stack(read(solution, R, THETA, level=0.3)) for solution in (plain, rest))
        assert two == pytest.approx(one, abs=1e-5 * np.abs(one).max())
    assert np.stack(flow.flux(rest, R, THETA)) == pytest.approx(np.stack(flow.flux(plain, R, THETA)), abs=1e-5)


def test_streamlines_in_the_section_are_refused(thinning):
    with pytest.raises(softlube.InputError, match="solution: its liquid thins with shear"):
        flow.section_streamlines(thinning, [(1.0, 0.3)])
