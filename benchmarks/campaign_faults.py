"""Kills, full disks and lost workers: nothing may be lost, hang, be left behind, or end in a traceback.

    python benchmarks/campaign_faults.py                    # all of it, about an hour on two cores
    python benchmarks/campaign_faults.py kills dask         # some of it
    python benchmarks/campaign_faults.py --quick            # a few of each kind

Prints a line for each kind of fault: how often it was tried, and how often something was lost, hung, was left behind or ended
in a traceback; and the longest time from the fault to the end of the command.  Exit code 1 if anything went wrong.

The kinds of fault:

- kills: SIGKILL that hits a sweep while it solves, resumed each time; the table must be that of an undisturbed sweep, byte for
  byte, and no problem may be solved again after it was stored.  Local and on Dask, with one process and two on a store.
- signals: SIGINT, SIGTERM, SIGHUP and SIGKILL at any moment of reproduce, fit, stribeck, sweep, squeeze and solve; a second
  later there may be no process of theirs, and after all but SIGKILL one line, the conventional exit code and no temporary file.
- disk: a limit to the size of files at every size that a command writes, a small full file system, a read-only one, a folder
  that vanishes; one line, the old files unchanged, and the store can be taken up.
- dask: a worker killed with its task while another joins, a single worker replaced, the scheduler killed, an address to which
  no route leads; the sweep goes on, or ends with one line within 30 s, and what was finished is kept.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

MARK = "SOFTLUBE_CAMPAIGN"
"""Environment variable by which the processes of a trial are found."""
HANG = 60.0
"""Seconds after which a command counts as hung."""
PROMISE = 30.0
"""Seconds in which a sweep without a cluster ends."""
LATER = 1.0
"""Seconds after which no process of a killed command may be there."""
COUNT = 40
"""Cases of a sweep."""
PLAN = "[sweep]\naccuracy = {accuracy}\n[parameters]\nbeta = {{ from = {first}, to = {last}, count = {count} }}\n"
BALL = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--load", "100 mN"]
HARD = [
    "--radius",
    "2 mm",
    "--young-modulus",
    "3 GPa",
    "--viscosity",
    "1 Pa s",
    "--load",
    "1 N",
    "--pressure-viscosity",
    "9 GPa^-1",
]
DATA = "load [N],speed [mm/s],friction [mN]\n" + "".join(
    f"1,{speed},{5 * speed**0.6:.3f}\n" for speed in (0.3, 0.5, 1, 2, 3, 5, 8, 12, 20, 40)
)
COMMANDS = {
    "reproduce": ["reproduce", "out", "--processes", "2"],
    "fit": ["fit", "data.csv", *HARD[:4], *HARD[8:], "--output", "fit.json"],
    "stribeck": ["stribeck", *HARD, "--slowest", "1 mm/s", "--fastest", "1 m/s", "--output", "stribeck.csv"],
    "sweep": ["sweep", "plan.toml", "--workers", "2"],
    "squeeze": ["squeeze", *BALL, "--initial-height", "100 um", "--duration", "1 s", "--accuracy", "2e-4", "--output", "o.nc"],
    "solve": ["solve", "--beta", "1e6", "--accuracy", "1e-3", "--output", "o.nc"],
}


def _hear() -> None:
    """Signals that the campaign ignores, under nohup or behind a shell's &, end the commands all the same."""
    for kind in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(kind, signal.SIG_DFL)


@dataclass
class Tally:
    """What came of the trials of one kind of fault."""

    kind: str
    tried: int = 0
    lost: int = 0
    hung: int = 0
    orphan: int = 0
    traceback: int = 0
    worst: float = 0.0

    @property
    def bad(self) -> int:
        """Things that went wrong."""
        return self.lost + self.hung + self.orphan + self.traceback

    def line(self) -> str:
        """A row of the table."""
        numbers = (self.tried, self.lost, self.hung, self.orphan, self.traceback)
        return f"{self.kind:<38}" + "".join(f"{number:>10}" for number in numbers) + f"{self.worst:>9.1f} s"


