"""Do starts of sliding end in what `softlube.solve` says of steady sliding?  Makes the tables of docs/notes/squeeze.md.

OPENBLAS_NUM_THREADS=1 python benchmarks/long_time_limit.py
"""

from __future__ import annotations

from dataclasses import replace

import softlube
from softlube.discretization.measure import measure
from softlube.model.exact import HERTZ_LOAD
from softlube.model.liquids import BarusLaw, NewtonianLaw
from softlube.model.substrates import HalfSpaceKernel, LayerKernel
from softlube.transient.motion import constant_load
from softlube.transient.sliding.integrate import start_sliding

CASES = [
    (1.0, HalfSpaceKernel(), NewtonianLaw()),
    (1000.0, HalfSpaceKernel(), NewtonianLaw()),
    (3e4, HalfSpaceKernel(), NewtonianLaw()),
    (100.0, LayerKernel(1.0), NewtonianLaw()),
    (100.0, LayerKernel(0.3), NewtonianLaw()),
    (1000.0, LayerKernel(0.3), NewtonianLaw()),
    (1000.0, HalfSpaceKernel(), BarusLaw(5.0)),
    (1000.0, LayerKernel(1.0), BarusLaw(5.0)),
]
COMPARED = ("film_center", "film_min", "friction_contact")
LONG = 8.0
"""Duration over β, after which the liquid has passed through the contact four times."""
SHORTEST = 60.0
"""Duration at least, for the sphere to come down."""


def main() -> None:
    print("β by the load, substrate, liquid: relative difference (error in solve) of " + ", ".join(COMPARED))
    for beta, substrate, liquid in CASES:
        motion = replace(constant_load(HERTZ_LOAD, 1.0, max(LONG * beta, SHORTEST)), substrate=substrate, liquid=liquid)
        late = measure(start_sliding(beta, motion, n_theta=18, tolerance=2e-3).fields[-1])
        steady = softlube.solve(beta_load=beta, substrate=substrate, liquid=liquid).quantities
        row = [f"{abs(late[name] / steady[name] - 1):.1e} ({steady[name].error / abs(steady[name]):.0e})" for name in COMPARED]
        print(f"{beta:g}, {substrate}, {liquid}: {', '.join(row)}", flush=True)


if __name__ == "__main__":
    main()
