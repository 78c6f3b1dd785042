"""Random sound inputs through the solver: each must converge to its accuracy or refuse with a reason.

    python benchmarks/random_inputs.py --cases 1000 --seed 1

β_load from 10⁻⁴ to 10⁸, loads, indentations and gaps, both cavitation settings, random sizes and units.  Each result is
checked: film positive, pressure not negative under the Reynolds condition, and every quantity of `CHECKED`, normalised with
the load, next to the master curve (`softlube.curve`).  Any other exception, or a wrong number, ends with exit code 1.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
import warnings
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from functools import partial

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

import softlube
from softlube import curve
from softlube.discretization.measure import measure

CHECKED = ("film_center", "film_min", "film_inlet", "friction_domain", "pressure_max", "pressure_gradient_inlet")
TOLERANCE = 0.005
"""Largest difference from the curve beside the two errors."""


def random_contact(seed: int, case: int) -> softlube.Contact:
    """A contact whose β, by load or by height, lies between 10⁻⁴ and 10⁸."""
    rng = np.random.default_rng([seed, case])
    radius = 10 ** rng.uniform(-4, -1)
    modulus = 10 ** rng.uniform(3, 7)
    viscosity = 10 ** rng.uniform(-3, 2)
    depth = radius * 10 ** rng.uniform(-4, -1.2)
    beta = 10 ** rng.uniform(-4, 8)
    speed = (2 / 3) * depth**2 / radius * np.pi * modulus / (viscosity * beta)
    given = {
        "radius": f"{radius * 1e3} mm",
        "viscosity": f"{viscosity * 1e3} mPa s",
        "speed": f"{speed * 1e6} um/s",
        "cavitation": str(rng.choice(["reynolds", "none"])),
    }
    given |= {"young_modulus": f"{3 * modulus / 1e3} kPa"} if rng.random() < 0.5 else {"shear_modulus": float(modulus)}
    load = 16 / 3 * modulus * depth * np.sqrt(radius * depth)
    kind = rng.choice(["load", "indentation", "gap", "touching"], p=[0.6, 0.25, 0.1, 0.05])
    if kind == "load":
        given["load"] = f"{load * 1e3} mN"
    else:
        given["indentation"] = f"{ {'indentation': depth, 'gap': -depth, 'touching': 0.0}[kind] * 1e6 } um"
    return softlube.Contact(**given)


def verdict(seed: int, case: int) -> tuple[str, str]:
    """What came of one case, in a word and in a line."""
    contact = random_contact(seed, case)
    warnings.simplefilter("ignore", softlube.ValidityWarning)  # inputs at random are often outside the model
    try:
        solution = contact.solve()
    except softlube.NotConvergedError as error:
        return "refused", f"{contact.problem()}: {error}"
    fields = solution.fields
    if fields.film.min() <= 0 or (contact.cavitation == "reynolds" and fields.pressure.min() < 0):
        return "WRONG", f"{contact.problem()}: film or pressure negative"
    if not 1e-4 < solution.beta_load < 1e8:
        return "off the curve", f"{contact.problem()}: beta_load = {solution.beta_load:.3g}"
    by_load = fields.in_units(np.sqrt(solution.beta_load / fields.beta))
    found = measure(by_load)
    for name in CHECKED:
        expected, error = curve.evaluate(name, beta_load=solution.beta_load, cavitation=contact.cavitation)
        allowed = (
            TOLERANCE * abs(expected) + error + abs(expected) * solution.quantities[name].error / abs(solution.quantities[name])
        )
        if not abs(found[name] - expected) <= allowed:
            return "WRONG", f"{contact.problem()}: {name} = {found[name]:.6g} and not {float(expected):.6g}"
    return "converged", ""


def main() -> int:
    """Run the cases; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args()
    counts: Counter[str] = Counter()
    began = time.perf_counter()
    with ProcessPoolExecutor(options.processes) as pool:
        verdicts = pool.map(partial(verdict, options.seed), range(options.cases))
        for case, (word, line) in enumerate(verdicts):
            counts[word] += 1
            if word != "converged":
                print(f"\rcase {case} {word}: {line}")
            print(f"\r{case + 1}/{options.cases}", end="", file=sys.stderr, flush=True)
    summary = ", ".join(f"{count} {word}" for word, count in counts.items())
    print(f"\r{options.cases} cases, seed {options.seed}: {summary}; {time.perf_counter() - began:.0f} s")
    return 1 if counts["WRONG"] else 0


if __name__ == "__main__":
    sys.exit(main())
