"""`softlube calculator`: what it writes and what it refuses, before it computes."""

import pytest

from softlube.cli.main import main


def test_it_writes_one_file(tmp_path, capsys):
    assert main(["calculator", str(tmp_path / "page.html")]) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["page.html"]
    assert (tmp_path / "page.html").read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    assert capsys.readouterr().out.startswith(f"Wrote {tmp_path / 'page.html'} (")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("page.txt", "--page: expected a file that ends with .html, got"),
        ("missing/page.html", "does not exist; expected a file in an existing folder"),
        ("folder.html", "is a folder; expected the name of a file"),
    ],
)
def test_a_wrong_target_is_refused_at_once(tmp_path, capsys, monkeypatch, name, message):
    (tmp_path / "folder.html").mkdir()
    monkeypatch.setattr("softlube.plots.calculator.page.page", lambda: pytest.fail("it computes first"))
    assert main(["calculator", str(tmp_path / name)]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["folder.html"]
