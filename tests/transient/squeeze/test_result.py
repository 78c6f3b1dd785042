"""A motion without sliding followed to an accuracy: errors that cover, the dimple, refusals."""

import numpy as np
import pytest

from softlube.errors import InputError, NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.transient.motion import constant_load, constant_speed
from softlube.transient.squeeze.integrate import integrate
from softlube.transient.squeeze.result import TOLERANCE, follow


def test_errors_cover_what_finer_rings_and_steps_change(squeezed):
    better = integrate(squeezed.run.motion, rings=181, tolerance=0.1 * TOLERANCE * squeezed.accuracy).histories(
        squeezed.run.time
    )
    for name in ("film_center", "film_min", "pressure_center", "height"):
        true = np.abs(squeezed.histories[name] - better[name])
        assert np.mean(true <= squeezed.errors[name]) > 0.95, name
    for name in ("film_center", "film_min"):
        assert np.max(squeezed.errors[name] / squeezed.histories[name]) <= squeezed.accuracy


def test_a_finer_accuracy_takes_finer_rings(squeezed):
    finer = follow(squeezed.run.motion, accuracy=1e-4)
    assert finer.rings[-1] > squeezed.rings[-1]
    assert np.max(finer.errors["film_min"] / finer.histories["film_min"]) <= 1e-4
    # The minimum leaves the axis between two steps, and not when one of them ends.
    assert finer.dimple_time == pytest.approx(squeezed.dimple_time, rel=0.01)
    assert np.min(np.abs(squeezed.time / squeezed.dimple_time - 1)) > 1e-6


def test_drainage_of_the_dimple(squeezed):
    """Late, the film at the centre falls about like t^(−1/2), the minimum faster."""
    h, late = squeezed.histories, squeezed.run.time > 300

    def exponent(name):
        return np.polyfit(np.log(squeezed.run.time[late]), np.log(h[name][late]), 1)[0]

    assert exponent("film_center") == pytest.approx(-0.5, abs=0.03)
    assert exponent("film_min") < exponent("film_center")
    assert 10 < squeezed.dimple_time < 40


def test_no_dimple_under_a_light_sphere():
    assert np.isnan(follow(constant_speed(1e-3, 1.0, 0.5e3)).dimple_time)


def test_refused():
    with pytest.raises(InputError, match="accuracy"):
        follow(constant_load(HERTZ_LOAD, 2.0, 1.0), accuracy=1e-7)
    with pytest.raises(InputError, match="Taylor's law"):
        follow(constant_speed(1e-8, 1.0, 0.5e8))


def test_not_converged_says_so(monkeypatch):
    monkeypatch.setattr("softlube.transient.squeeze.result.LADDER", (32, 36))
    with pytest.raises(NotConvergedError, match="36 rings"):
        follow(constant_load(HERTZ_LOAD, 2.0, 30.0), accuracy=1e-4)


def test_progress_is_told():
    lines = []
    follow(constant_load(HERTZ_LOAD, 2.0, 30.0), progress=lines.append)
    assert any("rings" in str(line) for line in lines)
