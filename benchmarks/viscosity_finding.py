"""What the choice of force, its region and the slab's thickness do to a viscosity fitted to friction (docs/how-to/fitting.md).

    python benchmarks/viscosity_finding.py

Synthetic friction without noise, of a liquid of 2 Pa s at the loads and speeds of the paper (section 3.5), is made under one
assumption and fitted under another: the shear on the sphere within two contact radii, which is what Eq. (28) is.
"""

from __future__ import annotations

import numpy as np

from softlube import Measurements, fit
from softlube.experiments.friction_model import PAPER_FIT, make_model

RADIUS, YOUNG_MODULUS, VISCOSITY, THICKNESS = 2e-3, 3e6, 2.0, 2e-3
HALF_SPACE = {"radius": RADIUS, "young_modulus": YOUNG_MODULUS}
LOAD, SPEED = (grid.ravel() for grid in np.meshgrid(np.geomspace(18.6e-3, 238.1e-3, 6), np.geomspace(2.5e-5, 1e-3, 12)))


def friction(force: str, region: float, **bodies: object) -> np.ndarray:
    """Friction under one assumption [N]."""
    data = Measurements.from_arrays(LOAD, SPEED, np.ones(LOAD.size))
    model = make_model(data, **HALF_SPACE | bodies, viscosity=VISCOSITY, force=force)
    values = {"viscosity": VISCOSITY, "young_modulus": YOUNG_MODULUS, "friction_offset": 0.0}
    return model.cover(values, region, None).friction(values)


def fitted(measured: np.ndarray, force: str = "sphere", region: float = 2.0, **bodies: object) -> tuple[float, float]:
    """Viscosity and scatter of a fit that assumes another."""
    data = Measurements.from_arrays(LOAD, SPEED, measured)
    found = fit(data, **HALF_SPACE | bodies, force=force, region=region, compare=False)
    return found.values["viscosity"], found.scatter


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
    for force in ("sphere", "total"):
        measured = friction(force, 2.0, thickness=THICKNESS)
        for name, bodies in (("half-space", {}), ("slab", {"thickness": THICKNESS})):
            viscosity, scatter = fitted(measured, force, **bodies)
            print(f"truth {force} on a slab of 2 mm: read as {name}: {viscosity:.3f} Pa s, scatter {100 * scatter:.1f} %")


if __name__ == "__main__":
    main()
