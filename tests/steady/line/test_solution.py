"""What a solution of a line contact gives: attributes, tables, JSON, profiles."""

import json

import numpy as np
import pytest

from softlube import LineContact, line

SOLUTION = line.solve(1e3)


def test_quantities_are_attributes():
    assert SOLUTION.film_min.error < 1e-6 * SOLUTION.film_min < 1e-6
    assert "film_min" in dir(SOLUTION)
    with pytest.raises(AttributeError, match="nonsense"):
        SOLUTION.nonsense  # noqa: B018
    assert SOLUTION.beta_load == 1e3


def test_tables_and_json():
    summary = SOLUTION.summary()
    assert summary.title.startswith("LineSolution: beta_load 1000, film_center 2.198901")
    assert ("minimum film", "H") in [(row[0], row[-1]) for row in summary.rows]
    assert summary.notes == ("L is half the width of the dry contact of a half-space, and H = L²/R",)
    table = SOLUTION.to_dataframe()
    assert table.loc["film_min", "value"] == SOLUTION.film_min
    plain = json.loads(json.dumps(SOLUTION.to_dict(), allow_nan=False))
    assert plain["quantities"]["film_min"] == {"value": float(SOLUTION.film_min), "error": SOLUTION.film_min.error}
    assert "dimensional" not in plain


def test_profile_at_the_nodes_and_at_places():
    table = SOLUTION.profile()
    assert list(table) == ["x", "film", "pressure"]
    assert np.all(np.diff(table["x"]) > 0)
    assert table["x"].min() < SOLUTION.free_boundary - 0.5
    assert np.trapezoid(table["pressure"], table["x"]) == pytest.approx(0.25, rel=1e-3)
    few = SOLUTION.profile([0.0, 0.5])
    assert few["film"][0] == pytest.approx(SOLUTION.film_center)


def test_profile_in_si():
    contact = LineContact(radius="10 mm", young_modulus="3 MPa", viscosity="1 Pa s", speed="10 mm/s", load_per_length="1 N/mm")
    solution = contact.solve()
    table = solution.profile()
    assert list(table) == ["x [m]", "film [m]", "pressure [Pa]"]
    assert np.trapezoid(table["pressure [Pa]"], table["x [m]"]) == pytest.approx(1000, rel=1e-3)
    assert "contact_half_width" in solution.to_dataframe().index
    assert solution.summary().notes == ()
    assert solution.to_dict()["dimensional"]["load"]["unit"] == "N/m"
