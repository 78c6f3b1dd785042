"""Films in time: the rigid limit, the dimple, conservation, separation, grid and tolerance, layers, thickening liquids."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from softlube.errors import InputError
from softlube.model.dry import dry_contact_at
from softlube.model.exact import HERTZ_LOAD
from softlube.model.indenters import PowerShape, RoundedPunchShape, SphereShape
from softlube.model.liquids import BarusLaw, CarreauYasudaLaw, NewtonianLaw, OstwaldLaw, RoelandsLaw
from softlube.model.substrates import HalfSpaceKernel, LayerKernel
from softlube.transient.motion import constant_load, constant_speed, history
from softlube.transient.squeeze.integrate import integrate

THICK, THIN = (CarreauYasudaLaw(NewtonianLaw(), time, 0.4, 0.5) for time in (1e-9, 1e20))
"""A liquid at rest whatever happens, and one on its second plateau, half the viscosity."""


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


def test_a_very_thick_layer_is_the_half_space(dimple):
    """The difference is the dry contact's, 1.127·(2/3) a/t of the indentation, and falls like 1/t."""
    difference = []
    for thickness in (100.0, 1000.0):
        run = integrate(replace(dimple.motion, substrate=LayerKernel(thickness)), rings=91, tolerance=1e-6)
        other, own = run.histories(dimple.time), dimple.histories()
        difference.append(np.max(np.abs(other["height"] - own["height"])))
        for name in ("film_center", "film_min"):
            assert other[name] == pytest.approx(own[name], rel=0.4 / thickness), name
    assert difference[1] == pytest.approx(0.1 * difference[0], rel=0.02)
    assert difference[1] == pytest.approx(1 - dry_contact_at(LayerKernel(1000.0), load=HERTZ_LOAD).indentation, rel=0.02)


LAYERS = [LayerKernel(1.0), LayerKernel(0.3), LayerKernel(0.1, 0.0), LayerKernel(0.3, 0.3, "frictionless")]


@pytest.mark.parametrize("layer", LAYERS, ids=str)
def test_on_a_layer_the_end_is_the_dry_contact(layer):
    """The height's distance from it falls like t^(−1/2), as the film at the centre does."""
    dry = dry_contact_at(layer, load=HERTZ_LOAD)
    run = integrate(replace(constant_load(HERTZ_LOAD, 2.0, 1e5), substrate=layer), rings=91, tolerance=1e-6)
    left = 1 + np.interp([1e3, 1e4, 1e5], run.time, run.heights) / dry.indentation
    assert left[2] < 8e-3
    assert np.log10(left[:-1] / left[1:]) == pytest.approx(0.5, abs=0.03)
    r = run.film.grid.r
    inside = r < 0.8 * dry.radius
    assert run.pressures[-1][inside] == pytest.approx(dry.pressure(r[inside]), rel=2e-3)
    assert run.loads[-1] == pytest.approx(HERTZ_LOAD, rel=1e-8)  # round-off of a thin film over a stiff layer
    assert run.volume_error < 1e-6


@pytest.mark.parametrize(
    ("indenter", "distance"),
    [(SphereShape(0.2, 1.0), 2e-3), (PowerShape(1.0, 1.0, 4.0), 2e-2), (RoundedPunchShape(1.0, 1.0, 0.5, 0.2), 3e-2)],
)
def test_under_any_indenter_the_end_is_the_dry_contact(indenter, distance):
    """Blunt ones come there late: their dry pressure is lowest on the axis, and holds a lens of liquid there."""
    dry = dry_contact_at(HalfSpaceKernel(), load=HERTZ_LOAD, indenter=indenter)
    run = integrate(replace(constant_load(HERTZ_LOAD, 2.0, 1e6), indenter=indenter), rings=91, tolerance=1e-6)
    left = 1 + np.interp([1e4, 1e5, 1e6], run.time, run.heights) / dry.indentation
    assert np.all(np.diff(left) < 0)
    assert left[2] < distance
    outer = (run.film.grid.r > 0.6 * dry.radius) & (run.film.grid.r < 0.8 * dry.radius)
    assert run.pressures[-1][outer] == pytest.approx(dry.pressure(run.film.grid.r[outer]), rel=4 * distance)
    assert run.volume_error < 1e-6


