"""Progress in a notebook: a bar below the cell, for calls that take long and are given no other listener."""

from __future__ import annotations

import html
import sys
import time
from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

from softlube.solvers.progress import Progress

Given = ParamSpec("Given")
Result = TypeVar("Result")

PATIENCE = 0.5
"""Seconds after which a call that is not over shows its bar."""
INTERVAL = 0.1
"""Seconds between two changes of the bar at least: each is a message to the browser."""


def watched(call: Callable[Given, Result]) -> Callable[Given, Result]:
    """Make a function with a keyword argument `progress` show a bar where it is called from a notebook without one."""

    @wraps(call)
    def shown(*positional: Given.args, **named: Given.kwargs) -> Result:
        if named.get("progress") is not None or not in_notebook():
            return call(*positional, **named)
        bar = Bar()
        named["progress"] = bar
        try:
            return call(*positional, **named)
        finally:
            bar.close()

    return shown


def in_notebook() -> bool:
    """Whether this process is the kernel of a notebook."""
    shell = sys.modules.get("IPython")  # no notebook without it
    found = shell.get_ipython() if shell is not None else None
    return getattr(found, "kernel", None) is not None


class Bar:
    """A bar below the cell, with the number of steps where it is known; gone when the call is over."""

    def __init__(self) -> None:
        self._shown = time.monotonic() + PATIENCE - INTERVAL
        self._handle: Any = None

    def __call__(self, progress: Progress) -> None:
        """Show how far the call has come."""
        if time.monotonic() - self._shown < INTERVAL:
            return
        share = "" if progress.total is None else f" value={progress.done} max={progress.total}"
        self._display(f"<progress{share}></progress> {html.escape(str(progress))}")
        self._shown = time.monotonic()

    def close(self) -> None:
        """Remove the bar."""
        if self._handle is not None:
            self._display("")

    def _display(self, text: str) -> None:
        from IPython.display import HTML, display  # type: ignore[import-not-found]

        if self._handle is None:
            self._handle = display(HTML(text), display_id=True)
        else:
            self._handle.update(HTML(text))
