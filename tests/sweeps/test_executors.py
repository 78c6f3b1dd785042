"""Workers on this machine: replaced when they die, gone when the sweep is."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass

import pytest

import softlube
from softlube.model.problem import Problem
from softlube.solvers.processes import WorkerDied, cores
from softlube.sweeps.executors import Local
from softlube.sweeps.steady import SteadyTask
from softlube.sweeps.tasks import Outcome

ROUGH = 0.02


def test_a_killed_worker_is_noticed_and_replaced():
    executor = Local(1)
    task = SteadyTask(Problem(beta=100))
    assert not executor.submit(0, task, ROUGH, False).result(60).failed
    process = executor._processes._workers[0].pid
    future = executor.submit(0, SteadyTask(Problem(beta=2e5)), 2e-4, False)
    os.kill(process, signal.SIGKILL)
    with pytest.raises(WorkerDied):
        future.result(60)
    assert not executor.submit(0, task, ROUGH, False).result(60).failed
    executor.close()


def test_workers_end_with_a_killed_sweep(tmp_path):
    script = (
        "import os, signal\n"
        "from softlube.sweeps.executors import Local\n"
        "from softlube.model.problem import Problem\n"
        "from softlube.sweeps.steady import SteadyTask\n"
        "executor = Local(1)\n"
        "executor.submit(0, SteadyTask(Problem(beta=100)), 0.05, False).result()\n"
        "print(executor._processes._workers[0].pid, flush=True)\n"
        "os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    killed = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
    assert killed.returncode == -signal.SIGKILL
    worker = int(killed.stdout)
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline:
        try:
            os.kill(worker, 0)
        except ProcessLookupError:
            return
        time.sleep(0.1)
    pytest.fail("the worker is still there")


def test_a_lane_is_one_process_with_one_thread(monkeypatch):
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "2")
    executor = Local(2)
    assert list(executor.lanes()) == [0, 1]
    futures = [executor.submit(lane, Told(beta=1), ROUGH, False) for lane in (0, 1, 0)]
    told = [future.result(60).facts for future in futures]
    executor.close()
    assert told[0]["process"] == told[2]["process"] != told[1]["process"]
    assert {facts["threads"] for facts in told} == {"1"}


@dataclass(frozen=True)
class Told:
    """A task that tells where it was solved."""

    beta: float

    def solve(self, accuracy, with_fields):
        return Outcome(facts={"process": os.getpid(), "threads": os.environ["OPENBLAS_NUM_THREADS"]})


def test_as_many_lanes_as_cores_unless_said_otherwise():
    assert len(Local().lanes()) == cores() >= 1
    for workers in (0, -1, True):
        with pytest.raises(softlube.InputError, match="workers: expected a positive whole number"):
            Local(workers)
