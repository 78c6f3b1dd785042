"""softlube stribeck: output, files, refusals."""

import json

import pandas as pd
import pytest

from softlube.cli.main import main

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
