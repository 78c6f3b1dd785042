"""Errors of every quantity on the solver's nested grids against the grid-converged values, as a table in Markdown.

    python benchmarks/convergence_table.py

The values are those of tests/verification/reference.json (made by benchmarks/fine_grid.py); errors are in units of 10⁻⁵, in
terms of `softlube.steady.error_estimate.yardstick`.  Two minutes.
"""

from __future__ import annotations

import json
from pathlib import Path

from softlube.discretization.system import forget_operators
from softlube.model.problem import Problem
from softlube.steady.error_estimate import yardstick
from softlube.steady.ladder import climb
from softlube.steady.regime import Regime

REFERENCE = Path(__file__).parent.parent / "tests" / "verification" / "reference.json"
FINEST = 39
COLUMNS = {
    "load": "load",
    "height": "height",
    "film_center": "film centre",
    "film_min": "film min",
    "film_inlet": "film inlet",
    "film_outlet_min": "film outlet",
    "pressure_max": "p max",
    "pressure_gradient_inlet": "inlet gradient",
    "boundary_layer": "boundary layer",
    "friction_contact": "friction r≤1",
    "friction_domain": "friction r≤2",
    "shear_rate_max": "max shear",
}


def main() -> None:
    """Print the table."""
    print("| problem | grid | " + " | ".join(COLUMNS.values()) + " |")
    print("|---|---|" + "---|" * len(COLUMNS))
    for case in json.loads(REFERENCE.read_text()):
        problem = Problem.from_plain(case["problem"])
        exact = {name: item["value"] for name, item in case["quantities"].items()}
        label = f"{'β_load' if problem.load_controlled else 'β'} = {problem.parameter:g}"
        label += "" if problem.cavitation == "reynolds" else ", full film"
        for rung in climb(Regime.of(problem)):
            values = rung.level.values
            if rung.grid.n_theta > 12:
                cells = [1e5 * (values[name] - exact[name]) / yardstick(name, exact) for name in COLUMNS]
                print(f"| {label} | {rung.grid.n_r} × {rung.grid.n_theta} | " + " | ".join(f"{c:.1f}" for c in cells) + " |")
            if rung.grid.n_theta >= FINEST:
                break
        doubts = [1e5 * case["quantities"][name]["uncertainty"] / yardstick(name, exact) for name in COLUMNS]
        print(f"| {label} | ± reference | " + " | ".join(f"{doubt:.1f}" for doubt in doubts) + " |", flush=True)
        forget_operators()


if __name__ == "__main__":
    main()
