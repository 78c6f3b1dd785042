"""Velocity, stress and flux: walls, averages, derivatives and conservation, none of which knows how the code computes them."""

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

import softlube
from softlube import flow
from softlube.model.liquids import LimitingStressLaw, NewtonianLaw
from softlube.readout.free_boundary import is_wet


@pytest.fixture(scope="module")
def full_film():
    return softlube.solve(beta=300, cavitation="none", accuracy=0.01)


R, THETA = np.meshgrid([0.0, 0.3, 0.9, 1.0, 1.2, 2.5], [0.0, 0.8, 2.0, -2.6, np.pi], indexing="ij")


@pytest.mark.parametrize("frame", ["substrate", "sphere"])
def test_no_slip_at_both_walls_exactly(solution, frame):
    moves = 1.0 if frame == "substrate" else 0.0
    sphere, substrate = flow.sphere_height(solution, R), flow.substrate_height(solution, R, THETA)
    for where in ({"z": sphere}, {"level": 1.0}):
        v_r, v_t = flow.velocity(solution, R, THETA, **where, frame=frame)
        assert np.array_equal(v_r, moves * np.cos(THETA))
        assert np.array_equal(v_t, -moves * np.sin(THETA))
    for where in ({"z": substrate}, {"level": 0.0}):
        v_r, v_t = flow.velocity(solution, R, THETA, **where, frame=frame)
        assert np.array_equal(v_r, (moves - 1) * np.cos(THETA))
        assert np.array_equal(v_t, -(moves - 1) * np.sin(THETA))


def test_nothing_flows_outside_the_film(solution):
    v_r, v_t = flow.velocity(solution, 0.5, 1.0, z=[-3.0, 0.5])
    assert np.isnan(v_r).all()
    assert np.isnan(v_t).all()


def test_velocity_is_that_of_equation_23(solution):
    """Written out as printed, with the pressure gradient by central differences."""
    r, theta, level = 0.97, 0.6, 0.3
    fields, step = solution.fields, 1e-5
    u, w, h = fields.film_at(r, theta), flow.substrate_height(solution, r, theta), flow.sphere_height(solution, r)
    z = w + level * u
    p_r = (fields.pressure_at(r + step, theta) - fields.pressure_at(r - step, theta)) / (2 * step)
    p_t = (fields.pressure_at(r, theta + step) - fields.pressure_at(r, theta - step)) / (2 * step)
    v_r, v_t = flow.velocity(solution, r, theta, z=z)
    assert v_r == pytest.approx(3 * 1000 * (z - w) * (z - h) * p_r + (z - w) / u * np.cos(theta), rel=1e-6)
    assert v_t == pytest.approx(3 * 1000 * (z - w) * (z - h) * p_t / r - (z - w) / u * np.sin(theta), rel=1e-6)


def test_average_is_the_integral_through_the_film(solution):
    x, weight = leggauss(4)
    level = ((x + 1) / 2)[:, None, None]
    for got, want in zip(flow.velocity(solution, R, THETA, level=level), flow.mean_velocity(solution, R, THETA), strict=True):
        assert np.tensordot(weight / 2, got, 1) == pytest.approx(want, abs=1e-13)


def test_shear_is_the_derivative_of_the_velocity(solution):
    r, theta = np.array([0.5, 0.99, 1.05]), np.array([0.4, 1.5, 0.1])
    u = solution.fields.film_at(r, theta)
    for level in (0.2, 0.5, 0.9):
        d = 1e-5
        upper, lower = (np.array(flow.velocity(solution, r, theta, level=level + s * d)) for s in (1, -1))
        v_r, v_t = (upper - lower) / (2 * d * u)
        tau_x, tau_y = flow.shear_stress(solution, r, theta, level=level)
        assert tau_x == pytest.approx(v_r * np.cos(theta) - v_t * np.sin(theta), rel=1e-6)
        assert tau_y == pytest.approx(v_r * np.sin(theta) + v_t * np.cos(theta), rel=1e-6, abs=1e-6)


def test_largest_wall_shear_is_the_solution_s(solution):
    r, theta = np.meshgrid(np.linspace(0.9, 1.05, 301), np.linspace(np.pi / 2, np.pi, 181), indexing="ij")
    walls = [np.hypot(*flow.shear_stress(solution, r, theta, level=level)).max() for level in (0, 1)]
    assert max(walls) == pytest.approx(solution.shear_rate_max, rel=3e-3)


def test_film_thins_the_flow_as_a_rigid_contact_does():
    """Where the pressure is Hertz's the flux is Couette's: −u/2 in the frame of the sphere, whatever the β."""
    solution = softlube.solve(beta=1e4, accuracy=0.01)
    q_r, q_t = flow.flux(solution, 0.5, np.array([0.0, np.pi / 2, np.pi]))
    half = solution.fields.film_at(0.5, np.array([0.0, np.pi / 2, np.pi])) / 2
    assert q_r == pytest.approx([-half[0], 0, half[2]], abs=0.04 * half[0])
    assert q_t == pytest.approx([0, half[1], 0], abs=0.04 * half[0])


@pytest.mark.parametrize("radius", [0.3, 0.6, 0.9, 1.0])
def test_liquid_is_conserved_within_the_contact(solution, full_film, radius):
    assert abs(flow.net_flux(solution, radius)) < 2e-4
    assert abs(flow.net_flux(full_film, radius)) < 1e-3


@pytest.mark.parametrize("radius", [1.1, 1.5, 3.0, 8.0])
def test_liquid_is_conserved_around_the_free_boundary(solution, full_film, radius):
    assert abs(flow.net_flux(full_film, radius)) < 6e-3
    # The broken film carries what crosses the free boundary, whose place is known to a part of a cell.
    assert abs(flow.net_flux(solution, radius)) < 0.015


