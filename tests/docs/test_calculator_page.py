"""docs/how-to/calculator.md: its command writes the file that it names, about as large as it says."""

import re
import shlex
from pathlib import Path

from softlube.cli.main import main
from softlube.theory.centre_line import FILM_ERROR, PRESSURE_ERROR

TEXT = (Path(__file__).parents[2] / "docs" / "how-to" / "calculator.md").read_text(encoding="utf-8")


def test_the_command_writes_its_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (command,) = re.findall(r"softlube calculator \S+", TEXT)
    assert main(shlex.split(command)[1:]) == 0
    (written,) = tmp_path.iterdir()
    assert written.name == "calculator.html"
    assert "about half a megabyte" in " ".join(TEXT.split())
    assert 400_000 < written.stat().st_size < 600_000


def test_the_errors_of_the_profiles_are_those_of_the_table():
    assert FILM_ERROR == PRESSURE_ERROR == 0.005
    assert "to 0.5 % of the film and of the largest pressure" in " ".join(TEXT.split())
