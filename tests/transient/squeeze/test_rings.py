"""The squeeze film on rings against Taylor's rigid sphere, a manufactured film, and its own derivatives."""

import numpy as np
import pytest

from softlube.discretization.elasticity import elastic_operator
from softlube.discretization.grid import PolarGrid
from softlube.model.exact import hertz_pressure
from softlube.model.liquids import BarusLaw, CarreauYasudaLaw, NewtonianLaw, OstwaldLaw, RoelandsLaw
from softlube.model.substrates import CreepingKernel, HalfSpaceKernel, LayerKernel
from softlube.transient.squeeze.rings import SqueezeFilm

GRID = PolarGrid(n_r=96, n_theta=6, edge_width=0.1, reach=60)


@pytest.fixture(scope="module")
def film():
    return SqueezeFilm.on(GRID, "height")


def _flux(film, u, p):
    return film.conductance * (film.midpoint @ u) ** 3 * (film.slope @ p)


def test_taylor_s_pressure_lowers_a_rigid_sphere_evenly(film):
    """Pressure V/(4h²) and ∫p dA = πV/(2h₀): Taylor's 6πηR²V/h."""
    h = 0.7 + film.shape
    p = 0.3 / (4 * h**2)
    rate = film.rate(_flux(film, h, p))
    assert rate[:-2] == pytest.approx(-0.3, rel=5e-4)
    assert film.load(p) == pytest.approx(np.pi * 0.3 / (2 * 0.7), rel=2e-6)


@pytest.mark.parametrize("rings", [48, 96])
def test_order_of_the_divergence(rings):
    """With u = 1 + r², p = exp(−r²): (1/r)(r u³ p′)′ in closed form; fourth order, at the centre too."""
    errors = []
    for n in (rings, 2 * rings):
        film = SqueezeFilm.on(GRID.resized(n, 6), "height")
        r = film.grid.r
        q = r**2
        exact = -2 * (1 + q) ** 2 * np.exp(-q) * (2 * (1 + q) * (1 - q) + 6 * q)
        rate = film.rate(_flux(film, 1 + q, np.exp(-q)))
        errors.append(np.max(np.abs(rate - exact[: film.n])))
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4, abs=0.5)


def test_hertz_pressure_lies_under_a_flat_film(film):
    """No film within r < 1 for the Hertz pressure and h₀ = −1, and back from the film to the pressure."""
    u = film.lift_under(hertz_pressure(film.grid.r), -1.0) + film.shape[: film.n]
    assert np.max(np.abs(u[film.grid.r[: film.n] < 0.8])) < 2e-3
    smooth = np.exp(-(film.grid.r**2))
    smooth[film.n - 1 :] = 0
    assert film.pressure(film.lift_under(smooth, -0.4), -0.4)[: film.n] == pytest.approx(smooth[: film.n], abs=1e-10)


def test_height_follows_from_the_load():
    film = SqueezeFilm.on(GRID, "load")
    p = 0.2 * np.exp(-(film.grid.r**2))
    p[film.n - 1 :] = 0
    lift = film.lift_under(p, 0.25)
    assert film.height(lift, film.load(p)) == pytest.approx(0.25, abs=1e-9)
    assert film.load(film.pressure(1 + lift**1.1, 0.37)) == pytest.approx(0.37, rel=1e-9)


@pytest.mark.parametrize("control", ["load", "height"])
@pytest.mark.parametrize("liquid", [NewtonianLaw(), BarusLaw(2.0), RoelandsLaw(2.0, 0.6, 5.0)], ids=lambda liquid: liquid.kind)
def test_derivative_of_the_flux_is_exact(control, liquid):
    film = SqueezeFilm.on(GRID, control, liquid=liquid)
    r = film.grid.r[: film.n]
    lift = 0.5 + 0.3 * np.exp(-(r**2))
    step = 1e-5 * np.cos(3 * r) * np.exp(-r)
    found = (film.flux(lift + step, 0.4) - film.flux(lift - step, 0.4)) / 2
    exact = film.flux_derivative(lift, 0.4) @ step
    assert exact == pytest.approx(found, abs=1e-5 * np.max(np.abs(found)))


def test_volume_within_a_radius_grows_by_the_flux_at_its_edge(film):
    weights = film.inflow_weights(50)
    assert set(np.flatnonzero(weights)) <= {0, 49, 50, 51}
    flux = np.random.default_rng(1).normal(size=weights.size)
    flux[0] = 0  # nothing flows through the centre
    rate = film.rate(flux)
    assert film.volume_weights(50) @ rate == pytest.approx(weights @ flux, rel=1e-9)
    # and the weights are a quadrature: ∫ 2π r exp(−r²) dr within all rings
    assert film.volume_weights(film.n) @ np.exp(-(film.grid.r[: film.n] ** 2)) == pytest.approx(np.pi, rel=1e-5)


