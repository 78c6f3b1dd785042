"""The Petrusevich spike: the crest of the pressure ahead of the outlet, under a liquid that thickens with the pressure."""

from __future__ import annotations

import numpy as np

from softlube.fields import Fields

OUTLET = np.array([np.pi])
SHARPEST = 2.0
"""Fall of ln η from a node to the next along r, in the outlet half, up to which a grid follows the pressure (measured)."""
OPEN_SPIKE = (
    "the pressure has a spike at r = {:.2f} (outlet axis) that is narrower than the finest cells and grows from grid to grid, "
    "so there is no maximum pressure, and nothing that goes by it; the films do not depend on it (docs/viscosity.md)"
)
"""What a solution with such a spike warns of; the radius over the unit of length."""


def outlet_crest(fields: Fields) -> float:
    """Radius on the outlet axis at which the film leaves its plateau: where a spike stands, or will stand as it grows.

    The thickened liquid is carried along like a plate, so the film is flat up to the crest and falls beyond it, towards its
    minimum on the axis: its curvature has an extremum in between, long before the pressure has a maximum there.
    """
    chart = fields.chart
    lowest = np.argmin(np.where(fields.r < 2, fields.film[:, -1], np.inf))
    xi = np.linspace(0.0, float(chart.xi_of(fields.r[lowest])), 400)[1:]
    r = chart.r_of(xi)
    slope = fields.film_spline(xi, OUTLET, dx=1)[:, 0] / chart.dr_dxi(r)
    return float(r[np.argmin(np.gradient(slope, r))])


def is_open(fields: Fields) -> bool:
    """Whether the grid does not resolve the pressure's fall towards the outlet: a spike is a needle on one node then."""
    outlet = fields.pressure[:, fields.theta > np.pi / 2]
    return bool(np.max(np.abs(np.diff(np.log(fields.fluid.viscosity(outlet)), axis=0))) > SHARPEST)
