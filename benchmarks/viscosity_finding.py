"""What the choice of force, its region and the slab's thickness do to a viscosity fitted to friction (docs/fitting.md).

    python benchmarks/viscosity_finding.py

Synthetic friction without noise, of a liquid of 2 Pa s at the loads and speeds of the paper (section 3.5), is made under one
assumption and fitted under another: the shear on the sphere within two contact radii, which is what Eq. (28) is.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq

from softlube import Measurements, fit
from softlube.experiments.friction_model import PAPER_FIT, make_model

RADIUS, YOUNG_MODULUS, VISCOSITY, THICKNESS = 2e-3, 3e6, 2.0, 2e-3
LOAD, SPEED = (grid.ravel() for grid in np.meshgrid(np.geomspace(18.6e-3, 238.1e-3, 6), np.geomspace(2.5e-5, 1e-3, 12)))


def friction(force: str, region: float, modulus: float = YOUNG_MODULUS, rows: slice | np.ndarray = slice(None)) -> np.ndarray:
    """Friction under one assumption [N]."""
    data = Measurements.from_arrays(LOAD[rows], SPEED[rows], np.ones(LOAD[rows].size))
    model = make_model(data, radius=RADIUS, young_modulus=modulus, viscosity=VISCOSITY, force=force)
    values = {"viscosity": VISCOSITY, "young_modulus": modulus, "friction_offset": 0.0}
    return model.cover(values, region, None).friction(values)


def fitted(measured: np.ndarray, force: str = "sphere", region: float = 2.0) -> tuple[float, float]:
    """Viscosity and scatter of a fit that assumes another."""
    data = Measurements.from_arrays(LOAD, SPEED, measured)
    found = fit(data, radius=RADIUS, young_modulus=YOUNG_MODULUS, force=force, region=region, compare=False)
    return found.values["viscosity"], found.scatter


def hertz(load: float) -> float:
    """Indentation of the half-space, Eq. (29)."""
    return (3 * load / (16 * YOUNG_MODULUS / 3 * math.sqrt(RADIUS))) ** (2 / 3)


def slab(load: float) -> float:
    """Indentation of the bonded incompressible slab (Dimitriadis et al., Biophys. J. 82, 2002)."""

    def too_much(indentation: float) -> float:
        chi = math.sqrt(RADIUS * indentation) / THICKNESS
        stiffer = 1 + 1.133 * chi + 1.283 * chi**2 + 0.769 * chi**3 + 0.0975 * chi**4
        return 16 / 3 * YOUNG_MODULUS / 3 * math.sqrt(RADIUS) * indentation**1.5 * stiffer - load

    return float(brentq(too_much, 1e-8, 1e-3))


def main() -> None:
    """Print the table of the docs."""
    for force in ("sphere", "total"):
        for region in (1.0, 2.0, 3.0, 5.0):
            viscosity, scatter = fitted(friction(force, region))
            print(
                f"truth {force:6} r <= {region:g}: read as sphere, r <= 2: {viscosity:.3f} Pa s, scatter {100 * scatter:.1f} %"
            )
    data = Measurements.from_arrays(LOAD, SPEED, np.ones(LOAD.size))
    model = make_model(data, radius=RADIUS, young_modulus=YOUNG_MODULUS, viscosity=VISCOSITY)
    values = {"viscosity": VISCOSITY, "young_modulus": YOUNG_MODULUS, "friction_offset": 0.0}
    paper = PAPER_FIT[0] * model.beta(values) ** -PAPER_FIT[1] * model.unit(values)
    for region in (2.0, 1.0):
        viscosity, scatter = fitted(paper, region=region)
        print(f"Eq. (28) itself, read as sphere, r <= {region:g}: {viscosity:.3f} Pa s, scatter {100 * scatter:.1f} %")
    # The slab as a half-space whose modulus, at each load, gives the slab's indentation.
    measured = np.empty(LOAD.size)
    for load in np.unique(LOAD):
        rows = load == LOAD
        print(f"slab at {1e3 * load:.1f} mN: indentation {slab(load) / hertz(load):.3f} of the half-space's")
        measured[rows] = friction("sphere", 2.0, YOUNG_MODULUS * (hertz(load) / slab(load)) ** 1.5, rows)
    viscosity, scatter = fitted(measured)
    print(f"truth slab of 2 mm: read as half-space: {viscosity:.3f} Pa s, scatter {100 * scatter:.1f} %")


if __name__ == "__main__":
    main()
