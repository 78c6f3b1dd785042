"""Work in several processes of this machine, each of which walks along neighbours and ends with its parent."""

from __future__ import annotations

import errno
import os
import pickle
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable, Hashable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import suppress
from typing import Any, BinaryIO, Generic, TypeVar, cast

from softlube.solvers.worker import receive, send

Task = TypeVar("Task")
Result = TypeVar("Result")

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS"), "1")
"""Environment of a worker: as many processes as cores leave no core for a second thread of the linear algebra."""
PATIENCE = 2.0
"""Seconds in which a process ends when it is told to; longer than `softlube.solvers.worker.GRACE`."""
MOST_DEATHS = 2
"""Times that a task may take its worker's process with it before it counts as failed."""


class WorkerDied(ChildProcessError):
    """The process that worked on a task is gone, by a signal or for want of memory."""

    def __init__(self, how: str) -> None:
        super().__init__(errno.ECHILD, how, "worker")

    def __str__(self) -> str:
        return str(self.strerror)


def cores() -> int:
    """Cores that this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity is not None else os.cpu_count() or 1


class Stretches(Generic[Task]):
    """Tasks in their order, a stretch for every lane; one that has none left takes half of the longest.

    Neighbours share work, such as the grids of neighbouring β, so every lane walks along neighbours.
    """

    def __init__(self, tasks: Sequence[Task]) -> None:
        self._unowned = deque(tasks)
        self._owned: dict[Hashable, deque[Task]] = {}

    def __len__(self) -> int:
        return len(self._unowned) + sum(map(len, self._owned.values()))

    def share(self, lanes: Sequence[Hashable]) -> None:
        """Give lanes that have come a stretch, and take it from lanes that are gone."""
        for lane in [lane for lane in self._owned if lane not in lanes]:
            self._unowned.extend(self._owned.pop(lane))
        newcomers = [lane for lane in lanes if lane not in self._owned]
        for number, lane in enumerate(newcomers):
            count = -(-len(self._unowned) // (len(newcomers) - number))
            self._owned[lane] = deque(self._unowned.popleft() for _ in range(count))

    def take(self, lane: Hashable) -> Task | None:
        """The lane's next task; none for a lane that is gone."""
        own = self._owned.get(lane)
        if own is None:
            return None
        if not own:
            longest = max([*self._owned.values(), self._unowned], key=len)
            own.extend(reversed([longest.pop() for _ in range(-(-len(longest) // 2))]))
        return own.popleft() if own else None

    def put_back(self, lane: Hashable, task: Task) -> None:
        """A task that is to be done again."""
        self._owned.get(lane, self._unowned).appendleft(task)


class Processes:
    """Lanes, each of which does one thing at a time in one process with one thread; started when first used, replaced when
    they die.

    A process ends when the pipe to it ends, see `softlube.solvers.worker`: with this one, however this one ends.  Unlike the
    standard library's, it needs no ``if __name__ == "__main__"`` in the caller's script.

    Parameters
    ----------
    count : int, optional
        Number of lanes; as many as there are cores if not given.
    """

    def __init__(self, count: int | None = None) -> None:
        self.lanes: list[Hashable] = list(range(count or cores()))
        self._workers: dict[Hashable, subprocess.Popen[bytes]] = {}

    def submit(self, lane: Hashable, function: Callable[..., Result], *arguments: Any) -> Future[Result]:
        """Call a function in the lane's process; the future raises `WorkerDied` if the process went away."""
        import cloudpickle

        request = cloudpickle.dumps((function, arguments))
        worker = self._workers.get(lane)
        if worker is not None and worker.poll() is not None:
            _end(worker)
            worker = None
        if worker is None:
            worker = self._workers[lane] = _start()
        future: Future[Result] = Future()
        threading.Thread(target=_call, args=(worker, request, future), daemon=True).start()
        return future

    def close(self) -> None:
        """End the processes and what they are doing."""
        workers = list(self._workers.values())
        self._workers.clear()
        for worker in workers:  # first all at once, then wait for each
            with suppress(OSError):
                _pipes(worker)[0].close()
        for worker in workers:
            _end(worker)

    def along(self, function: Callable[[Task], Result], tasks: Sequence[Task]) -> Iterator[tuple[Task, Result]]:
        """Call a function with each of some tasks, neighbours in one process; results as they come.

        Parameters
        ----------
        function : callable
            Importable by its name.
        tasks : sequence
            In the order in which neighbours share work; hashable.

        Raises
        ------
        WorkerDied
            If one task has ended its process `MOST_DEATHS` times.
        """
        pending = Stretches(tasks)
        pending.share(self.lanes)
        flying: dict[Future[Result], tuple[Hashable, Task]] = {}
        deaths: dict[Task, int] = {}
        while True:
            busy = {lane for lane, _ in flying.values()}
            for lane in self.lanes:
                task = pending.take(lane) if lane not in busy else None
                if task is not None:
                    flying[self.submit(lane, function, task)] = lane, task
            if not flying:
                return
            for future in wait(flying, return_when=FIRST_COMPLETED).done:
                lane, task = flying.pop(future)
                try:
                    yield task, future.result()
                except WorkerDied:
                    deaths[task] = deaths.get(task, 0) + 1
                    if deaths[task] == MOST_DEATHS:
                        raise
                    pending.put_back(lane, task)


def _start() -> subprocess.Popen[bytes]:
    """A process that waits for requests.  In a group of its own: what the terminal interrupts is this process."""
    code = f"import sys; sys.path[:] = {sys.path!r}; from softlube.solvers.worker import serve; serve()"
    own_group: dict[str, Any] = {"process_group": 0} if os.name == "posix" else {}
    return subprocess.Popen(
        [sys.executable, "-c", code],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=os.environ | ONE_THREAD,
        **own_group,
    )


def _end(worker: subprocess.Popen[bytes]) -> None:
    """Close what leads to a process, and wait until it has gone."""
    requests, replies = _pipes(worker)
    with suppress(OSError):
        requests.close()
    try:
        worker.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        worker.kill()
        worker.wait()
    replies.close()


def _pipes(worker: subprocess.Popen[bytes]) -> tuple[BinaryIO, BinaryIO]:
    """To the process and from it."""
    assert worker.stdin is not None
    assert worker.stdout is not None
    return cast(BinaryIO, worker.stdin), cast(BinaryIO, worker.stdout)


def _call(worker: subprocess.Popen[bytes], request: bytes, future: Future[Any]) -> None:
    """Ask the process, and put its answer into the future."""
    requests, replies = _pipes(worker)
    try:
        send(requests, request)
        answer = receive(replies)
    except (EOFError, OSError, ValueError):  # ValueError: closed by `Processes.close`
        code = worker.wait()
        how = f"signal {-code}" if code < 0 else f"exit code {code}"
        future.set_exception(WorkerDied(f"the process ended with {how}"))
        return
    try:
        good, result = pickle.loads(answer)
    except Exception as error:
        good, result = False, error
    if good:
        future.set_result(result)
    else:
        future.set_exception(result)
