"""The pressure spike on the way to a liquid that thickens: where it is, and meshes that go along with it.

A spike is narrow, 10⁻⁹ of the contact's width where viscosities rise by e²⁰, and its place moves as the liquid thickens.  So
the mesh is moved to where the spike is going to be, by the polynomial through its last places: then a step of the continuation
may be many widths long.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.line.measure import extremum
from softlube.discretization.line.panels import Panels

Array = NDArray[np.floating]

ORDER = 2
"""Degree of the polynomial."""
LARGEST_MOVE = 0.05
"""Largest move, over b, that is foreseen; a larger one is another place that has become the steepest."""
SPAN = 0.3
"""Reach of the mesh on either side that goes along as a whole, over b; twice as far away it stands still."""


def steepest(panels: Panels, gradient: Array) -> float:
    """Place s of the steepest pressure."""
    coefficients = panels.coefficients(gradient)
    return max((extremum(panels, coefficients, sign) for sign in (1, -1)), key=lambda found: abs(found[1]))[0]


def foreseen(steps: list[tuple[float, float]], parameter: float) -> float:
    """How far the steepest pressure moves from the last step to a parameter; 0 where nothing can be foreseen.

    Parameters
    ----------
    steps : list of tuple
        Parameter and place of each step.
    parameter : float
        The next one.
    """
    if len(steps) <= ORDER:
        return 0.0
    known, places = np.array(steps[-ORDER - 1 :]).T
    if np.max(np.abs(np.diff(places))) > LARGEST_MOVE:
        return 0.0
    move = float(np.polyval(np.polyfit(known - known[-1], places, ORDER), parameter - known[-1]) - places[-1])
    return move if abs(move) < LARGEST_MOVE else 0.0


def moved(panels: Panels, place: float, move: float) -> Panels:
    """Panels that are moved around a place, and stand still at their ends and far away."""
    left = max(float(panels.edges[0]), place - 2 * SPAN)
    known = [left, max((left + place) / 2, place - SPAN), place + SPAN, place + 2 * SPAN]
    return Panels(panels.edges + np.interp(panels.edges, known, [0.0, move, move, 0.0]), panels.points)
