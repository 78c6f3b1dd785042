"""Quantities from close-ups of a steep spike: its height, its place, and the friction of the liquid in it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from softlube.discretization.fields import Fields
from softlube.discretization.measure import FRICTIONS, boundary_layer, friction_parts, frictions
from softlube.model.quantities import Quantity
from softlube.solvers.budget import OutOfTime
from softlube.solvers.progress import Listener, Progress
from softlube.steady.error_estimate import LARGEST_ERROR, yardstick
from softlube.steady.refinements.spike.closeup import NEAR_RIDGE, WIDTHS, CloseUp, close_ups
from softlube.steady.refinements.spike.detection import (
    SHARPEST,
    ridge_error,
    tracked,
    wants_close_up,
)
from softlube.steady.regime import Regime

Array = NDArray[np.floating]

AHEAD = 20, 3
"""Nodes ahead of the fall from whose pressures the height is taken, the furthest and the nearest."""
LEAST_ERROR = {"spike_pressure": 6e-3, "spike_radius": 2e-4, "boundary_layer": 1e-3} | dict.fromkeys(FRICTIONS, 4e-3)
"""Relative errors that these meshes leave, measured against 45 angles and cells half as wide (benchmarks/spike_sphere.py)."""
OF_WHAT_GRIDS_MISS = 0.1
"""Least error of a friction, over the part of it that the contact's own grids miss."""
SAME_FILM = 1e-2
"""Relative difference of the minimum films up to which a close-up counts as a solution of the contact that the grids solved."""


class Crest(NamedTuple):
    """The pressure ahead of the fall at one angle.

    Attributes
    ----------
    pressure, radius : float
        How high, and where.
    residual : float
        How far the nodes are off the profile that it is taken from.
    fall : float
        By how much ln η falls to the next node.
    column : ndarray
        Pressures at this angle, the profile's close to the fall.
    """

    pressure: float
    radius: float
    residual: float
    fall: float
    column: Array


class Reading(NamedTuple):
    """A number that one close-up gives, and its error so far as this close-up can tell."""

    value: float
    doubt: float


def crest(fields: Fields, angle: int, fall: int) -> Crest:
    """The pressure at the angle of an index, ahead of the fall after the node of another.

    Where the fall is narrower than a cell, the pressure rises towards it like p_s − C x ln(1/x), x being the distance.  The
    last nodes alternate about that, an artefact of interpolating across the fall, so they are smoothed and the very last left
    out.
    """
    r, pressure = fields.r, fields.pressure[:, angle]
    ahead, behind = np.log(fields.liquid.viscosity(pressure[fall : fall + 2]))
    if ahead - behind < SHARPEST:
        top = fall
        while top > 0 and pressure[top - 1] > pressure[top]:
            top -= 1
        return Crest(float(pressure[top]), float(r[top]), 0.0, float(ahead - behind), pressure)
    i = np.arange(max(fall - AHEAD[0], 1), fall + 1)
    smooth = (pressure[i - 1] + 2 * pressure[i] + pressure[i + 1]) / 4
    middle = float(r[fall] + r[fall + 1]) / 2
    x = middle - r[i]
    profile = np.column_stack([np.ones_like(x), x * np.log(x), x])
    trusted = i <= fall - AHEAD[1]
    coefficients = np.linalg.lstsq(profile[trusted], smooth[trusted], rcond=None)[0]
    column = pressure.copy()
    column[i] = profile @ coefficients
    residual = float(np.max(np.abs(column[i] - smooth)[trusted]))
    return Crest(float(coefficients[0]), middle, residual, float(ahead - behind), column)


