"""Parameters of liquids that thin with shear from friction: recovered within their intervals, or told together only."""

import numpy as np
import pytest

import softlube
from softlube import Measurements, fit

TRUE = {"viscosity": 0.1, "relaxation_time": 1e-4, "index": 0.5}
RIG = {"radius": "9.5 mm", "young_modulus": "2.4 MPa"}
LOADS = (0.3, 1.0, 3.0)
START = {"viscosity": 0.105, "relaxation_time": 1.05e-4, "index": 0.51, "viscosity_law": "carreau"}
NOISE, RUNS = 0.03, 50


@pytest.fixture(scope="module")
def friction():
    """Solved friction of a Carreau liquid at three loads, from 0.1 to 1000 mm/s."""
    contact = softlube.Contact(**RIG, **TRUE, motion=softlube.Sliding(1.0), load=0.1)
    table = softlube.stribeck_curve(contact, list(LOADS), slowest=1e-4, fastest=1.0, points=20, accuracy=2e-3)
    columns = ("load [N]", "entrainment_speed [m/s]", "friction [N]")
    load, speed, force = (table[name].to_numpy() for name in columns)
    return Measurements.from_arrays(load, 2 * speed, force)


def noisy(data, seed, rows=slice(None)):
    rows = np.arange(len(data))[rows]
    scatter = np.exp(NOISE * np.random.default_rng(seed).standard_normal(len(data)))
    return Measurements.from_arrays(data.load[rows], data.speed[rows], (data.friction * scatter)[rows])


@pytest.mark.slow
def test_viscosity_time_and_index_are_recovered(friction):
    """Three loads, 60 rows, 3 % of noise: of 50 fits, 45 or more have each true value in its 95 % interval."""
    held = dict.fromkeys(TRUE, 0)
    for seed in range(RUNS):
        found = fit(noisy(friction, seed), **RIG, **START, free=tuple(TRUE), compare=False)
        for name, each in found.estimates.items():
            held[name] += each.low <= TRUE[name] <= each.high
    assert min(held.values()) >= 0.9 * RUNS, held


@pytest.mark.slow
def test_the_curves_between_their_nodes(friction):
    """Friction by polynomials in the time and the index against solved friction."""
    found = fit(noisy(friction, 0), **RIG, **START, free=tuple(TRUE), compare=False)
    model = found.model.friction(TRUE | {"young_modulus": 2.4e6, "friction_offset": 0.0})
    assert model == pytest.approx(friction.friction, rel=5e-3)


@pytest.mark.slow
def test_time_and_index_are_told_together_where_the_liquid_only_begins_to_thin(friction):
    slow = friction.speed < 0.01
    found = fit(noisy(friction, 1, slow), **RIG, **START, free=tuple(TRUE), compare=False)
    assert not found.estimates["index"].determined
    assert any("relaxation_time and index" in each and "together" in each for each in found.verdicts)


CARREAU = {"viscosity": 0.1, "infinite_viscosity": 0.005, "relaxation_time": 1e-2, "index": 0.4, "viscosity_law": "carreau"}
LIMITED = {"viscosity": 1.0, "limiting_stress": 3e3}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("true", "start", "fastest", "points"),
    [
        (CARREAU, {"viscosity": 0.105, "infinite_viscosity": 0.0055}, 1.0, 9),
        (LIMITED, {"viscosity": 0.95, "limiting_stress": 3.2e3}, 0.3, 8),
    ],
    ids=["second plateau", "limiting stress"],
)
def test_a_second_plateau_and_a_limiting_stress_are_recovered(true, start, fastest, points):
    """Two loads, 3 % of noise; the slow rows alone do not tell the second plateau, and that is said."""
    contact = softlube.Contact(**RIG, **true, motion=softlube.Sliding(1.0), load=0.3)
    table = softlube.stribeck_curve(contact, [0.3, 3.0], slowest=1e-3, fastest=fastest, points=points, accuracy=2e-3)
    load, speed, force = (table[each].to_numpy() for each in ("load [N]", "entrainment_speed [m/s]", "friction [N]"))
    data, given = Measurements.from_arrays(load, 2 * speed, force), RIG | true | start
    found = fit(noisy(data, 0), **given, free=tuple(start), compare=False)
    for name, estimate in found.estimates.items():
        assert estimate.determined
        assert estimate.low <= true[name] <= estimate.high
    if true is CARREAU:
        slow = fit(noisy(data, 0, data.speed < 0.02), **given, free=tuple(start), compare=False)
        assert slow.estimates["viscosity"].determined
        assert any("do not determine infinite_viscosity" in verdict for verdict in slow.verdicts)
