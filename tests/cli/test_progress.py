"""Progress on the terminal: a bar with a known number of steps, a line without; nothing where nobody looks."""

import io

import pytest
from rich.console import Console

from softlube.cli.progress import Bar, status_line
from softlube.solvers.progress import Progress


@pytest.fixture
def terminal(monkeypatch):
    """Standard error as a terminal that writes to memory."""
    text = io.StringIO()

    class Terminal(Console):
        def __init__(self, **options):
            super().__init__(file=text, force_terminal=True, width=100, quiet=options["quiet"])

    monkeypatch.setattr("rich.console.Console", Terminal)
    return text


def progress(message, done, total):
    return Progress(message, done, total)


def test_a_bar_counts(terminal):
    with Bar("starting") as bar:
        bar.show(progress("solving", 1, 4))
        bar.show(progress("drawing", 3, 4))
        task = bar._bar.tasks[0]
        assert (task.completed, task.total, task.description) == (3, 4, "drawing")
    assert "drawing" in terminal.getvalue()
    assert "3/4" in terminal.getvalue()


def test_other_work_starts_the_bar_anew(terminal):
    with Bar("starting") as bar:
        bar.show(progress("solving", 4, 4))
        bar.show(progress("fitting", 1, 9))
        assert (bar._bar.tasks[0].completed, bar._bar.tasks[0].total) == (1, 9)
        began = bar._bar.tasks[0].start_time
        bar.show(progress("fitting", 2, 9))
        assert bar._bar.tasks[0].start_time == began
        bar.show(progress("fitting again", 0, 9))
        assert bar._bar.tasks[0].completed == 0
        assert bar._bar.tasks[0].start_time > began


def test_a_bar_that_is_refused_leaves_no_trace(terminal):
    with Bar("starting"):
        pass
    assert terminal.getvalue() == ""


def test_nothing_is_shown_where_nobody_looks(capsys):
    with Bar("starting") as bar, status_line("solving") as show:
        bar.show(progress("solving", 1, 4))
        show("grid 1")
    with Bar("starting", quiet=True) as bar:
        bar.show(progress("solving", 1, 4))
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "grid" not in captured.err


def test_a_line_is_replaced(terminal):
    with status_line("solving") as show:
        show("grid 2 of 5")
    assert "grid 2 of 5" in terminal.getvalue()