def head() -> str:
    """Head of the table."""
    return (
        f"{'fault':<38}"
        + "".join(f"{name:>10}" for name in ("tried", "lost", "hung", "orphan", "traceback"))
        + f"{'worst':>11}"
    )


# --- commands ---------------------------------------------------------------------------------------------------------


class Command:
    """A softlube command as a process, marked so that its workers are found."""

    def __init__(self, arguments: list[str], folder: Path, prelude: str = "") -> None:
        self.mark = f"{os.getpid()}-{time.monotonic_ns()}"
        notes = Path(tempfile.gettempdir())  # not in the folder, whose disk may be full
        environment = os.environ | {MARK: self.mark, "SOFTLUBE_CACHE": str(folder / "cache"), "OPENBLAS_NUM_THREADS": "1"}
        code = f"{prelude}\nimport sys; sys.argv[1:] = {arguments!r}; from softlube.__main__ import main"
        self.started = notes / f"started-{self.mark}"
        code += f"; open({str(self.started)!r}, 'w').close(); sys.exit(main())"
        self.said = notes / f"said-{self.mark}"
        with open(self.said, "wb") as stream:
            self.process = subprocess.Popen(
                [sys.executable, "-c", code],
                cwd=folder,
                env=environment,
                stdout=subprocess.DEVNULL,
                stderr=stream,
                preexec_fn=_hear,
            )

    def wait(self, seconds: float = HANG) -> int | None:
        """Its exit code; None, and killed, if it does not end."""
        try:
            return self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return None

    def orphans(self) -> list[str]:
        """Its processes that are still there `LATER`."""
        deadline = time.monotonic() + LATER
        while (found := _marked(self.mark)) and time.monotonic() < deadline:
            time.sleep(0.05)
        return found

    def forget(self) -> None:
        """Remove what it said."""
        for path in (self.said, self.started):
            path.unlink(missing_ok=True)

    def error(self) -> str:
        """What it said on standard error."""
        text = self.said.read_text(errors="replace")
        self.forget()
        return text


def _marked(mark: str) -> list[str]:
    found = []
    for path in Path("/proc").glob("[0-9]*"):
        try:
            if f"{MARK}={mark}".encode() in (path / "environ").read_bytes():
                found.append(path.name)
        except OSError:  # it has just ended
            continue
    return found


def judge(tally: Tally, command: Command, code: int | None, began: float, *, lines: int = 1) -> str:
    """Count a trial that should have ended by itself; returns what it said."""
    tally.tried += 1
    tally.worst = max(tally.worst, time.monotonic() - began)
    tally.hung += code is None
    tally.orphan += bool(command.orphans())
    said = command.error()
    noisy = "Traceback" in said or "Error" in said.replace("softlube:", "") or len(said.splitlines()) > lines
    tally.traceback += noisy
    if noisy or code is None:
        print(f"  {tally.kind}: exit code {code}: {said.strip()[-600:]}", flush=True)
    return said


def stored(store: Path) -> dict[str, int]:
    """How often each problem was solved; read only, as others may write."""
    if not store.exists():
        return {}
    connection = sqlite3.connect(f"{store.as_uri()}?mode=ro", uri=True, timeout=30)
    try:
        return dict(connection.execute("SELECT key, count(*) FROM log GROUP BY key"))
    except sqlite3.OperationalError:  # not yet made
        return {}
    finally:
        connection.close()


def plan(folder: Path, count: int = COUNT, *, accuracy: float = 2e-2, first: float = 30.0, last: float = 3e3) -> Path:
    """A plan of cheap cases."""
    path = folder / "plan.toml"
    path.write_text(PLAN.format(accuracy=accuracy, first=first, last=last, count=count), encoding="utf-8")
    return path


