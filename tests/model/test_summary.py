"""Tables of texts: digits by the error, prefixes, units; as text and as HTML."""

import math

import numpy as np
import pytest

import softlube
from softlube.experiments.load_curve import load_curve
from softlube.model.problem import Problem
from softlube.model.quantities import Quantity
from softlube.model.summary import Summary, engineering, rounded, spread, steady_rows

LARGEST = 4000
"""Bytes of HTML that an object may show in a notebook."""


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


def test_rows_of_a_physical_contact(physical):
    rows = {row[0]: row[1:] for row in steady_rows(physical.problem, physical.quantities, physical.dimensional)}
    value, _, unit = rows["minimum film"]
    assert float(value) * 1e-9 == pytest.approx(physical.dimensional["film_min"], rel=1e-3)
    assert unit == "nm"
    assert float(rows["friction coefficient over r ≤ 2a"][0]) == pytest.approx(4.86889e-3, rel=1e-5)
    assert "radius of the dry contact" in rows


def test_rows_of_a_dimensionless_contact_have_the_paper_s_units(solution):
    rows = {row[0]: row[1:] for row in steady_rows(solution.problem, solution.quantities, {})}
    assert rows["minimum film"][2] == "|h0|"
    assert rows["film at the centre"][0].startswith("0.0161")
    assert not any("height" in name for name in rows)  # it is prescribed


def test_text_and_html_of_a_table():
    table = Summary("a < b", ("name", "value"), (("one", "1.5"), ("  two", "-20")), ("a doubt",))
    assert str(table).splitlines() == ["a < b", "name   value", "one      1.5", "  two    -20", "a doubt."]
    html = table._repr_html_()
    assert "<b>a &lt; b</b>" in html
    assert "<tr><td>&emsp;two</td><td class=n>-20</td></tr>" in html
    assert html.endswith("<p>a doubt.</p></div>")


def test_rows_that_are_shown_have_both_ends():
    assert spread(13) == list(range(13))
    assert spread(61)[:3] == [0, 5, 10]
    assert spread(61)[-1] == 60


def shows_itself(found, line=""):
    """A short line, a table under 4 kB, and numbers as a DataFrame."""
    assert len(found._repr_html_().encode()) < LARGEST
    assert len(repr(found).splitlines()[0]) < 250
    assert str(found.summary()).startswith(line)
    return found.to_dataframe()


def test_a_solution_is_shown_in_si(physical):
    frame = shows_itself(physical, "Solution: beta 16309.2, film_center 174.094 ± 0.035 nm, film_min 78.716 ± 0.1 nm")
    assert repr(physical).startswith("<Solution: beta 16309.2, film_center 174.094 ± 0.035 nm")
    for name, quantity in physical.dimensional.items():
        assert tuple(frame.loc[name, ["value", "error", "unit"]]) == (quantity.value, quantity.error, quantity.unit)
    assert frame.loc["film_min_angle_deg", "unit"] == "°"


def test_a_dimensionless_solution_is_shown_as_in_the_paper(solution):
    frame = shows_itself(solution, "Solution: beta 1000, film_center 0.01615")
    assert frame["value"].to_dict() == {name: float(quantity) for name, quantity in solution.quantities.items()}


@pytest.mark.parametrize("name", ["squeezed", "slid", "fall", "started"])
def test_a_film_in_time_is_shown_at_its_end(name, request):
    film = request.getfixturevalue(name)
    frame = shows_itself(film, f"{type(film).__name__}: after ")
    unit = "" if film.setup is None else " [m]"
    assert np.array_equal(frame[f"film_min{unit}"], film.histories["film_min"])
    assert np.array_equal(frame[f"film_min_error{unit}"], film.errors["film_min"])
    assert np.array_equal(frame["time" if film.setup is None else "time [s]"], film.time)


@pytest.mark.parametrize(
    "more",
    [
        {"speed": "0.1 mm/s"},
        {"entrainment_speed": "1 mm/s", "slide_to_roll": 0.1, "thickness": "1 mm", "roughness": "20 nm"},
        {"speed": "1 mm/s", "pressure_viscosity": "20 GPa^-1", "density": "870 kg/m^3"},
        {"speed": "1 mm/s", "pressure_viscosity": "20 GPa^-1", "viscosity_law": "roelands", "cavitation": "none"},
    ],
)
def test_a_contact_is_written_as_it_can_be_given(more):
    contact = softlube.Contact(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", load="100 mN", **more)
    again = eval(repr(contact), {"Contact": softlube.Contact})
    assert repr(again) == repr(contact)
    numbers = {name: value for name, value in contact.given.items() if isinstance(value, float)}
    assert {name: again.given[name] for name in numbers} == pytest.approx(numbers, rel=1e-12)
    assert repr(contact).startswith("Contact(radius='2 mm', shear_modulus='1 MPa', ")
    assert "newtonian" not in repr(contact)
    frame = shows_itself(contact, "Contact: sphere on ")
    assert frame.loc["load", "value"] == 0.1


def test_a_function_of_beta_is_shown_at_some_places():
    curve = softlube.curve.curve("film_min")
    frame = shows_itself(curve, "Curve: film_min from beta 0.0001 to 1e+08\n")
    assert np.array_equal(frame["film_min_error"], curve(frame["beta"])[1])
    frame = shows_itself(load_curve(Problem(beta_load=1.0), 1.0, 1e6), "LoadCurve: film_center, film_min, total, sphere from")
    assert list(frame)[:3] == ["beta", "film_center", "film_center_error"]
