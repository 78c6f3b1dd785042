"""The Petrusevich spike: the crest of the pressure ahead of the outlet, under a liquid that thickens with the pressure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.fields import Fields
from softlube.model.liquids import Liquid
from softlube.model.quantities import SPIKE, Quantity
from softlube.steady.error_estimate import LARGEST_ERROR

Array = NDArray[np.floating]

OUTLET_AXIS = np.array([np.pi])
"""Angle of the outlet axis, as a chart coordinate s."""
SHARPEST = 2.0
"""Change of ln η from a node to the next along r, in the outlet half, beyond which a spike is a needle.  Measured, like the
other constants here, against meshes about the spike (benchmarks/spike_sphere.py)."""
NEAR = 0.6, 1.1
"""Range in which the spike on the outlet axis is looked for, over the radius of the film's crest."""
LEFT_OF_FIRST_ORDER = 2.0
"""Error over the last change of a quantity that converges like the spacing h, on grids 1.5 times finer each: the error is
h/(1.5h − h) = 2 times the change."""
BETWEEN_NODES = 0.25
"""Error of a spike's height that the place of the nodes leaves, over the fall to the next node."""
RIDGE_ERROR = 0.06
"""Relative error of the largest pressure beside the axis, where the ridge is a needle and runs askew to the mesh."""
WELL_KNOWN = 0.02
"""Relative error of its height up to which a spike needs no mesh of its own."""
SPIKE_QUANTITIES = ("pressure_max", *SPIKE)
"""Quantities that a close-up of the spike gives, see `softlube.steady.refinements.spike.closeup`."""
OPEN_SPIKE = (
    "the pressure has a spike at r = {:.2f} (outlet axis) that is narrower than the finest cells and grows from grid to grid, "
    "so there is no maximum pressure, and no friction or boundary layer that depends on it; the films do not depend on it "
    "(docs/how-to/viscosity.md)"
)
"""Warning of a solution whose spike has no height; the radius is over the unit of length."""
COARSE_SPIKE = (
    "the pressure has a spike at r = {:.2f} (outlet axis) that the contact's finest cells hardly resolve; not given, because "
    "the error would be above 10 %: {}; the films do not depend on it (docs/how-to/viscosity.md)"
)
"""Warning where the spike has a height, and the quantities that it determines are not known well enough."""


def outlet_crest(fields: Fields) -> float:
    """Radius on the outlet axis at which the film leaves its plateau: where a spike stands, or will stand as it grows.

    The thickened liquid is carried along like a plate, so the film is flat up to the crest and falls beyond it, towards its
    minimum on the axis: its curvature has an extremum in between, long before the pressure has a maximum there.
    """
    chart = fields.chart
    lowest = np.argmin(np.where(fields.r < 2, fields.film[:, -1], np.inf))
    xi = np.linspace(0.0, float(chart.xi_of(fields.r[lowest])), 400)[1:]
    r = chart.r_of(xi)
    slope = fields.film_spline(xi, OUTLET_AXIS, dx=1)[:, 0] / chart.dr_dxi(r)
    return float(r[np.argmin(np.gradient(slope, r))])


def outlet_spike(fields: Fields) -> tuple[Array, Array] | None:
    """The node at the top of the spike on the outlet axis; None where the pressure only falls.

    Returns
    -------
    place : ndarray, shape (2,)
        Radius and pressure of the node.
    doubt : ndarray, shape (2,)
        How far the grid can tell them: the width of a cell, and a share of the fall to the higher neighbour.
    """
    crest = outlet_crest(fields)
    pressure = fields.pressure[:, -1]
    here = np.flatnonzero((pressure[1:-1] > pressure[:-2]) & (pressure[1:-1] > pressure[2:])) + 1
    here = here[(fields.r[here] > NEAR[0] * crest) & (fields.r[here] < NEAR[1] * crest)]
    if not here.size:
        return None
    i = int(here[np.argmax(pressure[here])])
    doubt = fields.r[i + 1] - fields.r[i], BETWEEN_NODES * (pressure[i] - max(pressure[i - 1], pressure[i + 1]))
    return np.array([fields.r[i], pressure[i]]), np.array(doubt)


def fall_from_top(fields: Fields) -> float:
    """Largest change of ln η from a node to the next along r, within two nodes of the largest pressure."""
    i, j = np.unravel_index(int(np.argmax(fields.pressure)), fields.pressure.shape)
    near = fields.pressure[max(i - 2, 0) : i + 3, j]
    return float(np.max(np.abs(np.diff(np.log(fields.liquid.viscosity(near))))))


def ridge_error(fall: float) -> float:
    """Relative error of the height of a ridge that runs askew to the mesh, from the change of ln η across a cell of it."""
    return RIDGE_ERROR * min(fall / SHARPEST, 1.0)


def is_needle(fields: Fields) -> bool:
    """Whether the crest stands on one node, so that these nodes tell nothing of the quantities that it determines."""
    return fields.steepest_fall > SHARPEST


def is_compressible(liquid: Liquid) -> bool:
    """Whether the density rises with the pressure."""
    return bool(np.any(liquid.density(np.ones(1))[1]))


def is_open(fields: Fields) -> bool:
    """Whether a spike is a needle and has no height that grids could agree on, however fine.

    A liquid that thickens without bound is carried along like a rigid punch, whose edge has an integrable singularity.  A
    liquid that becomes denser under pressure is softer than a punch, and its pressure falls from a finite height.
    """
    return is_needle(fields) and not is_compressible(fields.liquid)


def tracked(grids: Sequence[Fields]) -> dict[str, Quantity]:
    """Pressure and radius of the spike on the outlet axis from two grids; empty unless both show a spike that is no needle."""
    before, last = (outlet_spike(fields) for fields in grids[-2:])
    if before is None or last is None or is_needle(grids[-1]):
        return {}
    values, doubt = last
    errors = np.maximum(LEFT_OF_FIRST_ORDER * np.abs(values - before[0]), doubt)
    names = ("spike_radius", "spike_pressure")
    spike = {name: Quantity(*pair) for name, *pair in zip(names, values, errors, strict=True)}
    return spike if errors[1] <= LARGEST_ERROR * values[1] else {}


def wants_close_up(fields: Fields, quantities: Mapping[str, Quantity]) -> bool:
    """Whether a spike on the outlet axis has a height that the contact's own grids do not tell well enough."""
    if is_open(fields) or not fields.is_sharp or outlet_spike(fields) is None:
        return False
    height = quantities.get("spike_pressure")
    return height is None or height.error > WELL_KNOWN * height


def doubts(fields: Fields, quantities: Mapping[str, Quantity]) -> tuple[str, ...]:
    """Warnings about the quantities that a spike determines and that are not given."""
    if is_open(fields):
        return (OPEN_SPIKE.format(outlet_crest(fields)),)
    if not fields.is_sharp:
        return ()  # a quantity that is nan has another reason
    missing = [name for name, value in quantities.items() if np.isnan(value)]
    if is_needle(fields) and "spike_pressure" not in quantities:
        missing.append("spike_pressure")
    return (COARSE_SPIKE.format(outlet_crest(fields), ", ".join(missing)),) if missing else ()
