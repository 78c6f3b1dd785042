"""Numbers as they are printed: digits by the error, prefixes, units."""

import math

import pytest

from softlube.cli.table import engineering, rounded, solution_table
from softlube.model.quantities import Quantity


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (1.23456789, 0.0123, ("1.235", "0.012")),
        (1.23456789, 0.00096, ("1.23457", "0.00096")),
        (123.4, 45.0, ("123", "45")),
        (2.5e7, 3e4, ("2.5000e+07", "3e+04")),
        (1.5e-11, 2e-14, ("1.5000e-11", "2e-14")),
        (0.5, 0.0, ("0.5", "0")),
        (0.123456789, math.nan, ("0.123457", "unknown")),
        (math.nan, 1.0, ("none", "-")),
    ],
)
def test_the_error_cuts_the_digits(value, error, text):
    assert rounded(value, error) == text


def test_si_quantities_get_the_prefix_that_suits_them():
    assert engineering(Quantity(174.105e-9, 0.025e-9, "m")) == ("174.105", "0.025", "nm")
    assert engineering(Quantity(2.5e6, 1e3, "Pa")) == ("2.5000", "0.001", "MPa")
    assert engineering(Quantity(3.0, 0.1, "1/s")) == ("3.00", "0.1", "1/s")


def cells(table):
    return list(zip(*(list(column.cells) for column in table.columns), strict=True))


def test_rows_of_a_physical_contact(physical):
    rows = {row[0]: row[1:] for row in cells(solution_table(physical.problem, physical.quantities, physical.dimensional))}
    value, _, unit = rows["minimum film"]
    assert float(value) * 1e-9 == pytest.approx(physical.dimensional["film_min"], rel=1e-3)
    assert unit == "nm"
    assert float(rows["friction coefficient over r ≤ 2a"][0]) == pytest.approx(4.86889e-3, rel=1e-5)
    assert "radius of the dry contact" in rows


def test_rows_of_a_dimensionless_contact_have_the_paper_s_units(solution):
    rows = {row[0]: row[1:] for row in cells(solution_table(solution.problem, solution.quantities, {}))}
    assert rows["minimum film"][2] == "|h0|"
    assert rows["film at the centre"][0].startswith("0.0161")
    assert not any("height" in name for name in rows)  # it is prescribed
