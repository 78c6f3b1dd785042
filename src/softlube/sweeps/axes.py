"""Parameters of a plan: values, lists, ranges and columns of CSV files, combined to rows."""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from softlube.errors import InputError, shown
from softlube.files.tables import read_table
from softlube.physical.inputs import declared
from softlube.sweeps.tasks import Value

COMBINATIONS = ("product", "zip")
DIMENSIONLESS = ("beta", "beta_load")
MOST_CASES = 100_000
"""Cases that a plan may have: a day of one processor core, or nearly."""
SPACINGS = {"log": np.geomspace, "linear": np.linspace}


@dataclass(frozen=True)
class Axis:
    """Values of one parameter, or of several that go together row by row."""

    rows: Sequence[Mapping[str, Value]]
    origin: Sequence[str]
    """Where each row comes from, for messages."""


def read_axes(parameters: Mapping[str, Any], folder: Path) -> tuple[list[Axis], tuple[Path, ...], tuple[str, ...]]:
    """Axes, the files that were read, and what was left out of them.

    Raises
    ------
    InputError
        If a value is none of the parameter's, or a file is not as it should be.
    """
    axes: list[Axis] = []
    by_file: dict[Path, dict[str, str]] = {}
    for name, given in parameters.items():
        if isinstance(given, Mapping) and "csv" in given:
            unknown = set(given) - {"csv", "column"}
            if unknown:
                raise InputError(f"{name}: {unknown.pop()!r} is not known for a column; expected csv and column")
            if not isinstance(given["csv"], (str, os.PathLike)):
                raise InputError(f"{name}: csv: expected the name of a file, got {shown(given['csv'])}")
            by_file.setdefault(folder / given["csv"], {})[name] = str(given.get("column", name))
        else:
            values = _values(name, given)
            axes.append(Axis([{name: value} for value in values], [""] * len(values)))
    notices: list[str] = []
    for path, columns in by_file.items():
        text = [name for name in columns if _is_text(name)]
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
        if not _is_text(name) and name not in DIMENSIONLESS:
            return declared()[name].read_all(given)
        return [_value(name, item) for item in given]
    return [_value(name, given)]


def _is_text(name: str) -> bool:
    return name not in DIMENSIONLESS and declared()[name].is_text


def _value(name: str, given: Any) -> Value:
    if _is_text(name):
        if not isinstance(given, str):
            raise InputError(f"{name}: expected a text, got {shown(given)}")
        return given
    if name in DIMENSIONLESS:
        try:
            number = float(given)
        except (TypeError, ValueError, OverflowError):
            number = math.nan
        if isinstance(given, (bool, str)) or not (math.isfinite(number) and number > 0):
            raise InputError(f"{name}: expected a positive, finite number, got {shown(given)}")
        return number
    return declared()[name].read(given)


def _range(name: str, given: Mapping[str, Any]) -> list[Value]:
    expected = '{ from = "25 um/s", to = "1 mm/s", count = 12, spacing = "log" }'
    unknown = set(given) - {"from", "to", "count", "spacing"}
    if unknown or not {"from", "to", "count"} <= set(given) or _is_text(name):
        raise InputError(f"{name}: expected a value, a list, a column or a range such as {expected}")
    count, spacing = given["count"], given.get("spacing", "log")
    if isinstance(count, bool) or not isinstance(count, int) or not 2 <= count <= MOST_CASES:
        raise InputError(f"{name}: count: expected a whole number from 2 to {MOST_CASES}, got {shown(count)}")
    if not isinstance(spacing, str) or spacing not in SPACINGS:
        raise InputError(f"{name}: spacing: expected 'log' or 'linear', got {shown(spacing)}")
    low, high = map(float, _values(name, [given["from"], given["to"]]))
    if spacing == "log" and low * high <= 0:
        raise InputError(f'{name}: from, to: expected values of one sign, or spacing = "linear"; got {low:g} and {high:g}')
    return [float(value) for value in SPACINGS[spacing](low, high, count)]


def combined(axes: Sequence[Axis], combine: str) -> Iterator[tuple[dict[str, Value], str]]:
    """Rows of all axes together, the last axis fastest, with the origin of each.

    Raises
    ------
    InputError
        If zipped lengths differ, or there are too many rows.
    """
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
