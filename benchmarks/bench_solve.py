"""Speed: of a solve in a warm process, on layers, of the installed command from cold, of a sweep; cost against unknowns.

    OPENBLAS_NUM_THREADS=1 python benchmarks/bench_solve.py

Medians of several runs; "first" is the first solve of a process at that β, which builds the elastic operators.  On layers (of
a thickness t over √(R|h₀|)) times are given over those of the half-space, one solve of each in turn: "anew" with everything
built for every solve, the table of the kernel too.  The sweep takes 60 values of β_load from 10⁻⁴ to 10⁸ in two processes.
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
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

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
    from softlube.discretization.system import forget_operators

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


def cost(beta: float) -> tuple[list[tuple[int, float, float]], float, float]:
    """Unknowns and seconds of processor time, for the operators and for Newton's method, grid by grid; their exponents."""
    from softlube.discretization.system import ContactSystem, forget_operators
    from softlube.model.problem import Problem
    from softlube.solvers.newton import newton
    from softlube.steady.ladder import ladder_of
    from softlube.steady.level import prolong
    from softlube.steady.mesh import grid_for
    from softlube.steady.regime import Regime

    problem, rows, x, coarse = Problem(beta=beta), [], None, None
    regime = Regime.of(problem)
    forget_operators()
    for n_theta in ladder_of(regime)[:-1]:
        grid = grid_for(regime, n_theta)
        began = time.process_time()
        system = ContactSystem(problem, grid, regime.unit)
        built = time.process_time()
        x = newton(system, system.start() if x is None or coarse is None else prolong(x, coarse, grid, regime)).x
        rows.append((grid.n_unknown, built - began, time.process_time() - built))
        coarse = grid
    unknowns, building, solving = np.log(np.array(rows)[1:]).T
    return rows, float(np.polyfit(unknowns, building, 1)[0]), float(np.polyfit(unknowns, solving, 1)[0])


THICKNESSES = (3.0, 1.0, 0.3)


def layers(beta: float, repeats: int) -> tuple[dict[float, float], dict[float, float], tuple[float, float]]:
    """Median processor time on layers over the half-space's, warm and anew, and the half-space's own in seconds."""
    import softlube
    from softlube import dry
    from softlube.discretization.system import forget_operators
    from softlube.model.substrates import layer

    cases = {np.inf: {}} | {t: {"substrate": layer.LayerKernel(t)} for t in THICKNESSES}
    caches = (dry.dry_contact, dry.dry_contact_at, layer._remainder_table, layer._spectrum)
    times: dict[bool, dict[float, list[float]]] = {anew: {t: [] for t in cases} for anew in (False, True)}
    for _ in range(repeats):
        for thickness, arguments in cases.items():
            forget_operators()
            for cache in caches:
                cache.cache_clear()
            for anew in (True, False):
                began = time.process_time()
                softlube.solve(beta=beta, **arguments)
                times[anew][thickness].append(time.process_time() - began)
    warm, anew = ({t: statistics.median(each) for t, each in times[key].items()} for key in (False, True))
    over = [{t: each[t] / each[np.inf] for t in THICKNESSES} for each in (warm, anew)]
    return over[0], over[1], (warm[np.inf], anew[np.inf])


def solve_by_load(beta_load: float) -> str | None:
    """The message of a refusal, if it is one."""
    import softlube

    try:
        softlube.solve(beta_load=beta_load)
    except softlube.NotConvergedError as error:
        return str(error)
    return None


def sweep(processes: int = 2, points: int = 60) -> tuple[float, list[str]]:
    """Wall seconds of a sweep over β_load, start of the processes included, and what was refused."""
    began = time.perf_counter()
    with ProcessPoolExecutor(processes) as pool:
        refused = [line for line in pool.map(solve_by_load, np.geomspace(1e8, 1e-4, points)) if line]
    return time.perf_counter() - began, refused


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="two runs each, up to beta = 1e4, no sweep")
    quick = parser.parse_args().quick
    repeats = 2 if quick else 7
    print(f"threads: {os.environ.get('OPENBLAS_NUM_THREADS', 'all')}")
    seconds, megabytes = cold(repeats)
    print(f"softlube {' '.join(COMMAND[:3])} …, cold: {seconds:.2f} s wall, {megabytes:.0f} MB")
    print(f"{'beta':>8s} {'first [s]':>10s} {'warm [s]':>9s} {'unknowns':>9s}")
    for beta in (10.0, 100.0, 1e3, 1e4) if quick else (0.1, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8):
        first, again, unknowns = warm(beta, repeats)
        print(f"{beta:8.3g} {first:10.3f} {again:9.3f} {unknowns:9d}")
    print(f"{'beta':>8s} {'half-space [s]':>15s}  times that on layers of t = " + ", ".join(map(str, THICKNESSES)))
    for beta in (1e2, 1e3):
        again, anew, own = layers(beta, 3 if quick else 11)
        for name, ratios, seconds in (("warm", again, own[0]), ("anew", anew, own[1])):
            print(f"{beta:8.3g} {name:>7s} {seconds:7.3f}  " + "  ".join(f"{ratio:.2f}" for ratio in ratios.values()))
    for beta in (1e3,) if quick else (1e3, 1e6):
        rows, building, solving = cost(beta)
        print(f"beta = {beta:g}: {'unknowns':>9s} {'operators [s]':>14s} {'Newton [s]':>11s}")
        for unknowns, built, solved in rows:
            print(f"{'':12s} {unknowns:9d} {built:14.3f} {solved:11.3f}")
        print(f"{'':12s} cost ~ unknowns^{building:.2f} and unknowns^{solving:.2f}")
    if not quick:
        seconds, refused = sweep()
        print(f"60 values of beta_load from 1e-4 to 1e8 on two processes: {seconds:.1f} s wall, {len(refused)} refused")
        for line in refused:
            print(f"  {line}")


if __name__ == "__main__":
    main()
