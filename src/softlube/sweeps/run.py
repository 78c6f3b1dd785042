"""The sweep itself: tasks to lanes, outcomes to the store, each at once."""

from __future__ import annotations

import os
import time
from collections import deque
from collections.abc import Hashable, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, wait

from softlube.errors import InputError
from softlube.solvers.notebook import watched
from softlube.solvers.processes import Stretches, WorkerDied
from softlube.solvers.progress import Listener, Progress
from softlube.sweeps.executors import Dask, Executor, Local
from softlube.sweeps.plan import Plan, make_plan, read_plan
from softlube.sweeps.results import Sweep, warn_of
from softlube.sweeps.store import LEASE, Store
from softlube.sweeps.tasks import Outcome, Task
from softlube.sweeps.work import ROOMS, content_key, solver_version

BEAT = 0.5
"""Seconds after which the loop looks up at the latest: at workers that came, claims to renew, the other processes' results."""


@watched
def sweep(
    plan: Plan | Mapping[str, object] | str | os.PathLike[str],
    *,
    store: str | os.PathLike[str] | None = None,
    motion: str = "steady",
    combine: str = "product",
    accuracy: float | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    fields: bool = False,
    retry_failed: bool = False,
    progress: Listener | None = None,
) -> Sweep:
    """Solve many contacts, in steady sliding or in squeeze films, and keep each as soon as it is solved.

    Cases that are the same when normalised, such as steady ones of equal β, are solved once.  A run that was killed is taken up
    where it was by running it again.

    Parameters
    ----------
    plan : Plan, mapping or path
        A plan, a TOML file, or parameters as for `softlube.sweeps.plan.make_plan`.
    store : path, optional
        Database of the outcomes; without it nothing is kept on disk.
    motion, combine, accuracy
        For parameters given as a mapping; see `softlube.sweeps.plan.make_plan`.
    workers : int, optional
        Processes on this machine; as many as it has cores if not given.
    scheduler : str, optional
        Address of a Dask scheduler, "tcp://host:8786", to solve on its workers instead.
    fields : bool
        Keep the fields, too.
    retry_failed : bool
        Solve again what is stored as a failure.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after every outcome; it counts different problems, as cases that are
        the same when normalised share one.

    Returns
    -------
    Sweep

    Raises
    ------
    InputError
        If the plan, the store or the scheduler is not as it should be.  A case that cannot be solved raises nothing: it is a
        row of the table that says why.

    Examples
    --------
    >>> import softlube
    >>> result = softlube.sweep({"beta": [300, 1000]}, accuracy=0.01, workers=1)
    >>> result.table["film_center"].round(3).tolist()
    [0.033, 0.016]
    """
    if not isinstance(plan, Plan):
        plan = (
            make_plan(plan, motion=motion, combine=combine, accuracy=accuracy) if isinstance(plan, Mapping) else read_plan(plan)
        )
    if scheduler is not None and workers is not None:
        raise InputError("workers, scheduler: give one of them; the cluster has its own workers")
    each = [case.task for case in plan.cases]
    keys = [content_key(task, plan.accuracy) for task in each]
    tasks: dict[str, Task] = dict(zip(keys, each, strict=True))
    # Before the store: what is refused leaves no file behind.
    executor: Executor = Local(workers) if scheduler is None else Dask(scheduler, {task.kind for task in tasks.values()})
    try:
        with Store(":memory:" if store is None else store) as kept:
            run = _Run(plan.accuracy, tasks, kept, fields, retry_failed, progress)
            run.go(executor)
            foreign = kept.count_foreign({solver_version(kind) for kind in ROOMS})
            result = Sweep(plan, tuple(keys), kept.outcomes(tasks, fields=fields), run.found, foreign)
    finally:
        executor.close()
    warn_of(result)
    return result


