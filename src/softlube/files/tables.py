"""Tables of measurements, of cases and of histories: CSV with units in the header, read to SI or refused with the line.

What spreadsheets and rigs write is read: byte order mark, semicolons or tabs, decimal commas, comments after #, empty lines and
missing cells.  What could be read in two ways is refused.
"""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError
from softlube.files.reading import Damaged, read_bytes
from softlube.files.spreadsheets import is_spreadsheet, sheet_text
from softlube.model.inputs import GREATEST, LEAST, NUMBER, Input
from softlube.model.units import THOUSANDS, read_number
from softlube.physical.inputs import declared

Array = NDArray[np.floating]

MISSING = frozenset({"", "na", "n/a", "nan", "null", "none", "-", "--", "?"})
"""Cells that say that there is no value, in lower case."""
NUMBERS = {
    "beta": Input("β of Eq. (6d)", NUMBER, "1000"),
    "beta_load": Input("β by the load, Eq. (30)", NUMBER, "1000"),
    "slide_to_roll": Input("Difference of the surface speeds over their mean", NUMBER, "2"),
    # A drift of the force sensor can take a measured friction below zero.
    "friction_coefficient": Input("Friction over load", NUMBER, "0.01", signed=True),
}
"""Columns without unit that are no input of an experiment."""
FEW = 5
"""Lines named one by one in a notice."""
LARGEST, MOST_ROWS = 32_000_000, 1_000_000
"""Bytes and rows of a table that is read: a hundred times what a rig's averages or a history's times need."""
MOST_COLUMNS, LONGEST_HEADER = 1000, 200
"""Columns of a table, and characters of one column's header."""

_MINUS = str.maketrans("−–", "--")
_UNUSUAL = re.compile(r"[^0-9eE+.\s-]")
"""What `float` might take, but no number has: an underscore, digits of other scripts, "inf"."""
_HEADER = re.compile(r"^(?P<name>[^\[\](){}/]*?)\s*(?:\[(?P<square>[^\]]*)\]|\((?P<round>.*)\)|/\s*(?P<slash>.+)|)\s*$")


@dataclass(frozen=True)
class Table:
    """Columns of a file in SI.

    Attributes
    ----------
    source : str
        Name of the file.
    columns : mapping of str to ndarray, shape (rows,)
        In SI.
    lines : ndarray of int, shape (rows,)
        Where each row stands in the file.
    notices : tuple of str
        What was left out, with the lines.
    """

    source: str
    columns: Mapping[str, Array]
    lines: NDArray[np.integer]
    notices: tuple[str, ...] = ()

    def __len__(self) -> int:
        return self.lines.size


