"""Where tasks are solved: processes of this machine, or the workers of a Dask cluster.

Both offer lanes, each of which solves one task at a time in one process and keeps there what neighbours share, such as the
elastic operators of the grids it has met.  `softlube.sweeps.run` gives every lane neighbours.
"""

from __future__ import annotations

import asyncio
import errno
import logging
import time
import uuid
from collections.abc import Hashable, Iterable, Mapping
from concurrent.futures import CancelledError, Future, InvalidStateError, ThreadPoolExecutor
from contextlib import suppress
from typing import Any, Protocol, cast

from softlube.errors import InputError
from softlube.solvers.processes import MOST_DEATHS, Processes, WorkerDied
from softlube.sweeps.tasks import Outcome, Task
from softlube.sweeps.work import solve_one, solver_version

JOIN_TIMEOUT = 12.0
"""Seconds to wait for a scheduler, for its first worker, and for any answer."""
DESERTED = 20.0
"""Seconds to wait for another worker when all have gone."""
CLOSING = 2.0
"""Seconds to take leave of a cluster, which may have gone."""


class Executor(Protocol):
    """Something with lanes.

    Attributes
    ----------
    most_deaths : int
        Times that a task may take its worker with it before it counts as failed.
    """

    most_deaths: int

    def lanes(self) -> list[Hashable]:
        """Those there are now; workers may come and go.

        Raises
        ------
        ConnectionError
            If the whole cluster has gone.
        """
        ...

    def submit(self, lane: Hashable, task: Task, accuracy: float, fields: bool) -> Future[Outcome]:
        """Start to solve; the future raises `WorkerDied` if the process went away."""
        ...

    def close(self) -> None:
        """Let go of the workers and of what they are doing."""
        ...


class Local:
    """Processes of this machine; see `softlube.solvers.processes.Processes`."""

    most_deaths = MOST_DEATHS

    def __init__(self, workers: int | None = None) -> None:
        if workers is not None and (isinstance(workers, bool) or workers < 1):
            raise InputError(f"workers: expected a positive whole number, got {workers!r}")
        self._processes = Processes(workers)

    def lanes(self) -> list[Hashable]:
        """As many as there are processes."""
        return self._processes.lanes

    def submit(self, lane: Hashable, task: Task, accuracy: float, fields: bool) -> Future[Outcome]:
        """Solve in the lane's process."""
        return self._processes.submit(lane, solve_one, task, accuracy, fields)

    def close(self) -> None:
        """End the processes."""
        self._processes.close()


