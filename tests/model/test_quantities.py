"""The table of quantities against what is computed without it, and numbers with errors."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import softlube
from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.discretization.measure import measure
from softlube.model.quantities import (
    DERIVED,
    FIELDS,
    HYSTERESIS,
    LINE,
    LINE_DERIVED,
    QUANTITIES,
    REPORTED_ONLY,
    SPIKE,
    STEADY,
    THINNING,
    TRANSIENT,
    UNITS,
    Quantity,
    header,
    reference,
)

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "quantities.md"
BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}


def test_every_name_means_one_thing():
    tables = (STEADY, SPIKE, HYSTERESIS, THINNING, DERIVED, TRANSIENT, FIELDS)
    assert len(QUANTITIES) == sum(map(len, tables))
    assert all(name == row.name and row.dimension in UNITS for name, row in QUANTITIES.items())
    assert len({row.words for row in QUANTITIES.values()}) == len(QUANTITIES)


def test_the_table_lists_what_is_measured_in_its_order():
    grid = PolarGrid(20, 12)
    r = grid.r[:, None] * np.ones(grid.theta.size)
    fields = Fields(grid, grid.r, grid.theta, np.exp(-2 * r**2), 1 + r**2, 100.0, "none", 1.0)
    assert list(measure(fields)) == list(STEADY)


def test_powers_are_those_of_the_units_in_si():
    """`Materials.scales` computes the units from Eqs. (4) and (26) for any height."""
    contact = softlube.Contact(**BALL)
    cylinder = softlube.LineContact(**{name: BALL[name] for name in BALL if name != "load"}, load_per_length="1 N/mm")
    once, four_times = ({**contact.scales(height), **cylinder.scales(height)} for height in (1e-6, 4e-6))
    for dimension, (value, si) in once.items():
        assert four_times[dimension][0] / value == pytest.approx(4 ** UNITS[dimension].power, rel=1e-12), dimension
        assert si == UNITS[dimension].si
    by_load, by_depth = UNITS["load"], Quantity(1.0, 0.5)
    assert by_load.rescaled(by_depth, 4.0).value == 1 / 8
    assert by_load.rescaled(by_depth, 4.0).error == 1 / 16


def test_places_are_compared_with_one_and_do_not_decide():
    places = ("film_min_radius", "film_min_angle_deg")
    assert (*places, *THINNING) == REPORTED_ONLY
    assert all(QUANTITIES[name].size({}) == 1 for name in places)


def test_scaled_and_pickled_quantities_keep_their_errors():
    film = Quantity(2e-3, 1e-5).scaled(1e3, "nm")
    assert (film.value, film.error, film.unit) == (2.0, pytest.approx(1e-2), "nm")
    again = pickle.loads(pickle.dumps(film))
    assert (again.value, again.error, again.unit) == (film.value, film.error, film.unit)


def test_headers():
    assert header("film_min", "m") == "film_min [m]"
    assert header("film_min", "m", error=True) == "film_min_error [m]"
    assert header("height") == "height"


def test_the_page_shows_the_table():
    text = PAGE.read_text(encoding="utf-8")
    for table in (STEADY, SPIKE, HYSTERESIS, THINNING, DERIVED, TRANSIENT, FIELDS):
        assert reference(table) in text
    for table in (LINE, LINE_DERIVED):
        assert reference(table, "H") in text
