"""The worked example of docs/squeeze.md is run, and gives what the page says."""

import json
import re
import shlex
from pathlib import Path

import pytest

from softlube.approach.result import DESCRIPTION
from softlube.cli import main

PAGE = (Path(__file__).parents[1] / "docs" / "squeeze.md").read_text(encoding="utf-8")


def test_command_gives_the_numbers_of_the_page(capsys, monkeypatch, tmp_path):
    command = re.search(r"```bash\nsoftlube (squeeze .*)\n```", PAGE)
    assert command
    monkeypatch.chdir(tmp_path)
    assert main([*shlex.split(command[1]), "--json"]) == 0
    final = json.loads(capsys.readouterr().out)["final"]
    names = {text: name for name, text in DESCRIPTION.items()}
    lines = re.findall(r"^    (\D+?)  +(-?[\d.]+) +([nµ])m$", PAGE, flags=re.MULTILINE)
    assert len(lines) == 4
    for text, number, prefix in lines:
        scale = {"n": 1e9, "µ": 1e6}[prefix]
        assert final[names[text]]["value"] * scale == pytest.approx(float(number), rel=1e-3)
    assert {path.name for path in tmp_path.iterdir()} == {"squeeze.png", "squeeze.nc"}


def test_python_of_the_page_runs():
    code = re.search(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    assert code
    names = {}
    exec(code[1], names)
    press = names["press"]
    assert press.final["load"] == pytest.approx(0.125, rel=1e-6)