class Dask:
    """Workers of a Dask cluster.

    A task belongs to one worker.  That a worker has gone is asked of the scheduler, not waited for: its tasks then raise
    `WorkerDied`, and `softlube.sweeps.run` gives them to others.  No call waits for longer than `JOIN_TIMEOUT`.

    Parameters
    ----------
    address : str
        Of the scheduler.
    kinds : iterable of str
        Kinds of the tasks to come, see `softlube.sweeps.work.ROOMS`; the workers must solve them with the same code.
    """

    most_deaths = 4
    """On a cluster, machines go for reasons of their own."""

    def __init__(self, address: str, kinds: Iterable[str]) -> None:
        try:
            from distributed import Client
        except ImportError:
            raise InputError("scheduler: needs the extra dask: pip install 'softlube[dask]'") from None
        self._levels = _silenced()
        refused = _unreachable(address)
        if refused:
            _heard_again(self._levels)
            raise InputError(f"scheduler: cannot reach {address!r} ({refused}); expected an address such as tcp://host:8786")
        try:
            self._client: Any = Client(address, timeout=JOIN_TIMEOUT, set_as_default=False)
        except Exception as error:
            _heard_again(self._levels)
            raise InputError(f"scheduler: cannot reach {address!r} ({type(error).__name__})") from None
        self._running: dict[Future[Outcome], tuple[Hashable, Any]] = {}
        self._peopled = time.monotonic()
        self._name, self._count = uuid.uuid4().hex, 0
        ours = {solver_version(kind) for kind in kinds}
        try:
            self._client.wait_for_workers(1, timeout=JOIN_TIMEOUT)
            others = self._versions(kinds) - ours
            if others:
                refused = f"a worker has softlube {others.pop()}, and this is {ours.pop()}: install the same"
        except TimeoutError:
            refused = f"{address!r} has no worker that answers"
        except Exception as error:
            refused = f"the workers at {address!r} cannot run softlube ({error})"
        if refused:
            self.close()
            raise InputError(f"scheduler: {refused}")

    def _versions(self, kinds: Iterable[str]) -> set[str]:
        """Versions of the code on the workers."""
        asked = (self._client.sync(self._client._run, solver_version, kind, callback_timeout=JOIN_TIMEOUT) for kind in kinds)
        return {version for answers in asked for version in answers.values()}

    def lanes(self) -> list[Hashable]:
        """One for each thread of each worker.  Tasks of those that have gone raise `WorkerDied`."""
        try:
            if self._client.status != "running":
                raise OSError
            workers = self._client.sync(self._client.scheduler.identity, callback_timeout=JOIN_TIMEOUT)["workers"]
        except (OSError, AttributeError, RuntimeError):  # AttributeError, RuntimeError: its client has just given up
            raise _lost("the connection to the cluster was lost") from None
        lanes: list[Hashable] = [
            (address, thread) for address, worker in workers.items() for thread in range(worker["nthreads"])
        ]
        if lanes:
            self._peopled = time.monotonic()
        elif time.monotonic() - self._peopled > DESERTED:
            raise _lost(f"the cluster has had no worker for {DESERTED:.0f} s")
        for result, (lane, remote) in list(self._running.items()):
            if lane not in lanes and not result.done():
                _settle(result, error=WorkerDied("its worker has gone"))
                remote.cancel()
            if result.done():
                del self._running[result]
        return lanes

    def submit(self, lane: Hashable, task: Task, accuracy: float, fields: bool) -> Future[Outcome]:
        """Solve on the lane's worker."""
        assert isinstance(lane, tuple)
        self._count += 1
        key = f"softlube-{self._name}-{self._count}"
        remote = self._client.submit(solve_one, task, accuracy, fields, workers=[lane[0]], pure=False, key=key)
        result: Future[Outcome] = Future()

        async def outcome() -> Outcome:
            return await remote

        def hand_on(done: Future[Outcome]) -> None:
            error = CancelledError() if done.cancelled() else done.exception()
            if type(error).__name__ == "KilledWorker":
                error = WorkerDied("it took several workers down")
            elif isinstance(error, (CancelledError, OSError)):
                error = _lost("the connection to the cluster was lost")
            _settle(result, None if error else done.result(), error)

        # Not by a callback of the remote future: Dask has one thread for all of them, and a lost result blocks it.
        asyncio.run_coroutine_threadsafe(outcome(), self._client.loop.asyncio_loop).add_done_callback(hand_on)
        self._running[result] = lane, remote  # the cluster forgets a task that nobody holds
        return result

    def close(self) -> None:
        """Leave the cluster as it was."""
        with suppress(OSError, RuntimeError, AssertionError):  # it has gone, or does not answer: there is nothing to leave
            self._client.close(timeout=CLOSING)
        _heard_again(self._levels)


def _unreachable(address: str) -> str:
    """Why there is no scheduler at an address; empty if there is one.

    Asked before a client is made: one that was made half cannot be ended.
    """
    from distributed.core import rpc

    async def ask() -> None:
        scheduler = rpc(address)
        try:
            await asyncio.wait_for(scheduler.identity(), JOIN_TIMEOUT)
        finally:
            await scheduler.close_rpc()

    try:
        with ThreadPoolExecutor(1) as thread:  # this thread may have a loop of its own, as notebooks do
            thread.submit(asyncio.run, ask()).result()
    except TimeoutError:
        return f"no answer within {JOIN_TIMEOUT:.0f} s"
    except (OSError, ValueError) as error:
        return str(error).splitlines()[0] if str(error) else type(error).__name__
    except Exception:  # it may have said anything
        return "what answers is no scheduler of Dask"
    return ""


def _settle(result: Future[Outcome], outcome: Outcome | None = None, error: BaseException | None = None) -> None:
    """End a future, if it has not ended; two threads may try."""
    with suppress(InvalidStateError):
        if error is not None:
            result.set_exception(error)
        else:
            result.set_result(cast(Outcome, outcome))


def _lost(what: str) -> ConnectionResetError:
    return ConnectionResetError(errno.ECONNRESET, f"{what}; what is finished is kept, run again to take it up", "scheduler")


def _silenced() -> dict[str, int]:
    """Have Dask log nothing; returns the levels of its loggers.  It logs every loss, and what matters is an exception here."""
    known = [name for name in logging.root.manager.loggerDict if name.startswith(("distributed", "tornado"))]
    levels = {name: logging.getLogger(name).level for name in (*known, "asyncio")}
    for name in levels:
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    return levels


def _heard_again(levels: Mapping[str, int]) -> None:
    for name, level in levels.items():
        logging.getLogger(name).setLevel(level)
