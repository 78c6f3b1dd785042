"""The ridge of a spike: on a field whose ridge is known, and in the picture of a hard contact."""

from dataclasses import replace

import numpy as np
import pytest

import softlube
from softlube.plots.spike import ridge

WIDTH = 0.01


def crest(theta):
    return 0.9 - 0.05 * (np.pi - theta) ** 2


def pressure(r, theta):
    """A dry contact's with a narrow ridge on its outlet side."""
    dome = np.sqrt(np.maximum(1 - r**2, 0)) / np.pi
    height = np.clip((theta - 1.8) / 0.3, 0, 1)
    return 0.6 * dome + height * np.exp(-(((r - crest(theta)) / WIDTH) ** 2))


@pytest.fixture(scope="module")
def fields(solution):
    r = np.unique(np.concatenate([np.linspace(0.05, 3, 100), np.linspace(0.75, 0.95, 120)]))
    theta = np.linspace(0, np.pi, 30)
    values = pressure(r[:, None], theta)
    return replace(solution.fields, r=r, theta=theta, pressure=values, film=np.ones_like(values))


def test_the_crest_is_found(fields):
    found = ridge(fields)
    assert found.start == pytest.approx(1.85, abs=0.15)
    theta = np.linspace(found.start, np.pi, 50)
    assert found.radius(theta) == pytest.approx(crest(theta), abs=1e-3)


def test_between_the_angles_of_the_grid_the_ridge_is_as_high_as_on_them(fields):
    """It moves by several of its widths from one angle to the next."""
    theta = np.linspace(2.2, np.pi, 200)
    r, values = ridge(fields).pressure(theta, 2.0)
    assert values.max(axis=1) == pytest.approx(pressure(crest(theta), theta), rel=0.02)
    assert r[np.arange(200), values.argmax(axis=1)] == pytest.approx(crest(theta), abs=0.3 * WIDTH)
    assert np.all(np.diff(r, axis=1) >= 0)
    assert (r[:, 0] == 0).all()
    assert r[:, -1] == pytest.approx(2.0)


def test_a_soft_contact_has_none(solution):
    assert ridge(solution.fields) is None


def test_the_map_s_colours_end_at_the_pressure_in_the_middle():
    hard = softlube.Contact(
        radius="10 mm",
        young_modulus="210 GPa",
        poisson_ratio=0.3,
        viscosity="0.04 Pa s",
        pressure_viscosity="12 GPa^-1",
        speed="1 m/s",
        load="10 N",
    ).solve(accuracy=0.05)
    assert ridge(hard.fields) is not None
    figure = hard.plot()
    assert "blue: the spike, above the scale" in figure.axes[1].get_title(loc="right")
    middle = float(hard.dimensional["pressure_center"]) / 1e9
    levels = figure.axes[1].collections[0].levels
    assert middle <= levels[-1] < 1.2 * middle
    _, line = figure.axes[-2].lines[0].get_data()
    assert np.all(line >= 0)
