"""The way to a line contact: starts, meshes, continuation, order of accuracy."""

import numpy as np
import pytest

from softlube.discretization.line.measure import LineFields, measure
from softlube.discretization.line.panels import Panels
from softlube.errors import NotConvergedError
from softlube.model.liquids import BarusLaw
from softlube.model.problem import Problem
from softlube.steady.line import march as module
from softlube.steady.line.march import RIGID_HEIGHT, first, followed, march, resolved, solve_on, transferred, unresolved


def last(**problem):
    *_, stage = march(Problem(**problem))
    return stage


def test_height_of_a_rigid_cylinder():
    state = last(beta_load=1e-6).state
    assert state.height * 1e-6 == pytest.approx(RIGID_HEIGHT, rel=1e-3)


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_meshes_resolve_thick_and_thin_films(cavitation):
    for beta in (1e-4, 10.0, 1e6):
        stage = last(beta_load=beta, cavitation=cavitation)
        assert unresolved(stage).max() < module.RESOLVED
        assert stage.panels.number < 100
        assert stage.problem.parameter == beta


def test_orders_of_accuracy():
    """Three points on a panel: p′ is a parabola there, and the flux converges with the fourth power of the spacing at least."""
    problem = Problem(beta_load=100.0)
    exact = last(beta_load=100.0)
    exact = resolved(solve_on(problem, exact.panels.with_points(14), transferred(exact, exact.panels.with_points(14))), 1e-9)
    wanted = measure(LineFields(exact.equations, exact.state))
    panels, errors = exact.panels.with_points(3), []
    for _ in range(3):
        stage = solve_on(problem, panels, transferred(exact, panels))
        values = measure(LineFields(stage.equations, stage.state))
        errors.append([abs(values[name] / wanted[name] - 1) for name in ("film_carried", "free_boundary", "friction_couette")])
        panels = panels.split(np.ones(panels.number, dtype=bool))
    orders = np.log2(np.array(errors[0]) / errors[-1]) / 2
    assert np.all(orders > 4), orders


def test_a_way_that_ends():
    stage = first(Problem(beta_load=1.0))

    with pytest.raises(NotConvergedError, match=r"continuation ended at beta_load = 1$"):
        list(followed(stage, lambda _: Problem(beta_load=1e30), 0.0, 1.0, 1.0))


def test_a_spike_that_is_too_narrow():
    with pytest.raises(NotConvergedError, match="the pressure spike becomes narrower"):
        list(march(Problem(beta_load=8.3, liquid=BarusLaw(42.0))))


def test_newton_fails_from_nonsense():
    stage = first(Problem(beta_load=1.0))
    panels = Panels(stage.panels.edges, 4)
    state = transferred(stage, panels)
    assert solve_on(Problem(beta_load=1e25), panels, state) is None
