"""What tables of measurements have in common: columns of numbers, checked and described."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError
from softlube.model.prefixes import shown
from softlube.model.summary import Summary

Array: TypeAlias = NDArray[np.floating]


def checked_columns(given: Mapping[str, object], signed: Collection[str] = ()) -> list[Array]:
    """Columns in SI as arrays of one length.

    Parameters
    ----------
    given : mapping of str to array_like
        Columns by their names.
    signed : collection of str
        Names of the columns that may have zero and negative numbers.

    Raises
    ------
    InputError
        If a column is no row of finite numbers, one that is not signed has a number that is not positive, or they differ in
        length.
    """
    arrays: list[Array] = []
    for name, column in given.items():
        try:
            values = np.atleast_1d(np.asarray(column, dtype=float))
        except (TypeError, ValueError):
            raise InputError(f"{name}: expected numbers in SI units, got {column!r}") from None
        if values.ndim != 1 or not np.all(np.isfinite(values)) or (name not in signed and np.any(values <= 0)):
            raise InputError(f"{name}: expected a row of finite numbers" + ("" if name in signed else " above zero"))
        arrays.append(values)
    if len({values.size for values in arrays}) > 1:
        raise InputError(f"{', '.join(given)}: differ in length, {', '.join(str(values.size) for values in arrays)}")
    return arrays


def summary_of(headline: str, columns: Sequence[tuple[str, Array, str]], notices: Sequence[str]) -> Summary:
    """Least, median and greatest value of every column.

    Parameters
    ----------
    headline : str
        What the table is.
    columns : sequence of (str, ndarray, str)
        Name, values and unit in SI of each; one without values is left out.
    notices : sequence of str
        What was left out of the file.
    """
    rows = [
        (name, *(shown(float(f"{value:.4g}"), unit) for value in (values.min(), np.median(values), values.max())))
        for name, values, unit in columns
        if values.size
    ]
    return Summary(headline, ("column", "least", "median", "greatest"), tuple(rows), tuple(notices))
