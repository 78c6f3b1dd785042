"""Panels: integrals, interpolation, cutting and joining, against polynomials."""

import numpy as np
import pytest

from softlube.discretization.line.panels import Panels

EDGES = np.array([-3.0, -1.0, 0.0, 0.5, 2.0, 6.0])


def test_gauss_rule_and_interpolation_are_exact_for_polynomials():
    panels = Panels(EDGES, 4)
    s = panels.nodes
    assert panels.weights @ s**7 == pytest.approx((6.0**8 - 3.0**8) / 8, rel=1e-13)
    places = np.linspace(-3, 6, 37)
    assert panels.evaluate(panels.coefficients(s**3 - s), places) == pytest.approx(places**3 - places, abs=1e-11)


def test_integral_from_its_derivative_and_its_ends():
    panels = Panels(EDGES, 4)
    s, places = panels.nodes, np.linspace(-3, 6, 37)

    def f(x):
        return x**4 - 2 * x

    found = panels.integral_coefficients(4 * s**3 - 2, np.array([f(-3.0), f(6.0)]))
    assert panels.evaluate(found, places) == pytest.approx(f(places), abs=1e-10)
    at_nodes = panels.integral_at_nodes @ (4 * s**3 - 2) + panels.of_ends(panels.values_at_nodes) @ [f(-3.0), f(6.0)]
    assert at_nodes == pytest.approx(f(s), abs=1e-10)


def test_downstream_of_the_origin_integrals_start_downstream():
    panels = Panels(EDGES, 3)
    assert panels.turn == 2
    assert Panels(EDGES[2:], 3).turn == 0
    # What happens upstream leaves no round-off downstream.
    bump = np.where(panels.nodes > 0, 1e16, 0.0)
    assert panels.integral_at_nodes[:6] @ bump == pytest.approx(np.zeros(6))


def test_cut_and_joined():
    panels = Panels(np.array([0.0, 1.0, 10.0, 1000.0]), 3)
    assert panels.split(np.array([True, False, True])).edges == pytest.approx([0, 0.5, 1, 10, 100, 1000])
    fine = panels.split(np.ones(3, dtype=bool))
    assert fine.joined(np.array([True, True, False, True, True, True])).edges == pytest.approx([0, 1, np.sqrt(10), 100, 1000])
    assert panels.with_points(5).size == 15
