"""What a sweep is to solve: parameters as values, lists, ranges or columns of a CSV file; product or zipped."""

from __future__ import annotations

import itertools
import math
import os
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from softlube.contact import Contact
from softlube.errors import InputError
from softlube.problem import Problem
from softlube.tables import read_table
from softlube.units import KINDS, to_si

COMBINATIONS = ("product", "zip")
DIMENSIONLESS = ("beta", "beta_load")
TEXT = ("cavitation", "base", "viscosity_law", "density_law")
NOT_OF_A_CASE = ("friction", "entrainment_speed")
"""Physical quantities that describe no contact to be solved."""
PARAMETERS = (*(name for name in KINDS if name not in NOT_OF_A_CASE), *DIMENSIONLESS, *TEXT)
MOST_CASES = 100_000
"""Cases that a plan may have: a day of one processor core, or nearly."""
DIGITS = 12
"""Digits of β that count: cases that differ by rounding only are solved once."""
SPACINGS = {"log": np.geomspace, "linear": np.linspace}

Value = float | str


@dataclass(frozen=True)
class Case:
    """One contact of a sweep.

    Attributes
    ----------
    inputs : mapping of str to float or str
        Arguments of `Contact` in SI, or of `Problem`.
    problem : Problem
        The dimensionless problem, its β rounded to `DIGITS` digits.
    """

    inputs: Mapping[str, Value]
    problem: Problem

    @classmethod
    def of(cls, inputs: Mapping[str, Value]) -> Case:
        """Check the inputs.

        Raises
        ------
        InputError
            If they describe no contact.
        """
        if any(name in inputs for name in DIMENSIONLESS):
            physical = [name for name in inputs if name not in (*DIMENSIONLESS, "cavitation")]
            if physical:
                first = next(name for name in DIMENSIONLESS if name in inputs)
                raise InputError(f"{first}, {physical[0]}: give a dimensionless or a physical contact, not both")
            problem = Problem(**inputs)  # type: ignore[arg-type]
        else:
            problem = Contact(**inputs).problem()  # type: ignore[arg-type]
        beta = float(f"{problem.parameter:.{DIGITS}g}")
        rounded = replace(problem, beta_load=beta) if problem.load_controlled else replace(problem, beta=beta)
        return cls(dict(inputs), rounded)

    @property
    def contact(self) -> Contact | None:
        """The physical contact, None for a dimensionless case."""
        return None if any(name in self.inputs for name in DIMENSIONLESS) else Contact(**self.inputs)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Plan:
    """The cases of a sweep.

    Attributes
    ----------
    cases : tuple of Case
    accuracy : float
        See `softlube.solve`.
    sources : tuple of Path
        Files that were read, which no result may overwrite.
    notices : tuple of str
        What was left out of the files.
    """

    cases: tuple[Case, ...]
    accuracy: float = 1e-3
    sources: tuple[Path, ...] = ()
    notices: tuple[str, ...] = ()


@dataclass(frozen=True)
class Axis:
    """Values of one parameter, or of several that go together row by row."""

    rows: Sequence[Mapping[str, Value]]
    origin: Sequence[str]
    """Where each row comes from, for messages."""


def make_plan(
    parameters: Mapping[str, Any],
    *,
    combine: str = "product",
    accuracy: float = 1e-3,
    folder: str | os.PathLike[str] = ".",
) -> Plan:
    """Cases from parameters.

    Parameters
    ----------
    parameters : mapping
        Name of a parameter of `Contact` or `Problem` to a value ("2 mm", a number in SI), a sequence of values, a range
        ``{"from": "25 um/s", "to": "1 mm/s", "count": 12, "spacing": "log"}``, or a column of a file
        ``{"csv": "cases.csv", "column": "speed"}``.  Columns of one file go together row by row.
    combine : {"product", "zip"}
        Every value of a parameter with every value of the others, or first with first, second with second.
    accuracy : float
        See `softlube.solve`.
    folder : path
        Where the CSV files are.

    Raises
    ------
    InputError
        If a value is no such thing, the zipped lengths differ, or a case describes no contact.
    """
    if combine not in COMBINATIONS:
        raise InputError(f"combine: expected 'product' or 'zip', got {combine!r}")
    if isinstance(accuracy, bool) or not isinstance(accuracy, (int, float)) or not 0 < accuracy <= 0.1:
        raise InputError(f"accuracy: expected a number up to 0.1 such as 1e-3, got {accuracy!r}")
    for name in parameters:
        if name not in PARAMETERS:
            raise InputError(f"{name}: no parameter of a contact; expected one of {', '.join(PARAMETERS)}")
    if not parameters:
        raise InputError("parameters: none are given; a contact needs radius, viscosity, …, or beta")
    axes, sources, notices = _axes(parameters, Path(folder))
    cases = []
    for row, origin in _combined(axes, combine):
        try:
            cases.append(Case.of(row))
        except InputError as error:
            raise InputError(f"{origin}: {error}" if origin else str(error)) from None
    return Plan(tuple(cases), float(accuracy), sources, notices)