def readings(seen: CloseUp, fields: Fields, edge: float) -> dict[str, Reading]:
    """What one close-up says.

    Parameters
    ----------
    seen : CloseUp
        The close-up.
    fields : Fields
        Solution on the contact's own grid, which gives the Poiseuille parts of the frictions: they do not depend on the spike.
    edge : float
        Radius of the dry contact.
    """
    own, fields = fields, seen.fields
    outlet = np.flatnonzero(fields.theta > np.pi / 2)
    crests = [crest(fields, int(k), int(seen.fall[k])) for k in outlet]
    axis, highest = crests[-1], max(crests, key=lambda each: each.pressure)
    place = seen.shift + axis.radius
    least = max(LEAST_ERROR["spike_pressure"], 0.0 if highest is axis else ridge_error(highest.fall))
    result = {
        "spike_pressure": Reading(axis.pressure, max(axis.residual, LEAST_ERROR["spike_pressure"] * axis.pressure)),
        "spike_radius": Reading(place, max(seen.cell, LEAST_ERROR["spike_radius"] * place)),
        "pressure_max": max(
            Reading(highest.pressure, max(highest.residual, least * highest.pressure)),
            largest_elsewhere(seen),
        ),
    }
    mended = fields.pressure.copy()
    mended[:, outlet] = np.column_stack([each.column for each in crests])
    # The nodes as they are put too much liquid under high pressure; a profile on wide cells, too little.
    much, little = (
        frictions(lambda cutoff, p=pressure: (couette_within(seen, p, cutoff * edge), friction_parts(own, cutoff * edge)[1]))
        for pressure in (fields.pressure, mended)
    )
    for name in FRICTIONS:
        value = (much[name] + little[name]) / 2
        result[name] = Reading(value, max(abs(much[name] - little[name]) / 2, LEAST_ERROR[name] * value))
    return result


def largest_elsewhere(seen: CloseUp) -> Reading:
    """The largest pressure at a node that is not close to the ridge, and by how much the least of its neighbours is lower."""
    fields = seen.fields
    away = (fields.r[:, None] < (1 - NEAR_RIDGE) * seen.radius) | (fields.theta <= np.pi / 2)
    i, j = np.unravel_index(int(np.argmax(np.where(away, fields.pressure, -np.inf))), away.shape)
    around = fields.pressure[max(i - 1, 0) : i + 2, max(j - 1, 0) : j + 2]
    return Reading(float(fields.pressure[i, j]), float(fields.pressure[i, j] - around.min()))


def couette_within(seen: CloseUp, pressure: Array, cutoff: float) -> float:
    """Couette part of Eq. (27a) over the disc r ≤ cutoff about the contact's centre; p and u are linear between the nodes."""
    fields = seen.fields
    chart = fields.chart
    nodes = chart.xi_of(fields.r)
    x, weight = leggauss(4)
    rays = np.empty(fields.theta.size)
    thinned = fields.thinned if fields.liquid.thins and fields.slip else None
    for k, theta in enumerate(fields.theta):
        rim = seen.shift * np.cos(theta) + np.sqrt(cutoff**2 - (seen.shift * np.sin(theta)) ** 2)
        end = float(chart.xi_of(rim))
        edges = np.concatenate([[0.0], nodes[nodes < end], [end]])
        xi = (edges[:-1, None] + np.diff(edges)[:, None] * (x + 1) / 2).ravel()
        r = chart.r_of(xi)
        area = (np.diff(edges)[:, None] * weight / 2).ravel() * chart.dr_dxi(r) * r
        held, film = np.interp(xi, nodes, pressure[:, k]), np.interp(xi, nodes, fields.film[:, k])
        share = 1.0 if thinned is None else np.interp(xi, nodes, thinned[:, k])
        rays[k] = area @ fields.drag_under(held, film, share)
    s = chart.s_of(fields.theta)
    rays[[0, -1]] /= 2
    return float(2 * (s[1] - s[0]) * rays @ chart.dtheta_ds(s))


