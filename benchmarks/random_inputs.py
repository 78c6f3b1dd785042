"""Random sound inputs through the solver: each must converge to its accuracy or refuse with a reason.

    python benchmarks/random_inputs.py --cases 200 --seed 1

β from 1 to 10⁴, indentation or load, both cavitation settings, random sizes and units.  Each result is checked: film positive,
pressure not negative under the Reynolds condition, load between those of its neighbours in β (a smooth curve of 25 solutions
interpolated).  Any other exception, or a wrong number, ends with exit code 1.
"""

from __future__ import annotations

import argparse
import sys
import time

import numpy as np
from scipy.interpolate import CubicSpline

import softlube

CHECKED = ("load", "film_center", "film_min", "friction_domain", "pressure_max")
TOLERANCE = 0.01


def random_contact(rng: np.random.Generator) -> softlube.Contact:
    """A contact whose β lies between 1 and 10⁴."""
    radius = 10 ** rng.uniform(-4, -1)
    modulus = 10 ** rng.uniform(3, 7)
    viscosity = 10 ** rng.uniform(-3, 2)
    depth = radius * 10 ** rng.uniform(-4, -1.2)
    beta = 10 ** rng.uniform(0, 4)
    speed = (2 / 3) * depth**2 / radius * np.pi * modulus / (viscosity * beta)
    given = {
        "radius": f"{radius * 1e3} mm",
        "viscosity": f"{viscosity * 1e3} mPa s",
        "speed": f"{speed * 1e6} um/s",
        "cavitation": str(rng.choice(["reynolds", "none"])),
    }
    given |= {"young_modulus": f"{3 * modulus / 1e3} kPa"} if rng.random() < 0.5 else {"shear_modulus": float(modulus)}
    load = 16 / 3 * modulus * depth * np.sqrt(radius * depth)
    given |= {"indentation": f"{depth * 1e6} um"} if rng.random() < 0.5 else {"load": f"{load * 1e3} mN"}
    return softlube.Contact(**given)


def master_curves(cavitation: str) -> CubicSpline:
    """Logarithms of the checked quantities against ln β."""
    log_beta = np.linspace(np.log(0.35), np.log(1.5e4), 25)
    values = []
    for x in log_beta:
        solution = softlube.solve(beta=float(np.exp(x)), cavitation=cavitation)
        values.append([np.log(solution.quantities[name]) for name in CHECKED])
    return CubicSpline(log_beta, values)


def main() -> int:
    """Run the cases; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    curves = {cavitation: master_curves(cavitation) for cavitation in ("reynolds", "none")}
    converged, refused, wrong, began = 0, 0, 0, time.perf_counter()
    for case in range(options.cases):
        contact = random_contact(rng)
        try:
            solution = contact.solve()
        except softlube.NotConvergedError as error:
            refused += 1
            print(f"case {case} refused ({contact.problem()}): {error}")
            continue
        converged += 1
        expected = np.exp(curves[contact.cavitation](np.log(solution.beta)))
        found = np.array([solution.quantities[name] for name in CHECKED])
        sound = solution.fields.film.min() > 0 and (contact.cavitation == "none" or solution.fields.pressure.min() >= 0)
        if not sound or np.max(np.abs(found / expected - 1)) > TOLERANCE:
            wrong += 1
            print(f"case {case} WRONG: beta = {solution.beta:.6g}, relative to the curve {found / expected - 1}")
    print(
        f"{options.cases} cases, seed {options.seed}: {converged} converged, {refused} refused, {wrong} wrong, "
        f"{time.perf_counter() - began:.0f} s"
    )
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
