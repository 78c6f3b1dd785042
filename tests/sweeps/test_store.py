"""The store: whole or not at all, claims, and files that are no store."""

import sqlite3
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

import softlube
from softlube.model.problem import Problem
from softlube.sweeps import store as store_module
from softlube.sweeps.steady import SteadyTask
from softlube.sweeps.store import Store
from softlube.sweeps.tasks import Outcome
from softlube.sweeps.work import content_key, solver_version

DONE = Outcome(
    quantities={"film_min": (0.1, 1e-4), "boundary_layer": (float("nan"), float("nan"))},
    facts={"beta": 10.0, "beta_load": 12.0, "ended_by": "duration"},
)
FAILED = Outcome("too light")
ASKED = {"fields": False, "retry_failed": False}


def save(store, key, outcome):
    store.save(key, SteadyTask(Problem(beta=10)), 1e-3, "1", outcome)


def test_what_is_saved_is_found_by_another_process_s_eyes(tmp_path):
    with Store(tmp_path / "s") as first, Store(tmp_path / "s") as second:
        save(first, "a", DONE)
        save(first, "b", FAILED)
        found = second.outcomes(["a", "b", "c"])
    assert set(found) == {"a", "b"}
    assert (found["a"].facts, found["a"].quantities["film_min"]) == (DONE.facts, (0.1, 1e-4))
    assert found["b"].failed
    assert found["b"].reason == "too light"


def test_what_counts_as_settled(tmp_path):
    with Store(tmp_path / "s") as store:
        save(store, "a", DONE)
        save(store, "b", FAILED)
        keys = ["a", "b", "c"]
        assert store.settled(keys, fields=False, retry_failed=False) == {"a", "b"}
        assert store.settled(keys, fields=False, retry_failed=True) == {"a"}
        assert store.settled(keys, fields=True, retry_failed=False) == {"b"}


def test_a_failure_never_takes_the_place_of_a_solution(tmp_path):
    with Store(tmp_path / "s") as store:
        save(store, "a", FAILED)
        save(store, "a", DONE)
        save(store, "a", FAILED)
        assert not store.outcomes(["a"])["a"].failed
        assert store.counts() == {"a": 3}


def test_one_process_claims_and_the_other_waits(tmp_path):
    with Store(tmp_path / "s") as first, Store(tmp_path / "s") as second:
        assert first.claim("a", **ASKED) == "ours"
        assert first.claim("a", **ASKED) == "ours"
        assert second.claim("a", **ASKED) == "theirs"
        save(first, "a", DONE)
        assert second.claim("a", **ASKED) == "settled"
        assert second.claim("a", fields=True, retry_failed=False) == "ours"


def test_claims_end_with_the_process_or_when_they_are_not_renewed(tmp_path, monkeypatch):
    with Store(tmp_path / "s") as second:
        first = Store(tmp_path / "s")
        first.claim("a", **ASKED)
        first.claim("b", **ASKED)
        now = time.time()
        monkeypatch.setattr(store_module.time, "time", lambda: now + store_module.LEASE - 1)
        assert second.claim("a", **ASKED) == "theirs"
        first.renew()
        monkeypatch.setattr(store_module.time, "time", lambda: now + store_module.LEASE + 1)
        assert second.claim("a", **ASKED) == "theirs"
        monkeypatch.setattr(store_module.time, "time", lambda: now + 3 * store_module.LEASE)
        assert second.claim("a", **ASKED) == "ours"
        monkeypatch.undo()
        first.close()
        assert second.claim("b", **ASKED) == "ours"


def test_the_dead_claim_nothing(tmp_path):
    import subprocess
    import sys

    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    with Store(tmp_path / "s") as store:
        store.claim("a", **ASKED)
        store._connection.execute("UPDATE claims SET owner = 'another', process = ?", (dead.pid,))
        assert store.claim("a", **ASKED) == "ours"


