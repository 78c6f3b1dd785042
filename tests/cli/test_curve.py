"""softlube curve: values, files, refusals."""

import re

import numpy as np
import pytest

import softlube
from softlube.cli.main import main


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
    options = ["--start", "10", "--stop", "1000", "--points", "3", "--csv", str(csv), "--plot", str(plot)]
    assert main(["curve", "film_center", "film_min", *options]) == 0
    out = capsys.readouterr().out
    assert f"Wrote {csv}" in out
    assert csv.read_text().splitlines()[0] == "beta,film_center,film_center_error,film_min,film_min_error"
    rows = np.loadtxt(csv, delimiter=",", skiprows=1)
    assert rows[:, 0] == pytest.approx([10, 100, 1000])
    assert rows[1, 1] == pytest.approx(float(softlube.curve.film_center(100.0)[0]), rel=1e-8)
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
        (["--csv", "no/such/folder/a.csv"], "--csv: the folder"),
    ],
)
def test_bad_input_exits_2_and_writes_nothing(tmp_path, monkeypatch, capsys, arguments, fragment):
    monkeypatch.chdir(tmp_path)
    assert main(["curve", *arguments]) == 2
    captured = capsys.readouterr()
    assert fragment in captured.err
    assert captured.out == ""
    assert list(tmp_path.iterdir()) == []
