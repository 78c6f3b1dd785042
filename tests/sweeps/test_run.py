"""Sweeps: right numbers, failures as rows, nothing solved twice, workers that die, several processes at one store."""

import signal
import subprocess
import sys
import time
from concurrent.futures import Future

import pandas as pd
import pytest

import softlube
from softlube.model.problem import Problem
from softlube.solvers.processes import WorkerDied
from softlube.sweeps import Store
from softlube.sweeps.run import _Run
from softlube.sweeps.steady import SteadyTask
from softlube.sweeps.tasks import Outcome
from softlube.sweeps.work import solve_one

BALL = {
    "radius": "2 mm",
    "young_modulus": "3 MPa",
    "viscosity": "2 Pa s",
    "load": ["50 mN", "100 mN"],
    "speed": ["1 mm/s", "3 mm/s"],
}
ROUGH = 0.02


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """Four physical cases with their fields, and the store."""
    store = tmp_path_factory.mktemp("sweep") / "store"
    return softlube.sweep(BALL, accuracy=ROUGH, store=store, fields=True, workers=2), store


def test_numbers_are_those_of_solve(swept):
    result, _ = swept
    for number, (load, speed) in enumerate(
        [("50 mN", "1 mm/s"), ("50 mN", "3 mm/s"), ("100 mN", "1 mm/s"), ("100 mN", "3 mm/s")]
    ):
        row = result.table.iloc[number]
        solution = softlube.Contact(**BALL | {"load": load, "speed": speed}).solve(accuracy=ROUGH)
        assert row["status"] == "done"
        assert row["beta"] == pytest.approx(solution.beta, rel=1e-9)
        assert row["load [N]"] == solution.contact.load
        for name, unit in (("film_min", "m"), ("friction_domain", "N"), ("indentation", "m"), ("pressure_max", "Pa")):
            assert row[f"{name} [{unit}]"] == pytest.approx(solution.dimensional[name], rel=1e-8)
            assert row[f"{name}_error [{unit}]"] == pytest.approx(solution.dimensional[name].error, rel=1e-4, abs=1e-30)
        assert row["friction_coefficient"] == pytest.approx(solution.dimensional["friction_coefficient"], rel=1e-8)


def test_a_second_run_solves_nothing_and_gives_the_same(swept):
    result, store = swept
    states = []
    again = softlube.sweep(BALL, accuracy=ROUGH, store=store, progress=states.append)
    assert [(state.total, state.done, again.n_found) for state in states] == [(4, 4, 4)]
    pd.testing.assert_frame_equal(again.table, result.table, check_exact=True)
    with Store(store) as kept:
        assert set(kept.counts().values()) == {1}


def test_another_accuracy_is_another_case(swept):
    _, store = swept
    with Store(store) as kept:
        before = len(kept.counts())
    softlube.sweep(BALL | {"load": "50 mN", "speed": "1 mm/s"}, accuracy=0.03, store=store, workers=1)
    with Store(store) as kept:
        assert len(kept.counts()) == before + 1


def test_a_failed_case_is_a_row_with_its_reason_and_stops_nothing(tmp_path):
    store = tmp_path / "store"
    parameters = {"beta": [1e12, 100.0, 300.0]}
    result = softlube.sweep(parameters, accuracy=ROUGH, store=store, workers=1)
    assert result.table["status"].tolist() == ["failed", "done", "done"]
    assert "outside the range" in result.table["reason"][0]
    assert result.n_failed == 1

    def solved():
        with Store(store) as kept:
            return [kept.counts()[key] for key in result.keys]

    softlube.sweep(parameters, accuracy=ROUGH, store=store, workers=1)
    assert solved() == [1, 1, 1]
    again = softlube.sweep(parameters, accuracy=ROUGH, store=store, workers=1, retry_failed=True)
    assert solved() == [2, 1, 1]
    pd.testing.assert_frame_equal(again.table, result.table, check_exact=True)


def test_cases_of_equal_beta_share_a_solve():
    states = []
    viscosity = {"viscosity": ["1 Pa s", "2 Pa s"], "speed": ["2 mm/s", "1 mm/s"], "load": "50 mN"}
    result = softlube.sweep(BALL | viscosity, combine="zip", accuracy=ROUGH, workers=1, progress=states.append)
    assert states[-1].total == 1
    assert result.table["film_min [m]"].nunique() == 1
    assert result.table["shear_rate_max [1/s]"][0] == pytest.approx(2 * result.table["shear_rate_max [1/s]"][1])


def test_workers_and_scheduler_exclude_each_other():
    with pytest.raises(softlube.InputError, match="workers, scheduler"):
        softlube.sweep({"beta": 10}, workers=1, scheduler="tcp://127.0.0.1:1")
    with pytest.raises(softlube.InputError, match="workers: expected a positive"):
        softlube.sweep({"beta": 10}, workers=0)


