"""The coupled equations: exact Jacobian, far field, first guess."""

from dataclasses import replace

import numpy as np
import pytest

from softlube.discretization.grid import PolarGrid
from softlube.discretization.system import ContactSystem
from softlube.model.exact import HERTZ_LOAD, far_field_profile
from softlube.model.problem import Problem
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime

GRID = PolarGrid(20, 10, edge_width=0.1)
PROBLEMS = [
    Problem(beta=50.0),
    Problem(beta=50.0, height=0),
    Problem(beta=50.0, height=1),
    Problem(beta=50.0, cavitation="none"),
    Problem(beta_load=80.0),
    Problem(beta_load=80.0, cavitation="none"),
]


def state(problem):
    """A point near a solution, perturbed so that nothing vanishes by chance."""
    system = ContactSystem(problem, GRID)
    rng = np.random.default_rng(3)
    x = system.start()
    x[: GRID.n_unknown] += 0.002 * rng.random(GRID.n_unknown)
    return system, x, rng.normal(size=x.size)


@pytest.mark.parametrize("problem", PROBLEMS)
def test_jacobian_against_complex_step(problem):
    system, x, direction = state(problem)
    step = 1e-25
    moved = x + 1j * step * direction
    # The film and the residual are analytic in x, so the complex step differentiates the whole chain to round-off.
    n = GRID.n_unknown
    h0 = moved[-1] if problem.load_controlled else problem.height
    pressure = np.concatenate([moved[:n], system.rim_pressure[0] + h0 * system.rim_pressure[1]])
    high = system.elastic.radial_high
    high = replace(high, blocks=[(*where, matrices.astype(complex)) for *where, matrices in high.blocks])
    substrate = replace(system.elastic, radial_high=high)
    film = substrate.deflection(moved[:n]) + system.film_offset[0] + h0 * system.film_offset[1]
    numeric = system.reynolds.residual(pressure, film, system.speed).imag / step
    at = system.linearise(x)
    assert at.film == pytest.approx(film.real, rel=1e-13)
    assert at.times(direction)[:n] == pytest.approx(numeric, rel=1e-9, abs=1e-11)
    assert system.film_change(direction) == pytest.approx(film.imag / step, rel=1e-12, abs=1e-12)
    if problem.load_controlled:
        load = system.elastic.load_weights @ np.concatenate([moved[:n], system.rim_pressure[0] + h0 * system.rim_pressure[1]])
        load = load + system.speed * (system.elastic.far_load[0] + h0 * system.elastic.far_load[1])
        assert at.residual[-1] == pytest.approx(load.real - HERTZ_LOAD, abs=1e-14)
        assert at.times(direction)[-1] == pytest.approx(load.imag / step, rel=1e-12)


@pytest.mark.parametrize("problem", PROBLEMS)
def test_scale_is_about_the_diagonal(problem):
    """Newton's method compares p with R/scale; the true diagonal has the neighbours' share in it too."""
    system, x, _ = state(problem)
    at = system.linearise(x)
    diagonal = np.array([at.times(unit)[i] for i, unit in enumerate(np.eye(x.size))])
    ratio = at.scale[: GRID.n_unknown] / diagonal[: GRID.n_unknown]
    assert 0.95 < ratio.min() <= ratio.max() < 1.3
    assert at.scale.size == x.size


@pytest.mark.parametrize("problem", PROBLEMS)
def test_size_is_the_largest_relative_change_of_film_or_pressure(problem):
    system, x, direction = state(problem)
    at, n = system.linearise(x), system.grid.n_unknown
    for step in (1e-3 * direction, np.append(np.zeros(n - 1), direction[n - 1 :])):
        film = np.max(np.abs(system.film(x + step) / system.film(x) - 1))
        pressure = np.max(np.abs(step[:n])) / np.max(np.abs(x[:n]))
        assert at.reach(step)[0] == pytest.approx(max(film, pressure), rel=1e-9)


@pytest.mark.parametrize("problem", PROBLEMS)
def test_longest_step_keeps_the_film(problem):
    system, x, direction = state(problem)
    at = system.linearise(x)
    for size in (1e-3, 1.0, 1e3):
        fraction = at.reach(size * direction)[1]
        assert system.film(x + fraction * size * direction).min() >= 0.49 * at.film.min()
    assert at.reach(1e-9 * direction)[1] == 1


@pytest.mark.parametrize("problem", PROBLEMS)
def test_rim_carries_the_far_field(problem):
    system, x, _ = state(problem)
    h0 = system.height(x)
    rim = system.pressure(x).reshape(GRID.shape)[-2:]
    r = GRID.r[-2:, None]
    expected = far_field_profile(GRID.theta, problem.cavitation) / problem.parameter * r**-3 * (1 - 4 * h0 / r**2)
    assert rim == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
@pytest.mark.parametrize("given", [{"beta": 1.0, "height": h} for h in (-1, 0, 1)] + [{"beta_load": 1.0}])
def test_first_guess_has_a_positive_film(given, cavitation):
    name = "beta_load" if "beta_load" in given else "beta"
    for beta in (1e-6, 0.5, 3.0, 100.0, 1e5, 1e9):
        problem = Problem(**(given | {name: beta}), cavitation=cavitation)
        system = ContactSystem(problem, grid_for(Regime.of(problem), 12), Regime.of(problem).unit)
        start = system.start(Regime.of(problem).first_height / system.scale)
        film, height = system.film(start), system.height(start)
        assert film.min() > 0
        if height > 1:  # rigid: the gap
            assert film[0] == pytest.approx(height, rel=0.02)
        elif beta < 1e6:  # h₀ over Hertz contacts of indentation 1, lifted by the film of the Hertz limit
            assert film[0] == pytest.approx(height + 1 + max(system.beta, 1) ** -0.6, rel=0.1)


@pytest.mark.parametrize("problem", PROBLEMS)
def test_another_unit_of_height_describes_the_same_contact(problem):
    """The same state in half the unit, on the grid that is the same in metres."""
    system, x, _ = state(problem)
    other = ContactSystem(problem, GRID.scaled(2**0.5), 0.5)
    assert other.beta == system.beta / 4
    assert other.prescribed == pytest.approx(system.prescribed * (2**1.5 if problem.load_controlled else 2), rel=1e-14)
    y = x * 2**0.5
    if problem.load_controlled:
        y[-1] = 2 * x[-1]
    assert other.film(y) == pytest.approx(2 * system.film(x), rel=1e-12)
    assert other.load(y) == pytest.approx(2**1.5 * system.load(x), rel=1e-12)
    # the balance (6a) over an area is one of 2^(5/2): u^3 p ~ 2^(7/2), and speed ∂u ~ 2^(7/2), over the cells' edges
    n = GRID.n_unknown
    first, second = system.linearise(x).residual[:n], other.linearise(y).residual[:n]
    assert second == pytest.approx(2**3.5 * first, rel=1e-9, abs=1e-9 * np.abs(first).max())
