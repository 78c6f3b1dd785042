"""Progress of a longer command on the terminal, on standard error."""

from __future__ import annotations


class Steps:
    """A bar with the time left, for work of so many steps; usable as a context.

    Parameters
    ----------
    title : str
        What is being done.
    quiet : bool
        Show nothing.
    """

    def __init__(self, title: str, *, quiet: bool = False) -> None:
        from rich import progress
        from rich.console import Console

        self._bar = progress.Progress(
            progress.TextColumn("{task.description}"),
            progress.BarColumn(),
            progress.MofNCompleteColumn(),
            progress.TimeElapsedColumn(),
            progress.TextColumn("left"),
            progress.TimeRemainingColumn(),
            progress.TextColumn("{task.fields[note]}"),
            console=Console(stderr=True, quiet=quiet),
            transient=True,
        )
        self._task = self._bar.add_task(title, total=None, note="")

    def __enter__(self) -> Steps:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._bar.live.is_started:
            self._bar.stop()

    def step(self, what: str, done: int, total: int) -> None:
        """So much is done of what is being done now; another piece of work starts the clock anew."""
        if self._bar.tasks[0].description != what:
            self._bar.reset(self._task, description=what, total=total)
        self.update(done, total)

    def update(self, done: int, total: int, note: str = "") -> None:
        """So many steps of so many are done."""
        self._bar.start()  # only now: what is refused before leaves no trace on the terminal
        self._bar.update(self._task, completed=done, total=total, note=note)