def test_an_unexpected_error_is_a_failure_of_its_case(monkeypatch):
    def defect(*arguments, **options):
        raise ZeroDivisionError("a defect")

    monkeypatch.setattr("softlube.steady.solve.solve_problem", defect)
    assert solve_one(SteadyTask(Problem(beta=10)), 1e-3, False).reason == "ZeroDivisionError: a defect"


class Deadly:
    """An executor whose worker dies over some problems a number of times."""

    most_deaths = 2

    def __init__(self, deaths):
        self.deaths = deaths

    def lanes(self):
        return ["lane"]

    def submit(self, lane, task, accuracy, fields):
        future = Future()
        beta = task.problem.beta
        if self.deaths.get(beta, 0):
            self.deaths[beta] -= 1
            future.set_exception(WorkerDied("killed"))
        else:
            future.set_result(Outcome("", {"film_min": (1.0, 0.1)}, {"beta": beta}))
        return future

    def close(self):
        pass


def test_a_task_that_kills_its_worker_twice_has_failed():
    tasks = {str(beta): SteadyTask(Problem(beta=beta)) for beta in (1, 2, 3)}
    with Store(":memory:") as store:
        _Run(1e-3, tasks, store, False, False, None).go(Deadly({1: 1, 2: 2}))
        found = store.outcomes(tasks)
    assert [found[key].failed for key in ("1", "2", "3")] == [False, True, False]
    assert "died 2 times" in found["2"].reason


COMMAND = [sys.executable, "-c", "from softlube.cli.main import main; raise SystemExit(main())", "sweep"]
PLAN = """
[sweep]
accuracy = 0.05
[parameters]
beta = { from = 30, to = 3000, count = %d }
"""
SQUEEZE = """
[sweep]
motion = "squeeze"
accuracy = 0.05
[parameters]
radius = "2 mm"
young_modulus = "3 MPa"
viscosity = "2 Pa s"
load = "100 mN"
initial_height = { from = "20 um", to = "200 um", count = %d }
duration = "2 ms"
"""


def test_two_processes_at_one_store_share_the_work_and_lose_nothing(tmp_path):
    plan, store = tmp_path / "plan.toml", tmp_path / "both.sweep"
    plan.write_text(PLAN % 24)
    both = [
        subprocess.Popen([*COMMAND, str(plan), "--store", str(store), "--workers", "1", "--output", str(tmp_path / f"{n}.csv")])
        for n in (1, 2)
    ]
    assert [process.wait(300) for process in both] == [0, 0]
    with Store(store) as kept:
        counts = kept.counts()
    assert len(counts) == 24
    assert set(counts.values()) == {1}
    assert (tmp_path / "1.csv").read_bytes() == (tmp_path / "2.csv").read_bytes()
    table = pd.read_csv(tmp_path / "1.csv")
    assert (table["status"] == "done").all()


def _killed(tmp_path, cases, kills, text=PLAN):
    """Kill a sweep at random moments and resume it; the tables of the uninterrupted and of the resumed run, and the counts."""
    import random

    plan = tmp_path / "plan.toml"
    plan.write_text(text % cases)

    def command(name):
        return [*COMMAND, str(plan), "--store", str(tmp_path / f"{name}.sweep"), "--output", str(tmp_path / f"{name}.csv")]

    began = time.monotonic()
    subprocess.run(command("whole"), check=True, timeout=600)
    whole = time.monotonic() - began
    chance = random.Random(7)
    for _ in range(kills):
        process = subprocess.Popen(command("killed"))
        try:
            process.wait(chance.uniform(0, max(1.5 * whole / kills, 0.7 * whole)))
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
    subprocess.run(command("killed"), check=True, timeout=600)
    with Store(tmp_path / "killed.sweep") as kept:
        counts = kept.counts()
    return (tmp_path / "whole.csv").read_bytes(), (tmp_path / "killed.csv").read_bytes(), counts


def test_killed_and_resumed(tmp_path):
    whole, killed, counts = _killed(tmp_path, 30, 3)
    assert killed == whole
    assert len(counts) == 30
    assert set(counts.values()) == {1}


@pytest.mark.slow
def test_squeeze_films_killed_and_resumed(tmp_path):
    whole, killed, counts = _killed(tmp_path, 20, 3, SQUEEZE)
    assert killed == whole
    assert whole.count(b",done,") == 20
    assert len(counts) == 20
    assert set(counts.values()) == {1}


@pytest.mark.slow
def test_killed_twenty_times_and_resumed(tmp_path):
    whole, killed, counts = _killed(tmp_path, 150, 20)
    assert killed == whole
    assert len(counts) == 150
    assert set(counts.values()) == {1}
