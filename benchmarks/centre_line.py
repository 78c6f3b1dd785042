"""The table behind `softlube.theory.centre_line`: film and pressure along the centre line, solved and written as CSV.

    python benchmarks/centre_line.py src/softlube/theory/data/centre_line.csv

Four loads to the decade from β_load = 10⁻⁴ to 10⁸, eight from 0.1 to 100 and sixteen from 3 to 13, where the sphere begins to
dip in, under both conditions of cavitation.  A minute on one core.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from softlube.steady.solve import solve
from softlube.theory import master_curve
from softlube.theory.centre_line import STEP, places

EXPONENTS = np.unique(np.concatenate([np.arange(-4, 8.1, 1 / 4), np.arange(-1, 2.1, 1 / 8), np.arange(0.5, 1.15, 1 / 16)]))


def lines(beta_load: float, cavitation: str) -> list[str]:
    """Two lines of the table: cavitation, field, β_load, and a whole number for each place."""
    fields = solve(beta_load=beta_load, cavitation=cavitation, budget=600).fields
    center, highest = (
        float(master_curve.evaluate(name, beta_load=beta_load, cavitation=cavitation)[0])
        for name in ("film_center", "pressure_max")
    )
    x = places(beta_load, center)
    r, theta = np.abs(x), np.where(x > 0, 0.0, np.pi)
    values = {"film": np.log(fields.film_at(r, theta) / center), "pressure": fields.pressure_at(r, theta) / highest}
    return [
        ",".join([cavitation, name, f"{beta_load:.10g}", *(f"{round(each / STEP)}" for each in value)])
        for name, value in values.items()
    ]


def main() -> int:
    """Solve and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path", type=Path)
    options = parser.parse_args()
    written: list[str] = []
    loads = 10.0**EXPONENTS
    for cavitation in ("none", "reynolds"):
        for done, load in enumerate(loads, 1):
            written += lines(float(load), cavitation)
            print(f"\r{cavitation} {done}/{len(loads)}", end="", file=sys.stderr, flush=True)
    options.path.write_text("\n".join(written) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
