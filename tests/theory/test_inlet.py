"""The similarity problems against their own equations, their far fields, and other meshes."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from softlube.theory.inlet import FRONT, INLET_MESH, OUTLET_MESH, inlet, outlet
from softlube.theory.power_law import PowerLawFlow

# --- convergence: step, reach and length scale of the mesh, one at a time -----------------------------------------------------

OTHER_MESHES = ["step", "outer", "inner", "length"]


def changed(mesh, what):
    return replace(mesh, **{what: {"step": 0.15, "outer": mesh.outer + 6, "inner": 50.0, "length": 0.7 * mesh.length}[what]})


@pytest.mark.parametrize("what", OTHER_MESHES)
def test_inlet_does_not_depend_on_the_mesh(what):
    other = inlet(changed(INLET_MESH, what))
    assert other.film_inside == pytest.approx(inlet().film_inside, rel=5e-12)
    assert other.gradient_max == pytest.approx(inlet().gradient_max, rel=5e-8)
    assert other.film_at(0.0) == pytest.approx(inlet().film_at(0.0), rel=5e-9)


@pytest.mark.parametrize("what", OTHER_MESHES)
def test_full_outlet_does_not_depend_on_the_mesh(what):
    assert outlet("none", mesh=changed(OUTLET_MESH, what)).film_min == pytest.approx(outlet("none").film_min, rel=1e-9)


@pytest.mark.parametrize("what", OTHER_MESHES)
def test_cavitated_outlet_does_not_depend_on_the_mesh(what):
    other = outlet("reynolds", mesh=changed(FRONT, what))
    assert other.film_min == pytest.approx(outlet("reynolds").film_min, rel=5e-9)
    assert other.front == pytest.approx(outlet("reynolds").front, rel=5e-8)


THINNING = [(0.8, 0.0), (0.8, 2.0), (2 / 3, 2.0), (0.5, 0.0), (0.5, 2.0), (0.35, 0.0), (0.35, 2.0)]
"""Power-law index and slide-to-roll ratio.  At 2/3 the far pressure outside is in resonance with that of the end inside."""


@pytest.mark.parametrize(("index", "slide_to_roll"), THINNING)
def test_inlet_of_a_power_law_liquid_does_not_depend_on_the_mesh(index, slide_to_roll):
    """To six digits and better: the stress that vanishes at a wall leaves a weak singularity in sliding."""
    flow = PowerLawFlow(index, slide_to_roll)
    changes = [{"step": 0.09}, {"outer": 20.0}, {"inner": 24.0}, {"length": 0.2}]
    others = [inlet(replace(INLET_MESH, **each), flow).film_inside for each in changes]
    assert others == pytest.approx([inlet(flow=flow).film_inside] * 4, rel=1e-6)


def test_inlet_of_a_liquid_that_hardly_thins():
    """Its film is that of constant viscosity, and differs in proportion to 1 − n."""
    newtonian = inlet().film_inside
    assert inlet(flow=PowerLawFlow(1.0, 2.0)) is not None
    for slide_to_roll in (0.0, 2.0):
        little, twice = (inlet(flow=PowerLawFlow(1 - share, slide_to_roll)).film_inside - newtonian for share in (1e-5, 2e-5))
        assert abs(little) < 3e-5
        assert twice / little == pytest.approx(2, abs=1e-3)


@pytest.mark.parametrize("index", [0.1, 0.2, 1.8])
def test_indices_that_the_inlet_does_not_take(index):
    with pytest.raises(ValueError, match="index"):
        inlet(flow=PowerLawFlow(index))


# --- the equations, by means that the solver does not use --------------------------------------------------------------------


SHEARED = PowerLawFlow(0.5, 2.0)
SOLUTIONS = {
    "inlet": inlet,
    "thinning inlet": lambda: inlet(flow=SHEARED),
    "full outlet": lambda: outlet("none"),
    "cavitated outlet": lambda: outlet("reynolds"),
}


@pytest.mark.parametrize("name", SOLUTIONS)
def test_reynolds_equation(name):
    """u³ p′ = ±(u − u∞), with p′ from a spline through the pressures; for a thinning liquid u^(n+1) p′ drives (u − u∞)/u."""
    found = SOLUTIONS[name]()
    slope = CubicSpline(found.t, found.pressure)(found.t, 1) / CubicSpline(found.t, found.s)(found.t, 1)
    flux = (1 if name == "inlet" else -1) * (found.film - found.film_inside) / found.film**3
    if name == "thinning inlet":
        flux = SHEARED.gradient(1 - found.film_inside / found.film)[0] / found.film**1.5
    near = (np.abs(found.s) < 30) & (found.t > -6)
    assert slope[near] == pytest.approx(flux[near], abs=1e-3)


@pytest.mark.parametrize(
    ("name", "place"),
    [(name, place) for name in SOLUTIONS for place in (-0.5, -0.1, 0.1, 0.4, 2.0) if name != "cavitated outlet" or place > 0],
)
def test_film_is_the_elastic_gap(name, place):
    """u″ = −2 p.v.∫ p′/(s − s′) ds′, the principal value by a sum over points that straddle the pole evenly."""
    found = SOLUTIONS[name]()
    s, film, gradient = (CubicSpline(found.t, values) for values in (found.s, found.film, found.gradient))
    at, h = found.t[np.searchsorted(found.s, place)], 0.005
    t = at + (np.arange(-8000, 8000) + 0.5) * h
    t = t[(t > found.t[0]) & (t < found.t[-1])]
    principal = h * np.sum(gradient(t) * s(t, 1) / (s(at) - s(t)))
    curvature = (film(at, 2) - film(at, 1) * s(at, 2) / s(at, 1)) / s(at, 1) ** 2
    assert -2 * principal == pytest.approx(curvature, rel=0.02, abs=0.02)


def test_inlet_far_field():
    """Outside the dry gap 4π|s|^(3/2)/3 and, by Reynolds' equation in it, p = 9/(32π²s²); inside u∞ + u∞³/(2√s)."""
    found = inlet()
    out = (found.s < -300) & (found.s > -3e4)
    assert found.film[out] == pytest.approx(4 * np.pi / 3 * np.abs(found.s[out]) ** 1.5, rel=1e-3)
    assert found.pressure[out] == pytest.approx(9 / (32 * np.pi**2) / found.s[out] ** 2, rel=2e-3)
    inside = (found.s > 1e3) & (found.s < 1e8)
    assert found.pressure[inside] == pytest.approx(np.sqrt(found.s[inside]), rel=1e-5)
    excess = (found.film[inside] - found.film_inside) * 2 * np.sqrt(found.s[inside]) / found.film_inside**3
    assert excess == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize(("index", "slide_to_roll"), THINNING)
