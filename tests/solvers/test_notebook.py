"""What a notebook shows of a call that takes long, in a real kernel."""

import time

import nbformat
import pytest
from nbclient import NotebookClient

from softlube.solvers import notebook
from softlube.solvers.progress import Progress

CELLS = (
    "import softlube\n"
    "import softlube.solvers.notebook\n"
    "softlube.solvers.notebook.PATIENCE = 0.0\n"
    "softlube.solvers.notebook.INTERVAL = 0.0",
    "solution = softlube.solve(50)\nsolution",
    "softlube.solve(50, progress=print)",
    "rough = softlube.Contact(radius='2 mm', young_modulus='3 MPa', viscosity='2 Pa s', speed='0.1 mm/s', load='100 mN',\n"
    "                         roughness='50 nm')\n"
    "for accuracy in (0.03, 0.02):\n"
    "    rough.solve(accuracy=accuracy)",
)


@pytest.fixture(scope="module")
def outputs():
    """Outputs of every cell; the fifth is the fourth again."""
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(text) for text in (*CELLS, CELLS[-1])])
    NotebookClient(book, timeout=120, kernel_name="python3").execute()
    return [cell.outputs for cell in book.cells]


def displayed(cell):
    """HTML of what was displayed with a handle, as it was last updated."""
    return [output["data"]["text/html"] for output in cell if output["output_type"] == "display_data"]


def test_the_bar_is_gone_when_the_call_is_over_and_the_result_is_a_table(outputs):
    assert displayed(outputs[1]) == [""]
    (result,) = (output for output in outputs[1] if output["output_type"] == "execute_result")
    assert result["data"]["text/plain"].startswith("<Solution: beta 50,")
    assert result["data"]["text/html"].startswith("<div class=softlube>")
    assert len(result["data"]["text/html"].encode()) < 4000


def test_who_listens_sees_no_bar(outputs):
    assert displayed(outputs[2]) == []
    assert any("cells solved" in output.get("text", "") for output in outputs[2])


@pytest.mark.parametrize("cell", [3, 4])
def test_every_result_says_its_doubts(outputs, cell):
    text = "".join(output.get("text", "") for output in outputs[cell] if output.get("name") == "stderr")
    assert text.count("ValidityWarning: the minimum film is 1.6 times the roughness") == 2
    assert "rough.solve(accuracy=accuracy)" in text


def test_steps_of_the_bar(monkeypatch):
    shown = []
    monkeypatch.setattr(notebook.Bar, "_display", lambda self, text: shown.append(text))
    monkeypatch.setattr(notebook, "PATIENCE", 0.05)
    monkeypatch.setattr(notebook, "INTERVAL", 0.01)
    bar = notebook.Bar()
    bar(Progress("solving", 0, 8))  # too early
    time.sleep(0.06)
    bar(Progress("solving", 2, 8))
    bar(Progress("solving", 3, 8))  # too soon
    time.sleep(0.02)
    bar(Progress("a < b", 4))
    assert shown == ["<progress value=2 max=8></progress> solving: 2 of 8", "<progress></progress> a &lt; b"]


def test_outside_a_notebook_nothing_listens():
    assert not notebook.in_notebook()
    assert notebook.watched(lambda *, progress=None: progress)() is None
