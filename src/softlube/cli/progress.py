"""Progress of a longer command on the terminal, on standard error: a bar where the number of steps is known, else a line."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from softlube.solvers.progress import Progress


@contextmanager
def status_line(text: str, *, quiet: bool = False) -> Generator[Callable[[object], None]]:
    """One line with a spinner, for work with an unknown number of steps.

    Parameters
    ----------
    text : str
        First line.
    quiet : bool
        Show nothing.

    Yields
    ------
    show : callable
        Replaces the line by the ``str()`` of its argument, a `softlube.solvers.progress.Progress` or a text.
    """
    from rich.console import Console

    with Console(stderr=True, quiet=quiet).status(text, spinner="dots") as status:
        yield lambda news: status.update(str(news))


class Bar:
    """A bar with the time left, for work with a known number of steps; usable as a context.

    Parameters
    ----------
    title : str
        Text in front of the bar before the first step.
    quiet : bool
        Show nothing.
    """

    def __init__(self, title: str, *, quiet: bool = False) -> None:
        from rich import progress
        from rich.console import Console

        terminal = Console(stderr=True, quiet=quiet)
        self._bar = progress.Progress(
            progress.TextColumn("{task.description:<24}"),
            progress.BarColumn(),
            progress.MofNCompleteColumn(),
            progress.TimeElapsedColumn(),
            progress.TextColumn("left"),
            progress.TimeRemainingColumn(),
            console=terminal,
            transient=True,
            disable=not terminal.is_terminal,
        )
        self._task = self._bar.add_task(title, total=None)

    def __enter__(self) -> Bar:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._bar.live.is_started:
            self._bar.stop()

    def show(self, progress: Progress) -> None:
        """Move the bar; work with another number of steps, or that begins again, starts the clock anew."""
        task = self._bar.tasks[0]
        if progress.total != task.total or progress.done < task.completed:
            self._bar.reset(self._task, total=progress.total)
        self._bar.start()  # only now: what is refused before leaves no trace on the terminal
        self._bar.update(self._task, completed=progress.done, description=progress.message)
