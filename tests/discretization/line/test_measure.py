"""Quantities of a line contact: extrema of polynomials, profiles, forces that must balance."""

import numpy as np
import pytest

from softlube.discretization.line.measure import LineFields, extremum, measure
from softlube.discretization.line.panels import Panels
from softlube.model.liquids import BarusLaw
from softlube.model.problem import Problem
from softlube.steady.line.march import march


def fields_of(**problem):
    *_, stage = march(Problem(**problem))
    return LineFields(stage.equations, stage.state)


def test_extremum_of_a_smooth_function():
    panels = Panels(np.linspace(0, 6, 7), 10)
    coefficients = panels.coefficients(np.sin(panels.nodes))
    assert extremum(panels, coefficients, 1) == pytest.approx((np.pi / 2, 1.0), abs=1e-8)
    assert extremum(panels, coefficients, -1) == pytest.approx((3 * np.pi / 2, -1.0), abs=1e-8)
    assert extremum(panels, coefficients, 1, after=3.0)[0] == pytest.approx(3.0, abs=0.05)


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_profiles_and_their_extrema(cavitation):
    fields = fields_of(beta_load=1e3, cavitation=cavitation)
    values = measure(fields)
    x = np.linspace(-1.5, 1.5, 20001)
    film, pressure = fields.film_at(x), fields.pressure_at(x)
    assert values["film_min"] == pytest.approx(np.nanmin(film), rel=1e-6)
    assert values["film_min_place"] == pytest.approx(x[np.nanargmin(film)], abs=2e-4)
    assert values["pressure_max"] == pytest.approx(pressure.max(), rel=1e-6)
    assert values["load"] == pytest.approx(0.25, rel=1e-12)
    assert (pressure.min() < -0.01) == (cavitation == "none")
    assert ("free_boundary" in values) == (cavitation == "reynolds")


def test_the_gap_goes_on_behind_the_free_boundary():
    fields = fields_of(beta_load=1e3)
    x, gap = fields.opening(np.array([1e-4, 1e-2, 0.3]))
    assert x[-1] < fields.front < fields.x[0]
    assert gap[-1] == pytest.approx(fields.film[0], rel=5e-3)
    assert np.all(np.diff(gap) < 0)
    assert np.isnan(fields.film_at(fields.front - 0.1))
    assert fields.pressure_at(fields.front - 0.1) == 0


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
@pytest.mark.parametrize("liquid", [{}, {"liquid": BarusLaw(20.0)}])
def test_the_friction_is_what_the_liquid_dissipates(cavitation, liquid):
    """C − P = C + 3β ∫ u³φ p′² dx, and an elastic substrate drags nothing."""
    fields = fields_of(beta_load=300.0, cavitation=cavitation, **liquid)
    values, beta, panels, state = measure(fields), 300.0, fields.panels, fields.state
    fluidity = fields.equations.problem.liquid.fluidity(fields.pressure)[0]
    by_pressure = panels.weights @ (3 * beta * fields.film**3 * fluidity * state.gradient**2)
    ends = panels.edges[[0, -1]] if cavitation == "none" else panels.edges[[-1]]
    by_pressure += sum(6 / (beta * abs(fields.front + end)) for end in ends)  # beyond the mesh u = x²/2, p′ = −4/(βx⁴)
    assert values["friction_total"] == pytest.approx(values["friction_couette"] + by_pressure, rel=1e-7)
    moved = fields.x**2 / 2 - fields.film
    assert abs(6 * panels.weights @ ((moved - moved.max()) * state.gradient)) < 1e-6 * values["friction_total"]
