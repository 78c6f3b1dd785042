"""softlube stribeck: output, files, refusals."""

import json
import subprocess
import sys
import time

import pandas as pd
import pytest

import softlube
from softlube.cli.main import main
from softlube.files.cache import VARIABLE

RIG = ["--radius", "2 mm", "--young-modulus", "3 MPa"]


def test_stribeck(tmp_path, capsys):
    common = [*RIG, "--viscosity", "2 Pa s", "--load", "50 mN", "--slowest", "0.5 mm/s", "--fastest", "5 mm/s", "--points", "5"]
    files = ["--output", str(tmp_path / "s.csv"), "--plot", str(tmp_path / "s.png")]
    assert main(["stribeck", *common, "--load", "100 mN", "--roughness", "30 nm", *files]) == 0
    out = capsys.readouterr().out
    assert "load 50 mN" in out
    assert "λ" in out
    assert "…" not in out
    table = pd.read_csv(tmp_path / "s.csv")
    assert len(table) == 10
    assert (tmp_path / "s.png").read_bytes().startswith(b"\x89PNG")
    assert main(["stribeck", *common, "--slide-to-roll", "0", "--force", "couette", "--json"]) == 0
    captured = capsys.readouterr()
    data = json.loads(captured.out)
    rows = data["rows"]
    assert data["inputs"]["load"] == {"value": [0.05], "unit": "N"}
    assert captured.err == ""
    assert [row["friction [N]"] for row in rows] == [0.0] * 5
    assert rows[0]["film_min [m]"] == pytest.approx(table["film_min [m]"][0], rel=1e-4)


@pytest.mark.parametrize(
    ("arguments", "fragment"),
    [
        ([], "--load: missing"),
        (["--load", "1 N"], "--viscosity: missing"),
        (["--load", "-1 N", "--viscosity", "1 Pa s"], "--load: expected a positive"),
        (["--load", "1 N", "--viscosity", "1 Pa s", "--region", "all"], "--region: expected"),
        (["--load", "1 N", "--viscosity", "1 Pa s", "--against", "load"], "--against: expected"),
        (["--load", "1 N", "--viscosity", "1 Pa s", "--output", "a.txt"], "--output: expected a file ending"),
        (["--load", "1 N", "--viscosity", "1 Pa s", "--plot", "a.txt"], "--plot: expected a file ending"),
    ],
)
def test_a_bad_stribeck_curve_exits_2(capsys, arguments, fragment):
    assert main(["stribeck", *RIG, *arguments]) == 2
    assert fragment in capsys.readouterr().err


LAYER = ["--radius", "5 mm", "--young-modulus", "3 MPa", "--thickness", "1 mm", "--viscosity", "0.1 Pa s"]
OIL = ["--pressure-viscosity", "100 GPa^-1", "--load", "200 mN", "--accuracy", "0.02", "--points", "3"]
SPEEDS = ["--slowest", "10 mm/s", "--fastest", "100 mm/s"]


def test_a_layer_with_an_oil_is_the_solved_contact(capsys):
    """Computed, not read off a table; at its ends the curve is what softlube solve gives."""
    assert main(["stribeck", *LAYER, *OIL, *SPEEDS, "--json"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    slowest = json.loads(captured.out)["rows"][0]
    contact = softlube.Contact(
        radius="5 mm",
        young_modulus="3 MPa",
        thickness="1 mm",
        viscosity="0.1 Pa s",
        pressure_viscosity="100 GPa^-1",
        load="200 mN",
        speed="20 mm/s",
    )
    solved = contact.solve(accuracy=0.02).dimensional
    assert slowest["friction [N]"] == pytest.approx(solved["friction_total"], rel=1e-9)
    assert slowest["film_min [m]"] == pytest.approx(solved["film_min"], rel=1e-9)
    assert slowest["friction_error [N]"] == pytest.approx(solved["friction_total"].error, rel=1e-6)
    assert main(["stribeck", *LAYER, *OIL, *SPEEDS]) == 0
    out = capsys.readouterr().out
    assert "the whole horizontal force on the ball (total), within 2 radii" in out


def test_two_elastic_bodies_with_a_layer(capsys):
    """A stiff ball is a rigid one; a soft one makes the contact softer, and its friction less."""
    frictions = []
    for ball in ([], ["--ball-young-modulus", "1000 GPa"], ["--ball-young-modulus", "3 MPa"]):
        assert main(["stribeck", *LAYER, *OIL, *SPEEDS, *ball, "--json"]) == 0
        frictions.append(json.loads(capsys.readouterr().out)["rows"][0]["friction [N]"])
    assert frictions[1] == pytest.approx(frictions[0], rel=1e-4)
    assert abs(frictions[2] / frictions[0] - 1) > 0.02


@pytest.mark.slow
def test_61_speeds_on_a_layer_with_an_oil_are_there_in_time(monkeypatch, tmp_path):
    """On two cores that do nothing else: at first in 25 s, from a new process again in 2 s."""
    monkeypatch.setenv(VARIABLE, str(tmp_path / "cache"))
    speeds = ["--slowest", "0.1 mm/s", "--fastest", "1 m/s", "--points", "61", "--output", str(tmp_path / "s.csv")]
    command = [sys.executable, "-m", "softlube", "stribeck", *LAYER, *OIL[:4], *speeds]
    seconds = []
    for _ in range(2):
        began = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True)
        seconds.append(time.perf_counter() - began)
    assert seconds[0] < 25
    assert seconds[1] < 2
    assert len(pd.read_csv(tmp_path / "s.csv")) == 61
