"""The ladder of grids: accepted where a grid is fine enough, refused with advice where none is."""

import pytest

import softlube
from softlube.steady.error_estimate import SMOOTH
from softlube.steady.refinements import Refinement


def test_an_accuracy_that_no_grid_reaches_is_refused_with_advice(monkeypatch):
    monkeypatch.setattr("softlube.steady.ladder.LADDER", (12, 18))
    with pytest.raises(softlube.NotConvergedError, match=r"does not reach the accuracy.*Try accuracy="):
        softlube.solve(beta=1000, accuracy=3e-4)


def test_progress_is_reported_for_each_grid():
    lines = []
    result = softlube.solve(beta=50, progress=lines.append)
    assert len(lines) == len(result.levels)


def test_grids_too_coarse_to_be_judged_are_no_solution(monkeypatch):
    """Where a refinement forbids a verdict on every grid, nothing has accepted the result, and it is refused."""
    monkeypatch.setattr("softlube.steady.ladder.LADDER", (12, 18, 26))

    class Anywhere(Refinement):
        feature = "a feature that is everywhere"

        def determines(self, fields, values):
            return {"pressure_max": SMOOTH}

    monkeypatch.setattr("softlube.steady.refinements.KINDS", (Anywhere,))
    with pytest.raises(softlube.NotConvergedError, match="no grid is fine enough for a feature that is everywhere"):
        softlube.solve(beta=100)
