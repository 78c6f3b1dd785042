"""Results of a sweep as a tidy table (CSV, Parquet) and as NetCDF files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from softlube.errors import InputError, printable, warn
from softlube.files.writing import check_destination, netcdf, write_whole
from softlube.model.summary import Summarised, Summary, spread
from softlube.physical.inputs import declared
from softlube.sweeps.plan import Plan
from softlube.sweeps.tasks import Outcome

if TYPE_CHECKING:
    import pandas
    import xarray

FORMATS = (".csv", ".parquet", ".nc")
SHOWN = ("film_center", "film_min", "friction_coefficient")
"""Quantities that a summary shows."""
MOST_VARIED = 4
"""Inputs that vary, which a summary shows."""


@dataclass(frozen=True, repr=False)
class Sweep(Summarised):
    """A finished sweep.

    Attributes
    ----------
    plan : Plan
    keys : tuple of str
        Of every case, in the plan's order.
    outcomes : mapping of str to Outcome
        By key.
    n_found : int
        Number of outcomes that were in the store at the start.
    n_foreign : int
        Number of outcomes in the store that came of other code, an older version for instance: kept, and not used.
    """

    plan: Plan
    keys: tuple[str, ...]
    outcomes: Mapping[str, Outcome]
    n_found: int
    n_foreign: int = 0

    @property
    def n_failed(self) -> int:
        """Cases without a solution."""
        return sum(self.outcomes[key].failed for key in self.keys)

    @property
    def table(self) -> pandas.DataFrame:
        """One row a case: inputs, status, quantities and their errors, units in the headers."""
        return self._table.copy()

    @property
    def dataset(self) -> xarray.Dataset:
        """`table` as an xarray Dataset over the dimension "case": inputs as coordinates, errors beside their quantities."""
        from softlube.files.cf import table_dataset

        return table_dataset(self._table, self.plan.inputs())

    @cached_property
    def _table(self) -> pandas.DataFrame:
        return to_table(self)

    @property
    def n_warned(self) -> int:
        """Cases with warnings."""
        return int((self._table["warnings"].fillna("") != "").sum()) if "warnings" in self._table else 0

    @property
    def headline(self) -> str:
        """How many cases there are, and how many of them failed."""
        return f"Sweep: {len(self.keys)} cases, {self.n_failed} failed"

    def summary(self) -> Summary:
        """Inputs that vary and the films of some of the cases, equally far apart, with the first and the last."""
        table = self._table
        columns = {str(column).partition(" [")[0]: str(column) for column in table.columns}
        varied = [name for name, values in self.plan.inputs().items() if isinstance(values, list)]
        names = ["case", *varied[:MOST_VARIED], "status", *(name for name in SHOWN if name in columns)]
        shown = spread(len(table))
        rows = [tuple(map(_cell, line)) for line in table[[columns[name] for name in names]].iloc[shown].to_numpy().tolist()]
        notes = [f"{len(shown)} of {len(table)} cases"] if len(shown) < len(table) else []
        notes += [_warned(self.n_warned, len(table))] if self.n_warned else []
        return Summary(self.headline, tuple(columns[name] for name in names), tuple(rows), tuple(notes))

    def to_dataframe(self) -> pandas.DataFrame:
        """`table`."""
        return self.table

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the table as CSV or Parquet, or `dataset` as NetCDF, by the file's ending, whole or not at all."""
        save_table(self._table, check_table("output", path), self.plan.inputs())

    def save_fields(self, folder: str | os.PathLike[str]) -> list[Path]:
        """Write the solution of every solved case as NetCDF (case-00001.nc for the table's case 1); needs ``fields=True``."""
        return write_fields(self, folder)


def check_table(name: str, path: str | os.PathLike[str]) -> Path:
    """A path that a table can be written to.

    Raises
    ------
    InputError
        If the ending is none of `FORMATS`, the folder does not exist, or Parquet is not installed.
    """
    checked = check_destination(name, path)
    if checked.suffix.lower() not in FORMATS:
        raise InputError(f"{name}: expected a file ending in {', '.join(FORMATS[:-1])} or {FORMATS[-1]}, got {str(path)!r}")
    if checked.suffix.lower() == ".parquet":
        from importlib.util import find_spec

        if find_spec("pyarrow") is None:
            raise InputError(f"{name}: Parquet needs the extra parquet: pip install 'softlube[parquet]'; or give a .csv file")
    return checked