def read_table(
    path: str | os.PathLike[str],
    required: Sequence[str],
    *,
    columns: Mapping[str, Input] | None = None,
    rename: Mapping[str, str] | None = None,
    si_without_unit: bool = False,
    drop_repeats: bool = False,
    drop_missing: bool = False,
) -> Table:
    """Read columns of a CSV file whose header gives the units, as in ``load [mN], speed [mm/s]``.

    Parameters
    ----------
    path : path
        The file: UTF-8 (or UTF-16 with its mark), columns parted by commas, semicolons or tabs; or the first sheet of an .xlsx
        or .ods file.
    required : sequence of str
        Names of the columns: inputs of `softlube.physical.inputs`, or `NUMBERS`.
    columns : mapping of str to Input, optional
        Declarations of columns that are no inputs, or that mean something else in this table.
    rename : mapping of str to str, optional
        Header in the file, without its unit, for the name of a column where it differs.
    si_without_unit : bool
        Take a column without a unit to be in SI; otherwise it is refused.
    drop_repeats : bool
        Count a row once that repeats an earlier one in every cell of the file.
    drop_missing : bool
        Leave out, with a notice, rows in which a required cell is missing; otherwise they are refused.

    Returns
    -------
    Table

    Raises
    ------
    InputError
        If the file cannot be read, a column or its unit is missing or wrong, or a cell is no number or not positive; the
        message names file, line and column.
    """
    path = Path(path)
    lines = _content(path, _text(path))
    number, first = next(lines, (0, ""))
    if number and re.fullmatch(r"sep=.", first.strip()):  # spreadsheets write which separator they use
        number, first = next(lines, (0, ""))
    if not number:
        raise InputError(f"{path.name}, line 1: the file is empty; expected a header such as 'load [mN], speed [mm/s]'")
    separator = next((mark for mark in ";\t" if mark in first), ",")
    header = [cell.strip() for cell in _cells(path, number, first, separator)]
    rows, where, repeated_headers = _rows(path, lines, separator, header)
    if not rows:
        raise InputError(f"{path.name}, line {number}: there are no rows below the header")
    known = {**NUMBERS, **declared(), **(columns or {})}
    found = _columns(path, number, header, required, known, rename or {}, si_without_unit)

    notices = [_notice("the header stands again in", repeated_headers)] if repeated_headers else []
    if drop_repeats:
        rows, where, again = _without_repeats(rows, where)
        if again:
            notices.append(_notice("repeated and counted once:", again))
    by_column = list(zip(*rows, strict=True))
    comma = _decimal_comma(path, found, by_column, where)
    lines_array = np.array(where)
    values: dict[str, Array] = {}
    for name, (index, factor) in found.items():
        values[name] = _numbers(path, header[index], name, by_column[index], where, comma, factor, known[name].signed)
    keep = np.ones(lines_array.size, dtype=bool)
    for name in required:
        gaps = np.isnan(values[name])
        if gaps.any() and not drop_missing:
            expected = known[name].expected.replace("such as", "in the unit of the header, such as")
            raise InputError(f"{path.name}, line {lines_array[gaps][0]}: {name} is missing; expected {expected}")
        if gaps.any():
            notices.append(_notice(f"without {name}, left out:", lines_array[gaps].tolist()))
            keep &= ~gaps
    if not keep.any():
        raise InputError(f"{path.name}, line {lines_array[0]}: no row has all of {', '.join(required)}")
    return Table(path.name, {name: column[keep] for name, column in values.items()}, lines_array[keep], tuple(notices))


def header_names(path: str | os.PathLike[str]) -> list[str]:
    """Names of a file's columns, without units, as `read_table` understands them."""
    path = Path(path)
    for number, first in _content(path, _text(path)):
        if not re.fullmatch(r"sep=.", first.strip()):
            separator = next((mark for mark in ";\t" if mark in first), ",")
            return [_name_and_unit(cell)[0] for cell in _cells(path, number, first, separator)]
    return []


def one_of(path: str | os.PathLike[str], first: str, second: str) -> str:
    """Which of two columns that exclude each other a file has; the first where it has none.

    Raises
    ------
    InputError
        If it has both.
    """
    names = header_names(path)
    if first in names and second in names:
        raise InputError(f"{Path(path).name}, line 1: {first} and {second} are both there; keep one of them")
    return second if second in names else first


@contextmanager
def given_as(name: str) -> Iterator[None]:
    """Begin the message of every refusal with the name of the input that the file was given as."""
    try:
        yield
    except InputError as error:
        raise InputError(f"{name}: {error}") from None