@pytest.mark.parametrize("layer", [LayerKernel(0.3), LayerKernel(0.3, 0.3, "frictionless")], ids=str)
def test_on_a_layer_grid_and_tolerance_change_the_film_little(layer):
    motion = replace(constant_load(HERTZ_LOAD, 2.0, 1e3), substrate=layer)
    run = integrate(motion, rings=91, tolerance=1e-6)
    for rings, tolerance in ((45, 1e-6), (91, 2e-6), (182, 1e-6)):
        other = integrate(motion, rings=rings, tolerance=tolerance).histories(run.time)
        for name in ("film_center", "film_min"):
            assert other[name] == pytest.approx(run.histories()[name], rel=5e-3 if rings == 45 else 4e-4), (rings, name)


def test_a_layer_pressed_to_a_depth_carries_the_dry_contact_s_load():
    layer = LayerKernel(0.5)
    motion = replace(history("height", [0, 2, 5, 3000], [1.0, -0.5, -1.0, -1.0]), substrate=layer)
    run = integrate(motion, rings=91, tolerance=1e-6)
    assert run.loads[-1] == pytest.approx(dry_contact_at(layer, indentation=1.0).load, rel=0.02)
    assert run.loads.max() > 1.5 * run.loads[-1]  # the liquid resists


def test_barus_under_a_nearly_rigid_sphere():
    """P = −ln(1 − αq)/α with Taylor's q = V/(4h²): at half the height the viscosity has risen fivefold."""
    speed = 1e-8
    alpha = 0.8 / speed
    motion = replace(constant_speed(speed, 1.0, 0.5 / speed), liquid=BarusLaw(alpha))
    run = integrate(motion, rings=91, tolerance=1e-8)
    for step in (0, -1):
        q = speed / (4 * (run.heights[step] + run.film.shape) ** 2)
        expected = -np.log1p(-alpha * q) / alpha
        assert run.pressures[step][:60] == pytest.approx(expected[:60], rel=3e-4)
        assert run.loads[step] == pytest.approx(run.film.load(expected), rel=3e-5)
    assert np.exp(alpha * run.pressures[-1][0]) == pytest.approx(5, rel=0.02)


def test_a_thickening_liquid_drains_later(dimple):
    """α → 0 is constant viscosity, to first order in α; Roelands' law with z = 1 is Barus'."""
    own = dimple.histories()["film_center"]

    def film(liquid):
        return integrate(replace(dimple.motion, liquid=liquid), rings=91, tolerance=1e-6).histories(dimple.time)["film_center"]

    ratios = [film(BarusLaw(alpha)) / own - 1 for alpha in (0.01, 0.02)]
    assert np.all(ratios[0][1:] > 0)
    assert ratios[1][1:] == pytest.approx(2 * ratios[0][1:], rel=0.05)
    assert ratios[0].max() < 0.01
    assert film(RoelandsLaw(5.0, 1.0, 1.0)) == pytest.approx(film(BarusLaw(5.0)), rel=1e-6)


def test_a_power_law_under_a_nearly_rigid_sphere():
    """The load π∫ r² |∂p/∂r| dr with the slope that drives V r/2 out, in closed form, at every height."""
    n, speed = 0.85, 1e-8
    stress = speed  # some of the thinning's range: b is of the order of the speed
    motion = replace(constant_speed(speed, 1.0, 0.7 / speed), liquid=OstwaldLaw(NewtonianLaw(), stress, n))
    run = integrate(motion, rings=91, tolerance=1e-8)
    r = np.geomspace(1e-4, 1e4, 4001)
    for step in (0, -1):
        u = run.heights[step] + r**2 / 2
        slope = 2 * stress * ((2 * n + 1) / n * speed * r / u**2 / (2 * stress)) ** n / (6 * u)
        assert run.loads[step] == pytest.approx(np.pi * np.trapezoid(r**3 * slope, np.log(r)), rel=3e-3)


def test_a_liquid_that_does_not_thin_yet_is_newtonian_in_time():
    plain = constant_load(HERTZ_LOAD, 2.0, 30.0)
    runs = [integrate(replace(plain, liquid=law), rings=40, tolerance=1e-6) for law in (NewtonianLaw(), THICK, THIN)]
    assert runs[1].heights[-1] == pytest.approx(runs[0].heights[-1], rel=1e-5)
    # On the second plateau the time goes twice as fast.
    slow = integrate(replace(plain, duration=60.0), rings=40, tolerance=1e-6)
    assert runs[2].heights[-1] == pytest.approx(slow.heights[-1], rel=1e-4)
