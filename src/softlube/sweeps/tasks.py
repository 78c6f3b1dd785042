"""Protocols of a sweep's cases and tasks: all that plan, store, runner and executors know of them.

`softlube.sweeps.steady` has cases of steady sliding, `softlube.sweeps.approach` squeeze films and starts of sliding.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar, Protocol

Value = float | str
"""Value of a parameter: a number in SI, or a text."""


@dataclass(frozen=True)
class Outcome:
    """What came of a task, plain and small.

    Attributes
    ----------
    reason : str
        Why it failed; empty if it did not.
    quantities : mapping of str to (value, error)
        Normalised.
    facts : mapping of str to float or str
        What else is known, without an error.
    fields : bytes or None
        The solution as a NetCDF file, normalised, if asked for.
    """

    reason: str = ""
    quantities: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    facts: Mapping[str, Value] = field(default_factory=dict)
    fields: bytes | None = None

    @property
    def failed(self) -> bool:
        """Whether there is no solution."""
        return bool(self.reason)


class Task(Protocol):
    """Something to solve, in numbers only; cases that differ in nothing else share it.  Goes to the workers."""

    kind: ClassVar[str]
    """Key of `softlube.sweeps.work.ROOMS`, which says what code decides on the numbers."""

    @property
    def place(self) -> tuple[float, ...]:
        """Where it stands in the order in which a worker walks; neighbours share work."""
        ...

    def to_plain(self) -> dict[str, Any]:
        """All that determines the solution, but for accuracy and code."""
        ...

    def solve(self, accuracy: float, with_fields: bool) -> Outcome:
        """Solve; may raise."""
        ...


class Case(Protocol):
    """One row of the table."""

    @property
    def inputs(self) -> Mapping[str, Value]:
        """As in the plan, in SI."""
        ...

    @property
    def task(self) -> Task:
        """What is to be solved for it."""
        ...

    def numbers(self, outcome: Outcome) -> dict[str, Value]:
        """Cells of the table besides inputs, status and reason, in the case's own units; for a failure, too."""
        ...

    def write(self, fields: bytes, path: Path) -> None:
        """Write the fields of an outcome as NetCDF, in the case's own units."""
        ...


class Kind(Protocol):
    """What a plan's cases are cases of."""

    what: ClassVar[str]
    """In words, for messages: "a contact"."""
    needs: ClassVar[str]
    """What it cannot do without, in words."""
    parameters: ClassVar[tuple[str, ...]]

    @property
    def sources(self) -> Iterable[Path]:
        """Files that were read by `prepare`."""
        ...

    def accuracy(self, given: float | None, names: Iterable[str]) -> float:
        """The accuracy asked for, or the usual one of cases with such parameters; refused if it cannot be reached."""
        ...

    def prepare(self, inputs: Mapping[str, Value]) -> None:
        """Look at some of the values before any case is made of them; refuse what is wrong by itself."""
        ...

    def case(self, inputs: Mapping[str, Value]) -> Case:
        """Check the inputs together.

        Raises
        ------
        InputError
            If they describe no case.
        """
        ...
