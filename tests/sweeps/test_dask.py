"""The same sweep on a Dask cluster: same store, same table, also when a worker is killed."""

import socket
import subprocess
import sys
import threading
import time

import pandas as pd
import pytest

import softlube
from softlube.solvers.processes import WorkerDied

distributed = pytest.importorskip("distributed")

PARAMETERS = {"beta": [50.0, 100.0, 200.0, 1e12]}
ROUGH = 0.05


SQUEEZE = {"radius": "2 mm", "viscosity": "2 Pa s", "young_modulus": ["3 MPa", "3 TPa"], "approach_speed": "1 mm/s"}
SQUEEZE |= {"initial_height": "20 um", "duration": "10 ms"}


@pytest.mark.parametrize(
    ("motion", "parameters", "states"),
    [("steady", PARAMETERS, ["done", "done", "done", "failed"]), ("squeeze", SQUEEZE, ["done", "failed"])],
    ids=["steady", "squeeze"],
)
def test_a_cluster_gives_the_same_table(tmp_path, motion, parameters, states):
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=2, processes=False, dashboard_address=":0", host="127.0.0.1", protocol="tcp"
    ) as cluster:
        options = {"motion": motion, "accuracy": ROUGH}
        on_cluster = softlube.sweep(parameters, **options, store=tmp_path / "store", scheduler=cluster.scheduler_address)
    here = softlube.sweep(parameters, **options, workers=1)
    pd.testing.assert_frame_equal(on_cluster.table, here.table, check_exact=True)
    assert on_cluster.table["status"].tolist() == states


@pytest.mark.parametrize(
    ("address", "message"), [("nonsense", "cannot reach 'nonsense'"), ("tcp://127.0.0.1:9", "cannot reach")]
)
def test_no_scheduler_there(address, message, monkeypatch):
    monkeypatch.setattr("softlube.sweeps.executors.JOIN_TIMEOUT", 2.0)
    with pytest.raises(softlube.InputError, match=message):
        softlube.sweep(PARAMETERS, scheduler=address)


def test_a_lost_connection_is_no_failure_of_the_case():
    from softlube.model.problem import Problem
    from softlube.sweeps.executors import Dask
    from softlube.sweeps.steady import SteadyTask

    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", host="127.0.0.1", protocol="tcp"
    ) as cluster:
        executor = Dask(cluster.scheduler_address, ["steady"])
        (lane,) = executor.lanes()
        future = executor.submit(lane, SteadyTask(Problem(beta=1000)), 1e-3, False)
        executor._running[future][1].cancel()
        with pytest.raises(ConnectionResetError, match="run again to take it up"):
            future.result(60)
        executor.close()


def test_what_answers_is_no_scheduler():
    """A server of something else, whose bytes read as a message of exabytes."""
    with socket.create_server(("127.0.0.1", 0)) as server:

        def answer():
            connection, _ = server.accept()
            with connection:
                connection.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n" * 10)

        thread = threading.Thread(target=answer, daemon=True)
        thread.start()
        with pytest.raises(softlube.InputError, match="cannot reach"):
            softlube.sweep(PARAMETERS, scheduler=f"tcp://127.0.0.1:{server.getsockname()[1]}")
        thread.join(30)


def test_a_task_whose_worker_goes_is_given_back_and_a_deserted_cluster_is_told(monkeypatch):
    from softlube.model.problem import Problem
    from softlube.sweeps import executors
    from softlube.sweeps.steady import SteadyTask

    monkeypatch.setattr(executors, "DESERTED", 0.5)
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", host="127.0.0.1", protocol="tcp"
    ) as cluster:
        executor = executors.Dask(cluster.scheduler_address, ["steady"])
        (lane,) = executor.lanes()
        future = executor.submit((lane[0] + "0", 0), SteadyTask(Problem(beta=1000)), 0.1, False)  # a worker that is not there
        assert executor.lanes() == [lane]
        with pytest.raises(WorkerDied, match="its worker has gone"):
            future.result(0)
        executor._peopled -= 1.0
        monkeypatch.setattr(executor._client, "sync", lambda *arguments, **options: {"workers": {}})
        with pytest.raises(ConnectionResetError, match=r"no worker for .*run again to take it up"):
            executor.lanes()
        monkeypatch.undo()
        executor.close()


@pytest.mark.slow
def test_a_worker_killed_midway(tmp_path):
    """Two worker processes, one of them killed when a third of the cases is there."""
    parameters = {"beta": {"from": 30.0, "to": 3000.0, "count": 60}}
    file = tmp_path / "scheduler.json"

    def start(what, *options):
        command = [
            sys.executable,
            "-m",
            f"distributed.cli.dask_{what}",
            "--scheduler-file",
            str(file),
            "--no-dashboard",
            *options,
        ]
        return subprocess.Popen(command, cwd=tmp_path)

    processes = [start("scheduler", "--port", "0", "--host", "127.0.0.1")]
    try:
        while not file.exists():
            time.sleep(0.1)
        processes += [start("worker", "--nthreads", "1", "--no-nanny") for _ in range(2)]
        with distributed.Client(scheduler_file=str(file)) as client:
            client.wait_for_workers(2, timeout=120)
            address = client.scheduler.address
        killed = []

        def kill_one(state):
            if state.done > 20 and not killed:
                processes[-1].kill()
                killed.append(state.done)

        on_cluster = softlube.sweep(parameters, accuracy=ROUGH, scheduler=address, progress=kill_one)
    finally:
        for process in reversed(processes):
            process.terminate()
            process.wait()
    assert killed
    assert killed[0] < 60
    pd.testing.assert_frame_equal(on_cluster.table, softlube.sweep(parameters, accuracy=ROUGH).table, check_exact=True)
