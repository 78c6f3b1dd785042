"""`softlube reproduce` and `softlube flow` in-process: choices, refusals, what is written."""

import json

import pytest

import softlube
from softlube.cli.main import main
from softlube.paper.figures import FIGURES
from softlube.paper.reproduce import chosen_figures, disagreements, reproduce


def test_one_figure(tmp_path, capsys):
    assert main(["reproduce", str(tmp_path / "out"), "--figure", "11", "--processes", "1"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    assert "1 contacts and 1 figures" in captured.out
    written = sorted(path.relative_to(tmp_path / "out").as_posix() for path in (tmp_path / "out").rglob("*") if path.is_file())
    assert written == [
        "data/figure-11-rings.csv",
        "figures/figure-11.pdf",
        "figures/figure-11.png",
        "report.html",
        "solutions/beta-1000.nc",
    ]
    assert softlube.load(tmp_path / "out" / "solutions" / "beta-1000.nc").beta == 1000
    assert (tmp_path / "out" / "figures" / "figure-11.pdf").read_bytes().startswith(b"%PDF")
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert page.count("data:image/png;base64,") == 1
    assert "Figure 11" in page


def test_progress_counts_every_job(tmp_path):
    seen = []
    result = reproduce(tmp_path, ["11"], processes=1, progress=seen.append)
    assert [news.done for news in seen] == [0, 1, 2]
    assert {news.total for news in seen} == {2}
    assert result.seconds > 0
    assert len(result.files) == 5
    assert disagreements(result) == []


def test_choice_of_figures():
    assert [spec.key for spec in chosen_figures([])] == list(FIGURES)
    assert [spec.key for spec in chosen_figures(["S2", "5", "S2"])] == ["5", "S2"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--figure", "4"], "--figure: there is no figure '4'; expected one of 5, 6,"),
        (["--processes", "0"], "--processes: expected a positive number, got 0"),
        (["--data", "nothing.csv"], "--data: 'nothing.csv' does not exist"),
        (["--figure", "5", "--data", "nothing.csv"], "--data: measured friction goes into figure 13"),
    ],
)
def test_bad_input_is_refused_before_anything_is_written(tmp_path, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(tmp_path)
    assert main(["reproduce", "out", *arguments]) == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_no_folder(tmp_path, capsys):
    path = tmp_path / "out"
    path.write_text("mine")
    assert main(["reproduce", str(path), "--figure", "11"]) == 2
    assert "is a file; expected the name of a folder" in capsys.readouterr().err
    assert path.read_text() == "mine"


# --- softlube flow --------------------------------------------------------------------------------------------------

BALL = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]


def test_flow_of_a_dimensionless_contact(tmp_path, capsys):
    path = tmp_path / "flow.png"
    assert main(["flow", "--beta", "100", "--plot", str(path), "--level", "0.25"]) == 0
    out = capsys.readouterr().out
    assert "β = 100" in out
    assert "v |h0| a" in out
    assert path.read_bytes().startswith(b"\x89PNG")


def test_flow_of_a_solved_contact_in_si(tmp_path, capsys, physical):
    stored, path = tmp_path / "a.nc", tmp_path / "flow.pdf"
    physical.save(stored)
    assert main(["flow", "--solution", str(stored), "--plot", str(path)]) == 0
    out = capsys.readouterr().out
    assert "Pa on the sphere" in out
    assert "m³/s" in out
    # liquid through the contact, about the centre film times its width times half the speed
    flux = float(out.split("front half: ")[1].split()[0])
    assert flux == pytest.approx(174e-9 * 2 * 334e-6 * 0.1e-3 / 2, rel=0.15)
    assert path.read_bytes().startswith(b"%PDF")


def test_flow_of_a_physical_contact(tmp_path):
    path = tmp_path / "flow.svg"
    assert main(["flow", *BALL, "--plot", str(path)]) == 0
    drawing = path.read_text(encoding="utf-8")
    assert "[Pa]" in drawing


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--plot", "a.png"], "--solution: missing; give --solution, --beta, or a physical contact"),
        (["--beta", "10", "--radius", "2 mm", "--plot", "a.png"], "--beta, --radius: give one contact, not several"),
        (["--beta", "10", "--plot", "a.gif"], "--plot: expected a file ending in"),
        (["--beta", "10", "--plot", "a.png", "--level", "1.5"], "--level: expected a share of the film between 0"),
        (["--solution", "a.nc", "--plot", "a.png"], "'a.nc' does not exist"),
        (["--solution", "a.nc", "--cavitation", "none", "--plot", "a.png"], "--cavitation: the solution has its own"),
        (["--beta", "10"], "plot"),
    ],
)
def test_flow_refuses_bad_input(tmp_path, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(tmp_path)
    assert main(["flow", *arguments]) == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_help_names_the_commands(capsys):
    assert main(["--help"]) == 0
    out = capsys.readouterr().out
    assert "reproduce" in out
    assert "flow" in out


def test_json_of_the_solved_contact_is_untouched(capsys):
    """The new commands leave the old one as it was."""
    assert main(["solve", "--beta", "100", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["beta"] == 100
