"""Make the synthetic friction data of the examples: no measurement, but the shape of one.

72 combinations of load (18.6 to 238.1 mN) and sliding speed (0.025 to 1 mm/s) of a rigid sphere of R = 2 mm on a substrate of E
= 3 MPa in a liquid of 2 Pa s, as in section 3.5 of Wu, Moyle, Jagota & Hui (2020), whose measured numbers are not printed.
Friction is that of softlube's own solutions (the whole horizontal force on the sphere, within two radii of the dry contact)
times log-normal noise of 5 %.

    python examples/synthetic_friction.py examples/data/synthetic_friction.csv
"""

from __future__ import annotations

import sys

import numpy as np

from softlube import Measurements
from softlube.experiments.friction_model import Model, make_model

VISCOSITY = 2.0
YOUNG_MODULUS = 3e6
RADIUS = 2e-3
NOISE = 0.05
LOADS = np.geomspace(18.6e-3, 238.1e-3, 6)
SPEEDS = np.geomspace(0.025e-3, 1e-3, 12)


def true_friction() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Loads, speeds and friction without noise, in SI, 72 of each."""
    load, speed = (grid.ravel() for grid in np.meshgrid(LOADS, SPEEDS, indexing="ij"))
    model: Model = make_model(
        Measurements.from_arrays(load, speed, np.ones(load.size)),
        radius=RADIUS,
        young_modulus=YOUNG_MODULUS,
        viscosity=VISCOSITY,
    )
    values = {"viscosity": VISCOSITY, "young_modulus": YOUNG_MODULUS, "friction_offset": 0.0}
    return load, speed, model.cover(values, 2.0, None).friction(values)


def noisy(friction: np.ndarray, seed: int) -> np.ndarray:
    """Friction with noise in proportion to it."""
    return friction * np.exp(NOISE * np.random.default_rng(seed).standard_normal(friction.size))


def main(path: str, seed: int = 2020) -> None:
    """Write the table."""
    load, speed, friction = true_friction()
    rows = zip(load, speed, noisy(friction, seed), strict=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write("# SYNTHETIC data, not measured: made by examples/synthetic_friction.py from softlube's own solutions\n")
        file.write(f"# true values: viscosity {VISCOSITY:g} Pa s, E = 3 MPa, R = 2 mm; noise {NOISE:.0%}, seed {seed}\n")
        file.write("load [mN], speed [mm/s], friction [mN]\n")
        file.writelines(f"{1e3 * n:.1f}, {1e3 * v:.5f}, {1e3 * f:.5f}\n" for n, v, f in rows)


if __name__ == "__main__":
    main(*sys.argv[1:2])