def spike_quantities(
    regime: Regime, grids: Sequence[Fields], quantities: Mapping[str, Quantity], progress: Listener | None = None
) -> dict[str, Quantity]:
    """Height and place of a spike, and the quantities that it determines, where the contact's grids do not give them as well.

    Parameters
    ----------
    regime : Regime
        The contact.
    grids : sequence of Fields
        Solutions on the contact's grids, coarse to fine.
    quantities : mapping of str to Quantity
        Quantities from these grids; nan for those that they do not give.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each further mesh.
    """
    known = tracked(grids)
    if not wants_close_up(grids[-1], known):
        return known
    before = {**quantities, **known}
    try:
        closer = resolve_spike(regime, grids[-1], progress)
    except OutOfTime:  # the contact itself is solved
        closer = {}
    if "friction_total" in closer and "friction_hysteresis" in quantities:
        viscous, hysteresis = closer["friction_total"], quantities["friction_hysteresis"]
        closer["friction_viscous"] = viscous
        closer["friction_total"] = Quantity(viscous + hysteresis, viscous.error + hysteresis.error)
    if "pressure_max" in closer:
        closer["pressure_max"] = at_least(quantities["pressure_center"], closer["pressure_max"])
    return known | {name: each for name, each in closer.items() if name not in before or not _as_well(before[name], each)}


def _as_well(on_grid: Quantity, closer: Quantity) -> bool:
    """Whether a grid knows a quantity as well as close-ups: two grids that both miss a part of a spike may agree by chance."""
    return on_grid.error <= closer.error and abs(on_grid - closer) <= on_grid.error + closer.error


def resolve_spike(regime: Regime, fields: Fields, progress: Listener | None = None) -> dict[str, Quantity]:
    """Quantities that a spike determines, from close-ups, in the problem's own unit; empty where a mesh fails.

    The friction is the liquid's: without what a substrate that remembers takes.

    An error is the largest of the last change, half the change before, and the error that the last close-up itself leaves; that
    of a friction is at least a share of what the contact's own grids miss.  Quantities with an error above 10 % are left out.

    Parameters
    ----------
    regime : Regime
        A contact with a spike on the outlet axis.
    fields : Fields
        Its solution on a mesh about its centre.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each mesh.
    """
    seen, said = [], []
    for each in close_ups(regime, fields):
        seen.append(each)
        said.append(readings(each, fields, regime.edge_radius))
        if progress is not None:
            shape = " x ".join(map(str, each.fields.pressure.shape))
            progress(Progress(f"{shape} nodes about the spike solved in {each.seconds:.2f} s", len(seen)))
    lowest = float(np.min(fields.film))
    if len(seen) < len(WIDTHS) or abs(np.min(seen[-1].fields.film) - lowest) > SAME_FILM * lowest:
        return {}
    found = {name: _settled([each[name] for each in said[1:]]) for name in said[-1]}
    on_grid = frictions(lambda cutoff: friction_parts(fields, cutoff * regime.edge_radius))
    for name, value in on_grid.items():
        found[name] = Quantity(found[name], max(found[name].error, OF_WHAT_GRIDS_MISS * abs(found[name] - value)))
    found["boundary_layer"] = layer_beside_spike(fields, found["pressure_max"], regime.edge_radius)
    return {name: each for name, each in found.items() if each.error <= LARGEST_ERROR * yardstick(name, found)}


def _settled(said: Sequence[Reading]) -> Quantity:
    value = np.array([each.value for each in said])
    change = np.abs(np.diff(value))
    return Quantity(value[-1], max(change[-1], change[-2] / 2, said[-1].doubt))


def at_least(center: float, largest: Quantity) -> Quantity:
    """The largest pressure; a mesh about the spike knows it at its nodes only, and the contact's centre is not a node."""
    return Quantity(max(largest, center), largest.error)


def layer_beside_spike(fields: Fields, pressure_max: Quantity, edge: float) -> Quantity:
    """The inlet's boundary layer, which depends on the spike only through the maximum pressure, of which it takes 5 %."""
    value = boundary_layer(fields, pressure_max, edge)
    off = [
        abs(boundary_layer(fields, pressure_max + error, edge) - value) for error in (-pressure_max.error, pressure_max.error)
    ]
    least = LEAST_ERROR["boundary_layer"] * yardstick("boundary_layer", {"boundary_layer": value})
    return Quantity(value, max(*off, least))
