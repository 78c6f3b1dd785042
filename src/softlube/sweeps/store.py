"""The store of a sweep: every finished task at once on disk, under a key made of its content.

SQLite with a write-ahead log.  A transaction is there whole or not at all, whenever the process is killed, and several
processes may read and write at once.  A process that solves a task says so (a claim), so that another that works on the same
store does not solve it, too; the claims of the dead lapse.
"""

from __future__ import annotations

import json
import os
import socket
import sqlite3
import time
import uuid
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Literal

from softlube.errors import InputError
from softlube.sweeps.tasks import Outcome, Task

APPLICATION = 0x534C5542
"""Marks the file as ours (PRAGMA application_id): "SLUB"."""
LAYOUT = 2
LEASE = 30.0
"""Seconds after which a claim that is not renewed lapses."""
PATIENCE = 60.0
"""Seconds to wait for another process's transaction."""

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
                self._prepare()
                return
            except sqlite3.OperationalError as error:
                # The change to a write-ahead log does not wait for other processes by itself.
                if "locked" not in str(error) or time.monotonic() > deadline:
                    raise InputError(f"store: {str(path)!r} cannot be opened ({error})") from None
                time.sleep(0.05)
            except sqlite3.DatabaseError as error:
                raise InputError(f"store: {str(path)!r} is no store of a sweep ({error})") from None

    def _prepare(self) -> None:
        connection = self._connection
        application = connection.execute("PRAGMA application_id").fetchone()[0]
        layout = connection.execute("PRAGMA user_version").fetchone()[0]
        tables = connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
        if tables and (application, layout) == (APPLICATION, 1):
            self._take_over()
            layout = LAYOUT
        if tables and (application, layout) != (APPLICATION, LAYOUT):
            raise InputError(f"store: {str(self.path)!r} is a database of something else, or of another release of softlube")
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = FULL")
        if not tables:
            # In one transaction, so that no process finds a store half made.
            connection.executescript(
                f"BEGIN IMMEDIATE; {_TABLES} PRAGMA application_id = {APPLICATION}; PRAGMA user_version = {LAYOUT}; COMMIT;"
            )

    def _take_over(self) -> None:
        """Bring a store of the first layout, which had steady cases only and their β in columns, into the present one."""
        connection = self._connection
        connection.create_function("facts", 3, _first_facts)
        connection.execute("BEGIN IMMEDIATE")
        try:
            if connection.execute("PRAGMA user_version").fetchone()[0] == 1:  # not by another process meanwhile
                connection.execute("ALTER TABLE outcomes RENAME TO first_outcomes")
                connection.execute(_TABLES.split(";")[0])
                connection.execute(
                    "INSERT INTO outcomes SELECT key, problem, accuracy, solver, status, reason, quantities, "
                    "facts(status, beta, beta_load), fields, finished FROM first_outcomes"
                )
                connection.execute("DROP TABLE first_outcomes")
                connection.execute(f"PRAGMA user_version = {LAYOUT}")
            connection.execute("COMMIT")
        except BaseException:
            connection.execute("ROLLBACK")
            raise

    def close(self) -> None:
        """Give up own claims and close the file."""
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
        for key in keys:
            row = self._connection.execute(
                f"SELECT reason, quantities, facts, {'fields' if fields else 'NULL'} FROM outcomes WHERE key = ?",
                (key,),
            ).fetchone()
            if row is not None:
                found[key] = _outcome(row)
        return found

    def settled(self, keys: Iterable[str], *, fields: bool, retry_failed: bool) -> set[str]:
        """Keys that need no solving: solved (with fields, if those are wanted), or failed unless failures are to be retried."""
        wanted = set(keys)
        rows = self._connection.execute("SELECT key, status, fields IS NOT NULL FROM outcomes").fetchall()
        return {
            key
            for key, status, has_fields in rows
            if key in wanted
            and ((status == "done" and (has_fields or not fields)) or (status == "failed" and not retry_failed))
        }

    def save(self, key: str, task: Task, accuracy: float, solver: str, outcome: Outcome) -> None:
        """Keep an outcome and end the claim, in one transaction.  A failure never takes the place of a solution."""
        status = "failed" if outcome.failed else "done"
        finished = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
        values = (
            key,
            json.dumps(task.to_plain()),
            accuracy,
            solver,
            status,
            outcome.reason,
            json.dumps(dict(outcome.quantities)),
            json.dumps(dict(outcome.facts)),
            outcome.fields,
            finished,
        )
        connection = self._connection
        connection.execute("BEGIN IMMEDIATE")
        try:
            connection.execute(
                "INSERT INTO outcomes VALUES (?,?,?,?,?,?,?,?,?,?) ON CONFLICT (key) DO UPDATE SET status = excluded.status, "
                "reason = excluded.reason, quantities = excluded.quantities, facts = excluded.facts, "
                "fields = coalesce(excluded.fields, fields), finished = excluded.finished "
                "WHERE outcomes.status = 'failed' OR excluded.status = 'done'",
                values,
            )
            connection.execute("INSERT INTO log VALUES (?,?,?)", (key, status, finished))
            connection.execute("DELETE FROM claims WHERE key = ?", (key,))
            connection.execute("COMMIT")
        except BaseException:
            connection.execute("ROLLBACK")
            raise

    def count_foreign(self, solvers: Iterable[str]) -> int:
        """How many outcomes came of none of these versions of the code."""
        rows = self._connection.execute("SELECT solver, count(*) FROM outcomes GROUP BY solver")
        return sum(count for solver, count in rows if solver not in set(solvers))

    def counts(self) -> dict[str, int]:
        """How often each key was solved, over the life of the store."""
        return dict(self._connection.execute("SELECT key, count(*) FROM log GROUP BY key"))

    # --- claims -----------------------------------------------------------------------------------------------------

    def claim(self, key: str, *, fields: bool, retry_failed: bool) -> Literal["ours", "settled", "theirs"]:
        """Reserve a task: ours to solve, settled meanwhile, or being solved by another process."""
        connection = self._connection
        connection.execute("BEGIN IMMEDIATE")
        try:
            if key in self._settled_now(key, fields, retry_failed):
                return "settled"
            row = connection.execute("SELECT owner, host, process, renewed FROM claims WHERE key = ?", (key,)).fetchone()
            if row is not None and row[0] != self.owner and not _lapsed(*row[1:]):
                return "theirs"
            connection.execute(
                "INSERT OR REPLACE INTO claims VALUES (?,?,?,?,?)",
                (key, self.owner, socket.gethostname(), os.getpid(), time.time()),
            )
            return "ours"
        finally:
            connection.execute("COMMIT")

    def _settled_now(self, key: str, fields: bool, retry_failed: bool) -> set[str]:
        row = self._connection.execute("SELECT status, fields IS NOT NULL FROM outcomes WHERE key = ?", (key,)).fetchone()
        if row is None or (row[0] == "failed" and retry_failed) or (row[0] == "done" and fields and not row[1]):
            return set()
        return {key}

    def renew(self) -> None:
        """Say that this process is alive; to be called well within `LEASE`."""
        self._connection.execute("UPDATE claims SET renewed = ? WHERE owner = ?", (time.time(), self.owner))


def _outcome(row: tuple[str, str, str, bytes | None]) -> Outcome:
    reason, quantities, facts, fields = row
    values: Mapping[str, list[float]] = json.loads(quantities)
    return Outcome(reason, {name: (value, error) for name, (value, error) in values.items()}, json.loads(facts), fields)


def _first_facts(status: str, beta: float | None, beta_load: float | None) -> str:
    """Facts of the first layout's columns; SQLite has no nan."""
    named = {"beta": beta, "beta_load": beta_load} if status == "done" else {}
    return json.dumps({name: float("nan") if value is None else value for name, value in named.items()})


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