def undisturbed(folder: Path) -> bytes:
    """The table of the plan in a folder, without any fault."""
    command = Command(["sweep", "plan.toml", "--store", "whole.sweep", "--output", "whole.csv", "--workers", "1"], folder)
    code = command.wait(600)
    if code:
        raise SystemExit(f"the undisturbed sweep ended with {code}: {command.error()}")
    command.forget()
    return (folder / "whole.csv").read_bytes()


def check(tally: Tally, folder: Path, whole: bytes, *options: str, inflight: int = 0) -> None:
    """Take up the sweep of a folder; its table must be whole, and no problem solved twice but those in flight."""
    before = stored(folder / "store.sweep")
    command = Command(["sweep", "plan.toml", "--store", "store.sweep", "--output", "table.csv", *options], folder)
    code = command.wait(600)
    tally.hung += code is None
    said = command.error()
    after = stored(folder / "store.sweep")
    again = sum(after.get(key, 0) - count for key, count in before.items())
    if code or (folder / "table.csv").read_bytes() != whole or again > inflight or any(key not in after for key in before):
        tally.lost += 1
        print(f"  {tally.kind}: taken up with exit code {code}, {again} solved again; {said[-500:]}", flush=True)


# --- a cluster --------------------------------------------------------------------------------------------------------