@pytest.mark.parametrize("substrate", [HalfSpaceKernel(), LayerKernel(0.7), LayerKernel(0.7, 0.3, "frictionless")], ids=str)
def test_rings_are_the_plane_s_first_harmonic(substrate):
    """The deflection is that of the steady solver's operator."""
    plane = elastic_operator(GRID, "none", substrate.remainder)
    rings = SqueezeFilm.on(GRID, "load", substrate)
    assert rings.compliance == pytest.approx(plane.radial[0], rel=1e-8, abs=1e-8)
    p = np.exp(-(GRID.r**2))
    even = np.repeat(p, GRID.shape[1])
    assert rings.compliance @ p == pytest.approx(plane.deflection(even).reshape(GRID.shape)[:, 0], rel=1e-9)
    assert rings.load(p) == pytest.approx(float(plane.load_weights @ even), rel=1e-9)


@pytest.mark.parametrize("control", ["load", "height"])
def test_a_substrate_that_creeps_deflects_by_what_acts_and_what_it_remembers(control):
    """Of l = h₀ + K (J₀ p + s) the lift, s and its load are given: back comes p, with the load N or under the height h₀."""
    film = SqueezeFilm.on(GRID, control, CreepingKernel((0.5, 0.3), (1.0, 7.0)))
    acts, remembered = 0.2 * np.exp(-(GRID.r**2)), 0.1 * np.exp(-2 * GRID.r**2)
    for p in (acts, remembered):
        p[film.n - 1 :] = 0
    lift = film.lift_under(0.2 * acts + remembered, 0.25)
    state = np.concatenate([lift, remembered[: film.n], [film.load(remembered)] if control == "load" else []])
    drive = film.load(acts) if control == "load" else 0.25
    assert film.pressure(state, drive) == pytest.approx(acts, abs=1e-9)
    assert film.height(state, drive) == pytest.approx(0.25, abs=1e-9)
    far = 0.25 + (film.compliance @ (0.2 * acts + remembered))[film.n :]
    assert film.whole_film(state, drive)[film.n :] == pytest.approx(film.shape[film.n :] + far, rel=1e-12)


@pytest.mark.parametrize("alpha", [0.5, 2.0])
def test_barus_under_a_rigid_sphere(alpha):
    """With q = (1 − e^(−αp))/α the equation is that of constant viscosity: p = −ln(1 − αq)/α with Taylor's q = V/(4h²)."""
    film = SqueezeFilm.on(GRID, "height", liquid=BarusLaw(alpha))
    h = 0.7 + film.shape
    p = -np.log1p(-alpha * 0.3 / (4 * h**2)) / alpha
    fluidity, _ = film.liquid.fluidity(film.midpoint @ p)
    flux = film.conductance * fluidity * (film.midpoint @ h) ** 3 * (film.slope @ p)
    assert film.rate(flux)[:-2] == pytest.approx(-0.3, rel=5e-4)


def test_the_flux_of_a_power_law_is_its_closed_form():
    """Q = (2n/(2n+1)) (u/2)^((2n+1)/n) (|∂p/∂r|/K)^(1/n), here r φu²m/6 with m = (12n/(2n+1)) (b/4) (|b|/2t₁)^(1/n−1)."""
    n, film = 0.6, SqueezeFilm.on(GRID, "height", liquid=OstwaldLaw(NewtonianLaw(), 0.3, 0.6))
    lift = 0.4 + 0.1 * np.exp(-(film.grid.r[: film.n] ** 2))
    u = film.midpoint @ film.whole_film(lift, 0.5)
    slope = (film.slope @ film.pressure(lift, 0.5)) * film.across
    b = 6 * u * slope
    moment = 12 * n / (2 * n + 1) * b / 4 * (np.abs(b) / 0.6) ** (1 / n - 1)
    expected = GRID.r_face[: film.n + 2] * u**2 * moment / 6
    assert film.flux(lift, 0.5) == pytest.approx(expected, rel=1e-9, abs=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("liquid", [OstwaldLaw(BarusLaw(2.0), 0.3, 0.6), CarreauYasudaLaw(NewtonianLaw(), 20.0, 0.5, 0.01)])
def test_derivative_of_a_thinning_flux_is_that_of_differences(liquid):
    film = SqueezeFilm.on(GRID.resized(24, 6), "load", liquid=liquid)
    lift = 0.4 + 0.1 * np.exp(-(film.grid.r[: film.n] ** 2))
    change, step = np.cos(film.grid.r[: film.n]), 1e-6
    numeric = (film.flux(lift + step * change, 0.5) - film.flux(lift - step * change, 0.5)) / (2 * step)
    found = film.flux_derivative(lift, 0.5) @ change
    assert found == pytest.approx(numeric, abs=1e-7 * np.abs(numeric).max())
