"""Histories: what they say, and what is refused."""

import json
import pickle
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from softlube.errors import InputError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.indenters import PowerShape
from softlube.model.liquids import BarusLaw
from softlube.model.substrates import CreepingKernel, LayerKernel, ViscoelasticKernel
from softlube.transient.drives import sampled
from softlube.transient.motion import Motion, constant_load, constant_speed, history
from softlube.transient.squeeze.rings import SqueezeFilm


def _start(motion):
    film = SqueezeFilm.on(motion.grid(96), motion.control, indenter=motion.indenter)
    return film, motion.first_pressure(film)


def test_start_of_a_light_load_is_taylor_s():
    film, p = _start(constant_load(1e-6, 2.0, 1.0))
    assert p == pytest.approx(1e-6 * 2 * 2 / np.pi / 4 / (2 + film.shape) ** 2, rel=2e-4)
    assert film.load(p) == pytest.approx(1e-6, rel=1e-9)


def test_start_of_a_constant_speed_squeezes_out_what_it_displaces():
    """u³ ∂p/∂r = −V r/2 with the film that the pressure makes."""
    film, p = _start(constant_speed(0.5, 1.0, 1.0))
    u = 1.0 + film.shape + film.compliance @ p
    assert u[0] > 1.3  # not a rigid sphere
    flux = film.conductance * (film.midpoint @ u) ** 3 * (film.slope @ p)
    rate = film.rate(flux)
    assert rate[film.grid.r[: film.n] < 10] == pytest.approx(-0.5, rel=2e-3)


def test_start_under_a_blunt_indenter():
    """Far over the surface, where nothing yields, p = ∫ V r/(2u³) dr with u = h₀ + r⁴/8."""
    motion = replace(constant_speed(1e-6, 2.0, 1.0), indenter=PowerShape(1.0, 1.0, 4.0))
    film, p = _start(motion)
    r = film.grid.r[::12]
    exact = [quad(lambda x: 1e-6 * x / (2 * (2 + x**4 / 8) ** 3), each, np.inf)[0] for each in r]
    assert p[::12] == pytest.approx(exact, abs=1e-3 * exact[0])


def test_separation_starts_at_rest():
    assert not np.any(_start(constant_speed(-0.5, 1.0, 1.0))[1])


def test_lowest_height_is_that_of_the_dry_contact():
    assert constant_load(8 * HERTZ_LOAD, 2.0, 10.0).lowest_height == pytest.approx(-4)
    assert constant_load(1e-6, 2.0, 1e6).lowest_height == pytest.approx(2 * np.exp(-2 / np.pi))  # Taylor's law
    assert constant_speed(2.0, 1.0, 3.0).lowest_height == pytest.approx(-5)


def test_the_grid_holds_the_contact_that_creep_makes():
    """Under a constant load a³ grows like J; the first load has been taken up in part, by a share of 1/(1 + 2Nτ/π)."""
    shares, time = (0.6, 0.3), 1e4
    for tau, expected in (((1e-3, 1.0), 1.0), ((1.0, 1e7), 0.7 ** (1 / 3)), ((1e8, 1e8), 0.1 ** (1 / 3))):
        motion = replace(constant_load(HERTZ_LOAD, 2.0, time), substrate=CreepingKernel(shares, tau))
        assert motion.grid(64).edge == pytest.approx(expected, abs=0.002)
    growing = replace(constant_load(HERTZ_LOAD, 2.0, time), substrate=CreepingKernel((0.7,), (2e3,)))
    grid = growing.grid(64)
    assert grid.band == pytest.approx(0.305 ** (1 / 3) / grid.edge, rel=0.01)  # the film has become thin at t = 19
    assert grid.band_share == pytest.approx(16 * (1 - grid.band))
    assert constant_load(HERTZ_LOAD, 2.0, time).grid(64).band == 1
    assert replace(constant_speed(1.0, 1.0, 2.0), substrate=CreepingKernel((0.7,), (2e3,))).grid(64).band == 1


