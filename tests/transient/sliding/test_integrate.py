"""The start of sliding: ends in steady sliding, begins as a squeeze film, keeps the complementarity."""

from dataclasses import replace

import numpy as np
import pytest

import softlube
from softlube.discretization.measure import measure
from softlube.discretization.system import ContactSystem
from softlube.errors import InputError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.indenters import PowerShape, SphereShape
from softlube.model.liquids import BarusLaw, NewtonianLaw
from softlube.model.problem import Problem
from softlube.model.substrates import CreepingKernel, HalfSpaceKernel, LayerKernel
from softlube.steady.level import solve_level
from softlube.steady.mesh import angles_for, grid_for
from softlube.steady.regime import Regime
from softlube.transient.motion import constant_load, constant_speed, history
from softlube.transient.sliding.integrate import deepest_problem, mass_matrix, start_sliding
from softlube.transient.squeeze.integrate import integrate

BETA = 100.0
COMPARED = ("height", "film_center", "film_min", "friction_contact", "pressure_max")


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_steady_sliding_is_the_long_time_limit(cavitation):
    run = start_sliding(BETA, constant_load(HERTZ_LOAD, 1.0, 8 * BETA), cavitation=cavitation, n_theta=13, tolerance=3e-3)
    problem = Problem(beta_load=BETA, cavitation=cavitation)  # type: ignore[arg-type]
    steady = solve_level(Regime.of(problem), grid_for(Regime.of(problem), 13)).level.values
    late = measure(run.fields[-1])
    for name in COMPARED:
        assert late[name] == pytest.approx(steady[name], rel=1e-4), name
    assert run.film_center[0] > 10 * run.film_center[-1]


PRESSED_DOWN = history("height", [0, 50, 100, 700], [1.0, -0.5, -1.0, -1.0])
LOADED_LATE = history("load", [0, 100, 200, 800], [0.1, 0.1, HERTZ_LOAD, HERTZ_LOAD], 1.0)


@pytest.mark.parametrize(
    ("beta", "motion", "substrate", "liquid"),
    [
        (BETA, constant_load(HERTZ_LOAD, 1.0, 600.0), LayerKernel(1.0), NewtonianLaw()),
        (BETA, constant_load(HERTZ_LOAD, 1.0, 600.0), LayerKernel(0.3, 0.3, "frictionless"), NewtonianLaw()),
        (BETA, constant_load(HERTZ_LOAD, 1.0, 600.0), LayerKernel(1.0, 0.4), BarusLaw(5.0)),
        (BETA, constant_load(HERTZ_LOAD, 1.0, 600.0), HalfSpaceKernel(), BarusLaw(5.0)),
        (BETA, constant_load(2 * HERTZ_LOAD, 1.0, 800.0), HalfSpaceKernel(), NewtonianLaw()),
        (BETA, LOADED_LATE, HalfSpaceKernel(), NewtonianLaw()),
        (BETA, PRESSED_DOWN, HalfSpaceKernel(), NewtonianLaw()),
        (1.0, history("height", [0, 1, 2, 20], [1.0, 0.7, 0.5, 0.5]), HalfSpaceKernel(), NewtonianLaw()),
        (1.0, history("height", [0, 1, 2, 20], [1.0, 0.7, 0.0, 0.0]), LayerKernel(1.0), NewtonianLaw()),
        (1.0, constant_load(HERTZ_LOAD, 1.0, 60.0), HalfSpaceKernel(), NewtonianLaw()),
    ],
    ids=[
        "layer",
        "frictionless",
        "layer and Barus",
        "Barus",
        "another load",
        "load history",
        "depth",
        "gap",
        "touching a layer",
        "light",
    ],
)
def test_every_motion_ends_in_its_steady_sliding(beta, motion, substrate, liquid):
    motion = replace(motion, substrate=substrate, liquid=liquid)
    run = start_sliding(beta, motion, n_theta=13, tolerance=3e-3)
    problem, unit = deepest_problem(beta, motion, "reynolds")
    regime = Regime.of(problem)
    steady = measure(solve_level(regime, grid_for(regime, angles_for(regime, 12))).fields.in_units(1 / unit))
    late = measure(run.fields[-1])
    for name in (*COMPARED, "load"):
        assert late[name] == pytest.approx(steady[name], rel=2e-4, abs=1e-9), name


