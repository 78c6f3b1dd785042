"""``softlube squeeze`` in-process: output, files, exit codes."""

import json

import pytest
import xarray as xr

from softlube.cli.main import main

BALL = ["squeeze", "--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s"]
SLIDING = [*BALL, "--load", "100 mN"]
FALL = [*BALL, "--load", "100 mN", "--initial-height", "100 um", "--duration", "0.1 s"]


def test_table_and_files(capsys, tmp_path):
    assert main([*FALL, "--output", str(tmp_path / "a.nc"), "--plot", str(tmp_path / "a.png")]) == 0
    out = capsys.readouterr().out
    for text in ("film at the centre", "minimum film", "µm", "dimple", "balance of volume", "a.nc"):
        assert text in out
    assert "…" not in out
    assert (tmp_path / "a.png").exists()
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as data:
        assert data.sizes["time"] > 50
        assert data.time.attrs["units"] == "s"


def test_json_and_film_limit(capsys):
    assert main([*FALL, "--film-limit", "5 um", "--json"]) == 0
    captured = capsys.readouterr()
    data = json.loads(captured.out)
    assert captured.err == ""
    assert data["ended_by"] == "film_limit"
    assert data["final"]["film_min"]["value"] == pytest.approx(5e-6, rel=1e-3)
    assert 0 < data["time"]["value"] < 0.1


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ([*FALL, "--approach-speed", "1 um/s"], "--load, --approach-speed"),
        (BALL, "--load, --approach-speed, --history: all missing; give exactly one of them\n"),
        ([*BALL, "--load", "1 N", "--duration", "1 s"], "--initial-height"),
        ([*FALL, "--plot", "a.bmp"], "--plot"),
        ([*FALL, "--output", "nowhere/a.nc"], "--output"),
        ([*FALL, "--thickness", "1 N"], "--thickness"),
        ([*FALL, "--base", "frictionless"], "--base, --thickness"),
        ([*FALL, "--poisson-ratio", "0.6"], "--poisson-ratio"),
        ([*FALL, "--thickness", "1 mm", "--base", "glued"], "--base"),
        ([*FALL, "--speed", "1 mm/s", "--prony", "6 MPa @ 1 ms"], "a start of sliding on one that remembers is not solved"),
        ([*FALL, "--prony", "6 MPa"], "--prony: expected pairs of a modulus and a time"),
        ([*FALL, "--viscosity-law", "roelands"], "--viscosity-law, --pressure-viscosity"),
    ],
)
def test_refused_with_a_reason(capsys, arguments, text):
    assert main(arguments) == 2
    assert text in capsys.readouterr().err


def test_a_substrate_that_remembers(capsys):
    """The softer it becomes, the deeper the ball lies: between the instantaneous and the relaxed contact."""
    heights = []
    for series in (["--young-modulus", "9 MPa"], ["--young-modulus", "3 MPa", "--prony", "6 MPa @ 20 ms"], BALL[3:5]):
        arguments = ["squeeze", *BALL[1:3], *BALL[5:], *FALL[7:], *series]
        assert main([*arguments, "--accuracy", "0.01", "--json"]) == 0
        heights.append(json.loads(capsys.readouterr().out)["final"]["height"]["value"])
    assert heights[0] > heights[1] > heights[2]


def test_separation_is_reported(capsys):
    assert main([*BALL, "--approach-speed", "-10 um/s", "--initial-height", "5 um", "--duration", "0.1 s"]) == 0
    assert "-" in capsys.readouterr().out


def test_an_accuracy_that_is_not_reached_exits_3_and_writes_nothing(capsys, monkeypatch, tmp_path):
    monkeypatch.setattr("softlube.transient.squeeze.result.LADDER", (32, 36))
    assert main([*FALL, "--accuracy", "1e-4", "--output", str(tmp_path / "a.nc")]) == 3
    assert "36 rings" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_start_of_sliding(capsys, tmp_path):
    path = tmp_path / "a.nc"
    arguments = [*SLIDING, "--speed", "20 mm/s", "--initial-height", "100 um", "--duration", "5 ms", "--accuracy", "0.1"]
    assert main([*arguments, "--output", str(path)]) == 0
    out = capsys.readouterr().out
    assert "minimum film" in out
    assert "friction" in out
    assert "…" not in out
    assert path.exists()


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["--speed", "1 mm/s", "--history", "h.csv"], "--load, --history"),
        (["--history", "h.csv"], "--load, --history: given together; give exactly one of them\n"),
        (["--speed", "1 mm/s", "--approach-speed", "1 um/s"], "--load, --approach-speed"),
        (["--speed", "1 mm/s", "--plot", "h.bmp"], "--plot"),
        (["--pressed", "1 s"], "--pressed"),
        (["--cavitation", "none"], "--cavitation"),
        (["--entrainment-speed", "1 mm/s"], "--entrainment-speed: a start of rolling is not solved"),
    ],
)
def test_bad_combinations_on_the_command_line(capsys, options, text):
    assert main([*SLIDING, "--initial-height", "100 um", "--duration", "1 s", *options]) == 2
    assert text in capsys.readouterr().err
