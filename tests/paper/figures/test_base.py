"""What a figure is made of: cases, tables, statements, places."""

import csv

import numpy as np
import pytest

from softlube.paper.figures import FIGURES, Case, Statement, Table
from softlube.paper.figures.base import along, beta_colours, number, percent


def test_a_disagreement_without_a_reason_is_refused():
    with pytest.raises(ValueError, match="needs a sentence"):
        Statement("the sky is green", "blue", verdict="disagrees")


def test_style_is_left_alone(solutions):
    import matplotlib as mpl

    before = dict(mpl.rcParams)
    FIGURES["10"].draw({case: solutions[case] for case in FIGURES["10"].cases})
    assert dict(mpl.rcParams) == before


def test_tables_must_be_rectangular(tmp_path):
    with pytest.raises(ValueError, match=r"shorter|longer"):
        Table("odd", {"a": [1.0, 2.0], "b": [1.0]}).write(tmp_path / "odd.csv")
    assert list(tmp_path.iterdir()) == []


def test_names_of_files():
    assert Case(300.0).name == "beta-300"
    assert Case(300.0, "none").name == "beta-300-full-film"
    assert Case(0.0, physical=True).name == "ball-on-rubber"


def test_numbers_for_readers():
    assert percent(1.0234) == "+2.3 %"
    assert percent(0.9) == "−10.0 %"
    assert number(-0.58263) == "−0.5826"


def test_places_along_an_axis(solution):
    place, r, theta = along(solution, "x", 2.0)
    assert place == pytest.approx(-place[::-1])
    assert np.all(np.diff(place) > 0)
    assert (place[0], place[-1], r.min()) == (-2, 2, 0)
    assert r * np.cos(theta) == pytest.approx(place)
    place, r, theta = along(solution, "y", 1.0)
    assert np.all(theta == np.pi / 2)
    assert r == pytest.approx(np.abs(place))


def test_as_many_colours_as_lines():
    assert len(set(beta_colours(5))) == 5


def test_a_table_with_commas_and_text(tmp_path):
    Table("a", {"x, y": [1.0, 2.5], "what": ["first, second", "third"]}).write(tmp_path / "a.csv")
    with open(tmp_path / "a.csv", newline="", encoding="utf-8") as stream:
        assert list(csv.reader(stream)) == [["x, y", "what"], ["1", "first, second"], ["2.5", "third"]]
