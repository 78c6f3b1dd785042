"""softlube reproduce: what is written, refusals."""

import pytest

import softlube
from softlube.cli.main import main
from softlube.cli.reproduce import _law_table
from softlube.paper.report import Law


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


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--figure", "4"], "--figure: there is no figure '4'; expected one of 5, 6,"),
        (["--processes", "0"], "--processes: expected a positive number, got 0"),
        (["--data", "nothing.csv"], "--data: nothing.csv: the file does not exist"),
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


def test_laws_as_they_are_printed():
    law = Law("22a", "film, at the centre", 0.9, -0.58, 0.93, -0.587, -0.588, -0.586, 0.985, 1e4, -0.583, -0.59, -0.6)
    no_power = Law("21", "layer", 4.2, -0.51, 5.8, -0.555, -0.57, -0.54, 0.84, 1e4, -0.49, -0.64, None)
    table = _law_table([law, no_power])
    rows = list(zip(*(column.cells for column in table.columns), strict=True))
    assert rows[0] == ("(22a) film", "-0.5800", "-0.5870", "0.0010", "-0.0070", "-0.60")
    assert rows[1][-1] == "none"
