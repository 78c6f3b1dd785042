"""Fields between the nodes, against the functions that they are samples of."""

import numpy as np
import pytest

from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid

GRID = PolarGrid(60, 24, layer=0.3)


X = GRID.r[:, None] * np.cos(GRID.theta)


Y = GRID.r[:, None] * np.sin(GRID.theta)


def fields(pressure, film, beta=100.0, load=1.0):
    return Fields(GRID, GRID.r, GRID.theta, pressure, film, beta, "none", load)


GAUSSIAN = np.exp(-2 * ((X + 0.2) ** 2 + Y**2))


def test_fields_are_even_and_periodic():
    at = fields(GAUSSIAN, 1 + X**2 + Y**2 + 0.1 * X)
    for angle in (0.3, 2.0):
        values = [float(at.film_at(0.7, a)) for a in (angle, -angle, angle + 2 * np.pi, 2 * np.pi - angle)]
        assert values == pytest.approx([values[0]] * 4, rel=1e-12)
        assert values[0] == pytest.approx(1 + 0.49 + 0.07 * np.cos(angle), rel=1e-5)
