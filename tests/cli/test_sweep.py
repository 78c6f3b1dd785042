"""softlube sweep: output, files, refusals."""

import sqlite3

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
    assert (first, "times the roughness (boundary" in second) == ("", True)


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


def test_a_sweep_says_what_its_store_has_of_other_versions(plan, capsys):
    assert main(["sweep", str(plan), "--workers", "1"]) == 0
    assert "another version" not in capsys.readouterr().out
    with sqlite3.connect(plan.with_suffix(".sweep")) as store:
        store.execute("UPDATE outcomes SET key = 'old' || key, solver = '0.1.0+abc' WHERE status = 'done'")
    store.close()
    assert main(["sweep", str(plan), "--workers", "1"]) == 0
    out = capsys.readouterr().out
    assert "1 were in the store, 2 solved now" in out
    assert "The store also has 2 outcomes of another version of softlube: kept, not used." in out
