"""Grid-converged values: the yardstick of the other benchmarks and of the accuracy tests.

    python benchmarks/fine_grid.py tests/verification/reference.json

solves the cases of `CASES` on grids whose layer, angles, reach and proportions differ from the solver's own, and writes every
quantity with the change from the last coarser grid as its uncertainty.  Some fifteen minutes.
"""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from softlube.discretization.system import forget_operators
from softlube.model.problem import Problem
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime

CASES = [
    *(Problem(beta_load=beta) for beta in (1e-3, 0.1, 1.0, 3.0, 4.5, 10.0)),
    *(Problem(beta=beta) for beta in (10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4)),
    *(Problem(beta_load=beta) for beta in (1e5, 1e6, 1e8)),
    *(Problem(beta_load=beta, cavitation="none") for beta in (1e-3, 1.0)),
    *(Problem(beta=beta, cavitation="none") for beta in (10.0, 300.0, 1e4, 1e6)),
]


def reference(problem: Problem, n_theta: int = 48) -> dict[str, float]:
    """Quantities on a fine grid that shares nothing with the solver's but the equations."""
    regime, solved = Regime.of(problem), None
    for n in (18, 30, n_theta):
        own = grid_for(regime, n)
        grid = replace(own, edge_width=own.edge_width * 0.7, side_width=own.side_width * 0.8, reach=own.reach * 1.3)
        grid = grid.resized(
            int(np.ceil(grid.xi_of(grid.reach * grid.edge) * own.n_r / own.xi_of(own.reach * own.edge) * 1.2)), n
        )
        solved = solve_level(regime, grid, solved)
    assert solved is not None
    values = dict(solved.level.values)
    forget_operators()  # a gigabyte each
    return values


def main() -> None:
    """Solve the cases and write the file."""
    results = []
    for problem in CASES:
        sizes = (40, 60) if problem.parameter < 3e4 else (58, 84) if problem.parameter < 1e7 else (34, 48)
        coarser, finest = (reference(problem, n_theta) for n_theta in sizes)
        values = {name: {"value": value, "uncertainty": abs(value - coarser[name])} for name, value in finest.items()}
        results.append({"problem": problem.to_plain(), "quantities": values})
        print(f"{problem}: film_min = {finest['film_min']:.8g}", flush=True)
    Path(sys.argv[1]).write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
