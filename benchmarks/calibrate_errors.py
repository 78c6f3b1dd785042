"""How true are the error estimates?  Random contacts solved as usual and on a much finer, differently graded grid.

    python benchmarks/calibrate_errors.py --cases 60 --seed 1

Prints, for each quantity, the median and the largest true error of the default solution, how many of the true errors lie below
their estimates (coverage), how much larger than the true error the estimate is (median ratio), and the constant of
`softlube.solver.FREE_BOUNDARY` that these cases call for (90 % of errors times n_theta²).  A few seconds a case.
"""

from __future__ import annotations

import argparse

import numpy as np
from fine_grid import reference

from softlube.problem import Problem
from softlube.quantities import DESCRIPTION
from softlube.solver import FREE_BOUNDARY, estimate_errors, grid_for, prolong, solve_level


def random_problem(rng: np.random.Generator) -> Problem:
    """β from 1 to 3·10⁴, both cavitation settings, indentation and load control."""
    beta = float(10 ** rng.uniform(0, 4.5))
    cavitation = str(rng.choice(["reynolds", "reynolds", "none"]))
    if rng.random() < 0.3:
        return Problem(beta_load=max(beta, 30.0), cavitation=cavitation)  # type: ignore[arg-type]
    return Problem(beta=beta, cavitation=cavitation)  # type: ignore[arg-type]


def main() -> None:
    """Run the cases and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--levels", type=int, nargs="+", default=[12, 18, 26])
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    names = list(DESCRIPTION)
    errors, estimates = np.empty((2, options.cases, len(names)))
    for case in range(options.cases):
        problem = random_problem(rng)
        values, start, coarse = [], None, None
        for n_theta in options.levels:
            grid = grid_for(problem, n_theta)
            solved = solve_level(problem, grid, None if start is None else prolong(start, coarse, grid, problem))
            values.append(solved.level.values)
            start, coarse = solved.x, grid
        exact = reference(problem)
        scale = {name: 1.0 if name.startswith("film_min_") else abs(exact[name]) for name in names}
        estimate = estimate_errors(values, options.levels[-1], problem.cavitation)
        errors[case] = [abs(values[-1][name] - exact[name]) / scale[name] for name in names]
        estimates[case] = [estimate[name] / scale[name] for name in names]
        print(f"\r{case + 1}/{options.cases}", end="", flush=True)

    ratio = estimates / np.maximum(errors, 1e-15)
    print(f"\n\n{options.cases} cases, seed {options.seed}, grids {options.levels}")
    print(f"{'quantity':26s} {'median':>9s} {'largest':>9s} {'covered':>8s} {'ratio':>6s} {'n2 * 90 %':>10s} {'in use':>8s}")
    for k, name in enumerate(names):
        constant = np.percentile(errors[:, k], 90) * options.levels[-1] ** 2
        print(
            f"{name:26s} {np.median(errors[:, k]):9.1e} {errors[:, k].max():9.1e} {np.mean(ratio[:, k] >= 1):8.0%} "
            f"{np.median(ratio[:, k]):6.1f} {constant:10.3f} {FREE_BOUNDARY[name]:8.3f}"
        )
    print(f"{'all':26s} {'':9s} {'':9s} {np.mean(ratio >= 1):8.1%} {np.median(ratio):6.1f}")


if __name__ == "__main__":
    main()
