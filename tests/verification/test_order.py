"""Observed order of accuracy of the whole solver, in r and in θ, by a fit.

Without the cavitation condition the solution is smooth and the order is that of the scheme, four along r and six along θ.  With
it the free boundary lies somewhere between the nodes, which leaves second order with an erratic constant.
"""

import numpy as np
import pytest

from softlube.discretization.grid import PolarGrid
from softlube.model.problem import Problem
from softlube.steady.level import solve_level
from softlube.steady.regime import Regime

FINE = {"edge_width": 0.15, "side_width": 0.5}


def errors(problem, grids, finest, names):
    """Relative errors of quantities on each grid against the finest, shape (grids, names)."""
    exact = solve_level(Regime.of(problem), finest).level.values
    values = [solve_level(Regime.of(problem), grid).level.values for grid in grids]
    return np.array([[abs(v[name] / exact[name] - 1) for name in names] for v in values])


def order(sizes, error):
    return -np.polyfit(np.log(sizes), np.log(error), 1)[0]


SMOOTH = ["film_center", "film_inlet", "load", "friction_domain"]


@pytest.mark.parametrize(("direction", "sizes", "expected"), [("r", [24, 32, 43, 57], 4), ("theta", [12, 16, 20, 26], 6)])
def test_smooth_solutions_converge_at_the_order_of_the_scheme(direction, sizes, expected):
    problem = Problem(beta=30.0, cavitation="none")
    if direction == "r":
        grids = [PolarGrid(n, 16, **FINE) for n in sizes]
        finest = PolarGrid(120, 16, **FINE)
    else:
        grids = [PolarGrid(48, n, **FINE) for n in sizes]
        finest = PolarGrid(48, 60, **FINE)
    found = errors(problem, grids, finest, SMOOTH)
    # The friction is an integral of a cubic spline, whose own error, 10⁻⁷, is seen on the grids that differ in θ.
    combined = np.exp(np.log(found[:, : 4 if direction == "r" else 3]).mean(axis=1))
    assert order(np.array(sizes), combined) == pytest.approx(expected, abs=0.6)
    assert found[-1].max() < (1e-3 if direction == "r" else 1e-6)


def test_free_boundary_leaves_at_least_second_order():
    problem, sizes = Problem(beta=100.0), np.array([10, 14, 20, 28])
    grids = [PolarGrid(int(2.2 * n), n, edge_width=0.06, side_width=0.5) for n in sizes]
    finest = PolarGrid(110, 50, edge_width=0.06, side_width=0.5)
    names = ["film_center", "film_min", "film_outlet_min", "load_contact", "friction_contact"]
    found = errors(problem, grids, finest, names)
    assert order(sizes, np.exp(np.log(found).mean(axis=1))) > 1.9
    assert found[-1].max() < 1.5e-3
