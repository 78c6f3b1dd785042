"""How far a long calculation has come: one message for every call that takes long."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Progress:
    """One message about a long calculation; ``str()`` gives it as a line of text, so that ``progress=print`` works.

    Parameters
    ----------
    message : str
        What is being done, or what was done last.
    done : int
        Number of steps that are done.
    total : int or None
        Number of all steps; None where it is not known beforehand.

    Examples
    --------
    >>> print(Progress("bootstrap", 20, 400))
    bootstrap: 20 of 400
    >>> print(Progress("27 x 18 cells solved in 0.12 s", 1))
    27 x 18 cells solved in 0.12 s
    """

    message: str
    done: int
    total: int | None = None

    def __str__(self) -> str:
        return self.message if self.total is None else f"{self.message}: {self.done} of {self.total}"


Listener = Callable[[Progress], object]
"""What a long calculation calls with each `Progress`; it ignores what the call returns."""
