"""Examples of docs/how-to/squeeze.md are run and give what the page says; so does the table of layers of its notes."""

import json
import re
import shlex
from pathlib import Path

import pytest

from softlube.cli.main import main
from softlube.model.dry import dry_contact_at
from softlube.model.exact import HERTZ_LOAD
from softlube.model.quantities import QUANTITIES
from softlube.model.substrates import LayerKernel
from softlube.transient.squeeze.integrate import HISTORIES

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "how-to" / "squeeze.md").read_text(encoding="utf-8")


COMMANDS = re.findall(r"```bash\nsoftlube (squeeze .*)\n```\n\n((?:    .*\n)+)((?:\n    Warning.*\n)?)", PAGE)


@pytest.mark.parametrize(("command", "shown", "warning"), COMMANDS, ids=["half-space", "layer", "creep"])
def test_command_gives_the_numbers_of_the_page(capsys, monkeypatch, tmp_path, command, shown, warning):
    monkeypatch.chdir(tmp_path)
    arguments = shlex.split(command)
    assert main([*arguments, "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    names = {QUANTITIES[name].words: name for name in HISTORIES}
    lines = re.findall(r"^    (\D+?)  +(-?[\d.]+) +([nµ])m$", shown, flags=re.MULTILINE)
    assert len(lines) == 4
    for text, number, prefix in lines:
        scale = {"n": 1e9, "µ": 1e6}[prefix]
        assert result["final"][names[text]]["value"] * scale == pytest.approx(float(number), rel=1e-3)
    assert warning.strip() == "".join(f"Warning: {doubt}." for doubt in result["warnings"])
    assert {path.name for path in tmp_path.iterdir()} == {part for part in arguments if part.startswith("squeeze.")}


def test_python_of_the_page_runs():
    physical, normalised = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    names = {}
    exec(physical, names)
    assert names["press"].final["load"] == pytest.approx(0.125, rel=1e-6)
    exec(normalised, names)
    value, error = re.findall(r"# ([\d.]+) ± ([\d.e-]+)\n", normalised)[0]
    least = names["fall"].final["film_min"]
    assert least == pytest.approx(float(value), abs=2 * float(error))


def test_table_of_layers():
    notes = (DOCS / "notes" / "squeeze.md").read_text(encoding="utf-8")
    rows = re.findall(
        r"^\| (?:([\d.]+)|.*?)(, frictionless|, bonded.*?)? \|.*?\| −[\d.]+ \| −([\d.]+) \|", notes, flags=re.MULTILINE
    )
    layers = [(float(t), base, float(depth)) for t, base, depth in rows if t]
    assert len(layers) == 6
    for thickness, base, depth in layers:
        layer = LayerKernel(thickness, 0.5, "frictionless" if "frictionless" in base else "bonded")
        assert dry_contact_at(layer, load=HERTZ_LOAD).indentation == pytest.approx(depth, abs=6e-6)
