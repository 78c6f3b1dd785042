"""Squeeze films on substrates that remember: limits, equal times, the Jacobian, balances, creep of the dry contact, order."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import issparse

from softlube.discretization.grid import PolarGrid
from softlube.model.exact import HERTZ_LOAD
from softlube.model.liquids import BarusLaw, NewtonianLaw, OstwaldLaw
from softlube.model.substrates import CreepingKernel, HalfSpaceKernel, LayerKernel
from softlube.transient.motion import constant_load, constant_speed, history
from softlube.transient.squeeze.integrate import integrate
from softlube.transient.squeeze.memory import Memory
from softlube.transient.squeeze.rings import SqueezeFilm

PRESSED = constant_load(HERTZ_LOAD, 2.0, 1e3)
LOWERED = history("height", [0, 2, 5, 60], [1.0, -0.5, -1.0, -1.0])
FILMS = ("film_center", "film_min")


def creeping(motion, shares, times, relaxed=None):
    return replace(motion, substrate=CreepingKernel(shares, times, relaxed or motion.substrate))


@pytest.mark.parametrize("relaxed", [HalfSpaceKernel(), LayerKernel(0.5)], ids=["half-space", "layer"])
@pytest.mark.parametrize("motion", [PRESSED, LOWERED], ids=["load", "height"])
def test_short_times_are_the_relaxed_substrate(motion, relaxed):
    elastic = integrate(replace(motion, substrate=relaxed), rings=64, tolerance=1e-7)
    grid = elastic.film.grid
    at_once = integrate(creeping(motion, (0.5, 0.3), (0.0, 0.0), relaxed), rings=grid, tolerance=1e-7)
    soon = integrate(creeping(motion, (0.5, 0.3), (1e-7, 1e-6), relaxed), rings=grid, tolerance=1e-7)
    own = elastic.histories()
    for name in (*FILMS, "pressure_max"):
        assert at_once.histories(elastic.time)[name] == pytest.approx(own[name], rel=1e-6)
        assert soon.histories(elastic.time)[name] == pytest.approx(own[name], rel=2e-6 if name in FILMS else 3e-5), name


@pytest.mark.parametrize("control", ["load", "height"])
def test_long_times_are_the_instantaneous_substrate(control):
    """Stiffer by 1/J₀ its pressures are as many times larger, and so is the viscosity of the time that they are in."""
    stiffer, unit = 4.0, 1.0
    motion = replace(PRESSED, duration=100.0) if control == "load" else LOWERED
    slow = creeping(motion, (0.5, 0.25), (1e9, 1e10))
    if control == "load":
        unit = stiffer ** (-2 / 3)
        same = constant_load(HERTZ_LOAD, 2.0 / unit, 100.0)
    else:
        same = history("height", [stiffer * t for t in motion.drive.time], motion.drive.values)
    grid = slow.grid(64)
    run = integrate(slow, rings=grid, tolerance=1e-7)
    other = integrate(same, rings=grid.scaled(unit**-0.5), tolerance=1e-7)
    clock = 1.0 if control == "load" else stiffer
    mine, its = run.histories(other.time / clock), other.histories()
    for name in FILMS:
        assert mine[name] == pytest.approx(unit * its[name], rel=2e-6 if control == "load" else 1e-5), name
    assert mine["pressure_max"] == pytest.approx(stiffer * unit**0.5 * its["pressure_max"], rel=1e-4)
    assert mine["height"] == pytest.approx(unit * its["height"], abs=1e-6)


def test_equal_times_are_one():
    whole = integrate(creeping(PRESSED, (0.6, 0.2), (30.0, 1.0)), rings=40, tolerance=1e-6)
    split = integrate(creeping(PRESSED, (0.2, 0.2, 0.1, 0.3), (30.0, 1.0, 30.0, 30.0)), rings=40, tolerance=1e-6)
    for name, values in whole.histories().items():
        assert split.histories(whole.time)[name] == pytest.approx(values, rel=1e-8, abs=1e-10), name


def test_nearly_equal_times_are_nearly_one():
    """As two terms, which step otherwise: within what the tolerance leaves."""
    whole = integrate(creeping(PRESSED, (0.6,), (30.0,)), rings=40, tolerance=1e-8)
    split = integrate(creeping(PRESSED, (0.3, 0.3), (30.0, 30.0 * (1 + 1e-9))), rings=40, tolerance=1e-8)
    for name in FILMS:
        assert split.histories(whole.time)[name] == pytest.approx(whole.histories()[name], rel=1e-6), name


@pytest.mark.parametrize("control", ["load", "height"])
@pytest.mark.parametrize(
    "liquid", [NewtonianLaw(), BarusLaw(2.0), OstwaldLaw(NewtonianLaw(), 0.3, 0.6)], ids=["Newtonian", "Barus", "power law"]
)
def test_the_jacobian_is_that_of_differences(control, liquid):
    substrate = CreepingKernel((0.4, 0.3), (2.0, 0.3))
    film = SqueezeFilm.on(PolarGrid(n_r=24, n_theta=6, edge_width=0.1, reach=30), control, substrate, liquid)
    memory, n = Memory(film), film.n
    assert memory.shape == (2, n + (control == "load"))
    r, drive = film.grid.r[:n], 0.4
    inflow = film.inflow_weights(10)

    def rate(z):
        state = memory.state(z[:n], z[n + 1 :])
        flux = film.flux(state, drive)
        return memory.rate(np.append(film.rate(flux), inflow @ flux), z[n + 1 :], state, drive)

    remembered = np.concatenate([0.05 * np.exp(-(r**2)), [0.2] if control == "load" else []])
    z = np.concatenate([0.5 + 0.3 * np.exp(-(r**2)), [0.0], remembered, 0.7 * remembered])
    change = np.concatenate([np.cos(3 * r) * np.exp(-r), [0.3], *(np.cos(np.arange(remembered.size)) for _ in range(2))])
    step = 1e-7
    by_differences = (rate(z + step * change) - rate(z - step * change)) / (2 * step)
    by_state = film.flux_derivative(memory.state(z[:n], z[n + 1 :]), drive)
    matrix = memory.jacobian(film.rate(by_state), inflow @ by_state)
    assert issparse(matrix)
    exact = matrix @ change
    for part in (slice(n), slice(n, n + 1), slice(n + 1, None)):
        assert exact[part] == pytest.approx(by_differences[part], abs=1e-5 * np.abs(by_differences[part]).max())


@pytest.mark.parametrize(
    "motion", [PRESSED, LOWERED, constant_speed(-0.01, 0.5, 500), history("load", [0, 5, 20, 40], [0, 0.4, 0.4, 0.05], 1.0)]
)
def test_volume_and_load_balance(motion):
    run = integrate(creeping(motion, (0.4, 0.3), (2.0, 20.0)), rings=64, tolerance=1e-6)
    assert run.volume_error < 1e-6
    if motion.control == "load":
        loads = np.array([motion.drive(t) for t in run.time])
        assert run.loads == pytest.approx(loads, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(("shares", "times"), [((0.8,), (300.0,)), ((0.5, 0.3, 0.15), (50.0, 400.0, 3000.0))])
def test_the_contact_creeps_like_a_dry_one(shares, times):
    """Under a constant load a³ = J(t) a_relaxed³ (Lee & Radok), and −h₀ = a² but for a part of the film, as on elastic ones."""
    motion = creeping(replace(PRESSED, duration=1e4), shares, times)
    run = integrate(motion, rings=128, tolerance=1e-6)
    late = run.time > 200  # the load has acted on the substrate from time 0 on, more or less
    creep = 1 - np.array(shares) @ np.exp(-run.time[late] / np.array(times)[:, None])
    left = (run.heights[late] + creep ** (2 / 3)) / run.histories()["film_center"][late]
    assert np.all((left > 0.5) & (left < 1))
    elastic = integrate(replace(PRESSED, duration=1e4), rings=91, tolerance=1e-6)
    assert left[-1] == pytest.approx((elastic.heights[-1] + 1) / elastic.histories()["film_center"][-1], rel=0.02)
    assert creep[0] < 0.7 * creep[-1]


def test_held_at_a_depth_the_load_relaxes_like_a_dry_contact_s():
    """Of a dry sphere the contact stays as it is, and the load goes like E(t) = E_relaxed (1 + e^(−t/500)), 500 = J₀ 1000."""
    motion = history("height", [0, 2, 5, 3000], [1.0, -0.5, -1.0, -1.0])
    run, elastic = (integrate(each, rings=91, tolerance=1e-6) for each in (creeping(motion, (0.5,), (1000.0,)), motion))
    times = np.array([300.0, 1000.0, 3000.0])
    expected = HERTZ_LOAD * (1 + np.exp(-times / 500))
    excess = run.histories(times)["load"] / expected - 1
    # The film lies between, by which an elastic contact's load is larger, too.
    assert np.all((excess > 0) & (excess < elastic.histories(times)["load"] / HERTZ_LOAD - 1))
    assert excess[-1] < 0.025


def test_the_film_converges_like_the_fourth_power_of_the_rings():
    motion = creeping(PRESSED, (0.7,), (100.0,))
    fine = integrate(motion, rings=256, tolerance=1e-9)
    time = fine.time[:: fine.time.size // 50]
    exact = fine.histories(time)
    errors = []
    for rings in (64, 128):
        found = integrate(motion, rings=rings, tolerance=1e-8).histories(time)
        errors.append([np.max(np.abs(found[name] / exact[name] - 1)) for name in FILMS])
    assert np.log2(np.array(errors[0]) / errors[1]) == pytest.approx([4, 4], abs=0.8)


def test_on_elastic_substrates_nothing_is_remembered():
    film = SqueezeFilm.on(PolarGrid(n_r=24, n_theta=6, edge_width=0.1, reach=30), "load")
    memory = Memory(film)
    assert memory.shape == (0, 0)
    assert memory.at_first(np.zeros((0, film.shape.size))).size == 0
    assert isinstance(memory.jacobian(np.eye(24), np.zeros(24)), np.ndarray)
