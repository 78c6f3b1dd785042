"""Displacement under a line contact: Hertz, ends that bear pressure, what a substrate remembers, and energy."""

import numpy as np
import pytest

from softlube.discretization.line.displacement import displacement, surface
from softlube.discretization.line.memory import remembered
from softlube.discretization.line.panels import Panels
from softlube.model.substrates import HalfSpaceKernel, ViscoelasticKernel

GRADED = np.concatenate([[0], np.geomspace(1e-8, 1, 28), 2 - np.geomspace(1, 1e-8, 28)[1:], [2]])


def test_hertz():
    """√(1 − x²)/(2π) bears 1/4 and moves the surface by x²/2 and a constant."""
    panels = Panels(GRADED, 8)
    x = panels.nodes - 1
    gradient = -x / np.sqrt(1 - x**2) / (2 * np.pi)
    moved = displacement(HalfSpaceKernel(), panels)
    assert moved.load @ gradient == pytest.approx(0.25, rel=2e-5)
    w = moved.of(gradient, np.zeros(2))
    assert w - (moved.places - 1) ** 2 / 2 == pytest.approx(-(0.25 + np.log(2) / 2) + 0 * w, abs=2e-5)


def test_pressures_at_the_ends():
    """A pressure of 1 on 0 … 2, by its ends alone."""
    panels = Panels(np.array([0.0, 0.3, 2.0]), 5)
    moved = displacement(HalfSpaceKernel(), panels)
    x = moved.places
    with np.errstate(divide="ignore", invalid="ignore"):
        parts = [np.where(y > 0, y * np.log(y), 0.0) for y in (x, 2 - x)]
    assert moved.of(np.zeros(panels.size), np.array([0.0, 1.0])) == pytest.approx(2 * (sum(parts) - 2), abs=1e-12)
    assert moved.load_of_ends[1] == pytest.approx(2)


def bump(panels):
    s = panels.nodes
    return np.where(s < 2, np.sin(np.pi * s / 2) * np.cos(np.pi * s / 2) * np.pi, 0.0)  # of sin²(πs/2)


def test_equal_times_are_one_and_extreme_times_are_elastic():
    panels = Panels(np.concatenate([np.linspace(0, 2, 9), [3, 6, 20, 100, 1000]]), 8)
    gradient = bump(panels)

    def moved(*memory):
        w = displacement(ViscoelasticKernel(*memory), panels).matrix @ gradient
        return w - w[0]

    elastic = displacement(HalfSpaceKernel(), panels).matrix @ gradient
    elastic = elastic - elastic[0]
    assert moved((0.3, 0.4), (0.5, 0.5)) == pytest.approx(moved((0.7,), (0.5,)), abs=1e-13)
    # At the downstream end the memory has the polynomial of the first panel.
    assert moved((0.7,), (1e-9,)) == pytest.approx(elastic, abs=3e-6)
    assert moved((0.7,), (0.0,)) == pytest.approx(elastic, abs=1e-13)
    assert moved((0.7,), (1e13,)) == pytest.approx(0.3 * elastic, abs=1e-7)


@pytest.mark.parametrize("length", [0.1, 1.0, 10.0])
def test_the_substrate_loses_what_the_hysteresis_takes(length):
    """6∫ p w′ dx is the loss of the dashpots, 6 J L∫ q (−K q) dx with q the slope of the retarded pressure."""
    panels = Panels(np.concatenate([np.linspace(0, 2, 17), [2.5, 3, 4, 6, 10, 20, 50, 100, 300, 1000]]), 10)
    gradient, share = bump(panels), 0.7
    w = displacement(ViscoelasticKernel((share,), (length,)), panels).matrix @ gradient
    hysteresis = -6 * panels.weights @ ((w[:-1] - w[0]) * gradient)
    # The retarded pressure is left behind: q − L q′ = p, for many lengths downstream.
    behind = Panels(np.concatenate([-length * np.array([45, 30, 20, 12, 8, 5, 3, 2, 1, 0.5, 0.2]), panels.edges[:18]]), 10)
    p = np.where((behind.nodes > 0) & (behind.nodes < 2), np.sin(np.pi * behind.nodes / 2) ** 2, 0.0)
    slope = ((remembered(behind, length)[0] @ p)[:-1] - p) / length
    rows = surface(HalfSpaceKernel(), behind, behind)[:-1, :, :10]
    loss = -6 * share * length * (behind.weights * slope) @ np.einsum("xpk,pk->x", rows, behind.coefficients(slope))
    assert hysteresis == pytest.approx(loss, rel=1e-6)
