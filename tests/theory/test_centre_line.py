"""Profiles along the centre line against contacts solved anew, and where the table ends."""

import numpy as np
import pytest

from softlube.errors import InputError
from softlube.model.exact import hertz_pressure
from softlube.steady.solve import solve
from softlube.theory.centre_line import FILM_ERROR, PRESSURE_ERROR, cubic_weights, profiles, table

BETWEEN = (3e-4, 0.04, 0.5, 1.16, 3.4, 4.5, 9.3, 20.5, 133.0, 4e3, 2.4e5, 5e7)
"""β_load half-way between the table's, the transition at β_load = 4.5 among them."""


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
@pytest.mark.parametrize("beta_load", BETWEEN)
def test_profiles_between_the_nodes(beta_load, cavitation):
    line = profiles(beta_load, cavitation)
    fields = solve(beta_load=beta_load, cavitation=cavitation).fields
    r, theta = np.abs(line.x), np.where(line.x > 0, 0.0, np.pi)
    film, pressure = fields.film_at(r, theta), fields.pressure_at(r, theta)
    assert np.max(np.abs(line.film / film - 1)) < FILM_ERROR
    assert np.max(np.abs(line.pressure - pressure)) < PRESSURE_ERROR * pressure.max()


def test_the_hertz_limit():
    line = profiles(1e8)
    inside = np.abs(line.x) < 0.95
    np.testing.assert_allclose(line.pressure[inside], hertz_pressure(line.x[inside]), rtol=2e-3)


def test_places_reach_beyond_the_contact_and_increase():
    for beta_load in (1e-4, 1.0, 1e8):
        line = profiles(beta_load)
        assert np.all(np.diff(line.x) > 0)
        assert line.x[-1] >= 2 * (1 - 1e-9)
        np.testing.assert_array_equal(line.x, -line.x[::-1])


def test_the_table_ends_somewhere():
    for beta_load in (0.9e-4, 1.1e8):
        with pytest.raises(InputError, match="beta_load: profiles are kept from 1e-4 to 1e8"):
            profiles(beta_load)
    with pytest.raises(InputError, match="cavitation"):
        table("some")


def test_weights_are_exact_for_cubics():
    nodes = np.array([0.0, 0.5, 0.7, 2.0])
    for power in range(4):
        assert cubic_weights(nodes, 1.3) @ nodes**power == pytest.approx(1.3**power, rel=1e-13)
