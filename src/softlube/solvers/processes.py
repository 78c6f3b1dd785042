"""Work in several processes of this machine, each of which walks along neighbours and ends with its parent."""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from collections.abc import Callable, Hashable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from typing import Any, Generic, TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS"), "1")
"""Environment of a worker: as many processes as cores leave no core for a second thread of the linear algebra."""
WATCH = 0.5
"""Seconds between a worker's looks at whether its parent is there."""
MOST_DEATHS = 2
"""Times that a task may take its worker's process with it before it counts as failed."""


class WorkerDied(Exception):
    """The process that worked on a task is gone, by a signal or for want of memory."""


def cores() -> int:
    """Cores that this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity is not None else os.cpu_count() or 1


def end_with(parent: int) -> None:
    """End this process when its parent has ended: a killed calculation must not leave its workers behind.

    A worker waits for work on a pipe that it holds both ends of, and so would never notice.
    """

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(WATCH)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


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

    loky starts them: unlike the standard library's, its workers need no ``if __name__ == "__main__"`` in the caller's script,
    and one that dies is told as an error.

    Parameters
    ----------
    count : int, optional
        Number of lanes; as many as there are cores if not given.
    """

    def __init__(self, count: int | None = None) -> None:
        self.lanes: list[Hashable] = list(range(count or cores()))
        self._pools: dict[Hashable, Any] = {}

    def submit(self, lane: Hashable, function: Callable[..., Result], *arguments: Any) -> Future[Result]:
        """Call a function in the lane's process; the future raises `WorkerDied` if the process went away."""
        from loky.process_executor import BrokenProcessPool, ProcessPoolExecutor

        if lane not in self._pools:
            self._pools[lane] = ProcessPoolExecutor(
                max_workers=1, env=ONE_THREAD, initializer=end_with, initargs=(os.getpid(),)
            )
        result: Future[Result] = Future()

        def hand_on(done: Future[Result]) -> None:
            error = done.exception()
            if isinstance(error, BrokenProcessPool):
                self._pools.pop(lane, None)
                error = WorkerDied(str(error).splitlines()[0] if str(error) else "the process ended")
            if error is not None:
                result.set_exception(error)
            else:
                result.set_result(done.result())

        try:
            self._pools[lane].submit(function, *arguments).add_done_callback(hand_on)
        except BrokenProcessPool as error:  # died between two tasks
            self._pools.pop(lane, None)
            result.set_exception(WorkerDied(str(error)))
        return result

    def close(self, *, wait: bool) -> None:
        """End the processes; without `wait` also what they are doing."""
        for pool in self._pools.values():
            pool.shutdown(wait=wait, kill_workers=not wait)
        self._pools.clear()

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