@pytest.mark.parametrize("indenter", [PowerShape(1.0, 1.0, 4.0), SphereShape(0.2, 1.0)])
def test_under_any_indenter_it_ends_in_steady_sliding(indenter):
    motion = replace(constant_load(HERTZ_LOAD, 1.0, 800.0), indenter=indenter)
    problem, _ = deepest_problem(BETA, motion, "reynolds")
    steady = solve_level(Regime.of(problem), grid_for(Regime.of(problem), 13)).level.values
    late = measure(start_sliding(BETA, motion, n_theta=13, tolerance=3e-3).fields[-1], Regime.of(problem).edge_radius)
    for name in COMPARED:
        assert late[name] == pytest.approx(steady[name], rel=1e-3), name


def test_on_a_layer_to_the_accuracy_of_the_steady_solver():
    layer = LayerKernel(1.0)
    run = start_sliding(BETA, replace(constant_load(HERTZ_LOAD, 1.0, 6 * BETA), substrate=layer), tolerance=3e-3)
    steady = softlube.solve(beta_load=BETA, substrate=layer)
    late = measure(run.fields[-1], Regime.of(steady.problem).edge_radius)
    for name in ("height", "film_center", "film_min", "friction_contact"):
        assert late[name] == pytest.approx(float(steady.quantities[name]), rel=1e-2 if name == "film_min" else 2e-3), name


def test_slow_sliding_on_a_layer_is_a_squeeze_film():
    motion = replace(constant_load(HERTZ_LOAD, 1.0, 30.0), substrate=LayerKernel(0.5), liquid=BarusLaw(2.0))
    run = start_sliding(1e7, motion, n_theta=18, tolerance=3e-4)
    expected = integrate(motion, rings=128, tolerance=1e-7).histories(run.time)
    assert run.film_center == pytest.approx(expected["film_center"], rel=3e-3)
    assert run.height == pytest.approx(expected["height"], abs=5e-3)


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_a_sphere_that_is_pulled_off(cavitation):
    """Without the condition the film pulls as on the rings; with it, it lets go.

    The steps are judged by the film, of which the load of a substrate that yields so little takes more digits.
    """
    motion = constant_speed(-0.05, 0.1, 10.0)
    run = start_sliding(1e4, motion, cavitation=cavitation, n_theta=13, tolerance=3e-3)
    loads = np.array([fields.load for fields in run.fields])
    assert run.height == pytest.approx(0.1 + 0.05 * run.time)
    if cavitation == "reynolds":
        assert min(fields.pressure.min() for fields in run.fields) == 0
        assert np.all(loads >= 0)
    else:
        expected = integrate(motion, rings=91, tolerance=1e-6).histories(run.time)["load"]
        assert loads == pytest.approx(expected, abs=1e-2 * np.max(np.abs(expected)))


def test_film_limit_stops_at_the_limit():
    motion = constant_load(HERTZ_LOAD, 1.0, 80.0)
    whole, run = (start_sliding(BETA, motion, n_theta=13, tolerance=2e-3, film_limit=limit) for limit in (0.05, 0.1))
    assert (whole.ended_by, run.ended_by) == ("duration", "film_limit")
    assert measure(run.fields[-1])["film_min"] == pytest.approx(0.1, rel=2.1e-4)
    least = [measure(fields)["film_min"] for fields in whole.fields]
    assert run.time[-1] == pytest.approx(np.interp(-0.1, -np.array(least), whole.time), rel=5e-3)


