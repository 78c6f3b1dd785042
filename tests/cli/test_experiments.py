"""sweep, stribeck and fit from the command line: output, files, refusals."""

import json

import pandas as pd
import pytest

import softlube
from softlube.cli.main import main

PLAN = """
[sweep]
accuracy = 0.05

[parameters]
beta = [100, 300, 1e12]
"""
RIG = ["--radius", "2 mm", "--young-modulus", "3 MPa"]
HEADER = "load [mN], speed [mm/s], friction [mN]\n"


@pytest.fixture
def plan(tmp_path):
    path = tmp_path / "plan.toml"
    path.write_text(PLAN)
    return path


def test_sweep(plan, capsys):
    assert main(["sweep", str(plan), "--workers", "1", "--fields", str(plan.parent / "fields")]) == 0
    out = capsys.readouterr().out
    assert "3 cases, 3 different problems: 0 were in the store, 3 solved now. 1 cases failed." in out
    assert "case 3: beta = 1e+12 is outside the range" in out
    table = pd.read_csv(plan.parent / "plan-results.csv")
    assert table["film_center"][0] == pytest.approx(softlube.solve(beta=100, accuracy=0.05).film_center, rel=1e-9)
    assert sorted(path.name for path in (plan.parent / "fields").iterdir()) == ["case-00001.nc", "case-00002.nc"]
    first = (plan.parent / "plan-results.csv").read_bytes()
    assert main(["sweep", str(plan)]) == 0
    assert "3 were in the store, 0 solved now" in capsys.readouterr().out
    assert (plan.parent / "plan-results.csv").read_bytes() == first


def test_a_sweep_says_how_many_cases_have_warnings(plan, capsys):
    ball = 'radius = "2 mm"\nyoung_modulus = "3 MPa"\nviscosity = "2 Pa s"\nload = "50 mN"\nspeed = "1 mm/s"\n'
    plan.write_text(f'[sweep]\naccuracy = 0.05\n[parameters]\n{ball}roughness = ["1 nm", "1 mm"]\n')
    assert main(["sweep", str(plan), "--workers", "1"]) == 0
    assert "1 case has warnings; see the column warnings of the table." in capsys.readouterr().out
    first, second = pd.read_csv(plan.parent / "plan-results.csv")["warnings"].fillna("")
    assert (first, "below the roughness" in second) == ("", True)


def test_a_sweep_of_failures_only_exits_3(plan):
    plan.write_text("[parameters]\nbeta = 1e12\n")
    assert main(["sweep", str(plan), "--workers", "1", "--output", str(plan.parent / "a.parquet")]) == 3
    assert pd.read_parquet(plan.parent / "a.parquet")["status"].tolist() == ["failed"]


@pytest.mark.parametrize(
    ("content", "arguments", "fragment"),
    [
        ("", [], "plan.toml, line 1: parameters: none are given; a contact needs radius"),
        ("[parameters]\nbeta = [1, 'x']\n", [], "plan.toml, line 2: beta: expected a positive"),
        ("[parameters]\nspeed = -1\n", [], "plan.toml, line 2: speed: expected a positive"),
        ("[parameters]\nspeed = '1 mm'\n", [], "plan.toml, line 2: speed: 1 mm has the wrong dimension"),
        ("[parameters\n", [], "plan.toml, line 1: no TOML"),
        ("[parameters]\nbeta = { csv = 'c.csv', column = 'b' }\n", [], "c.csv, line 1: no column beta"),
        ("[parameters]\nload = { csv = 'c.csv' }\n", [], "c.csv, line 3: load: 'heavy' under 'load [mN]' is no number"),
        (PLAN, ["--output", "results.txt"], "--output: expected a file ending in"),
        (PLAN, ["--output", "no/such/folder/a.csv"], "--output: the folder"),
        (PLAN, ["--store", "no/such/folder/a"], "--store: the folder"),
        (PLAN, ["--fields", "no/such/folder"], "--fields: the folder"),
        (PLAN, ["--workers", "0"], "--workers: expected a positive"),
        (PLAN, ["--workers", "1", "--scheduler", "tcp://127.0.0.1:9"], "--workers, --scheduler: give one"),
    ],
)
def test_a_bad_sweep_exits_2_with_one_line_and_writes_nothing(plan, capsys, content, arguments, fragment):
    plan.write_text(content)
    (plan.parent / "c.csv").write_text("load [mN]\n1\nheavy\n")
    before = sorted(plan.parent.iterdir())
    assert main(["sweep", str(plan), *arguments]) == 2
    captured = capsys.readouterr()
    assert fragment in captured.err
    assert captured.err.count("\n") == 1
    assert captured.out == ""
    assert sorted(plan.parent.iterdir()) == before


