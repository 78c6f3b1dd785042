"""Default solutions against grid-converged values, each within its target and its own error estimate.

The values come from benchmarks/fine_grid.py, on grids with another grading, reach and proportion than the solver's.
"""

import json
from pathlib import Path

import numpy as np
import pytest

import softlube
from softlube.quantities import DESCRIPTION

REFERENCE = json.loads((Path(__file__).parent / "reference.json").read_text())
TARGETS = {"film_min": 3e-3, "pressure_gradient_inlet": 3e-3}
SHEAR = {"reynolds": 5e-3, "none": 3e-2}  # without the condition it is largest in the narrow suction behind the contact


@pytest.fixture(scope="module")
def comparison():
    """For each case: (name, true error, estimate, uncertainty of the reference, value)."""
    rows = {}
    for case in REFERENCE:
        solution = softlube.solve(beta=case["beta"], cavitation=case["cavitation"])
        rows[case["beta"], case["cavitation"]] = [
            (
                name,
                abs(solution.quantities[name] - case["quantities"][name]["value"]),
                solution.quantities[name].error,
                case["quantities"][name]["uncertainty"],
                case["quantities"][name]["value"],
            )
            for name in DESCRIPTION
        ]
    return rows


@pytest.mark.parametrize("case", [(c["beta"], c["cavitation"]) for c in REFERENCE])
def test_every_quantity_is_within_its_target(comparison, case):
    for name, error, _, _, value in comparison[case]:
        if name == "film_min_angle_deg":
            assert error < 2, name
        elif name == "film_min_radius":
            assert error < 5e-3, name
        else:
            target = SHEAR[case[1]] if name == "shear_rate_max" else TARGETS.get(name, 1e-3)
            assert error < target * abs(value), name


def test_error_estimates_are_honest_and_not_timid(comparison):
    rows = [row for case in comparison.values() for row in case]
    covered = [error <= estimate + uncertainty for _, error, estimate, uncertainty, _ in rows]
    ratio = [estimate / max(error, uncertainty, 1e-14) for _, error, estimate, uncertainty, _ in rows]
    assert np.mean(covered) >= 0.95
    assert np.median(ratio) < 10


def test_reference_is_sharper_than_the_targets():
    for case in REFERENCE:
        for name, entry in case["quantities"].items():
            if not name.startswith("film_min_") and name != "shear_rate_max":
                assert entry["uncertainty"] < TARGETS.get(name, 1e-3) * abs(entry["value"]), (case["beta"], name)
