"""Meshes that go along with the pressure spike."""

import numpy as np
import pytest

from softlube.discretization.line.panels import Panels
from softlube.steady.line.spike import LARGEST_MOVE, SPAN, foreseen, moved, steepest


def test_the_steepest_place():
    panels = Panels(np.linspace(0, 3, 13), 12)
    gradient = -np.exp(-((panels.nodes - 1.7) ** 2) / 0.1) + 0.5 * np.exp(-((panels.nodes - 0.4) ** 2) / 0.1)
    assert steepest(panels, gradient) == pytest.approx(1.7, abs=1e-5)


def test_a_parabola_is_foreseen_and_a_jump_is_not():
    steps = [(t, 0.2 + 0.01 * t - 0.002 * t**2) for t in (0.0, 1.0, 1.5)]
    assert foreseen(steps, 2.5) == pytest.approx(0.01 - 0.002 * (2.5**2 - 1.5**2), rel=1e-9)
    assert foreseen(steps[:2], 2.5) == 0
    assert foreseen([*steps[:2], (1.5, 1.9)], 2.5) == 0
    assert foreseen(steps, 100.0) == 0
    assert LARGEST_MOVE < SPAN


@pytest.mark.parametrize("place", [0.05, 0.5])
def test_panels_around_the_place_move_and_the_ends_stay(place):
    panels = Panels(np.concatenate([[0, 0.01, 0.03, place, place + 1e-9, place + 0.1], [place + 0.5, 2, 10]]), 4)
    new = moved(panels, place, 0.01)
    assert new.edges[3:6] - panels.edges[3:6] == pytest.approx(0.01)
    assert new.edges[[0, 7, 8]] == pytest.approx(panels.edges[[0, 7, 8]])
    assert np.all(np.diff(new.edges) > 0)
    # Without a free boundary the mesh goes on downstream.
    behind = Panels(np.array([-100, -5, -0.2, place - 0.2, place, place + 1e-9, 3]), 4)
    assert np.all(np.diff(moved(behind, place, -0.01).edges) > 0)
