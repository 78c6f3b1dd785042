"""Meshes about a spike's ridge: the same contact as on a mesh about its centre, wherever theirs is."""

from dataclasses import replace

import numpy as np
import pytest

import softlube
from softlube.discretization.grid import PolarGrid
from softlube.model.exact import HERTZ_PRESSURE
from softlube.model.liquids import BarusLaw, DowsonHigginsonLaw
from softlube.model.problem import Problem
from softlube.solvers.newton import newton
from softlube.steady.refinements.spike import crest as crests
from softlube.steady.refinements.spike.closeup import (
    ShiftedSystem,
    carried,
    circle_through,
    close_ups,
    falls,
    grid_about,
    ridge,
)
from softlube.steady.regime import Regime
from softlube.theory.engineering import BETA_LOAD_OF_M, alpha_of_moes


@pytest.fixture(scope="module")
def soft():
    return softlube.solve(beta_load=100.0)


@pytest.mark.parametrize("shift", [0.0, 0.3])
def test_a_contact_does_not_know_where_the_mesh_has_its_centre(soft, shift):
    grid = replace(grid_about(Regime.of(soft.problem), 26, shift, 0.6, 0.05), edge_width=0.15)
    system = ShiftedSystem(soft.problem, grid, 1.0, shift)
    result = newton(system, np.append(carried(soft.fields, grid, shift).ravel(), soft.height))
    assert result.converged
    fields = system.fields(result.x)
    assert fields.height == pytest.approx(soft.height, abs=5e-5)
    # The contact's centre is upstream of the mesh's.
    assert fields.film_at(shift, 0.0) == pytest.approx(soft.film_center, rel=5e-4)
    assert fields.film_at(1 - shift, np.pi) == pytest.approx(soft.fields.film_at(1.0, np.pi), rel=2e-3)
    assert fields.pressure_at(np.hypot(shift, 0.5), np.arctan2(0.5, shift)) == pytest.approx(
        soft.fields.pressure_at(0.5, np.pi / 2), rel=5e-4
    )


def test_pressures_are_carried_to_a_mesh_with_another_centre(soft):
    """What is linear in ξ and s in between is second order: a smooth pressure arrives within a per mil of its maximum."""
    shift = 0.25
    grid = PolarGrid(90, 40, edge_width=0.1)
    values = carried(soft.fields, grid, shift)
    r, theta = np.meshgrid(grid.r[: grid.n_r], grid.theta, indexing="ij")
    x, y = r * np.cos(theta) - shift, r * np.sin(theta)
    inside = np.hypot(x, y) < 0.9
    expected = soft.fields.pressure_at(np.hypot(x, y)[inside], np.arctan2(y, x)[inside])
    assert np.abs(values[inside] - expected).max() < 3e-3 * HERTZ_PRESSURE


def test_circle_through_points_of_one():
    phi = np.linspace(np.radians(130), np.pi, 9)
    shift, radius = circle_through(0.42 * np.cos(phi) - 0.325, 0.42 * np.sin(phi))
    assert (shift, radius) == pytest.approx((0.325, 0.42))


def test_close_ups_find_the_ridge_that_the_contact_shows(monkeypatch):
    """M = 20, L = 8: every mesh puts its circle where the last one saw the fall, within a few of that one's cells."""
    alpha = float(alpha_of_moes(20, 8))
    problem = Problem(beta_load=BETA_LOAD_OF_M * 20 ** (4 / 3), liquid=DowsonHigginsonLaw.of(BarusLaw(alpha), alpha / 20e-9))
    monkeypatch.setattr(crests, "resolve_spike", lambda *_: {})  # not here, but below
    solution = softlube.solve(beta_load=problem.beta_load, liquid=problem.liquid, accuracy=1e-2)
    seen = list(close_ups(Regime.of(problem), solution.fields, (1e-2, 2e-3, 5e-4), angles=26))
    assert len(seen) == 3
    for each, width, known in zip(seen, (1e-2, 2e-3, 5e-4), (0.025, 0.01, 0.003), strict=True):
        assert each.shift == pytest.approx(0.3101, abs=known)
        assert each.cell < 0.2 * width
        assert np.min(each.fields.film) == pytest.approx(np.min(solution.fields.film), rel=2e-3)
    last = seen[-1]
    x, y = ridge(last.fields, last.shift, last.radius)
    assert np.abs(np.hypot(x + last.shift, y) - last.radius).max() < 2e-3
    assert x[-1] == pytest.approx(-0.7318, abs=2e-4)
    assert np.array_equal(last.fall, falls(last.fields, last.radius))


def test_close_ups_end_where_newton_fails(soft):
    """From pressures that are no solution of anything: no mesh, rather than a wrong one."""
    alpha = float(alpha_of_moes(20, 30))
    problem = Problem(beta_load=BETA_LOAD_OF_M * 20 ** (4 / 3), liquid=DowsonHigginsonLaw.of(BarusLaw(alpha), alpha / 20e-9))
    hopeless = replace(soft.fields, pressure=soft.fields.pressure * 5, liquid=problem.liquid)
    assert list(close_ups(Regime.of(problem), hopeless, (1e-2,), angles=12)) == []


@pytest.mark.slow
def test_without_compressibility_the_spike_grows_with_every_mesh(monkeypatch):
    """M = 20: at L = 5.4 three meshes agree to 10⁻³; at L = 6 each of them has a spike a third higher than the last."""
    monkeypatch.setattr(crests, "resolve_spike", lambda *_: {})
    heights = {}
    for material in (5.4, 6.0):
        problem = Problem(beta_load=BETA_LOAD_OF_M * 20 ** (4 / 3), liquid=BarusLaw(float(alpha_of_moes(20, material))))
        solution = softlube.solve(beta_load=problem.beta_load, liquid=problem.liquid, accuracy=1e-2)
        seen = close_ups(Regime.of(problem), solution.fields, (1e-2, 2e-3, 5e-4, 1.25e-4), angles=39)
        heights[material] = [crests.crest(each.fields, 39, int(each.fall[-1])).pressure for each in seen][1:]
    assert heights[5.4] == pytest.approx([1.6297 * HERTZ_PRESSURE] * 3, rel=2e-3)
    coarse, middle, fine = heights[6.0]
    assert fine > 1.33 * middle > 1.33**2 * coarse