def test_results_may_not_overwrite_the_plan_s_files(plan, capsys):
    plan.write_text("[parameters]\nbeta = { csv = 'c.csv' }\n")
    (plan.parent / "c.csv").write_text("beta\n10\n")
    assert main(["sweep", str(plan), "--output", str(plan.parent / "c.csv")]) == 2
    assert "is read by the plan" in capsys.readouterr().err
    assert (plan.parent / "c.csv").read_text() == "beta\n10\n"


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
    rows = json.loads(captured.out)
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


@pytest.fixture
def data(tmp_path):
    """Twelve rows on the paper's Eq. (28), which is no more than a few per cent from the curve."""
    rows = []
    for load in (0.05, 0.1, 0.2):
        for speed in (1e-4, 3e-4, 1e-3, 3e-3):
            contact = softlube.Contact(radius="2 mm", young_modulus="3 MPa", viscosity=2.0, speed=speed, load=load)
            friction = 2e6 * 3.14159 / 3 * contact.unit_height**2 * 4.806 * contact.problem().beta_load ** -0.4398
            rows.append(f"{1e3 * load}, {1e3 * speed}, {1e3 * friction}\n")
    path = tmp_path / "data.csv"
    path.write_text(HEADER + "".join(rows))
    return path


def test_fit(data, tmp_path, capsys):
    files = ["--plot", str(tmp_path / "f.png"), "--output", str(tmp_path / "f.json")]
    assert main(["fit", str(data), *RIG, "--free", "viscosity", "--hold-out", "0.25", *files]) == 0
    out = capsys.readouterr().out
    for fragment in (
        "9 rows of data.csv",
        "viscosity",
        "held",
        "The data determine viscosity",
        "3 rows left out",
        "total, within",
    ):
        assert fragment in out
    assert main(["fit", str(data), *RIG, "--json"]) == 0
    captured = capsys.readouterr()
    found = json.loads(captured.out)
    assert captured.err == ""
    assert found["values"]["viscosity"] == pytest.approx(2.0, rel=0.06)
    assert found["estimates"]["viscosity"]["low"] < found["values"]["viscosity"] < found["estimates"]["viscosity"]["high"]
    saved = json.loads((tmp_path / "f.json").read_text())
    assert saved["hold_out"]["covered"] <= 1
    assert (tmp_path / "f.png").exists()


@pytest.mark.parametrize(
    ("content", "arguments", "fragment"),
    [
        ("", RIG, "data.csv, line 1: the file is empty"),
        (HEADER + "100, 0.1, much\n", RIG, "data.csv, line 2: friction: 'much' under 'friction [mN]' is no number"),
        (HEADER + "100, -0.1, 1\n", RIG, "data.csv, line 2: speed: expected a positive"),
        ("load [m], speed [m/s], friction [N]\n1,1,1\n", RIG, "data.csv, line 1: load cannot be in 'm'"),
        (None, RIG[:2], "--young-modulus: missing; give it or fit it"),
        (None, RIG[2:], "--radius: missing"),
        (None, [*RIG, "--free", "colour"], "--free: expected one or more"),
        (None, [*RIG, "--hold-out", "2"], "--hold-out: expected a fraction"),
        (None, [*RIG, "--plot", "a.gif"], "--plot: expected a file ending"),
        (None, [*RIG, "--output", "no/such/folder/a.json"], "--output: the folder"),
        (None, [*RIG, "--output", "DATA"], "expected files of their own"),
    ],
)
def test_a_bad_fit_exits_2_with_one_line_and_writes_nothing(data, tmp_path, capsys, content, arguments, fragment):
    if content is not None:
        data.write_text(content)
    before = data.read_bytes()
    plot = [] if "--plot" in arguments else ["--plot", str(tmp_path / "f.png")]
    assert main(["fit", str(data), *(str(data) if a == "DATA" else a for a in arguments), *plot]) == 2
    captured = capsys.readouterr()
    assert fragment in captured.err
    assert captured.err.count("\n") == 1
    assert captured.out == ""
    assert list(tmp_path.iterdir()) == [data]
    assert data.read_bytes() == before


@pytest.mark.parametrize("command", ["sweep", "stribeck", "fit"])
def test_help(capsys, command):
    assert main([command, "--help"]) == 0
    out = capsys.readouterr().out
    assert f"softlube {command}" in out
    assert "[default" in out
