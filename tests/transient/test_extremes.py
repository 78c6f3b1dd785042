"""Extremes of a film in time, in any units."""

import numpy as np
import pytest

from softlube.transient.extremes import Extremes

TIME = np.array([0.0, 1.0, 3.0])
HISTORIES = {
    "height": np.array([2.0, -1.0, 0.0]),
    "film_center": np.array([2.5, 0.1, 0.4]),
    "pressure_max": np.array([1.0, 7.0, 3.0]),
}
PRESSURE = np.array([[1.0, 0.5], [7.0, 2.0], [-4.0, 3.0]])


def test_extremes_of_histories():
    found = Extremes.of(TIME, HISTORIES, PRESSURE)
    assert found == Extremes(-1.0, -4.0, 7.0, 3.0, 2.5)


def test_a_minimum_between_the_nodes_counts():
    found = Extremes.of(TIME, HISTORIES | {"pressure_min": np.array([0.0, 0.0, -4.2])}, PRESSURE)
    assert found.least_pressure == -4.2


def test_in_other_units_they_are_the_extremes_of_scaled_histories():
    height, pressure, time = 2e-6, 3e5, 0.5
    scaled = {name: values * (pressure if "pressure" in name else height) for name, values in HISTORIES.items()}
    expected = Extremes.of(TIME * time, scaled, PRESSURE * pressure)
    found = Extremes.of(TIME, HISTORIES, PRESSURE).scaled(height, pressure, time)
    for name, value in vars(expected).items():
        assert getattr(found, name) == pytest.approx(value, rel=1e-14), name
