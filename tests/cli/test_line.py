"""softlube line: numbers, files, refusals."""

import csv
import json

import pytest

from softlube.cli.main import main

WIPER = ["--radius", "10 mm", "--young-modulus", "3 MPa", "--viscosity", "1 Pa s", "--speed", "10 mm/s"]
LOADED = [*WIPER, "--load-per-length", "1 N/mm"]


def test_a_physical_contact_with_its_files(tmp_path, capsys):
    profile, plot = tmp_path / "line.csv", tmp_path / "line.png"
    assert main(["line", *LOADED, "--profile", str(profile), "--plot", str(plot)]) == 0
    out = capsys.readouterr().out
    assert "load_per_length 1 kN/m" in out
    assert "β by the load = 2122.1, Reynolds condition" in out
    assert f"Wrote {profile}" in out
    rows = list(csv.reader(profile.read_text().splitlines()))
    assert rows[0] == ["x [m]", "film [m]", "pressure [Pa]"]
    assert len(rows) > 200
    assert plot.read_bytes().startswith(b"\x89PNG")


def test_a_dimensionless_contact(capsys):
    assert main(["line", "--beta-load", "1e4", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["inputs"] == {"beta_load": {"value": 1e4, "unit": ""}}
    assert found["quantities"]["film_center"]["value"] == pytest.approx(0.00541572, rel=1e-6)
    assert main(["line", "--beta-load", "1e4", "--cavitation", "none"]) == 0
    assert "L is half the width" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "--radius: missing; describe the contact"),
        ([*LOADED, "--beta-load", "1"], "--beta-load, --radius: give a dimensionless or a physical contact"),
        (WIPER, "--load-per-length: missing"),
        ([*LOADED, "--plot", "a.gif"], "--plot: expected a file ending in"),
        (["--beta-load", "1", "--plot", "a.png", "--profile", "a.png"], "--profile, --plot: expected two different files"),
    ],
)
def test_refusals(arguments, message, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["line", *arguments]) == 2
    assert message in capsys.readouterr().err
