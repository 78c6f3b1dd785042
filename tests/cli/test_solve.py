"""The command line in-process: output, exit codes, messages."""

import json
import re

import pytest

import softlube
from softlube.cli.main import main
from softlube.model.quantities import STEADY

BALL = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]


def test_table_of_a_physical_contact(capsys):
    assert main(["solve", *BALL, "--thickness", "2 mm"]) == 0
    out = capsys.readouterr().out
    for fragment in (
        "indentation ",
        "48.879",
        "radius of the dry contact",
        "µm",
        "minimum film",
        "nm",
        "friction coefficient over r ≤ 2a",
        "Converged in",
    ):
        assert fragment in out
    assert "Warning:" in out
    assert "…" not in out


def test_table_of_a_dimensionless_contact_fits_eighty_columns(capsys):
    assert main(["solve", "--beta", "100"]) == 0
    out = capsys.readouterr().out
    assert "β = 100" in out
    assert "|h0|" in out
    assert "…" not in out


def test_json_is_one_object_and_nothing_else(capsys, contact, physical):
    assert main(["solve", *BALL, "--json"]) == 0
    captured = capsys.readouterr()
    data = json.loads(captured.out)
    assert captured.err == ""
    assert data["beta"] == physical.beta
    assert set(STEADY) <= set(data["quantities"])
    assert data["quantities"]["film_min"] == {"value": physical.film_min, "error": physical.film_min.error}
    assert data["dimensional"]["friction_coefficient"]["value"] == physical.dimensional["friction_coefficient"]
    assert data["dimensional"]["indentation"]["unit"] == "m"


def test_json_says_what_the_true_sphere_would_change(capsys):
    wide = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]
    assert main(["solve", *wide, "--json"]) == 0
    (note,) = json.loads(capsys.readouterr().out)["notes"]
    assert note["text"].startswith("the contact's radius is 0.17 R")
    film = note["relative_changes"]["film at the centre"]
    assert film["value"] == pytest.approx(-0.0130, abs=5e-4)
    assert 0 < film["error"] < 0.003


