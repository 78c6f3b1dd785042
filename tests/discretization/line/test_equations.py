"""The equations of a line contact: exact Jacobian, mass between the nodes, the rigid cylinder."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from softlube.discretization.line.equations import LineEquations, LineState
from softlube.discretization.line.panels import Panels
from softlube.model.liquids import BarusLaw, DowsonHigginsonLaw, EyringLaw, NewtonianLaw
from softlube.model.problem import Problem
from softlube.model.substrates import ViscoelasticKernel
from softlube.steady.line.march import march

EDGES = np.array([0, 0.3, 1, 2, 4, 20])


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
@pytest.mark.parametrize("liquid", [NewtonianLaw(), DowsonHigginsonLaw(BarusLaw(8.0), 2.0), EyringLaw(BarusLaw(3.0), 0.05)])
def test_jacobian(cavitation, liquid):
    problem = Problem(beta_load=20.0, cavitation=cavitation, liquid=liquid, substrate=ViscoelasticKernel((0.4,), (0.7,)))
    edges = EDGES if cavitation == "reynolds" else np.concatenate([-EDGES[:0:-1], EDGES])
    panels = Panels(edges, 4)
    s = np.maximum(panels.nodes, 0)
    state = LineState((s - s**2) * np.exp(-2 * s), 1.5, 0.3, -0.8)
    equations = LineEquations(problem, panels, state)
    x = equations.vector(state)
    at = equations.linearise(x)
    direction = np.random.default_rng(3).normal(size=x.size)
    h = 1e-6
    # Rows are scaled by the film, whose change is no part of the Jacobian.
    film = [
        np.append(equations.film(equations.state(x + sign * h * direction))[:-1], np.ones(at.residual.size - panels.size))
        for sign in (-1, 1)
    ]
    low, high = (equations.linearise(x + sign * h * direction).residual * u for sign, u in zip((-1, 1), film, strict=True))
    rows = np.append(equations.film(state)[:-1], np.ones(at.residual.size - panels.size))
    assert at.times(direction) * rows == pytest.approx((high - low) / (2 * h), rel=1e-5, abs=1e-6)


def solved(**problem):
    *_, stage = march(Problem(**problem))
    return stage


def test_flux_is_the_same_between_the_nodes():
    stage = solved(beta_load=1e3)
    panels, equations, state = stage.panels, stage.equations, stage.state
    s = np.linspace(0.01, 3, 101)
    film = panels.evaluate(panels.coefficients(equations.film(state)[:-1]), s)
    gradient = panels.evaluate(panels.coefficients(state.gradient), s)
    assert film + 1e3 * film**3 * gradient == pytest.approx(np.full(101, state.flux), rel=1e-5)


def test_rigid_cylinder_with_the_reynolds_condition():
    """β → 0: p′ = −(u − u*)/(βu³) under u = h + x²/2, with p = p′ = 0 at the free boundary (Martin 1916)."""
    beta = 1e-6
    state = solved(beta_load=beta).state

    def pressure_far(front):  # over √(2h)/(βh²), with x = √(2h) tan θ
        carried = 1 + front**2
        return quad(lambda x: (1 + x**2 - carried) / (1 + x**2) ** 3, front, np.inf)[0]

    front = brentq(pressure_far, -0.9, -0.1)
    load = quad(lambda x: (x - front) * (1 + x**2 - 1 - front**2) / (1 + x**2) ** 3, front, np.inf)[0]
    height = 2 * load / (beta * 0.25)  # N = −∫ (x − x_f) p′ dx
    assert state.front / np.sqrt(2 * height) == pytest.approx(front, rel=2e-4)
    assert state.flux / height == pytest.approx(1 + front**2, rel=2e-4)
    assert state.flux == pytest.approx(2 / beta, rel=1e-5)