class _Run:
    """State of one call of `sweep`."""

    def __init__(
        self,
        accuracy: float,
        tasks: Mapping[str, Task],
        store: Store,
        fields: bool,
        retry_failed: bool,
        progress: Listener | None,
    ) -> None:
        self.accuracy = accuracy
        self.tasks = tasks
        self.store = store
        self.fields = fields
        self.retry_failed = retry_failed
        self.progress = progress
        settled = store.settled(tasks, fields=fields, retry_failed=retry_failed)
        self.found = self.done = len(settled)
        self.failed = 0
        order = sorted((key for key in tasks if key not in settled), key=lambda key: tasks[key].place)
        self.pending = Stretches(order)
        self.flying: dict[Future[Outcome], tuple[Hashable, str]] = {}
        self.landed: list[tuple[Future[Outcome], Hashable, str]] = []
        self.ready: dict[Hashable, str] = {}
        self.deaths: dict[str, int] = {}
        self.theirs: deque[str] = deque()
        self.renewed = time.monotonic()
        self._report()

    def go(self, executor: Executor) -> None:
        """Solve all that is pending.

        Raises
        ------
        ConnectionError
            If the cluster has gone; what had come from it is kept.
        """
        try:
            self._go(executor)
        except ConnectionError:
            for future, lane, key in [*self.landed, *((future, *flight) for future, flight in self.flying.items())]:
                if future.done() and future.exception() is None:
                    self._land(future, lane, key, executor.most_deaths)
            raise

    def _go(self, executor: Executor) -> None:
        while self.pending or self.flying or self.ready or self.theirs:
            self._fill(executor)
            for lane, _ in list(self.flying.values()):  # so that no worker waits for the store when it is done
                if lane not in self.ready and (key := self._claim(lane)) is not None:
                    self.ready[lane] = key
            if self.flying:
                finished = wait(self.flying, timeout=BEAT, return_when=FIRST_COMPLETED).done
                self.landed = [(future, *self.flying.pop(future)) for future in finished]
                if self.landed:
                    self._fill(executor)
                while self.landed:
                    self._land(*self.landed.pop(), executor.most_deaths)
            else:
                time.sleep(BEAT / 2)
            if time.monotonic() - self.renewed > LEASE / 6:
                self.store.renew()
                self.renewed = time.monotonic()

    def _fill(self, executor: Executor) -> None:
        """A task for every lane that has none."""
        lanes = executor.lanes()
        self.pending.share(lanes)
        for lane in [lane for lane in self.ready if lane not in lanes]:
            self.pending.put_back(lane, self.ready.pop(lane))
        busy = {lane for lane, _ in self.flying.values()}
        for lane in lanes:
            if lane in busy:
                continue
            key = self.ready.pop(lane, None) or self._claim(lane)
            if key is None and self.ready:  # what another lane has not begun
                _, key = self.ready.popitem()
            if key is not None:
                self.flying[executor.submit(lane, self.tasks[key], self.accuracy, self.fields)] = lane, key

    def _claim(self, lane: Hashable) -> str | None:
        """The lane's next task that is ours to solve."""
        while (key := self._next(lane)) is not None:
            claim = self.store.claim(key, fields=self.fields, retry_failed=self.retry_failed)
            if claim == "ours":
                return key
            if claim == "settled":
                self.done += 1
                self._report()
            else:
                self.theirs.append(key)
                if not self.pending:
                    return None  # nothing but what other processes are at: look again later
        return None

    def _next(self, lane: Hashable) -> str | None:
        key = self.pending.take(lane)
        return key if key is not None else (self.theirs.popleft() if self.theirs else None)

    def _land(self, future: Future[Outcome], lane: Hashable, key: str, most_deaths: int) -> None:
        """Keep what came of a task."""
        try:
            outcome = future.result()
        except WorkerDied as error:
            self.deaths[key] = self.deaths.get(key, 0) + 1
            if self.deaths[key] < most_deaths:
                self.pending.put_back(lane, key)
                return
            outcome = Outcome(f"the process that solved it died {most_deaths} times ({error})")
        task = self.tasks[key]
        self.store.save(key, task, self.accuracy, solver_version(task.kind), outcome)
        self.done += 1
        self.failed += outcome.failed
        self._report()

    def _report(self) -> None:
        if self.progress is not None:
            message = f"solving, {self.failed} failed" if self.failed else "solving"
            self.progress(Progress(message, self.done, len(self.tasks)))
