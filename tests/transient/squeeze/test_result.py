"""Following a motion to an accuracy: errors that cover, refusals, datasets and pictures."""

import json

import numpy as np
import pytest
import xarray as xr

from softlube.errors import InputError, NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.transient.motion import constant_load, constant_speed
from softlube.transient.squeeze.integrate import HISTORIES, integrate
from softlube.transient.squeeze.result import TOLERANCE, follow


@pytest.fixture(scope="module")
def result():
    return follow(constant_load(HERTZ_LOAD, 2.0, 3e3))


def test_errors_cover_what_finer_rings_and_steps_change(result):
    better = integrate(result.run.motion, rings=181, tolerance=0.1 * TOLERANCE * result.accuracy).histories(result.run.time)
    for name in ("film_center", "film_min", "pressure_center", "height"):
        true = np.abs(result.histories[name] - better[name])
        assert np.mean(true <= result.errors[name]) > 0.95, name
    for name in ("film_center", "film_min"):
        assert np.max(result.errors[name] / result.histories[name]) <= result.accuracy


def test_a_finer_accuracy_takes_finer_rings(result):
    finer = follow(result.run.motion, accuracy=1e-4)
    assert finer.rings[-1] > result.rings[-1]
    assert np.max(finer.errors["film_min"] / finer.histories["film_min"]) <= 1e-4
    # The minimum leaves the axis between two steps, and not when one of them ends.
    assert finer.dimple_time == pytest.approx(result.dimple_time, rel=0.01)
    assert np.min(np.abs(result.time / result.dimple_time - 1)) > 1e-6


def test_drainage_of_the_dimple(result):
    """Late, the film at the centre falls about like t^(−1/2), the minimum faster."""
    h, late = result.histories, result.run.time > 300

    def exponent(name):
        return np.polyfit(np.log(result.run.time[late]), np.log(h[name][late]), 1)[0]

    assert exponent("film_center") == pytest.approx(-0.5, abs=0.03)
    assert exponent("film_min") < exponent("film_center")
    assert 10 < result.dimple_time < 40


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


def test_dataset_and_file(result, tmp_path):
    result.save(tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as data:
        assert data.film.dims == ("time", "r")
        assert np.all(np.diff(data.time) > 0)
        assert set(HISTORIES) <= set(data.data_vars)
        assert data.film_min.values == pytest.approx(result.histories["film_min"])
        assert data.film.min("r").values == pytest.approx(result.histories["film_min"], rel=2e-2)
        assert data.attrs["ended_by"] == "duration"
        balance = data.volume - data.volume[0] - data.inflow
        assert float(np.abs(balance).max()) < 1e-6 * float(np.abs(data.inflow).max())
    assert json.dumps(result.to_dict(), allow_nan=False)


def test_picture(result, tmp_path):
    figure = result.plot(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert len(figure.axes[0].lines) >= 5
    with pytest.raises(InputError, match="plot"):
        result.plot(tmp_path / "a.bmp")