def read_plan(path: str | os.PathLike[str]) -> Plan:
    """Cases from a TOML file (docs/sweeps.md describes it).

    Raises
    ------
    InputError
        If the file is no plan; the message names the line.
    """
    path = Path(path)
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        raise InputError(f"plan: {str(path)!r} does not exist") from None
    except OSError as error:
        raise InputError(f"plan: {str(path)!r} cannot be read ({error.strerror})") from None
    except UnicodeDecodeError:
        raise InputError(f"{path.name}: not UTF-8 text; expected a plan in TOML") from None
    try:
        content = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{path.name}, {_place(str(error), text)}: no TOML: {str(error).split(' (at')[0]}") from None
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
        if name not in ("combine", "accuracy"):
            raise InputError(f"{path.name}, line {_line_of(text, name)}: {name!r} is no setting; expected combine or accuracy")
    if not parameters:
        raise InputError(f"{path.name}, line 1: no [parameters]; a contact needs radius, viscosity, …, or beta")
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


def _axes(parameters: Mapping[str, Any], folder: Path) -> tuple[list[Axis], tuple[Path, ...], tuple[str, ...]]:
    axes: list[Axis] = []
    by_file: dict[Path, dict[str, str]] = {}
    for name, given in parameters.items():
        if isinstance(given, Mapping) and "csv" in given:
            unknown = set(given) - {"csv", "column"}
            if unknown:
                raise InputError(f"{name}: {unknown.pop()!r} is not known for a column; expected csv and column")
            if not isinstance(given["csv"], (str, os.PathLike)):
                raise InputError(f"{name}: csv: expected the name of a file, got {given['csv']!r}")
            by_file.setdefault(folder / given["csv"], {})[name] = str(given.get("column", name))
        else:
            values = _values(name, given)
            axes.append(Axis([{name: value} for value in values], [""] * len(values)))
    notices: list[str] = []
    for path, columns in by_file.items():
        text = [name for name in columns if name in TEXT]
        if text:
            raise InputError(f"{text[0]}: expected {text[0]!r} in the plan, not in a column")
        table = read_table(path, list(columns), rename={theirs: ours for ours, theirs in columns.items()})
        notices += [f"{path.name}: {notice}" for notice in table.notices]
        rows = [
            dict(zip(columns, map(float, row), strict=True)) for row in zip(*(table.columns[n] for n in columns), strict=True)
        ]
        axes.append(Axis(rows, [f"{path.name}, line {line}" for line in table.lines]))
    return axes, tuple(by_file), tuple(notices)


def _values(name: str, given: Any) -> list[Value]:
    """All values of one parameter, in SI."""
    if isinstance(given, Mapping):
        return _range(name, given)
    if isinstance(given, np.ndarray):
        given = given.tolist()
    if isinstance(given, (list, tuple)):
        if not given:
            raise InputError(f"{name}: the list is empty")
        return [_value(name, item) for item in given]
    return [_value(name, given)]


def _value(name: str, given: Any) -> Value:
    if name in TEXT:
        if not isinstance(given, str):
            raise InputError(f"{name}: expected a text, got {given!r}")
        return given
    if name in DIMENSIONLESS:
        try:
            number = float(given)
        except (TypeError, ValueError):
            number = math.nan
        if isinstance(given, (bool, str)) or not (math.isfinite(number) and number > 0):
            raise InputError(f"{name}: expected a positive, finite number, got {given!r}")
        return number
    return to_si(name, given)


def _range(name: str, given: Mapping[str, Any]) -> list[Value]:
    expected = '{ from = "25 um/s", to = "1 mm/s", count = 12, spacing = "log" }'
    unknown = set(given) - {"from", "to", "count", "spacing"}
    if unknown or not {"from", "to", "count"} <= set(given) or name in TEXT:
        raise InputError(f"{name}: expected a value, a list, a column or a range such as {expected}")
    count, spacing = given["count"], given.get("spacing", "log")
    if isinstance(count, bool) or not isinstance(count, int) or not 2 <= count <= MOST_CASES:
        raise InputError(f"{name}: count: expected a whole number from 2 to {MOST_CASES}, got {count!r}")
    if spacing not in SPACINGS:
        raise InputError(f"{name}: spacing: expected 'log' or 'linear', got {spacing!r}")
    low, high = (float(_value(name, given[end])) for end in ("from", "to"))
    return [float(value) for value in SPACINGS[spacing](low, high, count)]


def _combined(axes: Sequence[Axis], combine: str) -> Iterator[tuple[dict[str, Value], str]]:
    """Rows of all axes together, the last axis fastest, with the origin of each."""
    lengths = [len(axis.rows) for axis in axes]
    if combine == "zip":
        count = max(lengths)
        for axis in axes:  # a single value goes with every row
            if len(axis.rows) not in (1, count):
                name = next(iter(axis.rows[0]))
                raise InputError(f"{name}: has {len(axis.rows)} values and another parameter {count}; zipped, all need as many")
        tuples: Iterator[tuple[int, ...]] = (tuple(i if n > 1 else 0 for n in lengths) for i in range(count))
    else:
        count = math.prod(lengths)
        tuples = itertools.product(*(range(n) for n in lengths))
    if count > MOST_CASES:
        name = next(iter(max(axes, key=lambda axis: len(axis.rows)).rows[0]))
        raise InputError(
            f"{name}: the plan has {count} cases and a sweep takes {MOST_CASES} at most; "
            "thin it out, or take a Stribeck curve or a fit, which interpolate"
        )
    for indices in tuples:
        row: dict[str, Value] = {}
        for axis, index in zip(axes, indices, strict=True):
            row |= axis.rows[index]
        origin = next((axis.origin[i] for axis, i in zip(axes, indices, strict=True) if axis.origin[i]), "")
        yield row, origin