def test_without_the_filling_liquid_would_appear_from_nowhere(solution):
    angle = np.linspace(0, np.pi, 2001)
    full = np.array(flow.mean_velocity(solution, 2.0, angle, frame="sphere")[0]) * solution.fields.film_at(2.0, angle)
    assert np.trapezoid(full, angle) > 0.3 * np.trapezoid(np.abs(full), angle) / 2


def test_stream_function_is_constant_along_streamlines(solution):
    angle = np.array([0.05, 0.4, 0.9])
    lines = flow.streamlines(solution, 1.9 * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    assert len(lines) == 3
    for line in lines:
        assert line[-1, 0] < -0.5  # from the inlet to the outlet
        r, theta = np.hypot(*line.T), np.arctan2(line[:, 1], line[:, 0])
        psi = flow.stream_function(solution, r, theta)[is_wet(solution, r, theta)]
        assert np.all(psi > 0)
        assert np.ptp(psi) < 0.01 * psi[0]


def test_streamlines_mirror_and_streak(solution):
    """The plane's symmetry; and behind the free boundary, straight lines."""
    up, down = flow.streamlines(solution, [(1.5, 0.5), (1.5, -0.5)])
    assert up[-1] * [1, -1] == pytest.approx(down[-1], abs=1e-6)
    r, theta = np.hypot(*up.T), np.arctan2(up[:, 1], up[:, 0])
    dry = ~is_wet(solution, r, theta)
    assert dry.any()
    assert np.ptp(up[dry][:, 1]) < 1e-6


def test_section_lines_turn_back_before_the_contact(solution):
    """Only what is near the substrate enters: above it the liquid turns round in front of the inlet."""
    low, high = flow.section_streamlines(solution, [(1.5, 0.02), (1.5, 0.3)])
    assert low[-1, 0] < -1
    assert high[:, 0].min() > 1
    assert high[-1, 0] == pytest.approx(2.0, abs=0.01)
    for line in (low, high):
        assert np.all((line[:, 1] >= 0) & (line[:, 1] <= 1))


def test_upstream_and_downstream_are_one_line(solution):
    (down,) = flow.section_streamlines(solution, [(1.5, 0.02)])
    middle = down[len(down) // 2]
    (both,) = flow.section_streamlines(solution, [middle], upstream=True)
    assert np.any(np.all(both == middle, axis=1))
    assert both[0, 0] > 1.5 > -0.9 > both[-1, 0]
    assert np.interp(-1.5, -both[:, 0], both[:, 1]) == pytest.approx(0.02, rel=0.02)
    (plane,) = flow.streamlines(solution, [(0.0, 0.4)], upstream=True)
    assert plane[0, 0] > 1.5
    assert plane[-1, 0] < -1.5


def test_section_lines_conserve_flux(full_film):
    """In a plane of symmetry nearby lines keep the flux between them but for the spreading sideways, (1/u)∂q_y/∂y."""
    # Level as a function of x along a line: compare with continuity integrated by hand through the film.
    (line,) = flow.section_streamlines(full_film, [(1.1, 0.4)])
    x, level = (line[0] + line[1]) / 2
    slope = (line[1, 1] - line[0, 1]) / (line[1, 0] - line[0, 0])
    d, nodes = 1e-4, leggauss(6)
    zeta, weight = level * (nodes[0] + 1) / 2, level * nodes[1] / 2

    def carried(px, py):
        """U times the velocity below the level, in the frame of the sphere."""
        r, theta = np.hypot(px, py), np.arctan2(py, px)
        v_r, v_t = flow.velocity(full_film, r, theta, level=zeta, frame="sphere")
        u = full_film.fields.film_at(r, theta)
        v_x, v_y = v_r * np.cos(theta) - v_t * np.sin(theta), v_r * np.sin(theta) + v_t * np.cos(theta)
        return u * np.array([weight @ v_x, weight @ v_y])

    divergence = (carried(x + d, 0)[0] - carried(x - d, 0)[0]) / (2 * d) + (carried(x, d)[1] - carried(x, -d)[1]) / (2 * d)
    rise = -divergence / full_film.fields.film_at(x, 0.0)
    v_x = flow.velocity(full_film, x, 0.0, level=level, frame="sphere")[0]
    assert slope == pytest.approx(rise / v_x, rel=0.03)


def test_bad_input_is_refused(solution):
    with pytest.raises(softlube.InputError, match="z, level: give exactly one"):
        flow.velocity(solution, 1.0, 0.0)
    with pytest.raises(softlube.InputError, match="frame: expected 'substrate' or 'sphere', got 'earth'"):
        flow.mean_velocity(solution, 1.0, 0.0, frame="earth")


def test_a_limited_liquid_that_rolls_has_its_walls_and_its_stress():
    """The flux knows no limit; the walls move at the slide-to-roll ratio, and the mean stress is the limited one."""
    law = LimitingStressLaw(NewtonianLaw(), 0.02, 0.0)
    rolling = softlube.solve(beta=300, liquid=law, slide_to_roll=0.5, accuracy=0.01)
    sphere, substrate = (flow.velocity(rolling, R, 0.0, level=level, frame="sphere")[0] for level in (1.0, 0.0))
    assert sphere == pytest.approx(-0.375)
    assert substrate == pytest.approx(-0.625)
    mean = (flow.shear_stress(rolling, R, THETA, level=1.0)[0] + flow.shear_stress(rolling, R, THETA, level=0.0)[0]) / 2
    sheared = 0.25 / rolling.fields.film_at(R, THETA)
    assert mean == pytest.approx(300 * 0.02 * (1 - np.exp(-sheared / 300 / 0.02)))
