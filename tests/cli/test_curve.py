"""softlube curve: values, files, refusals."""

import re

import numpy as np
import pytest

import softlube
from softlube.cli.main import main
from softlube.experiments.nodes import at
from softlube.steady.solve import solve_problem


def test_one_beta_prints_every_quantity_with_its_error(capsys, solution):
    assert main(["curve", "--beta", "1000"]) == 0
    out = capsys.readouterr().out
    assert "Normalised with the indentation" in out
    value, error = map(float, re.search(r"film_center +([0-9.]+) +± ([0-9.e-]+)", out).groups())
    assert value == pytest.approx(solution.film_center, abs=3 * solution.film_center.error)
    assert 0 < error < 1e-3 * value
    assert "friction_domain" in out


def test_one_beta_load_is_normalised_with_the_load(capsys):
    assert main(["curve", "film_min", "--beta-load", "1000"]) == 0
    out = capsys.readouterr().out
    assert "the Hertz indentation of the load" in out
    value = float(re.search(r"film_min +([0-9.]+)", out)[1])
    solved = softlube.solve(beta_load=1000).film_min
    assert value == pytest.approx(solved, abs=5 * solved.error)


def test_a_range_as_csv_and_picture(capsys, tmp_path):
    csv, plot = tmp_path / "c.csv", tmp_path / "c.png"
    options = ["--start", "10", "--stop", "1000", "--points", "3", "--output", str(csv), "--plot", str(plot)]
    assert main(["curve", "film_center", "film_min", *options]) == 0
    out = capsys.readouterr().out
    assert f"Wrote {csv}" in out
    assert csv.read_text().splitlines()[0] == "beta,film_center,film_center_error,film_min,film_min_error"
    rows = np.loadtxt(csv, delimiter=",", skiprows=1)
    assert rows[:, 0] == pytest.approx([10, 100, 1000])
    assert rows[1, 1] == pytest.approx(float(softlube.curve.film_center(100.0)[0]), rel=1e-8)
    assert plot.read_bytes().startswith(b"\x89PNG")


LAYER = ["--radius", "5 mm", "--young-modulus", "3 MPa", "--thickness", "1 mm", "--viscosity", "0.1 Pa s"]


@pytest.mark.parametrize(
    ("control", "symbol", "unit"),
    [(["--load", "200 mN"], "beta_load", "Hertz indentation"), (["--indentation", "100 um"], "beta", "the indentation")],
)
def test_a_layer_is_computed(capsys, tmp_path, control, symbol, unit):
    csv, plot = tmp_path / "c.csv", tmp_path / "c.png"
    options = [
        "--start",
        "100",
        "--stop",
        "1000",
        "--points",
        "3",
        "--accuracy",
        "0.02",
        "--output",
        str(csv),
        "--plot",
        str(plot),
    ]
    assert main(["curve", "film_center", "height" if "--load" in control else "load", *LAYER, *control, *options]) == 0
    out = capsys.readouterr().out
    assert f"Normalised with {unit}" in out.replace("the Hertz", "Hertz")
    assert "computed for this contact" in out
    assert csv.read_text().startswith(symbol + ",film_center")
    rows = np.loadtxt(csv, delimiter=",", skiprows=1)
    inputs = dict(zip((name[2:].replace("-", "_") for name in (*LAYER, *control)[::2]), (*LAYER, *control)[1::2], strict=True))
    problem = softlube.Contact(**inputs, speed=1.0).problem()
    solved = solve_problem(at(problem, 100.0), accuracy=0.02)
    assert rows[0, :3] == pytest.approx([100, solved.film_center, solved.film_center.error], rel=1e-6)
    assert plot.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "fragment"),
    [
        (["--start", "10", "--stop", "1"], "expected 0 < start < stop"),
        (["--points", "1"], "2 to 100000 points"),
        (["--beta", "-1"], "--beta: expected a positive"),
        (["--beta", "10", "--beta-load", "10"], "give exactly one"),
        (["colour"], "colour"),
        (["--by", "radius"], "--by"),
        (["--plot", "a.gif"], "--plot: expected a file ending in"),
        (["--beta", "10", "--plot", "a.png"], "--plot: a curve takes a range"),
        (["--beta", "10", *LAYER, "--load", "1 N"], "give a range, or softlube solve a speed"),
        (["--by", "load", *LAYER, "--indentation", "1 um"], "--by, --radius: a curve of a contact"),
        (["film_min_radius", *LAYER, "--load", "1 N"], "film_min_radius is no function of beta here"),
        (["--accuracy", "0.01"], "--accuracy: the table has its own errors"),
        (["--output", "no/such/folder/a.csv"], "--output: the folder"),
    ],
)
def test_bad_input_exits_2_and_writes_nothing(tmp_path, monkeypatch, capsys, arguments, fragment):
    monkeypatch.chdir(tmp_path)
    assert main(["curve", *arguments]) == 2
    captured = capsys.readouterr()
    assert fragment in captured.err
    assert captured.out == ""
    assert list(tmp_path.iterdir()) == []
