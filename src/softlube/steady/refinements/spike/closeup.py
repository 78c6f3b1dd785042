"""Close-ups of a steep spike: the contact on meshes whose centre is that of the spike's ridge, not that of the contact.

In a compressible liquid the Petrusevich spike has a height, but under a law like Barus's it falls off within 10⁻⁴ contact
radii, along a ridge that runs askew to circles about the contact's centre.  About a point nearer to the outlet the ridge is a
circle, to some 10⁻³ contact radii over 45° on either side of the axis, so that a few fine rings resolve it to any
width.  The equations do not know where their mesh has its centre; only the sphere's surface moves.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.discretization.splines import bilinear
from softlube.discretization.system import ContactSystem
from softlube.model.problem import Problem
from softlube.solvers.newton import newton
from softlube.steady.mesh import grid_for
from softlube.steady.refinements.spike.detection import outlet_crest
from softlube.steady.regime import Regime

Array = NDArray[np.floating]

WIDTHS = (1e-2, 2e-3, 5e-4, 1.25e-4)
"""Widths of the refined zone at the ridge, over the contact radius, one mesh after another; the first finds its place."""
ANGLES = 39
"""Angular intervals of these meshes."""
RADIAL_STEP = 4.5
"""Spacing of ξ times the number of angles."""
EDGE_LAYER, SIDE_LAYER = 0.6, 3.0
"""Least width of the refined zones at the contact's edge and, in angle, at its sides, over the shift of the mesh's centre."""
NEAR_AXIS = np.radians(150)
"""Angle about the contact's centre beyond which the ridge is taken for a circle."""
NEAR_RIDGE = 0.2
"""Distance from the ridge within which the fall is looked for, relative to the ridge's radius."""
STEPS = 150
"""Steps of Newton's method at most."""


class ShiftedSystem(ContactSystem):
    """The equations of a contact on a mesh whose centre lies `shift` downstream of the sphere's, in the system's units.

    The far field is left about the mesh's centre: at 20 contact radii it is 10⁻⁵ of the pressure.
    """

    def __init__(self, problem: Problem, grid: PolarGrid, scale: float, shift: float) -> None:
        super().__init__(problem, grid, scale)
        x = np.outer(grid.r, np.cos(grid.theta)).ravel()
        y = np.outer(grid.r, np.sin(grid.theta)).ravel()
        about_centre = np.repeat(self.indenter.height(grid.r), grid.shape[1])
        self.film_offset[0] += self.indenter.height(np.hypot(x - shift, y)) - about_centre


@dataclass(frozen=True)
class CloseUp:
    """The contact on one mesh about the ridge, in the problem's own unit of height.

    Attributes
    ----------
    shift : float
        Distance from the contact's centre to the mesh's, downstream.
    radius : float
        Radius of the ridge about the mesh's centre, as the mesh before foresaw it.
    fields : Fields
        Pressure and film, about the mesh's centre.
    seconds : float
        Time it took.
    """

    shift: float
    radius: float
    fields: Fields
    seconds: float

    @cached_property
    def fall(self) -> NDArray[np.integer]:
        """Index of the last node ahead of the ridge's fall, at every angle."""
        return falls(self.fields, self.radius)

    @property
    def cell(self) -> float:
        """Distance of the nodes on either side of the fall on the outlet axis."""
        return float(np.diff(self.fields.r)[self.fall[-1]])


def close_ups(regime: Regime, fields: Fields, widths: Sequence[float] = WIDTHS, angles: int = ANGLES) -> Iterator[CloseUp]:
    """Solve on ever finer meshes about a spike; ends early where Newton's method fails.

    Parameters
    ----------
    regime : Regime
        A contact whose solution has a spike on the outlet axis.
    fields : Fields
        The solution on a mesh about the contact's centre, in the problem's own unit.
    widths : sequence of float
        Of the refined zone, one mesh each.
    angles : int
        Angular intervals of the meshes.
    """
    problem, unit = regime.problem, regime.unit
    here, shift = fields.in_units(unit), 0.0
    radius = outlet_crest(here)
    for width in widths:
        began = time.perf_counter()
        new_shift, radius = circle_through(*ridge(here, shift, radius))
        grid = grid_about(regime, angles, new_shift, radius, width)
        system = ShiftedSystem(problem, grid, unit, new_shift)
        start = carried(here, grid, new_shift - shift).ravel()
        result = newton(system, np.append(start, here.height) if problem.load_controlled else start, max_iterations=STEPS)
        if not result.converged:
            return
        own = system.fields(result.x)
        here, shift = own.in_units(unit), new_shift
        length = np.sqrt(unit)
        yield CloseUp(shift * length, radius * length, own, time.perf_counter() - began)


def falls(fields: Fields, radius: float) -> NDArray[np.integer]:
    """Index of the last node ahead of the steepest fall of ln η, close to a radius, at every angle."""
    slope = np.diff(np.log(fields.liquid.viscosity(fields.pressure)), axis=0) / np.diff(fields.r)[:, None]
    near = np.abs(fields.r[1:] - radius) < NEAR_RIDGE * radius
    return np.argmin(np.where(near[:, None], slope, np.inf), axis=0)


def ridge(fields: Fields, shift: float, radius: float) -> tuple[Array, Array]:
    """Cartesian coordinates, about the contact's centre, of the fall close to the outlet axis, that on it last."""
    fall = falls(fields, radius)
    r = (fields.r[fall] + fields.r[fall + 1]) / 2
    x, y = r * np.cos(fields.theta) - shift, r * np.sin(fields.theta)
    near = np.arctan2(y, x) > NEAR_AXIS
    return x[near], y[near]


def circle_through(x: Array, y: Array) -> tuple[float, float]:
    """The circle, centred on the axis at (−shift, 0), through the last point and as near as can be to the others.

    Returns
    -------
    shift, radius : float
    """
    place = -x[-1]
    # (x + shift)² + y² = (place − shift)² is linear in the shift.
    from_crest = x + place
    shift = float((place**2 - x**2 - y**2) @ from_crest / (2 * from_crest @ from_crest))
    return shift, float(place - shift)


def grid_about(regime: Regime, angles: int, shift: float, radius: float, width: float) -> PolarGrid:
    """The mesh of the problem, its centre moved, with a refined zone at a radius about it."""
    grid = grid_for(regime, angles)
    grid = replace(
        grid,
        edge_width=max(grid.edge_width, EDGE_LAYER * shift / grid.edge),
        side_width=max(grid.side_width, min(SIDE_LAYER * shift, 1.0)),
        crest=radius / grid.edge,
        crest_width=width / grid.edge,
    )
    return grid.resized(int(np.ceil(grid.xi_of(grid.reach * grid.edge) * angles / RADIAL_STEP)), angles)


def carried(fields: Fields, grid: PolarGrid, shift: float) -> Array:
    """Pressures on the cells of a grid whose centre lies a shift downstream of the fields'; linear in between."""
    chart = fields.chart
    nodes = chart.xi_of(fields.r), chart.s_of(fields.theta)
    r, theta = np.meshgrid(grid.r[: grid.n_r], grid.theta, indexing="ij")
    x, y = r * np.cos(theta) - shift, np.abs(r * np.sin(theta))
    xi = chart.xi_of(np.clip(np.hypot(x, y), fields.r[0], fields.r[-1]))
    return bilinear(*nodes, fields.pressure, xi, chart.s_of(np.arctan2(y, x)))