def test_far_field_of_a_power_law_liquid(index, slide_to_roll):
    """Outside the dry gap, in which everything is driven back; inside an excess that falls like s^(−1/2n) in rolling."""
    flow = PowerLawFlow(index, slide_to_roll)
    found = inlet(flow=flow)
    a = (3 * index + 1) / 2
    strength = flow.gradient(np.array(1.0))[0] * (4 * np.pi / 3) ** -(index + 1) / a
    out = (found.s < -300) & (found.s > -3e3)
    assert found.film[out] == pytest.approx(4 * np.pi / 3 * np.abs(found.s[out]) ** 1.5, rel=1e-3)
    assert found.pressure[out] == pytest.approx(strength * np.abs(found.s[out]) ** -a, rel=2e-3)
    inside = (found.s > 100) & (found.s < 3e3)
    driven = found.film_inside ** (index + 1) / (2 * np.sqrt(found.s[inside]))
    excess = flow.backflow(driven)[0]
    assert found.film[inside] / found.film_inside - 1 == pytest.approx(excess, rel=0.05, abs=1e-4)


def test_far_fields_of_the_outlets():
    for cavitation in ("reynolds", "none"):
        found = outlet(cavitation)
        inside = (found.s > 1e3) & (found.s < 1e8)
        missing = (found.film_inside - found.film[inside]) * 2 * np.sqrt(found.s[inside]) / found.film_inside**3
        assert missing == pytest.approx(1, abs=0.01)
    out = (found.s < -100) & (found.s > -1e3)  # the last: full of liquid, under negative pressure
    assert found.pressure[out] == pytest.approx(-9 / (32 * np.pi**2) / found.s[out] ** 2, rel=3e-3)


def test_free_boundary():
    """At the front the pressure starts like a square and the film is the one from within."""
    found = outlet("reynolds")
    beyond = found.s - found.front
    near = (beyond > 1e-5) & (beyond < 1e-3)
    exponent = np.polyfit(np.log(beyond[near]), np.log(found.pressure[near]), 1)[0]
    assert exponent == pytest.approx(2, abs=0.02)
    assert found.film[0] == pytest.approx(found.film_inside, rel=1e-9)
    assert found.front == pytest.approx(-0.05716, abs=1e-5)
    assert np.all(found.pressure[near] > 0)


def test_pressure_without_the_reynolds_condition_is_negative_outside():
    found = outlet("none")
    assert found.pressure.min() < -0.2
    assert found.film_min < outlet("reynolds").film_min


def test_units_of_the_outlet():
    """An outlet with twice the film is another solution, with less than twice the minimum."""
    one, two = outlet("reynolds"), outlet("reynolds", 2 * inlet().film_inside)
    assert one.film_min < two.film_min < 2 * one.film_min


def test_unknown_condition():
    with pytest.raises(ValueError, match="cavitation"):
        outlet("half-sommerfeld")


def test_a_hopeless_mesh_is_refused():
    with pytest.raises(RuntimeError, match="did not converge"):
        inlet(replace(INLET_MESH, step=1.5))