def test_outcomes_of_other_code_are_counted(tmp_path):
    with Store(tmp_path / "s") as store:
        for key, solver in (("a", "old"), ("b", "old"), ("c", "new")):
            store.save(key, SteadyTask(Problem(beta=10)), 1e-3, solver, DONE)
        assert store.count_foreign({"new"}) == 2
        assert store.count_foreign({"new", "old"}) == 0


@pytest.mark.parametrize("content", [b"not a database, whatever it is called, but long enough to be read as one" * 3, None])
def test_no_store(tmp_path, content):
    path = tmp_path / "s"
    if content is None:
        with sqlite3.connect(path) as other:
            other.execute("CREATE TABLE birds (name TEXT)")
        other.close()
    else:
        path.write_bytes(content)
    before = path.read_bytes()
    with pytest.raises(softlube.InputError, match="store: "):
        Store(path)
    assert path.read_bytes() == before


def fill(path, count=400):
    """A store of outcomes on many pages."""
    with Store(path) as store:
        store._connection.execute("PRAGMA synchronous = OFF")
        for number in range(count):
            task = SteadyTask(Problem(beta=10.0 + number))
            store.save(content_key(task, 1e-3), task, 1e-3, solver_version("steady"), DONE)


@pytest.mark.parametrize("damage", ["page", "schema", "table", "release"])
def test_a_damaged_store_is_refused_and_not_changed(tmp_path, damage):
    path = tmp_path / "s"
    fill(path)
    if damage == "page":
        content = bytearray(path.read_bytes())
        content[4096 * 9 : 4096 * 10] = b"\xa5" * 4096
        path.write_bytes(content)
    elif damage == "schema":  # SQLite's message quotes it, and is no text either
        path.write_bytes(path.read_bytes().replace(b"CREATE TABLE log", b"CREATE \x95ABLE log"))
    else:
        with sqlite3.connect(path) as connection:
            connection.execute("DROP TABLE log" if damage == "table" else "PRAGMA user_version = 99")
        connection.close()
    before = path.read_bytes()
    with pytest.raises(softlube.InputError, match="another release" if damage == "release" else "is damaged; .*--salvage"):
        Store(path)
    assert path.read_bytes() == before


@pytest.mark.parametrize("column", ["quantities", "facts", "reason", "status"])
@pytest.mark.parametrize(
    "content", ["{", '{"film_min": 3}', "[1]", '{"film_min": [[], 1]}', '{"film_min": [0.2, 1e-4]}', b"{\xff}"]
)
def test_an_outcome_that_was_changed_is_told_before_anything_is_solved(tmp_path, column, content):
    with Store(tmp_path / "s") as store:
        save(store, "a", DONE)
        store._connection.execute("PRAGMA ignore_check_constraints = ON")
        store._connection.execute(f"UPDATE outcomes SET {column} = CAST(? AS TEXT)", (content,))  # bytes, too
        with pytest.raises(softlube.InputError, match=r"is damaged; .*an outcome is not readable"):
            store.settled("a", **ASKED)


def test_a_full_disk_is_told_and_the_store_goes_on(tmp_path):
    """SQLite has rolled back by itself then; a second time would hide the reason."""
    path = tmp_path / "s"
    fill(path, 3)
    with Store(path) as store:
        (pages,) = store._connection.execute("PRAGMA page_count").fetchone()
        store._connection.execute(f"PRAGMA max_page_count = {pages}")
        large = Outcome(quantities=DONE.quantities, facts=DONE.facts, fields=bytes(100_000))
        with pytest.raises(OSError, match=r"database or disk is full; what is finished is kept") as caught:
            save(store, "a", large)
        assert caught.value.filename == str(path)
        store._connection.execute("PRAGMA max_page_count = 100000")
        save(store, "a", large)
        assert store.outcomes("a", fields=True)["a"].fields == large.fields


def test_processes_that_make_the_store_at_once_all_find_it(tmp_path):
    together = threading.Barrier(6)

    def opened(path):
        together.wait()
        Store(path).close()

    with ThreadPoolExecutor(6) as pool:
        for name in range(20):
            list(pool.map(opened, [tmp_path / str(name)] * 6))
