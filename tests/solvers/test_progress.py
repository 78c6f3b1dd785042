"""One message for every call that takes long, each a line of text."""

from __future__ import annotations

import inspect

import pytest

import softlube
from softlube.paper.method.solver import march_relaxation, solve_cartesian, solve_relaxation
from softlube.paper.reproduce import reproduce
from softlube.solvers.progress import Progress


@pytest.mark.parametrize(
    ("progress", "line"),
    [
        (Progress("39 x 26 cells solved in 0.50 s", 2), "39 x 26 cells solved in 0.50 s"),
        (Progress("solving, 2 failed", 3, 8), "solving, 2 failed: 3 of 8"),
        (Progress("bootstrap", 0, 400), "bootstrap: 0 of 400"),
    ],
)
def test_line_of_text(progress, line):
    assert str(progress) == line


@pytest.mark.parametrize(
    "call",
    [
        softlube.solve,
        softlube.Contact.solve,
        softlube.squeeze,
        softlube.sweep,
        softlube.stribeck_curve,
        softlube.fit,
        reproduce,
        solve_relaxation,
        solve_cartesian,
        march_relaxation,
    ],
)
def test_every_long_call_takes_the_same(call):
    parameter = inspect.signature(call).parameters["progress"]
    assert parameter.default is None
    assert parameter.annotation == "Listener | None"


def test_print_is_a_listener(capsys):
    softlube.solve(beta=50, progress=print)
    lines = capsys.readouterr().out.splitlines()
    assert lines
    assert all(" cells solved in " in line for line in lines)
