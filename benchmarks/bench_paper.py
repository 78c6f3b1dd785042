"""The paper's claim, measured: a 50 × 30 polar mesh against a 100 × 50 Cartesian grid, and the modern solver beside them.

Run ``OPENBLAS_NUM_THREADS=1 python benchmarks/bench_paper.py`` (a minute), with other β as arguments if wanted.  Times are the
processor's, so that other work on the machine does not count.
Errors are relative to the modern solver's at an accuracy of 3e-4.  The Cartesian grid with dense elasticity makes the same
sweeps as with FFT, so its time is taken from the sweeps counted there and the time of 30 of them; ``--full`` runs them all.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import softlube
from softlube.errors import NotConvergedError
from softlube.model.problem import Problem
from softlube.paper.method import solve_cartesian, solve_relaxation
from softlube.paper.method.cartesian import CartesianMesh, CartesianScheme
from softlube.steady.solution import Solution

SHOWN = ("film_center", "film_min", "load", "friction_domain", "pressure_gradient_inlet")
REFERENCE_ACCURACY = 3e-4
POLAR, CARTESIAN, FINE = (50, 30), (100, 50), (200, 100)


def dense_seconds(beta: float, sweeps: int, n_x: int, n_y: int, sample: int = 30) -> float:
    """Time of so many sweeps with the full matrix, its assembly included."""
    began = time.process_time()
    scheme = CartesianScheme(CartesianMesh(n_x, n_y), "dense")
    pressure = scheme.guess()
    scheme.film(pressure)
    assembled = time.process_time()
    for _ in range(sample):
        pressure = scheme.sweep(pressure, scheme.film(pressure), beta, 0.01, floor=0.0)
    return assembled - began + (time.process_time() - assembled) / sample * sweeps


def timed(solve: Callable[[], Solution]) -> tuple[Solution, float]:
    """A solution and its processor time."""
    began = time.process_time()
    solution = solve()
    return solution, time.process_time() - began


def sweeps_of(solution: Solution) -> int:
    """All sweeps of a march, restarts included."""
    return sum(run.count for run in solution.levels[-1].history)  # type: ignore[attr-defined]


def row(name: str, solution: Solution, reference: Solution, seconds: float, sweeps: int | None) -> str:
    """One line of the table."""
    errors = [100 * (solution.quantities[quantity] / reference.quantities[quantity] - 1) for quantity in SHOWN]
    count = "" if sweeps is None else f"{sweeps}"
    return f"| {name} | {count} | {seconds:.2f} | " + " | ".join(f"{error:+.2f}" for error in errors) + " |"


def table(beta: float, full: bool, fine: bool) -> None:
    """Print the table for one β."""
    reference = softlube.solve(beta=beta, accuracy=REFERENCE_ACCURACY)
    print(f"\nβ = {beta:g}\n")
    print("| method | sweeps | time, s | " + " | ".join(f"{name}, %" for name in SHOWN) + " |")
    print("|---" * (3 + len(SHOWN)) + "|")
    problem = Problem(beta=beta)

    def cartesian(n_x: int, n_y: int) -> None:
        try:
            solution, seconds = timed(lambda: solve_cartesian(problem, n_x=n_x, n_y=n_y))
        except NotConvergedError as error:
            print(f"| Cartesian {n_x} × {n_y} | {error} |" + " |" * (1 + len(SHOWN)))
            return
        sweeps = sweeps_of(solution)
        print(row(f"Cartesian {n_x} × {n_y}, FFT", solution, reference, seconds, sweeps), flush=True)
        if (n_x, n_y) == CARTESIAN:
            if full:
                solution, seconds = timed(lambda: solve_cartesian(problem, n_x=n_x, n_y=n_y, elasticity="dense"))
            else:
                seconds = dense_seconds(beta, sweeps, n_x, n_y)
            print(row(f"Cartesian {n_x} × {n_y}, dense", solution, reference, seconds, sweeps), flush=True)

    polar, seconds = timed(lambda: solve_relaxation(problem, n_r=POLAR[0], n_theta=POLAR[1]))
    name = f"polar {POLAR[0]} × {POLAR[1]}"
    print(row(name, polar, reference, seconds, sweeps_of(polar)), flush=True)
    cartesian(*CARTESIAN)
    if fine:
        cartesian(*FINE)
    for accuracy in (1e-2, 1e-3):
        modern, seconds = timed(lambda accuracy=accuracy: softlube.solve(beta=beta, accuracy=accuracy))
        print(row(f"softlube.solve, accuracy {accuracy:g}", modern, reference, seconds, None), flush=True)


def main() -> None:
    """Print a table for each β."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("beta", nargs="*", type=float, default=[100.0, 1000.0])
    parser.add_argument("--full", action="store_true", help="run the dense Cartesian case to its end")
    parser.add_argument("--fine", action="store_true", help=f"add a {FINE[0]} x {FINE[1]} Cartesian grid")
    chosen = parser.parse_args()
    for beta in chosen.beta:
        table(beta, chosen.full, chosen.fine)


if __name__ == "__main__":
    main()