def _text(path: Path) -> str:
    try:
        raw = read_bytes(path, LARGEST)
    except Damaged as error:
        raise InputError(f"{path}: the file {error}") from None
    if is_spreadsheet(path):
        return sheet_text(path, raw)
    encoding = "utf-16" if raw[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    try:
        text = raw.decode(encoding)
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise InputError(f"{path.name}, line {line}: not UTF-8 text; save the table as CSV in UTF-8") from None
    if "\0" in text:
        raise InputError(f"{path.name}, line {text[: text.index(chr(0))].count(chr(10)) + 1}: not a text file; save it as CSV")
    return text


def _content(path: Path, text: str) -> Iterator[tuple[int, str]]:
    """Lines with something on them, comments cut off, numbered from 1."""
    for number, line in enumerate(text.splitlines(), 1):
        if "#" in line:
            line = line[: line.index("#")]
        if line.strip(" \t,;"):
            yield number, line


def _cells(path: Path, number: int, line: str, separator: str) -> list[str]:
    if line.count(separator) > MOST_COLUMNS:
        raise InputError(f"{path.name}, line {number}: more than {MOST_COLUMNS} columns")
    if '"' not in line:
        return [cell.lstrip() for cell in line.split(separator)]
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True))
    except csv.Error as error:
        raise InputError(f"{path.name}, line {number}: no row of a table ({error})") from None


def _rows(
    path: Path, lines: Iterator[tuple[int, str]], separator: str, header: list[str]
) -> tuple[list[list[str]], list[int], list[int]]:
    rows: list[list[str]] = []
    where: list[int] = []
    again: list[int] = []
    width = len(header)
    for number, line in lines:
        cells = _cells(path, number, line, separator)
        if len(cells) != width:
            while len(cells) > width and not cells[-1].strip():  # separators at the end of a line
                cells.pop()
            if len(cells) != width:
                advice = "; a decimal comma needs semicolons or tabs between the columns" if separator == "," else ""
                advice = advice if len(cells) > width else ""
                raise InputError(f"{path.name}, line {number}: {len(cells)} cells under {width} columns{advice}")
        if cells[0].strip() == header[0] and [cell.strip() for cell in cells] == header:
            again.append(number)
            continue
        if len(rows) == MOST_ROWS:
            raise InputError(f"{path.name}, line {number}: more than {MOST_ROWS} rows; thin the table out")
        rows.append(cells)
        where.append(number)
    return rows, where, again


def _name_and_unit(cell: str) -> tuple[str, str | None]:
    match = _HEADER.match(cell.strip()) if len(cell) <= LONGEST_HEADER else None
    if match is None:
        return cell.strip(), None
    unit = next((match[group] for group in ("square", "round", "slash") if match[group] is not None), None)
    name = re.sub(r"[\s\-]+", "_", match["name"].strip().lower())
    return _synonyms().get(name, name), unit if unit is None else re.sub(r"^\((.*)\)$", r"\1", unit.strip())


def _columns(
    path: Path,
    line: int,
    header: list[str],
    required: Sequence[str],
    declared: Mapping[str, Input],
    rename: Mapping[str, str],
    si_without_unit: bool,
) -> dict[str, tuple[int, float]]:
    """Index and factor to SI of every required column."""
    wanted = {_name_and_unit(theirs)[0]: ours for theirs, ours in rename.items()}
    found: dict[str, tuple[int, float]] = {}
    for index, cell in enumerate(header):
        name, unit = _name_and_unit(cell)
        name = wanted.get(name, name)
        if name not in required:
            continue
        if name in found:
            raise InputError(f"{path.name}, line {line}: two columns are called {name}; keep one of them")
        known = declared[name]
        if not known.unit:
            if unit not in (None, "", "1", "-"):
                raise InputError(f"{path.name}, line {line}: {name} has no unit, got {unit!r}")
            unit = ""
        elif not unit and not si_without_unit:
            example = known.example.split()[-1]
            raise InputError(
                f"{path.name}, line {line}: {name} has no unit; expected one in the header, as in '{name} [{example}]'"
            )
        try:
            found[name] = index, known.factor(unit) if unit else 1.0
        except InputError as error:
            message = f"{name} cannot be in {unit!r}; expected a unit of {known.expected} ({error})"
            raise InputError(f"{path.name}, line {line}: {message}") from None
    missing = [name for name in required if name not in found]
    if missing:
        has = ", ".join(repr(cell) for cell in header)
        raise InputError(f"{path.name}, line {line}: no column {', '.join(missing)}; the header has {has}")
    return found


