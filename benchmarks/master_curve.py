"""The table behind `softlube.curve`: every quantity with its error at some hundred β, solved and written as CSV.

    python benchmarks/master_curve.py src/softlube/theory/data/master_curve.csv

Loads from β_load = 10⁻⁴ to 10⁸, eight to the decade, give the curves normalised by the load.  Their indentations, as far as
the sphere dips in at β ≥ 1000, and indentations from β = 10⁻⁴ to 10³ give those normalised by the indentation.  Grids of up
to 61 angular intervals whatever the accuracy.  Ten minutes on two cores.
"""

from __future__ import annotations

import argparse
import csv
import os
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from softlube.discretization.system import forget_operators
from softlube.model.problem import Problem
from softlube.model.quantities import STEADY
from softlube.steady.ladder import climb, solution_of
from softlube.steady.regime import Regime

PER_DECADE = 8
FINEST = 61
DIPPED = 1e3
"""β from which the solutions by load serve for the curves by indentation too."""

Row = dict[str, str | float]


def problems() -> Iterator[Problem]:
    """All that is solved, slowest first."""
    exponents = np.arange(8 * PER_DECADE, -4 * PER_DECADE - 1, -1) / PER_DECADE
    for exponent in exponents:
        for cavitation in ("reynolds", "none"):
            yield Problem(beta_load=float(10**exponent), cavitation=cavitation)  # type: ignore[arg-type]
            if 10**exponent < 0.99 * DIPPED:
                yield Problem(beta=float(10**exponent), cavitation=cavitation)  # type: ignore[arg-type]


def rows_of(problem: Problem) -> list[Row]:
    """One line for each normalisation that the solution serves."""
    rungs = []
    for rung in climb(Regime.of(problem)):
        rungs.append(rung)
        if rung.grid.n_theta >= FINEST:
            break
    forget_operators()
    solution = solution_of(Regime.of(problem), rungs, np.nan)
    families = {"load" if problem.load_controlled else "indentation": (problem.parameter, solution.quantities)}
    if problem.load_controlled and solution.other_quantities and solution.beta >= DIPPED:
        families["indentation"] = (solution.beta, solution.other_quantities)
    rows: list[Row] = []
    for normalisation, (beta, quantities) in families.items():
        row: Row = {"cavitation": problem.cavitation, "normalisation": normalisation, "beta": f"{beta:.10g}"}
        for name in STEADY:
            row[name] = f"{float(quantities[name]):.9g}"
            row[f"{name}_error"] = f"{quantities[name].error:.2g}"
        rows.append(row)
    return rows


def main() -> int:
    """Solve and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path", type=Path)
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args()
    rows: list[Row] = []
    with ProcessPoolExecutor(options.processes) as pool:
        futures = [pool.submit(rows_of, problem) for problem in problems()]
        for done, future in enumerate(as_completed(futures), 1):
            rows += future.result()
            print(f"\r{done}/{len(futures)}", end="", file=sys.stderr, flush=True)
    rows.sort(key=lambda row: (str(row["cavitation"]), str(row["normalisation"]), float(row["beta"])))
    options.path.parent.mkdir(parents=True, exist_ok=True)
    with options.path.open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