def test_json_of_a_dimensionless_contact_has_no_dimensional_part(capsys):
    assert main(["solve", "--beta", "100", "--cavitation", "none", "--accuracy", "0.01", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert "dimensional" not in data
    assert (data["cavitation"], data["accuracy"]) == ("none", 0.01)


def test_the_paper_s_method(capsys, tmp_path):
    assert main(["solve", "--beta", "10", "--method", "relaxation", "--plot", str(tmp_path / "a.png")]) == 0
    out = capsys.readouterr().out
    assert "sweeps of the paper's method (relaxation)" in out
    assert "± unknown" in out
    assert (tmp_path / "a.png").exists()


def test_json_of_the_paper_s_method_says_that_errors_are_unknown(capsys):
    assert main(["solve", "--beta", "10", "--method", "relaxation", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["accuracy"] is None
    assert data["quantities"]["film_center"]["error"] is None
    # within 6 % of the truth at β = 10, where the domain cut at r = 2 tells
    assert data["quantities"]["film_center"]["value"] == pytest.approx(0.23662, rel=0.06)


def test_output_and_plot(capsys, tmp_path):
    output, plot = tmp_path / "a.nc", tmp_path / "a.png"
    assert main(["solve", "--beta", "100", "--output", str(output), "--plot", str(plot)]) == 0
    assert softlube.load(output).beta == 100
    assert plot.read_bytes().startswith(b"\x89PNG")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.nc", "a.png"]
    assert str(output) in capsys.readouterr().out


def test_table_of_a_dimensionless_load_names_its_unit(capsys):
    assert main(["solve", "--beta-load", "2", "--accuracy", "0.01"]) == 0
    out = capsys.readouterr().out
    assert "δ is the Hertz indentation of the load" in out
    assert "over the undeformed surface" in out
    assert "4πG δ L" in out
    assert "|h0|" not in out
    assert "…" not in out


@pytest.mark.parametrize("given", [["--indentation", "-1 um"], ["--indentation", "0 um"], ["--load", "50 uN"]])
def test_a_sphere_that_floats_is_solved_by_the_same_command(capsys, tmp_path, given):
    output = tmp_path / "a.nc"
    assert main(["solve", *BALL[:-2], *given, "--accuracy", "0.01", "--json", "--output", str(output)]) == 0
    data = json.loads(capsys.readouterr().out)
    depth = data["dimensional"]["indentation"]["value"]
    if given[0] == "--indentation":
        assert depth == pytest.approx(-1e-6 if given[1] == "-1 um" else 0, abs=1e-20)
    else:
        assert -6e-6 < depth < -3e-6
        assert data["dimensional"]["load"]["value"] == pytest.approx(5e-5, rel=1e-12)
    assert data["dimensional"]["film_min"]["value"] > -depth
    assert softlube.load(output).dimensional["indentation"] == depth
    assert main(["solve", *BALL[:-2], *given, "--accuracy", "0.01"]) == 0
    assert ("radius of the dry contact" in capsys.readouterr().out) == (given[0] == "--load")  # a gap has no dry contact


@pytest.mark.parametrize(
    ("arguments", "fragment"),
    [
        ([], "radius: missing"),
        (["--beta", "abc"], "--beta"),
        (["--beta", "-1"], "--beta: expected a positive"),
        (["--beta", "nan"], "--beta: cannot read 'nan': expected a finite"),
        (["--beta", "10", "--radius", "2 mm"], "not both"),
        (["--beta", "10", "--beta-load", "10"], "--beta, --beta-load: give exactly one"),
        (["--beta", "10", "--cavitation", "x"], "--cavitation: expected"),
        (["--beta", "10", "--accuracy", "7"], "--accuracy: expected"),
        (["--beta", "10", "--frobnicate", "7"], "--frobnicate"),
        (["--beta", "10", "stray"], "stray"),
        (["--beta", "10", "--method", "x"], "--method: expected"),
        (["--beta", "100", "--method", "relaxation", "--accuracy", "0.01"], "--accuracy: method 'relaxation' has one mesh"),
        (["--beta-load", "100", "--method", "cartesian"], "--beta-load: the paper's method"),
        (["--beta", "3", "--method", "relaxation"], "--beta: the paper's method"),
        (["--beta", "10", "--output", "no/such/folder/a.nc"], "--output: the folder"),
        (["--beta", "10", "--plot", "no/such/folder/a.png"], "--plot: the folder"),
        (["--beta", "10", "--plot", "a.bmp"], "--plot: expected a file ending"),
        (["--beta", "10", "--plot", "a.png", "--output", "a.png"], "--output, --plot: expected two different"),
        ([*BALL, "--load", "1 N"], "--load"),
        ([*BALL, "--indentation", "1 um"], "--load, --indentation: are both given"),
        ([*BALL, "--shear-modulus", "1 MPa"], "--young-modulus, --shear-modulus: are both given"),
        (BALL[2:], "--radius: missing"),
        (BALL[:-2], "--load, --indentation: are both missing"),
        ([*BALL[:-1], "-5 N"], "--load: expected a positive"),
        ([*BALL[:-1], "5 m"], "--load: 5 m has the wrong dimension"),
        ([*BALL[:-1], "5"], "--load: '5' has no unit"),
        ([*BALL[:-2], "--indentation", "-5 N"], "--indentation: -5 N has the wrong dimension"),
        ([*BALL[:-2], "--indentation", "-inf m"], "--indentation: cannot read '-inf m': expected a finite"),
        ([*BALL, "--roughness", "0 nm"], "--roughness: expected a positive"),
    ],
)
def test_bad_input_exits_2_with_one_line(capsys, arguments, fragment):
    assert main(["solve", *arguments]) == 2
    captured = capsys.readouterr()
    assert fragment in captured.err
    assert captured.out == ""
    assert captured.err.count("\n") == 1


def test_no_convergence_exits_3_and_writes_nothing(capsys, tmp_path):
    output = tmp_path / "a.nc"
    assert main(["solve", "--beta", "1e10", "--output", str(output)]) == 3
    captured = capsys.readouterr()
    assert "outside the range" in captured.err
    assert captured.out == ""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("beta", "times"), [("100", "3 times that"), ("1e8", "10 times that")])
def test_the_report_says_how_accurate_the_minimum_film_was_asked_to_be(beta, times, capsys):
    assert main(["solve", "--beta-load", beta, "--accuracy", "1e-2"]) == 0
    assert times in capsys.readouterr().out


RIG = ["--ball-young-modulus", "5 MPa", "--substrate-radius=-5 mm", "--entrainment-speed", "0.05 mm/s", "--slide-to-roll", "0"]


def test_a_rig_with_two_elastic_bodies_that_roll(capsys):
    bodies = [each for each in BALL if each not in ("--speed", "0.1 mm/s")]
    assert main(["solve", *bodies, *RIG]) == 0
    out = capsys.readouterr().out
    assert re.search(r"shear on the ball over r ≤ a +none", out)
    assert "Where the ball turns" in out
    assert main(["solve", *bodies, *RIG, "--json"]) == 0
    solved = json.loads(capsys.readouterr().out)["dimensional"]
    assert main(["solve", *bodies, *RIG, "--json", "--fast"]) == 0
    fast = json.loads(capsys.readouterr().out)["dimensional"]
    assert fast["friction_contact"]["value"] is None
    for name in ("friction_total", "film_min"):
        allowed = 3 * (fast[name]["error"] + solved[name]["error"])
        assert fast[name]["value"] == pytest.approx(solved[name]["value"], abs=allowed)
    assert main(["solve", *BALL, *RIG]) == 2
    assert "--speed, --entrainment-speed: no motion has both" in capsys.readouterr().err