def test_steady_sliding_to_the_accuracy_of_the_steady_solver():
    """On the default grid, from a film squeezed thinner than the steady one."""
    run = start_sliding(BETA, constant_load(HERTZ_LOAD, 1.0, 6 * BETA), pressed=3000.0, tolerance=3e-3)
    steady = softlube.solve(beta_load=BETA)
    late = measure(run.fields[-1])
    assert run.film_center[0] < 0.5 * steady.film_center
    for name in ("height", "film_center", "film_min", "friction_contact"):
        assert late[name] == pytest.approx(float(steady.quantities[name]), rel=1e-2 if name == "film_min" else 2e-3), name


def test_very_slow_sliding_is_a_squeeze_film():
    """β → ∞: the plane and the rings, two integrators, one film."""
    run = start_sliding(1e7, constant_load(HERTZ_LOAD, 1.0, 30.0), n_theta=18, tolerance=3e-4)
    rings = integrate(constant_load(HERTZ_LOAD, 1.0, 30.0), rings=128, tolerance=1e-7)
    expected = rings.histories(run.time)
    assert run.film_center == pytest.approx(expected["film_center"], rel=3e-3)
    assert run.height == pytest.approx(expected["height"], abs=5e-3)


def test_tolerance_changes_the_film_little():
    loose, tight = (start_sliding(BETA, constant_load(HERTZ_LOAD, 1.0, BETA), n_theta=13, tolerance=t) for t in (1e-3, 5e-4))
    assert np.interp(tight.time, loose.time, loose.height)[-1] == pytest.approx(tight.height[-1], abs=5e-4)
    assert loose.film_center[-1] == pytest.approx(tight.film_center[-1], rel=5e-3)


def test_pressure_stays_positive_and_carries_the_load():
    run = start_sliding(BETA, constant_load(HERTZ_LOAD, 1.0, 0.5 * BETA), n_theta=13, tolerance=3e-3)
    for fields in run.fields[1:]:
        assert fields.pressure.min() >= 0
        assert fields.film.min() > 0
        assert fields.load == pytest.approx(HERTZ_LOAD, rel=1e-6)


def test_mass_is_the_measure_of_the_plane():
    """∫ exp(−r²) dA = π, with a dependence on θ that integrates to nothing."""
    problem = Problem(beta_load=BETA)
    grid = grid_for(Regime.of(problem), 18)
    mass = mass_matrix(ContactSystem(problem, grid))
    field = np.exp(-(grid.r[:, None] ** 2)) * (1 + grid.r[:, None] * np.cos(grid.theta))
    weights = np.full(grid.shape[1], grid.d_s)
    weights[[0, -1]] /= 2
    rings = (mass @ field.ravel()).reshape(grid.n_r, -1)
    assert 2 * grid.d_xi * np.sum(rings @ weights) == pytest.approx(np.pi, rel=3e-4)


def test_refused():
    with pytest.raises(InputError, match="tolerance"):
        start_sliding(BETA, constant_load(HERTZ_LOAD, 1.0, 1.0), tolerance=0.0)
    with pytest.raises(InputError, match="initial_height"):
        start_sliding(BETA, constant_load(HERTZ_LOAD, -1.0, 1.0))
    with pytest.raises(InputError, match="film_limit: the film starts at"):
        start_sliding(BETA, constant_load(HERTZ_LOAD, 1.0, 1.0), film_limit=3.0)
    with pytest.raises(InputError, match="not positive all the time"):
        start_sliding(BETA, history("load", [0, 1], [1.0, 0.0], 1.0))
    with pytest.raises(InputError, match="pressed"):
        start_sliding(BETA, constant_speed(1.0, 1.0, 0.5), pressed=1.0)
    with pytest.raises(InputError, match="a start of sliding on one that remembers is not solved"):
        start_sliding(BETA, replace(constant_load(HERTZ_LOAD, 1.0, 1.0), substrate=CreepingKernel((0.5,), (1.0,))))
