"""The store of a sweep: every finished task at once on disk, under a key made of its content.

SQLite with a write-ahead log.  A transaction is there whole or not at all, whenever the process is killed, and several
processes may read and write at once.  A process that solves a task says so (a claim), so that another that works on the same
store does not solve it, too; the claims of the dead lapse.
"""

from __future__ import annotations

import errno
import hashlib
import json
import os
import socket
import sqlite3
import time
import uuid
from collections.abc import Generator, Iterable
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Literal

from softlube.errors import InputError
from softlube.sweeps.tasks import Outcome, Task

APPLICATION = 0x534C5542
"""Marks the file as ours (PRAGMA application_id): "SLUB"."""
LAYOUT = 3
LEASE = 30.0
"""Seconds after which a claim that is not renewed lapses."""
PATIENCE = 60.0
"""Seconds to wait for another process's transaction."""
DAMAGE = sqlite3.DatabaseError, UnicodeDecodeError
"""What SQLite's driver raises on a damaged file; the second where SQLite's own message quotes bytes that are no text."""

_TABLES = """
CREATE TABLE IF NOT EXISTS outcomes (
    key TEXT PRIMARY KEY,
    problem TEXT NOT NULL,
    accuracy REAL NOT NULL,
    solver TEXT NOT NULL,
    status TEXT NOT NULL CHECK (status IN ('done', 'failed')),
    reason TEXT NOT NULL,
    quantities TEXT NOT NULL,
    facts TEXT NOT NULL,
    digest TEXT NOT NULL,
    fields BLOB,
    finished TEXT NOT NULL
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS claims (
    key TEXT PRIMARY KEY,
    owner TEXT NOT NULL,
    host TEXT NOT NULL,
    process INTEGER NOT NULL,
    renewed REAL NOT NULL
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS log (key TEXT NOT NULL, status TEXT NOT NULL, finished TEXT NOT NULL);
"""
OUTCOME = "key, status, reason, quantities, facts, digest"
"""Columns that make an outcome, but for the fields; see `outcome_of`."""


