"""The start of sliding in SI: ends where `Contact.solve` is, errors, files, refusals."""

import json

import numpy as np
import pytest
import xarray as xr

import softlube
from softlube.cli.main import main
from softlube.errors import InputError
from softlube.physical.sliding import slide
from softlube.transient.sliding.result import HISTORIES

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "load": "100 mN", "speed": "20 mm/s"}
START = BALL | {"initial_height": "100 um", "duration": "0.2 s", "accuracy": 0.05}
OPTIONS = [part for name, value in BALL.items() for part in ("--" + name.replace("_", "-"), value)]


@pytest.fixture(scope="module")
def started():
    return slide(**START)


def test_ends_in_steady_sliding(started):
    steady = softlube.Contact(**BALL).solve().dimensional
    for name in ("film_center", "film_min", "friction_domain", "pressure_max"):
        assert started.final[name] == pytest.approx(float(steady[name]), rel=5e-3), name
        assert started.final[name].unit == steady[name].unit
    assert -started.final["height"] == pytest.approx(float(steady["indentation"]), rel=1e-3)


def test_histories_and_errors(started):
    assert started.time[0] == 0
    assert started.time[-1] == pytest.approx(0.2)
    assert started.histories["height"][0] == pytest.approx(100e-6)
    assert started.histories["load"][1:] == pytest.approx(0.1)
    assert np.max(started.errors["film_min"] / started.histories["film_min"]) <= 0.05


def test_on_a_layer_it_ends_in_steady_sliding():
    model = {"thickness": "0.5 mm", "poisson_ratio": 0.4, "base": "frictionless", "pressure_viscosity": "0.5 MPa^-1"}
    start = slide(**START | {"duration": "0.1 s"}, **model)
    steady = softlube.Contact(**BALL, **model).solve().dimensional
    for name in ("film_center", "film_min", "friction_domain", "pressure_max"):
        assert start.final[name] == pytest.approx(float(steady[name]), rel=6e-3), name
    assert -start.final["height"] == pytest.approx(float(steady["indentation"]), rel=1e-3)
    assert any("contact radii thick" in doubt for doubt in start.warnings)


def test_a_height_from_a_file_ends_in_steady_sliding(tmp_path):
    path = tmp_path / "h.csv"
    path.write_text("time [ms],height [um]\n0,20\n10,-20\n20,-40\n120,-40\n", encoding="utf-8")
    moved = {name: value for name, value in BALL.items() if name != "load"}
    start = slide(**moved, history=path, accuracy=0.1)
    steady = softlube.Contact(**moved, indentation="40 um").solve().dimensional
    assert start.histories["height"][[0, -1]] == pytest.approx([20e-6, -40e-6])
    for name in ("film_center", "film_min", "load", "pressure_max"):
        assert start.final[name] == pytest.approx(float(steady[name]), rel=2e-2), name
    assert start.run.fields[-1].height == pytest.approx(-2)


def test_film_limit_and_picture(started, tmp_path):
    stopped = slide(**START | {"film_limit": "20 um", "duration": "10 ms"})
    assert stopped.run.ended_by == stopped.to_dict()["ended_by"] == "film_limit"
    assert stopped.final["film_min"] == pytest.approx(20e-6, rel=1e-3)
    crossed = np.interp(-20e-6, -started.histories["film_min"], started.time)
    assert stopped.time[-1] == pytest.approx(crossed, rel=5e-3)
    assert 0 < stopped.time_error < 0.05 * stopped.time[-1]
    figure = started.plot(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    film = figure.axes[0].lines[-1].get_ydata()
    assert film.min() == pytest.approx(float(started.final["film_min"]) * 1e6, rel=0.1)  # the neck is off the axis
    with pytest.raises(InputError, match="plot"):
        started.plot(tmp_path / "a.bmp")


def test_file(started, tmp_path):
    started.save(tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as data:
        assert data.film.dims == ("time", "r", "theta")
        assert set(HISTORIES) <= set(data.data_vars)
        assert float(data.film[-1].min()) == pytest.approx(float(started.final["film_min"]), rel=2e-2)
    assert json.dumps(started.to_dict(), allow_nan=False)


def test_command(capsys, tmp_path):
    path = tmp_path / "a.nc"
    arguments = ["squeeze", *OPTIONS, "--initial-height", "100 um", "--duration", "5 ms", "--accuracy", "0.1"]
    assert main([*arguments, "--output", str(path)]) == 0
    out = capsys.readouterr().out
    assert "minimum film" in out
    assert "friction" in out
    assert "…" not in out
    assert path.exists()


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"load": None}, "load, .*: all missing"),
        ({"speed": None}, "speed: missing"),
        ({"load": lambda t: 0.1 * np.cos(100 * t)}, "not positive all the time"),
        ({"duration": None}, "duration: missing"),
        ({"initial_height": "0 m"}, "initial_height"),
        ({"pressed": "-1 s"}, "pressed"),
        ({"load": None, "approach_speed": "1 um/s", "pressed": "1 s"}, "pressed: a sphere is pressed by a load"),
        ({"film_limit": "150 um"}, "film_limit"),
        ({"cavitation": "jfo"}, "cavitation"),
        ({"accuracy": 1e-6}, "accuracy"),
        ({"speed": "-1 m/s"}, "speed"),
    ],
)
def test_refused(change, text):
    with pytest.raises(InputError, match=text):
        slide(**START | change)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["--speed", "1 mm/s", "--history", "h.csv"], "--load, --history"),
        (["--speed", "1 mm/s", "--approach-speed", "1 um/s"], "--load, --approach-speed"),
        (["--speed", "1 mm/s", "--plot", "h.bmp"], "--plot"),
        (["--pressed", "1 s"], "--pressed"),
        (["--cavitation", "none"], "--cavitation"),
    ],
)
def test_bad_combinations_on_the_command_line(capsys, options, text):
    base = [part for part in OPTIONS if part not in ("--speed", "20 mm/s")]
    assert main(["squeeze", *base, "--initial-height", "100 um", "--duration", "1 s", *options]) == 2
    assert text in capsys.readouterr().err
