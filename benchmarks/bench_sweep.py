"""What a sweep takes, alone, killed and on a cluster: 500 cases, ten loads by fifty speeds over three decades.

    python benchmarks/bench_sweep.py time            # wall time on two processes
    python benchmarks/bench_sweep.py kill --kills 20 # SIGKILL at random moments, resumed each time
    python benchmarks/bench_sweep.py dask            # one and two worker processes; one of two killed midway

--cases makes the sweep smaller.  Each part ends with an error if the tables differ.
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

COMMAND = [sys.executable, "-c", "from softlube.cli.main import main; raise SystemExit(main())", "sweep"]
PLAN = """
[parameters]
radius = "2 mm"
young_modulus = "3 MPa"
viscosity = "2 Pa s"
load = {{ from = "60 mN", to = "150 mN", count = 10 }}
speed = {{ from = "0.1 mm/s", to = "100 mm/s", count = {speeds} }}
"""


def plan(folder: Path, cases: int) -> Path:
    """Plan of about so many cases, in a folder of its own."""
    path = folder / "plan.toml"
    path.write_text(PLAN.format(speeds=max(cases // 10, 2)), encoding="utf-8")
    return path


def processor() -> float:
    """Seconds of processor time of all processes that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(path: Path, store: str, table: str, *options: str) -> float:
    """Seconds that the command takes."""
    began = time.perf_counter()
    arguments = [str(path), "--store", str(path.parent / store), "--output", str(path.parent / table), *options]
    subprocess.run([*COMMAND, *arguments], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - began


def solved(store: Path) -> dict[str, int]:
    """How often each problem was solved."""
    from softlube.sweeps import Store

    with Store(store) as kept:
        return kept.counts()


def same(first: Path, second: Path) -> None:
    """End if two tables differ."""
    if first.read_bytes() != second.read_bytes():
        raise SystemExit(f"{second.name} differs from {first.name}")


def kill(folder: Path, path: Path, kills: int, workers: int) -> None:
    """Kill and resume, and compare."""
    whole = run(path, "whole.sweep", "whole.csv", "--workers", str(workers))
    print(f"uninterrupted: {whole:.1f} s")
    chance = random.Random(1)
    arguments = [str(path), "--store", str(folder / "killed.sweep"), "--output", str(folder / "killed.csv")]
    for number in range(kills):
        wait = chance.uniform(0.0, 2.2 * whole / kills)
        process = subprocess.Popen(
            [*COMMAND, *arguments, "--workers", str(workers)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        try:
            process.wait(wait)
            print(f"kill {number + 1}: had ended before")
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
            done = sum(solved(folder / "killed.sweep").values()) if (folder / "killed.sweep").exists() else 0
            print(f"kill {number + 1} after {wait:.1f} s: {done} solved", flush=True)
    run(path, "killed.sweep", "killed.csv", "--workers", str(workers))
    same(folder / "whole.csv", folder / "killed.csv")
    counts = solved(folder / "killed.sweep")
    print(f"identical tables; {len(counts)} problems, {sum(counts.values()) - len(counts)} stored twice")
    if set(counts.values()) != {1}:
        raise SystemExit("a problem was solved again after it had been stored")


class Cluster:
    """A Dask scheduler and workers as processes."""

    def __init__(self, workers: int, folder: Path) -> None:
        self.address_file = folder / f"scheduler-{workers}.json"
        self.address_file.unlink(missing_ok=True)  # an earlier cluster's address is nobody's now
        environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}

        def start(what: str, *arguments: str) -> subprocess.Popen:
            command = [
                sys.executable,
                "-m",
                f"distributed.cli.dask_{what}",
                *arguments,
                "--scheduler-file",
                str(self.address_file),
            ]
            return subprocess.Popen(command, env=environment, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        self.processes = [start("scheduler", "--port", "0", "--no-dashboard", "--host", "127.0.0.1")]
        while not self.address_file.exists():
            time.sleep(0.1)
        options = ("--nthreads", "1", "--no-nanny", "--no-dashboard")
        self.workers = [start("worker", *options, "--name", f"worker-{number}") for number in range(workers)]
        self.processes += self.workers
        from distributed import Client

        with Client(scheduler_file=str(self.address_file)) as client:
            client.wait_for_workers(workers)
            self.address = client.scheduler.address

    def close(self) -> None:
        """End all processes, the workers first."""
        for process in reversed(self.processes):
            process.kill()
            process.wait()


def dask(folder: Path, path: Path) -> None:
    """One worker, two, and two of which one is killed."""
    run(path, "whole.sweep", "whole.csv", "--workers", "2")
    times = {}
    for workers in (1, 2):
        cluster = Cluster(workers, folder)
        times[workers] = run(path, f"dask{workers}.sweep", f"dask{workers}.csv", "--scheduler", cluster.address)
        cluster.close()
        same(folder / "whole.csv", folder / f"dask{workers}.csv")
        print(f"Dask, {workers} worker(s): {times[workers]:.1f} s", flush=True)
    print(f"parallel efficiency {times[1] / (2 * times[2]):.2f}")
    cluster = Cluster(2, folder)
    arguments = [
        str(path),
        "--store",
        str(folder / "shot.sweep"),
        "--output",
        str(folder / "shot.csv"),
        "--scheduler",
        cluster.address,
    ]
    process = subprocess.Popen([*COMMAND, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(times[2] / 2)
    cluster.workers[1].kill()
    if process.wait():
        raise SystemExit("the sweep ended with an error")
    cluster.close()
    same(folder / "whole.csv", folder / "shot.csv")
    print(f"one of two workers killed: identical table; {len(solved(folder / 'shot.sweep'))} problems")


def main() -> None:
    """Parse and run."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("part", choices=("time", "kill", "dask"))
    parser.add_argument("--cases", type=int, default=500)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    folder = Path(tempfile.mkdtemp())
    try:
        path = plan(folder, options.cases)
        if options.part == "time":
            wall = run(path, "a.sweep", "a.csv", "--workers", str(options.workers))
            load = os.getloadavg()[0]
            print(f"{options.cases} cases: {wall:.1f} s of wall time, {processor():.1f} s of processor time, load {load:.1f}")
        elif options.part == "kill":
            kill(folder, path, options.kills, options.workers)
        else:
            dask(folder, path)
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
