"""A campaign against trust: malformed input for every reader, and sound contacts of every model, in processes that are watched.

    python benchmarks/campaign.py                      # all kinds, 10,000 inputs, hours
    python benchmarks/campaign.py netcdf --count 500   # one kind
    python benchmarks/campaign.py contacts --seed 7 --keep outcomes.jsonl

Each kind makes its inputs from a seed and a number, so that a case can be tried again alone (--first 123 --count 1).  A verdict
is "taken" (read or solved, and right), "refused" (one line that says why), "WRONG" (taken, but an independent check disagrees,
or a message that is no line), "CRASHED" (any other exception, a process that dies) or "HUNG" (longer than the kind's limit).
The table has them all with the worst time, and the worst time and memory of a refusal; the exit code is 1 if one was wrong,
crashed or hung.  Outcomes are kept in a file if one is named, so that a campaign that was interrupted goes on where it was.
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).parent))

VERDICTS = ("taken", "refused", "WRONG", "CRASHED", "HUNG")
Outcome = tuple[str, str, float, float, Mapping[str, int]]
"""Verdict, line, seconds, most memory in MB, and how often each of some things was seen."""


@dataclass(frozen=True)
class Kind:
    """One kind of input.

    Attributes
    ----------
    module : str
        Module of this folder that has `function`.
    function : str
        Name of a function of (seed, number, folder) that tries one case and returns a verdict and a line on it, and perhaps
        the most memory in MB (None where the worker's own counts) and how often each of some things was seen.
    count : int
        Cases of a whole campaign.
    limit : float
        Seconds after which a case hangs.
    """

    module: str
    function: str
    count: int
    limit: float


KINDS = {
    "text": Kind("campaign_readers", "text", 2000, 20),
    "table": Kind("campaign_readers", "table", 1500, 20),
    "history": Kind("campaign_readers", "history", 1000, 20),
    "plan": Kind("campaign_readers", "plan", 1500, 20),
    "netcdf": Kind("campaign_readers", "netcdf_file", 1200, 20),
    "store": Kind("campaign_readers", "store", 500, 60),
    "command": Kind("campaign_readers", "command", 300, 60),
    "contacts": Kind("campaign_contacts", "contact", 2000, 1800),
}
"""Kinds of input.  Faults of disk, processes and workers are kinds of the module `campaign_faults`, where that is there."""
with suppress(ModuleNotFoundError):
    KINDS |= importlib.import_module("campaign_faults").KINDS


@dataclass
class Row:
    """What came of one kind."""

    counts: Counter[str] = field(default_factory=Counter)
    slowest: float = 0.0
    refusal: float = 0.0
    memory: float = 0.0
    seen: Counter[str] = field(default_factory=Counter)

    def add(self, outcome: Outcome) -> None:
        """Count a case."""
        verdict, _, seconds, memory, seen = outcome
        self.counts[verdict] += 1
        self.slowest = max(self.slowest, seconds)
        if verdict == "refused":
            self.refusal, self.memory = max(self.refusal, seconds), max(self.memory, memory)
        self.seen.update(seen)


def memory() -> float:
    """Most memory [MB] that this process and its children have had since `forget`; nan where the system does not say."""
    total = 0
    for process in ["self", *children()]:
        try:
            status = Path(f"/proc/{process}/status").read_text()
        except OSError:
            return float("nan")
        total += next((int(line.split()[1]) for line in status.splitlines() if line.startswith("VmHWM")), 0)
    return total / 1024


def children() -> list[str]:
    """Processes that this one has started."""
    return [each for path in Path("/proc/self/task").glob("*/children") for each in path.read_text().split()]


def forget() -> None:
    """Count the most memory from now on."""
    for process in ["self", *children()]:
        try:
            Path(f"/proc/{process}/clear_refs").write_text("5")
        except OSError:
            return


def work(kind: str, seed: int, folder: str, pipe: Connection) -> None:
    """A process that tries cases: a number in, an outcome out."""
    warnings.simplefilter("ignore")
    module = importlib.import_module(KINDS[kind].module)
    function: Callable[..., tuple[Any, ...]] = getattr(module, KINDS[kind].function)
    getattr(module, "prepare", bool)()
    pipe.send("ready")
    while (number := pipe.recv()) is not None:
        place = Path(tempfile.mkdtemp(dir=folder))
        forget()
        began = time.perf_counter()
        peak, seen = None, {}
        try:
            verdict, line, peak, seen = (*function(seed, number, place), None, {})[:4]
        except BaseException:
            verdict, line = "CRASHED", traceback.format_exc().strip().replace("\n", " | ")[-600:]
        pipe.send((verdict, line, time.perf_counter() - began, memory() if peak is None else peak, seen))


class Worker:
    """A watched process."""

    def __init__(self, kind: str, seed: int, folder: str) -> None:
        self.arguments, self.number, self.began = (kind, seed, folder), -1, 0.0
        self.start()

    def start(self) -> None:
        context = get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=work, args=(*self.arguments, theirs))
        self.process.start()
        theirs.close()
        self.pipe.recv()  # the clock does not run before it is ready

    def give(self, number: int) -> None:
        self.number, self.began = number, time.perf_counter()
        self.pipe.send(number)

    def result(self, limit: float) -> Outcome | None:
        """What came of the case, None while it goes on."""
        seconds = time.perf_counter() - self.began
        try:
            if self.pipe.poll():
                return self.pipe.recv()
        except EOFError:
            self.process.join()
            code = self.process.exitcode
            self.start()
            return "CRASHED", f"the process ended with {code}", seconds, float("nan"), {}
        if seconds > limit:
            self.process.kill()
            self.start()
            return "HUNG", f"more than {limit:g} s", seconds, float("nan"), {}
        return None

    def stop(self) -> None:
        self.pipe.send(None)
        self.process.join(10)
        self.process.kill()


def tried(kind: str, seed: int, numbers: Sequence[int], processes: int) -> Iterator[tuple[int, Outcome]]:
    """Number and outcome of every case."""
    waiting = iter(numbers)
    with tempfile.TemporaryDirectory() as folder:
        workers = [Worker(kind, seed, folder) for _ in range(min(processes, len(numbers)))]
        busy = set()
        for worker in workers:
            worker.give(next(waiting))
            busy.add(worker)
        while busy:
            wait([worker.pipe for worker in busy], timeout=1.0)
            for worker in list(busy):
                if (found := worker.result(KINDS[kind].limit)) is None:
                    continue
                yield worker.number, found
                if (number := next(waiting, None)) is None:
                    busy.remove(worker)
                else:
                    worker.give(number)
        for worker in workers:
            worker.stop()


def kept(path: Path | None, kind: str, seed: int) -> dict[int, Outcome]:
    """Outcomes of a kind that a file of JSON lines has, by their numbers."""
    lines = path.read_text().splitlines() if path and path.exists() else []
    return {number: outcome for *case, number, outcome in map(json.loads, lines) if case == [kind, seed]}


def table(rows: dict[str, Row]) -> str:
    """The rows as text."""
    lines = [f"{'kind':12}{'tried':>7}{''.join(f'{each:>9}' for each in VERDICTS)}{'slowest s':>11}{'refusal s':>11}{'MB':>7}"]
    for kind, row in rows.items():
        counts = "".join(f"{row.counts[each]:9}" for each in VERDICTS)
        lines.append(f"{kind:12}{row.counts.total():7}{counts}{row.slowest:11.2f}{row.refusal:11.2f}{row.memory:7.0f}")
        lines += [f"{count:12d}  {what}" for what, count in sorted(row.seen.items())]
    return "\n".join(lines)


def main() -> int:
    """Run the campaign; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", metavar="kind", help=f"{', '.join(KINDS)} [all]")
    parser.add_argument("--count", type=int, help="cases of each kind [a whole campaign's]")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--keep", type=Path, help="file of JSON lines for the outcomes; what it has is not tried again")
    options: Any = parser.parse_args()
    rows: dict[str, Row] = {}
    for kind in options.kinds or KINDS:
        row = rows.setdefault(kind, Row())
        numbers = range(options.first, options.first + (options.count or KINDS[kind].count))
        known = kept(options.keep, kind, options.seed)
        for number in known.keys() & set(numbers):
            row.add(known[number])
        rest = [number for number in numbers if number not in known]
        for number, outcome in tried(kind, options.seed, rest, options.processes):
            row.add(outcome)
            if options.keep:
                with options.keep.open("a") as file:
                    file.write(json.dumps([kind, options.seed, number, outcome]) + "\n")
            verdict, line, *_ = outcome
            if verdict.isupper():
                print(f"{kind} {number} {verdict}: {line}", flush=True)
            print(f"\r{kind} {row.counts.total()}/{len(numbers)} ", end="", file=sys.stderr, flush=True)
    print("\r" + table(rows))
    return 1 if any(row.counts[each] for row in rows.values() for each in VERDICTS if each.isupper()) else 0


if __name__ == "__main__":
    sys.exit(main())