def test_a_start_on_a_substrate_that_creeps():
    """The deflection of the start is that of the part of the pressure that has been taken up."""
    motion = replace(constant_load(HERTZ_LOAD, 0.5, 1.0), substrate=CreepingKernel((0.7,), (3.0,)))
    film = SqueezeFilm.on(motion.grid(96), motion.control, motion.substrate)
    p = motion.first_pressure(film)
    yielded = motion.yielded(film.shape)
    assert yielded[0] == pytest.approx(0.3 + 0.7 / (1 + 3 * 2 * HERTZ_LOAD / np.pi), rel=5e-3)  # less what is long past
    assert film.load(p) == pytest.approx(HERTZ_LOAD, rel=1e-9)
    u = 0.5 + film.shape + film.compliance @ (yielded * p)
    rate = film.rate(film.conductance * (film.midpoint @ u) ** 3 * (film.slope @ p))[film.grid.r[: film.n] < 10]
    assert rate == pytest.approx(rate[0], rel=4e-3)


def test_history_passes_through_its_points_without_overshoot():
    time, values = [0, 1, 2, 4], [0.0, 1.0, 1.0, 0.2]
    motion = history("load", time, values, 2.0)
    assert [float(motion.drive(t)) for t in time] == pytest.approx(values)
    assert motion.samples.max() <= 1 + 1e-12
    assert (motion.duration, motion.initial_height) == (4.0, 2.0)
    assert history("height", [0, 1], [3.0, 2.0]).initial_height == 3.0


@pytest.mark.parametrize(
    "motion",
    [
        constant_load(0.1, 2.0, 3.0),
        constant_speed(-0.5, 1.0, 0.3),
        history("load", [0, 1, 2, 4], [0.0, 1.0, 1.0, 0.2], 2.0),
        replace(history("height", [0, 1], [3.0, 2.0]), substrate=LayerKernel(0.5, 0.3), liquid=BarusLaw(2.0)),
        replace(constant_load(0.1, 2.0, 3.0), substrate=CreepingKernel((0.5, 0.2), (1.0, 30.0), LayerKernel(0.5))),
    ],
    ids=["load", "speed", "history", "models", "creep"],
)
def test_motions_come_back_from_plain_values(motion):
    again = Motion.from_plain(json.loads(json.dumps(motion.to_plain())))
    assert again == motion == pickle.loads(pickle.dumps(motion))
    times = np.linspace(0, motion.duration, 101)
    assert np.array_equal(sampled(again.drive, times), [motion.drive(t) for t in times])


def test_lengths_of_steady_sliding_are_refused():
    with pytest.raises(InputError, match="got lengths of steady sliding, a ViscoelasticKernel"):
        replace(constant_load(0.1, 2.0, 3.0), substrate=ViscoelasticKernel((0.5,), (1.0,))).grid(64)


def test_a_function_has_no_plain_values():
    with pytest.raises(InputError, match="a function of the time cannot be written down"):
        Motion("load", lambda t: 1.0, 1.0, 1.0).to_plain()


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: constant_load(0.0, 1.0, 1.0), "nothing moves"),
        (lambda: constant_load(1.0, -1.0, 1.0), "initial_height"),
        (lambda: constant_speed(1.0, 1.0, np.inf), "duration"),
        (lambda: Motion("speed", lambda t: 1.0, 1.0, 1.0), "control"),  # type: ignore[arg-type]
        (lambda: constant_speed(np.nan, 1.0, 1.0), "finite"),
        (lambda: history("load", [0, 1], [1, 2]), "initial_height"),
        (lambda: history("load", [0], [1], 1.0), "two points"),
        (lambda: history("load", [1, 2], [1, 2], 1.0), "start at 0"),
        (lambda: history("load", [0, 2, 1], [1, 2, 3], 1.0), "increase"),
        (lambda: history("load", [0, 1], [1, np.nan], 1.0), "finite"),
    ],
)
def test_refused(make, text):
    with pytest.raises(InputError, match=text):
        make()
