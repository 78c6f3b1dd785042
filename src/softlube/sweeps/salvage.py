"""What is sound in a damaged store, copied into a new one."""

from __future__ import annotations

import hashlib
import json
import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, suppress
from pathlib import Path
from typing import Any

from softlube.errors import InputError
from softlube.files.writing import check_destination
from softlube.sweeps.store import DAMAGE, Store, outcome_of

DEEPEST = 3
"""Digits of the keys up to which a damaged range is divided: 4096 ranges at most."""

_COLUMNS = "key, problem, accuracy, solver, status, reason, quantities, facts, digest, fields, finished"


def salvage(store: str | os.PathLike[str], new: str | os.PathLike[str]) -> int:
    """Copy the outcomes of a store that can be read, and whose keys are those of their content, into a new store.

    Parameters
    ----------
    store : path
        The damaged store; it is not changed.
    new : path
        The store to make; there must be no such file.

    Returns
    -------
    int
        Number of outcomes copied.

    Raises
    ------
    InputError
        If there is no store, it cannot be read at all, or the new file exists.
    """
    store, new = Path(store), check_destination("salvage", new)
    if not store.is_file():
        raise InputError(f"store: {str(store)!r} does not exist; salvage copies what is sound in a damaged one")
    if new.exists():
        raise InputError(f"salvage: {str(new)!r} exists; expected the name of a new store")
    with closing(sqlite3.connect(store)) as damaged:
        try:
            damaged.execute("PRAGMA query_only = ON")
            damaged.execute(f"SELECT {_COLUMNS} FROM outcomes LIMIT 0")
        except sqlite3.Error as error:
            raise InputError(f"store: nothing of {str(store)!r} can be read ({error}); try: sqlite3 FILE .recover") from None
        rows = [row for row in _rows(damaged) if _is_sound(row)]
    with Store(new) as made:
        made.copy(rows)
    return len(rows)


def _rows(damaged: sqlite3.Connection, prefix: str = "") -> Iterator[tuple[Any, ...]]:
    """Rows whose key begins with a prefix.  Where a page is damaged, by smaller ranges from both their ends."""
    query = f"SELECT {_COLUMNS} FROM outcomes WHERE key >= ? AND key < ? ORDER BY key "
    bounds = prefix, prefix + "g"
    try:
        yield from damaged.execute(query, bounds).fetchall()
    except DAMAGE:
        if len(prefix) < DEEPEST:
            for digit in "0123456789abcdef":
                yield from _rows(damaged, prefix + digit)
            return
        found = {}
        for order in ("ASC", "DESC"):
            with suppress(*DAMAGE):
                for row in damaged.execute(query + order, bounds):
                    found[row[0]] = row
        yield from found.values()


def _is_sound(row: tuple[Any, ...]) -> bool:
    key, problem, accuracy, solver, *told, _ = row
    try:
        outcome_of((key, *told))
        content = {"problem": json.loads(problem), "accuracy": accuracy, "solver": solver}
    except (ValueError, TypeError, sqlite3.DatabaseError):
        return False
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
    return digest == key
