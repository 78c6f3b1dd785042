"""Work in several processes: neighbours in one of them, and a process that dies."""

import os
import signal
import time
from functools import partial

import pytest

from softlube.solvers.processes import Processes, Stretches, WorkerDied


def test_every_lane_walks_along_beta_and_helps_the_slowest():
    stretches = Stretches([str(n) for n in range(10)])
    stretches.share(["a", "b"])
    assert [stretches.take("a") for _ in range(5)] == list("01234")
    assert stretches.take("b") == "5"
    assert [stretches.take("a") for _ in range(2)] == ["8", "9"]  # half of what b has left
    stretches.share(["a", "c"])  # b has gone, c has come
    assert stretches.take("b") is None
    assert sorted(filter(None, (stretches.take(lane) for lane in "acac"))) == ["6", "7"]
    assert len(stretches) == 0
    assert stretches.take("a") is None


def process_of(task, folder):
    """The process of a task, which ends when the other process has come as far: 1 with 3, and 2 with 4."""
    (folder / str(task)).touch()
    partner = folder / str({1: 3, 3: 1, 2: 4, 4: 2}[task])
    deadline = time.monotonic() + 60
    while not partner.exists():
        assert time.monotonic() < deadline, "the two tasks are not done at the same time"
        time.sleep(0.01)
    return os.getpid()


def deadly(task):
    if task == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return task


def test_neighbours_share_a_process(tmp_path):
    processes = Processes(2)
    found = dict(processes.along(partial(process_of, folder=tmp_path), [1, 2, 3, 4]))
    processes.close()
    assert found[1] == found[2] != found[3] == found[4]
    assert set(found) == {1, 2, 3, 4}


def test_a_task_that_ends_its_process_again_and_again_is_told():
    processes = Processes(1)
    walk = processes.along(deadly, [1, 2, 3])
    assert next(walk) == (1, 1)
    with pytest.raises(WorkerDied):
        next(walk)
    processes.close()
