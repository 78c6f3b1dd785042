"""Speed of a solve in a warm process and of the installed command from cold, with its memory.

    OPENBLAS_NUM_THREADS=1 python benchmarks/bench_solve.py

Medians of several runs; "first" is the first solve of a process at that β, which builds the elastic operators.
"""

from __future__ import annotations

import argparse
import os
import resource
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

COMMAND = [
    "solve",
    "--radius",
    "2 mm",
    "--young-modulus",
    "3 MPa",
    "--viscosity",
    "2 Pa s",
    "--speed",
    "0.1 mm/s",
    "--load",
    "100 mN",
]


def warm(beta: float, repeats: int) -> tuple[float, float, int]:
    """Seconds of processor time of a first and of a warm solve, and unknowns of the finest grid."""
    import softlube
    from softlube.system import forget_operators

    softlube.solve(beta=50)  # imports
    forget_operators()
    began = time.process_time()
    solution = softlube.solve(beta=beta)
    first = time.process_time() - began
    times = []
    for _ in range(repeats if first < 2 else 2):
        began = time.process_time()
        softlube.solve(beta=beta)
        times.append(time.process_time() - began)
    finest = solution.levels[-1]
    return first, statistics.median(times), finest.n_r * (finest.n_theta + 1)


def cold(repeats: int) -> tuple[float, float]:
    """Wall seconds (median) and peak memory in MB of the installed command.

    To be called while this process is small: a child's peak counts what it shared with its parent when it was forked.
    """
    program = shutil.which("softlube") or str(Path(sys.executable).parent / "softlube")
    times = []
    for _ in range(repeats):
        began = time.perf_counter()
        subprocess.run([program, *COMMAND], check=True, stdout=subprocess.DEVNULL)
        times.append(time.perf_counter() - began)
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    return statistics.median(times), peak


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="two runs each, no beta = 1e5")
    quick = parser.parse_args().quick
    repeats = 2 if quick else 7
    print(f"threads: {os.environ.get('OPENBLAS_NUM_THREADS', 'all')}")
    seconds, megabytes = cold(repeats)
    print(f"softlube {' '.join(COMMAND[:3])} …, cold: {seconds:.2f} s wall, {megabytes:.0f} MB")
    print(f"{'beta':>8s} {'first [s]':>10s} {'warm [s]':>9s} {'unknowns':>9s}")
    for beta in (10.0, 100.0, 1e3, 1e4) if quick else (10.0, 100.0, 1e3, 1e4, 1e5):
        first, again, unknowns = warm(beta, repeats)
        print(f"{beta:8.0f} {first:10.3f} {again:9.3f} {unknowns:9d}")


if __name__ == "__main__":
    main()
