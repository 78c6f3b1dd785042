"""The film's figures: profiles, maps, the inlet film."""

import numpy as np
import pytest

from softlube.paper.figures import Case
from softlube.paper.figures.base import PROFILES, WIDE
from softlube.paper.figures.film import MAPS


def test_profiles_are_even_in_y_and_leave_a_film(drawn, solutions):
    (film_x, film_y) = drawn("8").tables
    beta, _, u = (np.asarray(column, dtype=float) for column in film_y.columns.values())
    for value in PROFILES:
        assert u[beta == value] == pytest.approx(u[beta == value][::-1], rel=1e-9)
    assert min(film_x.columns["u [|h0|]"]) > 0
    beta, x, u = (np.asarray(column, dtype=float) for column in film_x.columns.values())
    for value in PROFILES:
        centre = (beta == value) & (x == 0)
        assert u[centre] == pytest.approx(float(solutions[Case(value)].film_center), rel=1e-9)


def test_no_point_of_a_map_is_below_the_minimum(drawn, solutions):
    columns = drawn("9").tables[0].columns
    for value in MAPS:
        film, least = np.asarray(columns[f"u at beta = {value:g} [|h0|]"]), float(solutions[Case(value)].film_min)
        assert least * 0.999 < film.min() < 1.1 * least  # of a coarse map


def test_the_inlet_film_and_its_limit(drawn, solutions):
    columns = drawn("S3").tables[0].columns
    assert columns["u(1, 0) [|h0|]"] == pytest.approx([float(solutions[Case(beta)].film_inlet) for beta in WIDE])
    ratio = columns["u(1, 0) [|h0|]"] / columns["similarity theory [|h0|]"]
    assert abs(ratio[-1] - 1) < 0.02
    assert np.all(np.diff(np.abs(ratio - 1)) < 0)  # it comes nearer all the way