def check_folder(name: str, path: str | os.PathLike[str]) -> Path:
    """A folder that files can be written to: one that exists, or a name for it in one that exists.

    Raises
    ------
    InputError
        If there is a file of that name, the folder above does not exist, or nothing can be written.
    """
    path = Path(path)
    if path.exists() and not path.is_dir():
        raise InputError(f"{name}: {os.fspath(path)!r} is a file; expected the name of a folder")
    check_destination(name, path / "case-00001.nc" if path.is_dir() else path)
    return path


def warn_of(result: Sweep) -> None:
    """Say in one warning how many cases have warnings."""
    if result.n_warned:
        warn([_warned(result.n_warned, len(result.keys))])


def _warned(count: int, total: int) -> str:
    return f"{count} of {total} cases {'has' if count == 1 else 'have'} warnings: see the column warnings of the table"


def _cell(value: object) -> str:
    if isinstance(value, float):
        return "none" if value != value else f"{value:.5g}"
    return printable(value)


def to_table(result: Sweep) -> pandas.DataFrame:
    """One row a case, in the plan's order.

    Columns are the inputs, status ("done", "failed") and reason, warnings (with "; " in between), and what such cases have:
    steady ones β of Eqs. (6d) and (30), squeeze films when and why they ended, both every quantity with its error.  Physical
    cases have their quantities in SI, with the unit in the header ("film_min [m]"), so that the file can be read again as a
    table of cases; dimensionless ones in the paper's normalisation.  The order and the numbers depend on the plan alone, not on
    who solved what and when.
    """
    import pandas as pd

    units = {name: each.unit for name, each in declared().items()}
    rows = []
    for number, (case, key) in enumerate(zip(result.plan.cases, result.keys, strict=True), 1):
        outcome = result.outcomes[key]
        row: dict[str, Any] = {"case": number}
        for name, value in case.inputs.items():
            row[f"{name} [{units[name]}]" if units.get(name) else name] = value
        row |= {"status": "failed" if outcome.failed else "done", "reason": outcome.reason}
        for name, value in case.numbers(outcome).items():
            row.setdefault(name, value)
        rows.append(row)
    return pd.DataFrame(rows)


def save_table(table: pandas.DataFrame, path: str | os.PathLike[str], inputs: Iterable[str] = ()) -> None:
    """Write a table as CSV, Parquet or NetCDF, whole or not at all; `check_table` has said that the path will do.

    Parameters
    ----------
    table : DataFrame
        A row for each case, units in the headers.
    path : path
        The file.
    inputs : iterable of str
        Names of the columns that are coordinates in NetCDF.

    Raises
    ------
    InputError, OSError
        See `softlube.files.writing.write_whole`.
    """
    write_whole({path: _content(table, Path(path).suffix.lower(), inputs)})


def _content(table: pandas.DataFrame, ending: str, inputs: Iterable[str]) -> bytes:
    if ending == ".csv":
        return table.to_csv(index=False, lineterminator="\n").encode()
    if ending == ".parquet":
        return table.to_parquet(index=False)
    from softlube.files.cf import table_dataset

    return netcdf(table_dataset(table, inputs))


def write_fields(result: Sweep, folder: str | os.PathLike[str]) -> list[Path]:
    """Write every solved case as a NetCDF file, with its fields in SI if it is physical.

    Raises
    ------
    InputError
        If the folder cannot be made, or the fields were not kept.
    """
    folder = check_folder("fields", folder)
    folder.mkdir(exist_ok=True)
    written = []
    for number, (case, key) in enumerate(zip(result.plan.cases, result.keys, strict=True), 1):
        outcome = result.outcomes[key]
        if outcome.failed:
            continue
        if outcome.fields is None:
            raise InputError("fields: were not kept by this sweep; run it with fields=True")
        path = folder / f"case-{number:05d}.nc"
        case.write(outcome.fields, path)
        written.append(path)
    return written
