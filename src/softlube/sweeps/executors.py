"""Where tasks are solved: processes of this machine, or the workers of a Dask cluster.

Both offer lanes, each of which solves one task at a time in one process and keeps there what neighbours share, such as the
elastic operators of the grids it has met.  `softlube.sweeps.run` gives every lane neighbours.
"""

from __future__ import annotations

import errno
import gc
from collections.abc import Hashable, Iterable
from concurrent.futures import Future
from typing import Any, Protocol

from softlube.errors import InputError
from softlube.solvers.processes import Processes, WorkerDied
from softlube.sweeps.tasks import Outcome, Task
from softlube.sweeps.work import solve_one, solver_version

JOIN_TIMEOUT = 30.0
"""Seconds to wait for a scheduler, and for its first worker."""


class Executor(Protocol):
    """Something with lanes."""

    def lanes(self) -> list[Hashable]:
        """Those there are now; workers may come and go."""
        ...

    def submit(self, lane: Hashable, task: Task, accuracy: float, fields: bool) -> Future[Outcome]:
        """Start to solve; the future raises `WorkerDied` if the process went away, OSError if all of the cluster did."""
        ...

    def close(self) -> None:
        """Let go of the workers and of what they are doing."""
        ...


class Local:
    """Processes of this machine; see `softlube.solvers.processes.Processes`."""

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
    """Workers of a Dask cluster.  Where one goes away, the scheduler gives its task to another.

    Parameters
    ----------
    address : str
        Of the scheduler.
    kinds : iterable of str
        Kinds of the tasks to come, see `softlube.sweeps.work.ROOMS`; the workers must solve them with the same code.
    """

    def __init__(self, address: str, kinds: Iterable[str]) -> None:
        try:
            from distributed import Client
        except ImportError:
            raise InputError("scheduler: needs the extra dask: pip install 'softlube[dask]'") from None
        reason = ""
        try:
            self._client = Client(address, timeout=JOIN_TIMEOUT, set_as_default=False)
        except (OSError, ValueError) as error:
            reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        if reason:
            gc.collect()  # ends the half-made client now; ended while another one starts, it blocks both
            raise InputError(f"scheduler: cannot reach {address!r} ({reason}); expected an address such as tcp://host:8786")
        try:
            self._client.wait_for_workers(1, timeout=JOIN_TIMEOUT)
            ours = [solver_version(kind) for kind in sorted(kinds)]
            versions = [version for kind in sorted(kinds) for version in self._client.run(solver_version, kind).values()]
        except TimeoutError:
            self._client.close()
            raise InputError(f"scheduler: {address!r} has no worker") from None
        except Exception as error:
            self._client.close()
            raise InputError(f"scheduler: the workers at {address!r} cannot run softlube ({error})") from None
        others = set(versions) - set(ours)
        if others:
            self._client.close()
            raise InputError(f"scheduler: a worker has softlube {others.pop()}, and this is {ours[0]}: install the same")
        self._count = 0

    def lanes(self) -> list[Hashable]:
        """One for each thread of each worker."""
        workers = self._client.scheduler_info(n_workers=-1)["workers"]
        return [(address, thread) for address, worker in workers.items() for thread in range(worker["nthreads"])]

    def submit(self, lane: Hashable, task: Task, accuracy: float, fields: bool) -> Future[Outcome]:
        """Solve on the lane's worker, or on another if that one is gone."""
        from distributed.scheduler import KilledWorker

        assert isinstance(lane, tuple)
        self._count += 1
        remote = self._client.submit(
            solve_one,
            task,
            accuracy,
            fields,
            workers=[lane[0]],
            allow_other_workers=True,
            pure=False,
            key=f"softlube-{id(self)}-{self._count}",
        )
        result: Future[Outcome] = Future()

        def hand_on(done: Any) -> None:
            if done.cancelled():
                lost = "the connection to the cluster was lost; what is finished is kept, run again to take it up"
                result.set_exception(ConnectionResetError(errno.ECONNRESET, lost, "scheduler"))
                return
            error = done.exception()
            if isinstance(error, KilledWorker):
                error = WorkerDied("it took several workers down")
            if error is not None:
                result.set_exception(error)
            else:
                result.set_result(done.result())

        remote.add_done_callback(hand_on)
        result.remote = remote  # type: ignore[attr-defined]  # the cluster forgets a task that nobody holds
        return result

    def close(self) -> None:
        """Leave the cluster as it was."""
        self._client.close()
