"""How true are the error estimates?  Random contacts solved as usual and on much finer, differently graded grids.

    python benchmarks/calibrate_errors.py --cases 60 --seed 3 [--layers]

β from 10⁻⁴ to 10⁸, loads and indentations, both cavitation settings; or layers, β from 10 to 10⁴.  Prints, for each quantity,
the median and the largest
true error of the default solution (in terms of `softlube.steady.error_estimate.yardstick`), how many of the true errors lie
below their estimates (coverage), and how much larger than the true error the estimate is (median ratio).  Ten seconds a case.
"""

from __future__ import annotations

import argparse
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from fine_grid import reference

from softlube.model.problem import Problem
from softlube.model.quantities import STEADY
from softlube.model.substrates import LayerKernel
from softlube.steady.error_estimate import yardstick
from softlube.steady.solve import solve_problem


def random_layer(rng: np.random.Generator) -> Problem:
    """A contact on a layer, bonded or not, of any Poisson ratio."""
    beta = float(10 ** rng.uniform(1, 4))
    ratio = float(rng.choice([0.5, 0.5, 0.5, 0.45, 0.3, 0.0]))
    base = str(rng.choice(["bonded", "bonded", "bonded", "frictionless"]))
    thinnest = 0.25 if (ratio, base) == (0.5, "bonded") else 0.12
    layer = LayerKernel(float(10 ** rng.uniform(np.log10(thinnest), np.log10(3))), ratio, base)  # type: ignore[arg-type]
    cavitation = str(rng.choice(["reynolds"] * 4 + ["none"]))
    control = "beta_load" if rng.random() < 0.3 else "beta"
    return Problem(**{control: beta}, cavitation=cavitation, substrate=layer)  # type: ignore[arg-type]


def random_problem(seed: int, case: int, layers: bool) -> Problem:
    """One of the cases."""
    rng = np.random.default_rng([seed, case])
    if layers:
        return random_layer(rng)
    beta = float(10 ** rng.uniform(-4, 8))
    cavitation = str(rng.choice(["reynolds", "reynolds", "none"]))
    if rng.random() < 0.6:
        return Problem(beta_load=beta, cavitation=cavitation)  # type: ignore[arg-type]
    return Problem(beta=beta, cavitation=cavitation)  # type: ignore[arg-type]


def compare(seed: int, layers: bool, case: int) -> tuple[list[float], list[float], int]:
    """True errors and estimates of one case, and the angles of its finest grid."""
    problem = random_problem(seed, case, layers)
    solution, exact = solve_problem(problem), reference(problem)
    scales = [yardstick(name, exact) for name in STEADY]
    errors = [abs(solution.quantities[name] - exact[name]) for name in STEADY]
    estimates = [solution.quantities[name].error for name in STEADY]
    divide = np.array(scales)
    return list(errors / divide), list(estimates / divide), solution.levels[-1].n_theta


def main() -> None:
    """Run the cases and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=60)
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--layers", action="store_true")
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args()
    rows = []
    with ProcessPoolExecutor(options.processes) as pool:
        for done, row in enumerate(pool.map(partial(compare, options.seed, options.layers), range(options.cases)), 1):
            rows.append(row)
            print(f"\r{done}/{options.cases}", end="", file=sys.stderr, flush=True)
    errors, estimates = (np.array([row[part] for row in rows]) for part in (0, 1))
    angles, counts = np.unique([row[2] for row in rows], return_counts=True)
    ended = ", ".join(f"{count} at {n}" for n, count in zip(angles, counts, strict=True))
    print(f"\n{options.cases} cases, seed {options.seed}; finest grids: {ended} angular intervals")
    print(f"| {'quantity':22s} | {'median error':>12s} | {'largest':>8s} | {'covered':>8s} | {'ratio':>5s} |")
    print("|---|---|---|---|---|")
    measured = estimates > 0  # prescribed quantities have no error
    ratio = np.where(measured, estimates / np.maximum(errors, 1e-12), np.nan)
    for k, name in enumerate(STEADY):
        own, quotient = errors[measured[:, k], k], ratio[measured[:, k], k]
        covered, middle = np.mean(quotient >= 1), np.median(quotient)
        print(f"| {name:22s} | {np.median(own):12.1e} | {own.max():8.1e} | {covered:8.0%} | {middle:5.1f} |")
    print(f"| {'**all**':22s} | {'':12s} | {'':8s} | {np.nanmean(ratio[measured] >= 1):8.1%} | {np.nanmedian(ratio):5.1f} |")


if __name__ == "__main__":
    main()
