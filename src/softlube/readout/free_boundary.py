"""The free boundary behind the contact, read off a solution under the Reynolds condition, and the broken film beyond it.

There the pressure is constant and the gap only partly filled: liquid moves along −x, relative to the sphere, in streaks whose
share of the gap is what the flux across the free boundary leaves them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import gaussian_filter1d

from softlube.discretization.fields import Fields
from softlube.steady.solution import Solution

Array = NDArray[np.floating]

CENTRE = 1e-7
"""Radius that stands for the centre, where the direction e_r is that of the angle asked for."""
KNEE = np.radians(110)
RIM = 1.02
"""The free boundary is followed along rays from this angle on, and where it hugs the contact's rim closer than that; along
circles where it runs outwards."""
RAGGED = 6
"""Number of circles over which the boundary is smoothed."""


@dataclass(frozen=True)
class FreeBoundary:
    """Where the film breaks behind the contact: at x = place(|y|), as a function of y.

    Attributes
    ----------
    place, film : callable
        x̄ of the free boundary, and the film thickness on it, by |ȳ|.
    """

    place: PchipInterpolator
    film: PchipInterpolator

    def is_wet(self, r: Array, theta: Array) -> NDArray[np.bool_]:
        """Whether the film is whole at a place; θ in [0, π]."""
        y = np.minimum(r * np.sin(theta), self.place.x[-1])
        return r * np.cos(theta) > self.place(y)

    def angle(self, r: ArrayLike) -> Array:
        """Angle from the inlet at which a circle about the centre leaves the whole film; π if it never does."""
        r = np.asarray(r, dtype=float)
        low, high = np.full(r.shape, np.pi / 2), np.full(r.shape, np.pi)
        for _ in range(48):
            middle = (low + high) / 2
            wet = self.is_wet(r, middle)
            low, high = np.where(wet, middle, low), np.where(wet, high, middle)
        return high


def _end_of_film(coordinate: Array, pressure: Array) -> float:
    """Where the pressure along a line of nodes first falls to zero, nan if it does not.

    It falls as the square of the distance, so that its root is continued in a straight line, at most to the first node without.
    """
    dry = np.flatnonzero(pressure <= 0)
    if dry.size == 0 or dry[0] < 2:
        return np.nan
    k = int(dry[0])
    before, last = np.sqrt(pressure[k - 2 : k])
    slope = (before - last) / (coordinate[k - 1] - coordinate[k - 2])
    ahead = coordinate[k - 1] + last / slope if slope > 0 else np.inf
    return float(min(ahead, coordinate[k]))


@lru_cache(maxsize=8)
def _free_boundary(solution: _ById) -> FreeBoundary | None:
    fields = solution.fields
    if fields.cavitation != "reynolds":
        return None
    rays = [(_end_of_film(fields.r, fields.pressure[:, k]), t) for k, t in enumerate(fields.theta) if t > np.pi / 2]
    rear = [(r, t) for r, t in rays if t > KNEE or r < RIM]
    if not rear or np.isnan(rear[-1][0]):
        return None
    knee = rear[0][0]
    # The rim's nodes beyond the last cell hold the far field, not the solution.
    side = [(r, _end_of_film(fields.theta, fields.pressure[k])) for k, r in enumerate(fields.r[:-2]) if r > knee * 1.002]
    side = [pair for pair in side if not np.isnan(pair[1])]
    if len(side) > RAGGED:
        # Where the boundary runs between two rays of nodes it keeps to them by turns: smoothed over a few circles.
        angles = gaussian_filter1d([t for _, t in side], RAGGED / 2, mode="nearest")
        side = [(r, t) for (r, _), t in zip(side, angles, strict=True)]
    place = np.array([pair for pair in rear[::-1] + side if not np.isnan(pair).any()])
    x, y = place[:, 0] * np.cos(place[:, 1]), place[:, 0] * np.sin(place[:, 1])
    y[0] = 0.0
    rising = np.concatenate([[True], y[1:] > np.maximum.accumulate(y)[:-1] + 1e-9])
    x, y, place = x[rising], y[rising], place[rising]
    return FreeBoundary(PchipInterpolator(y, x), PchipInterpolator(y, fields.film_at(place[:, 0], place[:, 1])))


class _ById:
    """A solution as a key of a cache: it holds arrays, and is not hashable itself."""

    def __init__(self, solution: Solution) -> None:
        self.fields: Fields = solution.fields

    def __hash__(self) -> int:
        return id(self.fields)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _ById) and other.fields is self.fields


def free_boundary(solution: Solution) -> FreeBoundary | None:
    """The free boundary behind the contact; None without the Reynolds condition, or where nothing cavitates."""
    return _free_boundary(_ById(solution))


def polar(r: ArrayLike, theta: ArrayLike) -> tuple[Array, Array, Array]:
    """Broadcast r (kept off the centre), |θ| in [0, π], and the sign of y."""
    r, theta = np.broadcast_arrays(np.asarray(r, dtype=float), np.asarray(theta, dtype=float))
    turned = np.remainder(theta + np.pi, 2 * np.pi) - np.pi
    return np.maximum(r, CENTRE), np.abs(turned), np.where(turned < 0, -1.0, 1.0)


def is_wet(solution: Solution, r: ArrayLike, theta: ArrayLike) -> NDArray[np.bool_]:
    """Whether the film is whole there: everywhere but behind the free boundary of the Reynolds condition."""
    radius, angle, _ = polar(r, theta)
    boundary = free_boundary(solution)
    return np.ones(radius.shape, dtype=bool) if boundary is None else boundary.is_wet(radius, angle)


def filling(solution: Solution, r: ArrayLike, theta: ArrayLike) -> Array:
    """Share of the gap that is filled with liquid: 1 in the whole film, less behind the free boundary.

    Behind it there is no pressure gradient and liquid moves along −x; conservation gives ū(x_front, y)/ū(x, y).
    """
    radius, angle, _ = polar(r, theta)
    boundary = free_boundary(solution)
    wet = is_wet(solution, r, theta)
    if boundary is None or wet.all():
        return np.ones(radius.shape)
    y = np.minimum(radius * np.sin(angle), boundary.film.x[-1])
    return np.where(wet, 1.0, np.minimum(boundary.film(y) / solution.fields.film_at(radius, angle), 1.0))