class Store:
    """Outcomes on disk.

    Parameters
    ----------
    path : path
        The file; made if it does not exist.

    Raises
    ------
    InputError
        If the file is no store.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.owner = uuid.uuid4().hex
        deadline = time.monotonic() + PATIENCE
        while True:
            try:
                self._connection = sqlite3.connect(self.path, timeout=PATIENCE, isolation_level=None)
            except sqlite3.Error as error:
                raise InputError(f"store: {str(path)!r} cannot be opened ({error})") from None
            # Text that is none any more is found by its digest; to SQLite's driver it would look like a fault of the system.
            self._connection.text_factory = lambda text: text.decode("utf-8", "surrogateescape")
            try:
                self._prepare()
                return
            except sqlite3.OperationalError as error:
                self._connection.close()
                # The change to a write-ahead log does not wait for other processes by itself.
                if "locked" not in str(error) or time.monotonic() > deadline:
                    raise InputError(f"store: {str(path)!r} cannot be opened ({error})") from None
                time.sleep(0.05)
            except DAMAGE as error:
                self._connection.close()
                what = "is no store of a sweep" if "not a database" in str(error) else f"is damaged; {_remedy(self.path)}"
                raise InputError(f"store: {str(path)!r} {what} ({error})") from None
            except BaseException:
                self._connection.close()
                raise

    def _prepare(self) -> None:
        """Look whether it is a store, and sound, before anything is changed."""
        connection = self._connection
        # In one transaction, so that a store that another process makes meanwhile is seen whole or not at all.
        connection.execute("BEGIN")
        application = connection.execute("PRAGMA application_id").fetchone()[0]
        layout = connection.execute("PRAGMA user_version").fetchone()[0]
        tables = {name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        connection.execute("COMMIT")
        if tables:
            if application != APPLICATION:
                raise InputError(f"store: {str(self.path)!r} is a database of something else")
            if layout != LAYOUT:
                raise InputError(f"store: {str(self.path)!r} is of another release of softlube; expected a file of its own")
            missing = {"outcomes", "claims", "log"} - tables
            if missing:
                raise sqlite3.DatabaseError(f"there is no table {missing.pop()!r}")
            (found,) = connection.execute("PRAGMA quick_check(1)").fetchone()
            if found != "ok":
                raise sqlite3.DatabaseError(found.splitlines()[-1])
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = FULL")
        if not tables:
            # In one transaction, so that no process finds a store half made.
            connection.executescript(
                f"BEGIN IMMEDIATE; {_TABLES} PRAGMA application_id = {APPLICATION}; PRAGMA user_version = {LAYOUT}; COMMIT;"
            )

    @contextmanager
    def _said(self) -> Generator[None]:
        """What SQLite cannot do is an error of the system that names the file; what it finds damaged, one of the input."""
        try:
            yield
        except sqlite3.OperationalError as error:
            raise OSError(errno.EIO, f"{error}; what is finished is kept, run again to take it up", str(self.path)) from error
        except DAMAGE as error:
            raise InputError(f"store: {str(self.path)!r} is damaged; {_remedy(self.path)} ({error})") from error

    @contextmanager
    def _transaction(self) -> Generator[sqlite3.Connection]:
        """Changes that are made all, or not at all."""
        with self._said():
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield self._connection
                self._connection.execute("COMMIT")
            except BaseException:
                with suppress(sqlite3.Error):  # where the disk is full, SQLite has rolled back already
                    self._connection.execute("ROLLBACK")
                raise

    def close(self) -> None:
        """Give up own claims and close the file."""
        with suppress(sqlite3.Error):  # they lapse with this process
            self._connection.execute("DELETE FROM claims WHERE owner = ?", (self.owner,))
        self._connection.close()

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    # --- outcomes ---------------------------------------------------------------------------------------------------

    def outcomes(self, keys: Iterable[str], *, fields: bool = False) -> dict[str, Outcome]:
        """Outcomes of the keys that have one, with the bytes of their fields if asked for."""
        found: dict[str, Outcome] = {}
        with self._said():
            for key in keys:
                row = self._connection.execute(
                    f"SELECT {OUTCOME}, {'fields' if fields else 'NULL'} FROM outcomes WHERE key = ?", (key,)
                ).fetchone()
                if row is not None:
                    found[key] = outcome_of(row)
        return found

    def settled(self, keys: Iterable[str], *, fields: bool, retry_failed: bool) -> set[str]:
        """Keys that need no solving: solved (with fields, if those are wanted), or failed unless failures are to be retried.

        Raises
        ------
        InputError
            If what is stored of one of the keys cannot be read.
        """
        settled = set()
        with self._said():
            for key in dict.fromkeys(keys):
                row = self._connection.execute(
                    f"SELECT {OUTCOME}, NULL, fields IS NOT NULL FROM outcomes WHERE key = ?", (key,)
                ).fetchone()
                if row is None:
                    continue
                outcome_of(row[:-1])
                if _is_settled(row[1], row[-1], fields, retry_failed):
                    settled.add(key)
        return settled

    def save(self, key: str, task: Task, accuracy: float, solver: str, outcome: Outcome) -> None:
        """Keep an outcome and end the claim, in one transaction.  A failure never takes the place of a solution."""
        status = "failed" if outcome.failed else "done"
        finished = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
        told = outcome.reason, json.dumps(dict(outcome.quantities)), json.dumps(dict(outcome.facts))
        digest = _digest(key, status, *told)
        values = (key, json.dumps(task.to_plain()), accuracy, solver, status, *told, digest, outcome.fields, finished)
        with self._transaction() as connection:
            connection.execute(
                "INSERT INTO outcomes VALUES (?,?,?,?,?,?,?,?,?,?,?) ON CONFLICT (key) DO UPDATE SET status = excluded.status, "
                "reason = excluded.reason, quantities = excluded.quantities, facts = excluded.facts, digest = excluded.digest, "
                "fields = coalesce(excluded.fields, fields), finished = excluded.finished "
                "WHERE outcomes.status = 'failed' OR excluded.status = 'done'",
                values,
            )
            connection.execute("INSERT INTO log VALUES (?,?,?)", (key, status, finished))
            connection.execute("DELETE FROM claims WHERE key = ?", (key,))

    def copy(self, rows: Iterable[tuple[Any, ...]]) -> None:
        """Keep rows of another store, with all the columns of `outcomes`."""
        with self._transaction() as connection:
            for row in rows:
                connection.execute("INSERT INTO outcomes VALUES (?,?,?,?,?,?,?,?,?,?,?)", row)
                connection.execute("INSERT INTO log VALUES (?,?,?)", (row[0], row[4], row[-1]))

    def count_foreign(self, solvers: Iterable[str]) -> int:
        """How many outcomes came of none of these versions of the code."""
        with self._said():
            rows = self._connection.execute("SELECT solver, count(*) FROM outcomes GROUP BY solver").fetchall()
        return sum(count for solver, count in rows if solver not in set(solvers))

    def counts(self) -> dict[str, int]:
        """How often each key was solved, over the life of the store."""
        with self._said():
            return dict(self._connection.execute("SELECT key, count(*) FROM log GROUP BY key"))

    # --- claims -----------------------------------------------------------------------------------------------------

    def claim(self, key: str, *, fields: bool, retry_failed: bool) -> Literal["ours", "settled", "theirs"]:
        """Reserve a task: ours to solve, settled meanwhile, or being solved by another process."""
        with self._transaction() as connection:
            row = connection.execute("SELECT status, fields IS NOT NULL FROM outcomes WHERE key = ?", (key,)).fetchone()
            if row is not None and _is_settled(row[0], row[1], fields, retry_failed):
                return "settled"
            row = connection.execute("SELECT owner, host, process, renewed FROM claims WHERE key = ?", (key,)).fetchone()
            if row is not None and row[0] != self.owner and not _lapsed(*row[1:]):
                return "theirs"
            connection.execute(
                "INSERT OR REPLACE INTO claims VALUES (?,?,?,?,?)",
                (key, self.owner, socket.gethostname(), os.getpid(), time.time()),
            )
            return "ours"

    def renew(self) -> None:
        """Say that this process is alive; to be called well within `LEASE`."""
        with self._said():
            self._connection.execute("UPDATE claims SET renewed = ? WHERE owner = ?", (time.time(), self.owner))


def outcome_of(row: tuple[Any, ...]) -> Outcome:
    """An outcome from the columns `OUTCOME` and its fields, as they are stored.

    Raises
    ------
    sqlite3.DatabaseError
        If they are no such thing, or something in them was changed.
    """
    *content, digest, fields = row
    _, status, reason, quantities, facts = content
    values, known = {}, {}
    try:
        values = {name: (float(value), float(error)) for name, (value, error) in json.loads(quantities).items()}
        known = json.loads(facts)
        sound = all(isinstance(each, (int, float, str)) for each in known.values()) and digest == _digest(*content)
        sound = sound and status == ("failed" if reason else "done")
    except (ValueError, TypeError, AttributeError):
        sound = False
    if not sound:
        raise sqlite3.DatabaseError("an outcome is not readable")
    return Outcome(reason, values, known, fields)


def _digest(key: str, status: str, reason: str, quantities: str, facts: str) -> str:
    """Of what is stored of an outcome: SQLite does not notice a changed digit.  Fields are checked when they are read."""
    return hashlib.sha256(json.dumps([key, status, reason, quantities, facts]).encode()).hexdigest()


def _is_settled(status: str, has_fields: bool, fields: bool, retry_failed: bool) -> bool:
    return (status == "done" and (has_fields or not fields)) or (status == "failed" and not retry_failed)


def _remedy(path: Path) -> str:
    name = path.name
    return f"what is sound can be copied: softlube sweep PLAN --store {name} --salvage NEW, or sqlite3 {name} .recover"


def _lapsed(host: str, process: int, renewed: float) -> bool:
    if time.time() - renewed > LEASE:
        return True
    if host != socket.gethostname() or os.name != "posix":
        return False
    try:
        os.kill(process, 0)  # asks whether it lives; sends nothing
    except ProcessLookupError:
        return True
    except PermissionError:
        return False
    return False
