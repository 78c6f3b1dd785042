"""What a sweep is to solve: the cases of a plan in TOML, or of parameters in Python."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import Any

from softlube.errors import InputError, shown
from softlube.files.reading import Damaged, read_bytes
from softlube.sweeps.axes import COMBINATIONS, combined, read_axes
from softlube.sweeps.tasks import Case, Kind, Value

MOTIONS = {"steady": "steady:Steady", "squeeze": "approach:Approaches"}
"""How the sphere moves, and the room that has such cases.  Imported when wanted: a worker needs one of them at most."""
LARGEST = 1_000_000
"""Bytes of a plan: ten for each case that it may have, and columns of many values stand in a CSV file."""
UNENDING = re.compile(r"[^=,\n#]{2000}")
"""A key or a value that goes on and on: the time for a key of many parts grows with their square."""
SETTINGS = ("motion", "combine", "accuracy")


@dataclass(frozen=True)
class Plan:
    """The cases of a sweep.

    Attributes
    ----------
    cases : tuple of Case
    accuracy : float
        See `softlube.solve` and `softlube.squeeze`.
    sources : tuple of Path
        Files that were read, which no result may overwrite.
    notices : tuple of str
        What was left out of the files.
    """

    cases: tuple[Case, ...]
    accuracy: float
    sources: tuple[Path, ...] = ()
    notices: tuple[str, ...] = ()

    def inputs(self) -> dict[str, Value | list[Value]]:
        """Inputs by their names, in SI: the value that all cases have, or a list of the different ones in their order."""
        values: dict[str, dict[Value, None]] = {}
        for case in self.cases:
            for name, value in case.inputs.items():
                values.setdefault(name, {})[value] = None
        return {name: list(each) if len(each) > 1 else next(iter(each)) for name, each in values.items()}


def make_plan(
    parameters: Mapping[str, Any],
    *,
    motion: str = "steady",
    combine: str = "product",
    accuracy: float | None = None,
    folder: str | os.PathLike[str] = ".",
) -> Plan:
    """Cases from parameters.

    Parameters
    ----------
    parameters : mapping
        Name of a parameter of `Contact` or `Problem`, or of `softlube.squeeze`, to a value ("2 mm", a number in SI), a sequence
        of values, a range ``{"from": "25 um/s", "to": "1 mm/s", "count": 12, "spacing": "log"}``, or a column of a file
        ``{"csv": "cases.csv", "column": "speed"}``.  Columns of one file go together row by row.
    motion : {"steady", "squeeze"}
        Steady sliding, or a squeeze film; with a speed the latter starts to slide.
    combine : {"product", "zip"}
        Every value of a parameter with every value of the others, or first with first, second with second.
    accuracy : float, optional
        See `softlube.solve`, `softlube.squeeze` and `softlube.slide`; each has its own if not given.
    folder : path
        Where the CSV files are.

    Raises
    ------
    InputError
        If a value is no such thing, the zipped lengths differ, or the values of a case do not go together.
    """
    kind = _kind(motion, folder)
    if combine not in COMBINATIONS:
        raise InputError(f"combine: expected 'product' or 'zip', got {shown(combine)}")
    for name in parameters:
        if name not in kind.parameters:
            raise InputError(f"{name}: no parameter of {kind.what}{_hint(name, kind, folder)}")
    asked = kind.accuracy(accuracy, parameters)
    if not parameters:
        raise InputError(f"parameters: none are given; {kind.what} needs {kind.needs}")
    axes, sources, notices = read_axes(parameters, Path(folder))
    for axis in axes:
        for row in axis.rows:
            kind.prepare(row)
    cases = []
    for row, origin in combined(axes, combine):
        try:
            cases.append(kind.case(row))
        except InputError as error:
            raise InputError(f"{origin}: {error}" if origin else str(error)) from None
    return Plan(tuple(cases), asked, (*sources, *kind.sources), notices)


def _kind(motion: object, folder: str | os.PathLike[str]) -> Kind:
    if not isinstance(motion, str) or motion not in MOTIONS:
        raise InputError(f"motion: expected {' or '.join(map(repr, MOTIONS))}, got {shown(motion)}")
    module, name = MOTIONS[motion].split(":")
    return getattr(import_module(f"softlube.sweeps.{module}"), name)(Path(folder))


def _hint(name: str, kind: Kind, folder: str | os.PathLike[str]) -> str:
    """What to say of a parameter that a kind does not have."""
    for motion in MOTIONS:
        other = _kind(motion, folder)
        if name in other.parameters:
            return f", but one of {other.what}; set motion = {motion!r} (in a file under [sweep]), or leave it out"
    return f"; expected one of {', '.join(kind.parameters)}"


def read_plan(path: str | os.PathLike[str]) -> Plan:
    """Cases from a TOML file (docs/how-to/sweeps.md describes it).

    Raises
    ------
    InputError
        If the file is no plan; the message names the line.
    """
    path = Path(path)
    try:
        text = read_bytes(path, LARGEST).decode("utf-8-sig")
    except Damaged as error:
        raise error.about(f"plan: {os.fspath(path)!r}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path.name}: not UTF-8 text; expected a plan in TOML") from None
    if (long := UNENDING.search(text)) is not None:
        line = text.count("\n", 0, long.start()) + 1
        raise InputError(f"{path.name}, line {line}: a key or a value is longer than anything that a plan needs")
    try:
        content = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{path.name}, {_place(str(error), text)}: no TOML: {str(error).split(' (at')[0]}") from None
    except (ValueError, RecursionError):  # thousands of digits, hundreds of brackets
        raise InputError(f"{path.name}: not read: a number is too long, or lists stand in lists without end") from None
    settings = content.pop("sweep", {})
    parameters = content.pop("parameters", {})
    if content:
        unknown = next(iter(content))
        place = f"{path.name}, line {_line_of(text, unknown)}"
        raise InputError(f"{place}: {unknown!r} is not known here; expected the tables [sweep] and [parameters]")
    for name, table in (("sweep", settings), ("parameters", parameters)):
        if not isinstance(table, dict):
            raise InputError(f"{path.name}, line {_line_of(text, name)}: {name!r} must be a table, [{name}]")
    for name in settings:
        if name not in SETTINGS:
            place = f"{path.name}, line {_line_of(text, name)}"
            raise InputError(f"{place}: {name!r} is no setting; expected one of {', '.join(SETTINGS)}")
    try:
        plan = make_plan(parameters, **settings, folder=path.parent)
    except InputError as error:
        message = str(error)
        if ", line " in message.split(":")[0]:  # a CSV file's own complaint
            raise
        name = re.split(r"[:, ]", message, maxsplit=1)[0]
        raise InputError(f"{path.name}, line {_line_of(text, name)}: {message}") from None
    return replace(plan, sources=(path, *plan.sources))


def _place(message: str, text: str) -> str:
    match = re.search(r"at line (\d+)", message)
    return f"line {match[1] if match else max(text.count(chr(10)), 1)}"


def _line_of(text: str, name: str) -> int:
    """Line on which a key or table is defined; 1 if it is nowhere."""
    pattern = re.compile(rf"^\s*(?:\[+\s*)?[\"']?{re.escape(name)}[\"']?\s*(?:=|\]|\.)")
    return next((number for number, line in enumerate(text.splitlines(), 1) if pattern.match(line)), 1)