class Cluster:
    """A Dask scheduler and workers as processes."""

    def __init__(self, folder: Path, workers: int) -> None:
        self.folder = folder
        self.file = folder / f"scheduler-{time.monotonic_ns()}.json"
        self.scheduler = self._start("scheduler", "--port", "0", "--host", "127.0.0.1")
        while not self.file.exists():
            time.sleep(0.05)
        import json

        self.address = str(json.loads(self.file.read_text())["address"])
        self.workers = [self.join() for _ in range(workers)]

    def _start(self, what: str, *options: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", f"distributed.cli.dask_{what}", *options, "--no-dashboard"]
        environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        return subprocess.Popen(
            [*command, "--scheduler-file", str(self.file)],
            cwd=self.folder,
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def join(self) -> subprocess.Popen[bytes]:
        """Another worker."""
        return self._start("worker", "--nthreads", "1", "--no-nanny")

    def close(self) -> None:
        """End all."""
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()


# --- kills ------------------------------------------------------------------------------------------------------------


def kills(quick: bool) -> Iterator[Tally]:
    """SIGKILLs of solving sweeps."""
    each = 2 if quick else 25
    for where in ("local", "Dask"):
        for processes in (1, 2):
            yield _killed(
                Tally(f"SIGKILL, {where}, {processes} process{'es' if processes > 1 else ''}"), where, processes, each
            )


def _killed(tally: Tally, where: str, processes: int, kills: int) -> Tally:
    chance = random.Random(processes)
    with _folder() as folder:
        cluster = Cluster(folder, 1) if where == "Dask" else None
        options = ["--scheduler", cluster.address] if cluster is not None else ["--workers", "1"]
        plan(folder)
        whole = undisturbed(folder)
        store = folder / "store.sweep"
        while tally.tried < kills:
            for each in folder.glob("store.sweep*"):  # done: begin again
                each.unlink()
            while tally.tried < kills:
                at = sum(stored(store).values())
                target = at + chance.randint(1, 8)
                arguments = ["sweep", "plan.toml", "--store", "store.sweep", "--output"]
                both = [Command([*arguments, f"{number}.csv", *options], folder) for number in range(processes)]
                while sum(stored(store).values()) < target and both[0].process.poll() is None:
                    time.sleep(0.02)
                time.sleep(chance.uniform(0, 0.1))
                alive = both[0].process.poll() is None
                before = stored(store)
                if alive:
                    both[0].process.kill()
                    both[0].process.wait()
                    began = time.monotonic()
                    tally.tried += 1
                    tally.orphan += bool(both[0].orphans())
                    tally.worst = max(tally.worst, time.monotonic() - began)
                for other in both[1:]:
                    code = other.wait(300)  # it goes on, and takes what the killed one was at
                    tally.hung += code is None
                    tally.lost += bool(code) or (folder / "1.csv").read_bytes() != whole
                for each in both:
                    tally.traceback += "Traceback" in each.error()
                after = stored(store)
                tally.lost += any(after.get(key, 0) != count for key, count in before.items())
                if not alive or processes > 1:
                    break
            check(tally, folder, whole, *options)
            if set(stored(store).values()) != {1}:
                tally.lost += 1
                print(f"  {tally.kind}: a problem was solved again after it was stored", flush=True)
        if cluster is not None:
            cluster.close()
    return tally


# --- signals ----------------------------------------------------------------------------------------------------------


def signals(quick: bool) -> Iterator[Tally]:
    """Signals to every command."""
    for name, arguments in COMMANDS.items():
        yield _signalled(Tally(f"signals, {name}"), arguments, 4 if quick else 20)


def _signalled(tally: Tally, arguments: list[str], trials: int) -> Tally:
    chance = random.Random(1)
    kinds = [signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP]
    while tally.tried < trials:
        kind = kinds[tally.tried % len(kinds)]
        with _folder() as folder:
            plan(folder, 200, accuracy=1e-3, last=3e5)
            (folder / "data.csv").write_text(DATA)
            command = Command(arguments, folder)
            while not command.started.exists():  # before, the interpreter starts, and no code of softlube is there to answer
                time.sleep(0.01)
            try:
                command.process.wait(chance.uniform(0.05, 4.0))
                if command.process.returncode not in (0, 3):
                    raise SystemExit(f"{arguments}: ended before the signal: {command.error()}")
                command.forget()
                continue
            except subprocess.TimeoutExpired:
                began = time.monotonic()
            command.process.send_signal(kind)
            code = command.wait()
            said = judge(tally, command, code, began)
            if kind is not signal.SIGKILL:
                left = [path.name for path in folder.rglob("*") if path.name.startswith(".") or path.name.endswith("-wal")]
                if left or (code not in (0, 128 + kind)) or (code and not said):
                    tally.lost += 1
                    print(f"  {tally.kind}: {kind.name}: exit code {code}, left {left}, said {said!r}", flush=True)
    return tally


# --- disks ------------------------------------------------------------------------------------------------------------

LIMIT = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, ({size}, resource.RLIM_INFINITY))"


def disk(quick: bool) -> Iterator[Tally]:
    """Faults of disks."""
    yield _limited(3 if quick else 20)
    yield _full(2 if quick else 5)
    yield _read_only(1 if quick else 3)
    yield _vanished(1 if quick else 3)


def _refused(tally: Tally, command: Command, old: dict[Path, bytes], codes: tuple[int, ...] = (1,)) -> None:
    """One line, an exit code, and the old files as they were."""
    began = time.monotonic()
    code = command.wait(120)
    said = judge(tally, command, code, began)
    changed = [path.name for path, content in old.items() if path.read_bytes() != content]
    if changed or code not in codes or not said.startswith("softlube: "):
        tally.lost += 1
        print(f"  {tally.kind}: exit code {code}, changed {changed}, said {said!r}", flush=True)


def _limited(trials: int) -> Tally:
    """Limits at every size that is written: one in the store, or in its log, or in a file."""
    tally = Tally("disk: limit to the size of files")
    with _folder() as folder:
        plan(folder)
        whole = undisturbed(folder)
        old = {folder / name: b"old" for name in ("o.nc", "o.png", "o.json")}
        for path in old:
            path.write_bytes(b"old")
        sizes = [int(1000 * 1.9**step) for step in range(trials // 2)]
        for size in sizes:
            for each in folder.glob("store.sweep*"):
                each.unlink()
            arguments = ["sweep", "plan.toml", "--store", "store.sweep", "--output", "limited.csv", "--workers", "1"]
            command = Command(arguments, folder, LIMIT.format(size=size))
            code = command.wait(120)
            if code == 0:
                command.forget()
                continue  # it fitted
            began = time.monotonic()
            said = judge(tally, command, code, began)
            if code not in (1, 2) or not said.startswith("softlube: "):
                tally.lost += 1
                print(f"  {tally.kind}: {size} bytes: exit code {code}: {said!r}", flush=True)
            check(tally, folder, whole, "--workers", "1")
        for step in range(trials - trials // 2):
            size = int(500 * 1.6**step)
            output = ("o.nc", "o.png")[step % 2]
            option = "--output" if output == "o.nc" else "--plot"
            arguments = ["solve", "--beta", "100", "--accuracy", "0.02", option, output]
            _refused(tally, Command(arguments, folder, LIMIT.format(size=size)), old)
    return tally


@contextmanager
def _mounted(size: str) -> Iterator[Path | None]:
    """A small file system of its own; None where it cannot be mounted."""
    with _folder() as folder:
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)], capture_output=True)
        try:
            yield folder if done.returncode == 0 else None
        finally:
            if done.returncode == 0:
                subprocess.run(["umount", "-l", str(folder)], check=True)


def _full(trials: int) -> Tally:
    tally = Tally("disk: full file system")
    for trial in range(trials):
        with _mounted("2M") as folder:
            if folder is None:
                tally.kind += " (skipped: no mount)"
                return tally
            plan(folder)
            whole = undisturbed(folder)
            old = {folder / "o.nc": b"old"}
            (folder / "o.nc").write_bytes(b"old")
            ballast = folder / "ballast"
            arguments = ["sweep", "plan.toml", "--store", "store.sweep", "--output", "table.csv", "--workers", "1"]
            with open(ballast, "wb") as stream:
                free = os.statvfs(folder).f_bavail * os.statvfs(folder).f_frsize
                stream.write(bytes(max(free - (8 + 24 * trial) * 4096, 0)))
            _refused(tally, Command(arguments, folder), old, (1, 2))
            with open(ballast, "ab") as stream:
                free = os.statvfs(folder).f_bavail * os.statvfs(folder).f_frsize
                stream.write(bytes(max(free - 4 * 4096, 0)))
            _refused(tally, Command(["solve", "--beta", "100", "--accuracy", "0.02", "--output", "o.nc"], folder), old)
            ballast.unlink()
            check(tally, folder, whole, "--workers", "1")
    return tally


def _read_only(trials: int) -> Tally:
    tally = Tally("disk: read-only")
    for _ in range(trials):
        with _mounted("4M") as folder:
            if folder is None:
                tally.kind += " (skipped: no mount)"
                return tally
            plan(folder)
            whole = undisturbed(folder)
            shutil.copy(folder / "whole.sweep", folder / "store.sweep")
            old = {folder / "store.sweep": (folder / "store.sweep").read_bytes()}
            with _folder() as elsewhere:
                shutil.copy(folder / "plan.toml", elsewhere)
                subprocess.run(["mount", "-o", "remount,ro", str(folder)], check=True)
                for store, output in ((folder / "store.sweep", "t.csv"), ("s.sweep", str(folder / "t.csv"))):
                    arguments = ["sweep", "plan.toml", "--store", str(store), "--output", output, "--workers", "1"]
                    _refused(tally, Command(arguments, elsewhere), old, (1, 2))
                subprocess.run(["mount", "-o", "remount,rw", str(folder)], check=True)
            check(tally, folder, whole, "--workers", "1")
    return tally


def _vanished(trials: int) -> Tally:
    tally = Tally("disk: folder vanishes")
    for _ in range(trials):
        with _folder() as folder:
            (folder / "there").mkdir()
            command = Command(["solve", "--beta", "1e6", "--accuracy", "1e-3", "--output", "there/o.nc"], folder)
            while not command.started.exists():
                time.sleep(0.01)
            time.sleep(0.6)  # the folder has been looked at
            (folder / "there").rmdir()
            _refused(tally, command, {}, (1, 2))
    return tally


# --- Dask -------------------------------------------------------------------------------------------------------------


def dask(quick: bool) -> Iterator[Tally]:
    """Faults of a cluster."""
    trials = 2 if quick else 20
    faults: dict[str, tuple[Callable[[Cluster], None], int]] = {
        "Dask: worker killed, another joins": (_kill_and_join, 2),
        "Dask: single worker replaced": (_kill_and_join, 1),
        "Dask: scheduler killed": (_kill_scheduler, 2),
    }
    for kind, (fault, workers) in faults.items():
        yield _on_cluster(Tally(kind), fault, workers, trials)
    tally = Tally("Dask: address without a route")
    for _ in range(trials):
        with _folder() as folder:
            plan(folder)
            began = time.monotonic()
            command = Command(["sweep", "plan.toml", "--scheduler", "tcp://10.255.255.1:8786"], folder)
            code = command.wait(PROMISE)
            judge(tally, command, code, began)
            tally.lost += code != 2
    yield tally


def _kill_and_join(cluster: Cluster) -> None:
    cluster.workers[0].kill()
    cluster.workers[0].wait()
    cluster.workers[0] = cluster.join()


def _kill_scheduler(cluster: Cluster) -> None:
    cluster.scheduler.kill()
    cluster.scheduler.wait()


def _on_cluster(tally: Tally, fault: Callable[[Cluster], None], workers: int, trials: int) -> Tally:
    chance = random.Random(2)
    with _folder() as folder:
        plan(folder)
        whole = undisturbed(folder)
        while tally.tried < trials:
            cluster = Cluster(folder, workers)
            try:
                for each in (*folder.glob("store.sweep*"), *folder.glob("faulty.csv")):
                    each.unlink()
                arguments = ["sweep", "plan.toml", "--store", "store.sweep", "--output", "faulty.csv"]
                command = Command([*arguments, "--scheduler", cluster.address], folder)
                target = chance.randint(1, COUNT - 5)
                while len(stored(folder / "store.sweep")) < target and command.process.poll() is None:
                    time.sleep(0.02)
                if command.process.poll() is not None:
                    raise SystemExit(f"{tally.kind}: ended before the fault: {command.error()}")
                time.sleep(chance.uniform(0, 0.05))
                fault(cluster)
                began = time.monotonic()
                code = command.wait(HANG if fault is _kill_and_join else PROMISE)
                judge(tally, command, code, began)
                finished = fault is _kill_and_join
                right = code == (0 if finished else 1)
                if not right or (finished and (folder / "faulty.csv").read_bytes() != whole):
                    tally.lost += 1
                    print(f"  {tally.kind}: exit code {code}", flush=True)
            finally:
                cluster.close()
            check(tally, folder, whole, "--workers", "1")
    return tally


# --- all of it --------------------------------------------------------------------------------------------------------


@contextmanager
def _folder() -> Iterator[Path]:
    folder = Path(tempfile.mkdtemp(prefix="softlube-faults-"))
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


KINDS = {"kills": kills, "signals": signals, "disk": disk, "dask": dask}


def main() -> int:
    """Parse, run and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", metavar="kind", help=f"of {', '.join(KINDS)}; all if none is given")
    parser.add_argument("--quick", action="store_true", help="a few trials of each kind")
    options = parser.parse_args()
    for number in (signal.SIGINT, signal.SIGHUP):  # a shell in the background, or nohup, has them ignored: also by the commands
        signal.signal(number, signal.default_int_handler)
    tallies = []
    for name in options.kinds or KINDS:
        for tally in KINDS[name](options.quick):
            tallies.append(tally)
            print(tally.line(), flush=True)
    print("\n" + head())
    for tally in tallies:
        print(tally.line())
    return int(any(tally.bad for tally in tallies))


if __name__ == "__main__":
    sys.exit(main())
