"""The side problem: independence of the mesh, its two quasi-steady ends, and the constants kept in `limits`."""

from dataclasses import replace

import numpy as np
import pytest

import softlube.theory.side
from softlube import limits
from softlube.solvers.newton import newton
from softlube.theory.inlet import inlet, outlet
from softlube.theory.side import Implicit, SideMesh, Strip, side_film

COARSE = SideMesh(step=0.15, length=0.2, outer=10.0, start=10.0, n_times=150)


@pytest.fixture(scope="module")
def long_march():
    return side_film("reynolds", SideMesh(step=0.15, length=0.2, start=30.0, end=30.0, n_times=400))


@pytest.mark.slow
@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_constants_kept_in_limits(cavitation):
    """The default mesh alone leaves 2e-5, nearly all of it from the time steps, which are of second order."""
    half, default = side_film(cavitation, SideMesh(n_times=200)), side_film(cavitation)
    extrapolated = default.film_min + (default.film_min - half.film_min) / 3
    assert limits.SIDE_FILM[cavitation] == pytest.approx(extrapolated, rel=1.5e-5)
    assert limits.SIDE_TIME[cavitation] == pytest.approx(default.time_of_min, abs=3e-4)
    assert limits.film_min_asymptote(1.0) == pytest.approx(2.18889, abs=3e-5)
    assert limits.film_min_asymptote(1.0, "none") == pytest.approx(2.16538, abs=3e-5)


@pytest.mark.slow
@pytest.mark.parametrize("change", [{"step": 0.09}, {"length": 0.1}, {"outer": 13.0}, {"inner": 28.0}, {"start": 10.0}])
def test_minimum_does_not_depend_on_the_mesh(change):
    other = side_film("reynolds", replace(SideMesh(), **change))
    assert other.film_min == pytest.approx(side_film("reynolds").film_min, rel=3e-5)
    assert other.time_of_min == pytest.approx(side_film("reynolds").time_of_min, abs=1e-3)
    assert other.place_of_min == pytest.approx(side_film("reynolds").place_of_min, abs=2e-3)


def test_second_order_in_time():
    film = [side_film("none", replace(COARSE, n_times=n)).film_min for n in (75, 150, 300)]
    assert np.log2((film[0] - film[1]) / (film[1] - film[2])) == pytest.approx(2, abs=0.4)


def test_it_ends_in_the_outlet(long_march):
    """Far behind the side, each angle has the outlet of its own entrainment, up to O(τ^(−4/5))."""
    late = long_march.time > 15
    ratio = long_march.film[late] / (inlet().film_inside * long_march.time[late] ** 0.6)
    assert np.all(np.diff(ratio) < 0)
    # ratio(τ) = ratio(∞) (1 + k τ^(−4/5)), by two times
    t, r = long_march.time[late][[0, -1]] ** -0.8, ratio[[0, -1]]
    assert r[1] - t[1] * (r[1] - r[0]) / (t[1] - t[0]) == pytest.approx(limits.outlet_film_ratio(), rel=0.03)
    place = long_march.place[-1] / long_march.time[-1] ** 0.4
    assert place == pytest.approx(outlet("reynolds").film_min_place, abs=0.05)


def test_minimum_is_the_thinnest_of_the_march(long_march):
    """The film grows both ways from τ = 0.53: nothing on the edge is thinner."""
    lowest = np.argmin(long_march.film)
    before, behind = long_march.film[: lowest + 1], long_march.film[lowest:]
    assert np.all(np.diff(before) < 0)
    assert np.all(np.diff(behind) > 0)
    assert long_march.film.min() == pytest.approx(limits.SIDE_FILM["reynolds"], rel=2e-3)


def test_initial_state_is_the_inlet():
    strip = Strip(COARSE)
    film = strip.film_under(strip.initial_state(30.0))
    near = np.abs(strip.s) < 20
    expected = np.interp(strip.s[near] / 30**0.4, inlet().s, inlet().film) * 30**0.6
    assert film[near] == pytest.approx(expected, rel=0.03)
    far = (strip.s > 1e3) & (strip.s < 1e6)
    assert film[far] == pytest.approx(inlet().film_inside * (2 * strip.s[far] + 900) ** 0.3, rel=5e-3)


def test_jacobian_is_exact():
    strip = Strip(replace(COARSE, step=0.4))
    x = strip.initial_state(3.0)
    system = Implicit(strip, 0.7, 2.0, -2 * strip.film_under(x), strip.breakable)
    step = np.exp(-(strip.t**2) / 4) * 1e-2
    at, h = system.linearise(x), 1e-5
    difference = (system.linearise(x + h * step).residual - system.linearise(x - h * step).residual) / (2 * h)
    assert at.times(step) == pytest.approx(difference, abs=1e-6 * np.max(np.abs(difference)))


def test_complementarity():
    """One step behind τ = 0: pressure not negative, residual not negative, one of them zero."""
    strip = Strip(COARSE)
    x = strip.initial_state(10.0)
    system = Implicit(strip, 1.0, 20.0, -20 * strip.film_under(x), strip.breakable)
    result = newton(system, x, tolerance=1e-11)
    assert result.converged
    residual = system.linearise(result.x).residual
    assert np.all(result.x[strip.breakable] >= 0)
    assert np.any(result.x[strip.breakable] == 0)
    assert np.all(residual > -1e-8)
    assert np.max(np.abs(residual[result.x != 0])) < 1e-6


def test_unknown_condition():
    with pytest.raises(ValueError, match="cavitation"):
        side_film("half-sommerfeld")


def test_a_step_that_does_not_converge_is_refused(monkeypatch):
    monkeypatch.setattr(softlube.theory.side, "newton", lambda system, x, **kwargs: newton(system, x, max_iterations=1))
    with pytest.raises(RuntimeError, match="did not converge"):
        side_film("reynolds", replace(COARSE, n_times=149))
