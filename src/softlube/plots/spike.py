"""The ridge of a pressure spike for pictures.

A spike is narrower than the distance by which it moves from one angle of the grid to the next, so an interpolation at
constant radius shows a row of beads.  Here the pressure is interpolated at a constant share of the ridge's radius.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from softlube.discretization.fields import Fields

Array = NDArray[np.floating]

INNERMOST = 0.4
"""Radius over the contact's beyond which a spike is looked for."""
RISE = 1.05
"""Pressure of a spike over the least between it and the middle, from which on it counts as one."""
NEARBY = 0.04
"""Distance, over the ridge's radius, within which the ridge goes on at the next angle of the grid."""
DEGREE = 3
"""Degree of the polynomial in (π − θ)² that the ridge's radius is."""
REFINED = 4
"""Points drawn for each node along a radius."""


@dataclass(frozen=True)
class Ridge:
    """Where a spike's crest is.

    Attributes
    ----------
    fields : Fields
        The solution's.
    start : float
        Least angle from the inlet at which there is a crest.
    coefficients : ndarray
        Of the polynomial in (π − θ)² that gives its radius, the highest power first.
    """

    fields: Fields
    start: float
    coefficients: Array

    def radius(self, theta: Array) -> Array:
        """Radius of the crest at some angles; before its start it stays."""
        return np.polyval(self.coefficients, (np.pi - np.maximum(theta, self.start)) ** 2)

    def pressure(self, theta: Array, reach: float) -> tuple[Array, Array]:
        """Radii and pressures along rays at some angles from 0 to π, each of the shape (angles, points).

        Parameters
        ----------
        theta : ndarray, shape (angles,)
            Angles from the inlet.
        reach : float
            Radius up to which a ray goes.
        """
        nodes, at_outlet = self.fields.r, float(self.radius(np.array([np.pi]))[0])
        fine = np.interp(np.arange(0, nodes.size - 1, 1 / REFINED), np.arange(nodes.size), nodes)
        fine = np.concatenate([[0.0], fine[fine < reach], [reach]])
        share = np.interp(fine, [0.0, at_outlet, reach], [0.0, 1.0, 2.0])

        def place(angles: Array) -> Array:
            crest = self.radius(angles)[:, None]
            return np.where(share <= 1, share * crest, crest + (share - 1) * (reach - crest))

        along = np.clip(theta, self.fields.theta[0], self.fields.theta[-1])
        with np.errstate(all="ignore"):  # slopes next to nothing: their harmonic mean is nothing, too
            on_nodes = [
                PchipInterpolator(nodes, column)(np.clip(r, nodes[0], nodes[-1]))
                for column, r in zip(self.fields.pressure.T, place(self.fields.theta), strict=True)
            ]
            pressure = PchipInterpolator(self.fields.theta, np.array(on_nodes))(along)
        # Where the pressure ends the interpolant may round to less than nothing.
        return place(theta), np.maximum(pressure, 0) if self.fields.cavitation == "reynolds" else pressure


def ridge(fields: Fields) -> Ridge | None:
    """The crest of the spike, followed from the outlet axis towards the inlet; None where there is none."""
    found: list[tuple[float, float]] = []
    for k in range(fields.theta.size - 1, -1, -1):
        near = fields.r > INNERMOST if not found else np.abs(fields.r / found[-1][1] - 1) < NEARBY
        rows = np.flatnonzero(near)
        if rows.size < 3:
            break
        column = fields.pressure[:, k]
        top = rows[np.argmax(column[rows])]
        inside = column[(fields.r > INNERMOST / 2) & (fields.r < fields.r[top])]
        if top in (rows[0], rows[-1]) or not inside.size or column[top] < RISE * inside.min():
            break
        found.append((float(fields.theta[k]), _between_nodes(fields.r, column, int(top))))
    if len(found) < DEGREE + 2:
        return None
    theta, radius = np.array(found).T
    return Ridge(fields, float(theta[-1]), np.polyfit((np.pi - theta) ** 2, radius, DEGREE))


def _between_nodes(r: Array, pressure: Array, top: int) -> float:
    """Radius of the maximum of the parabola through three nodes."""
    a, b, c = np.polyfit(r[top - 1 : top + 2] - r[top], pressure[top - 1 : top + 2], 2)
    del c
    return float(r[top] + np.clip(-b / (2 * a), r[top - 1] - r[top], r[top + 1] - r[top]))
