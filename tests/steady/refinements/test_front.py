"""Fronts at the sides of very thin layers: how well the extrema there are known, and what is said of them."""

import pytest

import softlube
from softlube.model.problem import Problem
from softlube.model.substrates import LayerKernel
from softlube.steady.error_estimate import LARGEST_ERROR
from softlube.steady.refinements.front import DETERMINED, ERRATIC, Front
from softlube.steady.regime import Regime


def test_a_minimum_film_at_a_front():
    solution = softlube.solve(beta=50.0, substrate=LayerKernel(0.2))
    assert solution.film_center == pytest.approx(0.0112645, rel=2e-4)
    assert abs(solution.film_min - 0.007386) < solution.film_min.error < LARGEST_ERROR * solution.film_min  # on 310 x 124 cells
    (said,) = solution.warnings
    assert "film_min is known to" in said


@pytest.mark.slow
def test_a_front_that_only_the_finest_grids_resolve():
    solution = softlube.solve(beta=100.0, substrate=LayerKernel(0.2))
    assert solution.film_center == pytest.approx(0.00787966, rel=1e-4)  # on 407 x 155 cells, as the film and place below
    assert abs(solution.film_min - 0.00351079) < solution.film_min.error < LARGEST_ERROR * solution.film_min
    assert solution.film_min_radius == pytest.approx(1.77545, abs=5e-4)
    (said,) = solution.warnings
    assert "film_min is known to" in said


def test_a_front_determines_the_extrema_where_the_film_is_thinnest_at_the_sides():
    thin, thick = (Regime.of(Problem(beta=50.0, substrate=LayerKernel(thickness))) for thickness in (0.2, 2.0))
    at_the_sides, at_the_outlet = {"film_min_angle_deg": 100.0}, {"film_min_angle_deg": 179.0}
    assert Front(thin).determines(None, at_the_sides) == dict.fromkeys(DETERMINED, ERRATIC)
    assert Front(thin).determines(None, at_the_outlet) == {}
    assert Front(thick).determines(None, at_the_sides) == {}
    assert "other beta are solved" in Front(thin).advice
    assert Front(thick).advice == ""
