"""Films in time: the rigid limit, the dimple, conservation, separation, independence of grid and tolerance."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from softlube.approach.integrate import integrate
from softlube.approach.motion import constant_load, constant_speed, history
from softlube.errors import InputError
from softlube.limits import HERTZ_LOAD


@pytest.fixture(scope="module")
def dimple():
    return integrate(constant_load(HERTZ_LOAD, 2.0, 1e3), rings=91, tolerance=1e-6)


def test_rigid_sphere_at_constant_speed_meets_taylor_s_force():
    """6πηR²V/h is πV/(2h₀) normalised, over a decade of heights."""
    run = integrate(constant_speed(1e-8, 1.0, 0.9e8), rings=91, tolerance=1e-8)
    assert run.heights[-1] == pytest.approx(0.1)
    assert run.loads == pytest.approx(np.pi * 1e-8 / (2 * run.heights), rel=1e-4)


def test_rigid_sphere_under_a_constant_load_sinks_exponentially():
    """πV/(2h₀) = N: h₀ falls like exp(−2Nt/π)."""
    load = 1e-4  # the substrate yields by about as little
    run = integrate(constant_load(load, 1.0, 2e4), rings=91, tolerance=1e-7)
    assert run.heights == pytest.approx(np.exp(-2 * load * run.time / np.pi), rel=1e-3)


def test_soft_sphere_under_a_load_forms_a_dimple(dimple):
    h = dimple.histories()
    assert h["film_min_radius"][0] == 0
    assert 0.9 < h["film_min_radius"][-1] < 1
    assert h["film_min"][-1] < 0.65 * h["film_center"][-1]
    assert h["pressure_center"].max() > 1.02 * 2 / np.pi**2 > 0.98 * h["pressure_center"][-1]
    assert dimple.loads == pytest.approx(HERTZ_LOAD, rel=1e-9)
    # and approaches the dry contact
    assert h["height"][-1] == pytest.approx(-1, abs=0.03)
    assert np.all(np.diff(h["film_min"]) < 0)


def test_volume_balance(dimple):
    assert dimple.volume_error < 1e-6
    # by other means: the film's volume and the flux at r = 1.5 from splines through the fields
    grid = dimple.film.grid
    xi = np.concatenate([-grid.xi[::-1], grid.xi])

    def spline(values, parity=1.0):
        return CubicSpline(xi, np.concatenate([parity * values[::-1], values]))

    fine = np.linspace(0, float(grid.xi_of(1.5)), 2001)
    r = grid.r_of(fine)
    volume, outflow = [], []
    for u, p in zip(dimple.films, dimple.pressures, strict=True):
        density = CubicSpline(fine, 2 * np.pi * r * grid.dr_dxi(r) * spline(u)(fine))
        volume.append(float(density.integrate(0, fine[-1])))
        slope = float(spline(p)(fine[-1], 1)) / float(grid.dr_dxi(1.5))
        outflow.append(-2 * np.pi * 1.5 * float(spline(u)(fine[-1])) ** 3 * slope)
    passed = CubicSpline(dimple.time, outflow).antiderivative()(dimple.time)
    change = np.array(volume) - volume[0]
    assert np.max(np.abs(change + passed)) < 1e-4 * np.max(np.abs(change))


def test_halving_grid_and_tolerance_changes_the_film_little(dimple):
    for rings, tolerance in ((45, 1e-6), (91, 2e-6), (91, 5e-7), (182, 1e-6)):
        other = integrate(dimple.motion, rings=rings, tolerance=tolerance).histories(dimple.time)
        for name in ("film_center", "film_min"):
            assert other[name] == pytest.approx(dimple.histories()[name], rel=5e-3 if rings == 45 else 4e-4), (rings, name)


def test_film_limit_stops_at_the_limit():
    run = integrate(constant_load(HERTZ_LOAD, 2.0, 1e4), rings=64, tolerance=1e-6, film_limit=0.05)
    assert run.ended_by == "film_limit"
    assert run.histories()["film_min"][-1] == pytest.approx(0.05, rel=1e-3)
    with pytest.raises(InputError, match="film_limit"):
        integrate(constant_load(HERTZ_LOAD, 2.0, 1e4), rings=64, tolerance=1e-6, film_limit=3.0)


def test_separation_pulls_and_ends_rigid():
    """A slowly withdrawn sphere feels −6πηR²|V|/h once it is far away."""
    run = integrate(constant_speed(-0.01, 0.5, 500), rings=91, tolerance=1e-6)
    h = run.histories()
    assert h["pressure_min"].min() < 0
    assert np.all(h["load"][1:] < 0)
    assert h["load"][-1] == pytest.approx(-np.pi * 0.01 / (2 * run.heights[-1]), rel=5e-3)
    # the substrate is sucked up: the film lags behind the sphere
    early = np.searchsorted(run.time, 20)
    assert h["film_center"][early] < run.heights[early]


def test_approach_and_retreat_lag_behind_the_motion():
    motion = history("height", np.linspace(0, 40, 41), 1 + 0.8 * np.cos(np.linspace(0, 2 * np.pi, 41)))
    run = integrate(motion, rings=64, tolerance=1e-6)
    assert run.loads.max() > 0 > run.loads.min()
    assert run.time[np.argmax(run.loads)] < 20 < run.time[np.argmin(run.loads)]
