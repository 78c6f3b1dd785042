"""A start of sliding followed to an accuracy: errors that cover, steady sliding at the end, refusals."""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from softlube.errors import InputError, NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.transient.motion import constant_load
from softlube.transient.sliding.result import HISTORIES, LADDER, check_accuracy, follow_sliding


def test_errors_cover_what_shorter_steps_and_finer_grids_change(slid):
    finer = follow_sliding(slid.motion, beta=100.0, accuracy=0.01)
    for name in ("film_center", "film_min", "friction_domain"):
        true = np.abs(slid.histories[name] - PchipInterpolator(finer.time, finer.histories[name])(slid.time))
        assert np.mean(true <= slid.errors[name]) >= 0.95, name
        assert np.max(true / slid.histories[name]) < slid.accuracy, name


def test_the_accuracy_is_kept_at_every_time(slid):
    for name in ("film_center", "film_min"):
        assert np.max(slid.errors[name] / slid.histories[name]) <= slid.accuracy
    assert set(slid.histories) == set(HISTORIES)
    assert slid.angles == LADDER[: len(slid.angles)]


def test_it_says_what_it_was_told(slid):
    assert slid.sliding == {"beta": 100.0, "pressed": 0.0, "cavitation": "reynolds"}
    assert slid.theta[[0, -1]] == pytest.approx([0, np.pi])
    assert slid.run.ended_by == "duration"
    assert slid.histories["height"][0] == 1.0


def test_progress_is_told():
    lines = []
    follow_sliding(constant_load(HERTZ_LOAD, 1.0, 1.0), beta=100.0, accuracy=0.1, progress=lines.append)
    assert any("sliding" in str(line) for line in lines)


def test_not_converged_says_so(monkeypatch):
    monkeypatch.setattr("softlube.transient.sliding.result.LADDER", (9, 11))
    with pytest.raises(NotConvergedError, match=r"known to .* only, not to 1.0e-03"):
        follow_sliding(constant_load(HERTZ_LOAD, 1.0, 5.0), beta=100.0, accuracy=1e-3)


@pytest.mark.parametrize("accuracy", [1e-4, 0.2, float("nan")])
def test_an_impossible_accuracy_is_refused(accuracy):
    with pytest.raises(InputError, match=r"accuracy: expected a number from 0.001 to 0.1 with sliding"):
        check_accuracy(accuracy)
