"""Grid-converged values: the yardstick of the other benchmarks and of the accuracy tests.

    python benchmarks/fine_grid.py tests/verification/reference.json

solves the cases of `CASES` on grids whose layer, angles, reach and proportions differ from the solver's own, and writes every
quantity with what moving the grid by half a cell changes as its uncertainty.  Some ten minutes.
"""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from softlube.discretization.system import forget_operators
from softlube.model.problem import Problem
from softlube.steady.level import solve_level
from softlube.steady.mesh import angles_for, grid_for
from softlube.steady.refinements import refinements_for
from softlube.steady.regime import Regime

CASES = [
    *(Problem(beta_load=beta) for beta in (1e-3, 0.1, 1.0, 3.0, 4.5, 10.0)),
    *(Problem(beta=beta) for beta in (10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4)),
    *(Problem(beta_load=beta) for beta in (1e5, 1e6, 1e8)),
    *(Problem(beta_load=beta, cavitation="none") for beta in (1e-3, 1.0)),
    *(Problem(beta=beta, cavitation="none") for beta in (10.0, 300.0, 1e4, 1e6)),
]


def reference(problem: Problem, n_theta: int = 60) -> dict[str, tuple[float, float]]:
    """Quantities on two fine grids that share nothing with the solver's but the equations: means, and half their differences.

    The second is the first moved by half a cell, so that the free boundary falls elsewhere between the nodes.
    """
    regime, solved = Regime.of(problem), None
    for n in (18, 30, n_theta):
        angles = angles_for(regime, n)
        own = grid_for(regime, angles, [partial(each.adjust, before=solved) for each in refinements_for(regime)])
        grid = replace(own, edge_width=own.edge_width * 0.7, side_width=own.side_width * 0.8, reach=own.reach * 1.3)
        share = own.n_r / own.xi_of(own.reach * own.edge)
        solved = solve_level(
            regime, grid.resized(int(np.ceil(grid.xi_of(grid.reach * grid.edge) * share * 1.2)), angles), solved
        )
    assert solved is not None
    here = solved.level.values
    half_a_cell = solved.grid.d_xi * float(solved.grid.dr_dxi(solved.grid.edge)) / solved.grid.edge / 2
    there = solve_level(replace(regime, unit=regime.unit * (1 + half_a_cell) ** 2), solved.grid, solved).level.values
    forget_operators()  # a gigabyte each
    return {name: ((value + there[name]) / 2, abs(value - there[name]) / 2) for name, value in here.items()}


def main() -> None:
    """Solve the cases and write the file."""
    results = []
    for problem in CASES:
        n_theta = 60 if problem.parameter < 3e4 else 84 if problem.parameter < 1e7 else 48
        finest = reference(problem, n_theta)
        values = {name: {"value": value, "uncertainty": uncertainty} for name, (value, uncertainty) in finest.items()}
        results.append({"problem": problem.to_plain(), "quantities": values})
        print(f"{problem}: film_min = {values['film_min']['value']:.8g}", flush=True)
    Path(sys.argv[1]).write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
