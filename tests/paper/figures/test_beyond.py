"""Figures beyond the paper's: parts of the friction, exponents, engineering formulas."""

import numpy as np
import pytest

from softlube.paper.figures import FIGURES


def test_friction_parts_add_up_in_the_table(drawn):
    table = {name.split(" [")[0]: np.asarray(values) for name, values in drawn("friction").tables[0].columns.items()}
    assert table["sphere"] == pytest.approx(table["couette"] + table["poiseuille"])
    assert table["substrate"] == pytest.approx(table["couette"] - table["poiseuille"])
    assert table["drag"] == pytest.approx(table["sphere"] + table["sphere_pressure"])
    imbalance = drawn("friction").tables[1].columns["horizontal imbalance, whole plane"]
    assert np.max(np.abs(imbalance)) < 2e-4


def test_exponents_are_those_of_the_laws(drawn):
    columns, laws = drawn("exponents").tables[0].columns, drawn("10").tables[0].columns
    assert columns["(22a) film at the centre"] == pytest.approx(laws["(22a) local exponent"])


def test_formulas_of_the_engineers_are_near(drawn):
    """Nijenbanning, Venner & Moes state a few per cent for the centre film."""
    columns = drawn("formulas").tables[0].columns
    ours, theirs = (np.asarray(columns[f"H center, {who}"]) for who in ("softlube", "Nijenbanning et al."))
    assert np.abs(ours / theirs - 1).max() < 0.08


def test_the_table_of_the_ball_on_rubber(drawn, solutions):
    (case,) = FIGURES["contact"].cases
    columns = drawn("contact").tables[0].columns
    row = list(columns["quantity"]).index("film_min")
    assert columns["value"][row] == pytest.approx(float(solutions[case].dimensional["film_min"]))
    assert columns["unit"][row] == "m"