def _without_repeats(rows: list[list[str]], where: list[int]) -> tuple[list[list[str]], list[int], list[int]]:
    seen: set[tuple[str, ...]] = set()
    kept: list[list[str]] = []
    lines: list[int] = []
    again: list[int] = []
    for row, line in zip(rows, where, strict=True):
        key = tuple(cell.strip() for cell in row)
        if key in seen:
            again.append(line)
            continue
        seen.add(key)
        kept.append(row)
        lines.append(line)
    return kept, lines, again


def _decimal_comma(
    path: Path, found: Mapping[str, tuple[int, float]], by_column: Sequence[Sequence[str]], where: Sequence[int]
) -> bool:
    """Whether commas are decimal signs; refused if the file has points, too, or the commas may all part thousands."""
    first: dict[str, tuple[int, str]] = {}
    for index, _ in found.values():
        for mark in ".,":
            row = next((i for i, cell in enumerate(by_column[index]) if mark in cell), None)
            if row is not None and (mark not in first or where[row] < first[mark][0]):
                first[mark] = where[row], by_column[index][row].strip()
    if len(first) == 2:
        line, cell = max(first.values())
        other_line, other = min(first.values())
        raise InputError(
            f"{path.name}, line {line}: {cell!r} here and {other!r} in line {other_line}: is the decimal sign a comma or a "
            "point? Use one of them, and no signs between thousands"
        )
    if "," not in first:
        return False
    commas = (cell.strip() for index, _ in found.values() for cell in by_column[index] if "," in cell)
    if all(map(THOUSANDS.fullmatch, commas)):
        line, cell = first[","]
        raise InputError(
            f"{path.name}, line {line}: {cell!r}: the comma may part decimals or thousands; write "
            f"{cell.replace(',', '.')!r} or {cell.replace(',', '')!r}"
        )
    return True


def _numbers(
    path: Path,
    title: str,
    name: str,
    cells: Sequence[str],
    where: Sequence[int],
    comma: bool,
    factor: float,
    signed: bool,
) -> Array:
    """Cells of a column, in SI."""
    pointed = [cell.replace(",", ".") for cell in cells] if comma else cells
    try:
        if _UNUSUAL.search("".join(pointed)):
            raise ValueError
        values = np.array(list(map(float, pointed)))
    except ValueError:
        values = np.array([_number(path, title, name, cell, where[i], comma) for i, cell in enumerate(cells)])
    size = np.abs(values)
    impossible = (size > GREATEST / factor) | ((size < LEAST / factor) & (size != 0))
    if not signed:
        impossible |= values <= 0
    if impossible.any():
        row = int(np.argmax(impossible))
        kind = "a finite number" if signed else "a positive, finite number"
        raise InputError(f"{path.name}, line {where[row]}: {name}: expected {kind} under {title!r}, got {cells[row].strip()!r}")
    return values * factor


def _number(path: Path, title: str, name: str, cell: str, line: int, comma: bool) -> float:
    text = cell.strip()
    if text.translate(_MINUS).lower() in MISSING:
        return np.nan
    try:
        return read_number(text.replace(",", ".") if comma and text.count(",") == 1 else text)
    except InputError as error:
        raise InputError(
            f"{path.name}, line {line}: {name}: {text!r} under {title!r} is no number (units belong in the header): {error}"
        ) from None


def _synonyms() -> dict[str, str]:
    """Other headers for an input."""
    return {other: name for name, each in declared().items() for other in each.synonyms}


def _notice(text: str, lines: Sequence[int]) -> str:
    named = ", ".join(str(line) for line in lines[:FEW])
    more = f" and {len(lines) - FEW} more" if len(lines) > FEW else ""
    return f"{text} line{'s' if len(lines) > 1 else ''} {named}{more}"
