"""Friction without noise, for the fits."""

from dataclasses import replace

import numpy as np
import pytest

from softlube import Measurements
from softlube.experiments.friction_model import make_model

KNOWN = {"radius": "2 mm", "young_modulus": "3 MPa"}


VISCOSITY = 2.0


@pytest.fixture(scope="session")
def clean():
    """72 combinations of load and speed as in the paper's section 3.5 with their friction, without noise, in SI."""
    load, speed = (grid.ravel() for grid in np.meshgrid(np.geomspace(18.6e-3, 238.1e-3, 6), np.geomspace(2.5e-5, 1e-3, 12)))
    data = Measurements.from_arrays(load, speed, np.ones(load.size))
    model = make_model(data, **KNOWN, viscosity=VISCOSITY)
    values = {"viscosity": VISCOSITY, "young_modulus": 3e6, "friction_offset": 0.0}
    return replace(data, friction=model.cover(values, 2.0, None).friction(values))
