"""Without the Reynolds condition: the suction, and what becomes of load and friction."""

import numpy as np
import pytest

from softlube.paper.figures import Case


def test_changes_are_those_of_the_solutions(drawn, solutions):
    columns = drawn("S2").tables[1].columns
    for name in ("friction_domain", "load", "film_outlet_min"):
        for beta, change in zip(columns["beta"], columns[f"{name}: full film over Reynolds condition - 1"], strict=True):
            free, bounded = solutions[Case(float(beta), "none")], solutions[Case(float(beta))]
            assert change == pytest.approx(free.quantities[name] / bounded.quantities[name] - 1)


def test_suction_takes_load_and_dies_away_with_beta(drawn):
    columns = {name: np.asarray(values) for name, values in drawn("S2").tables[1].columns.items()}
    load = columns["load: full film over Reynolds condition - 1"]
    assert np.all(load < 0)
    assert np.all(np.diff(np.abs(load)) < 0)
    depth = columns["lowest pressure over the largest"]
    assert np.all(np.diff(depth) > 0)
    assert np.all(depth < 0)


def test_only_the_full_film_has_negative_pressures(drawn):
    profile = {name: np.asarray(values) for name, values in drawn("S2").tables[0].columns.items()}
    assert profile["p, full film"].min() < -0.01
    assert profile["p, Reynolds condition"].min() == 0
    ahead = profile["x [sqrt(R|h0|)]"] > 0.5
    assert profile["p, full film"][ahead] == pytest.approx(profile["p, Reynolds condition"][ahead], abs=5e-3)
