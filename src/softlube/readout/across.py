"""Profiles across the film of a liquid that thins with shear: stress, shear rate, velocity.

`softlube.readout.flow` asks for them; units and frames are described there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from softlube.model.film_section import film_section
from softlube.model.liquids import Liquid
from softlube.readout.film import driving_gradient
from softlube.steady.solution import Solution

Array = NDArray[np.floating]

POINTS = 20
"""Gauss's points from the place of least stress to a level of the film."""


@dataclass(frozen=True)
class Across:
    """The flow across the film at some places.

    Attributes
    ----------
    liquid : Liquid
    beta : float
        β of the fields.
    film : ndarray
        ū at the places.
    fluidity : ndarray
        η₀/η at rest.
    mean, difference : ndarray, shape (2, …)
        Mean shear stress, and what it grows by from the substrate to the sphere; Cartesian, in units of (2π/3) G (unit of
        height)/R.
    moment : ndarray, shape (2, …)
        See `softlube.model.film_section`.
    """

    liquid: Liquid
    beta: float
    film: Array
    fluidity: Array
    mean: Array
    difference: Array
    moment: Array

    @classmethod
    def at(cls, liquid: Liquid, beta: float, slip: float, film: Array, pressure: Array, gradient: Array) -> Across:
        """Solve for the flow.

        Parameters
        ----------
        liquid : Liquid
            Its law.
        beta : float
            β of the fields.
        slip : float
            See `softlube.discretization.fields.Fields.slip`.
        film, pressure : ndarray
            At the places.
        gradient : ndarray, shape (2, …)
            Of the reduced pressure, Cartesian.
        """
        fluidity, _ = liquid.fluidity(pressure)
        difference = 6 * film / fluidity * gradient
        section = film_section(liquid, difference.reshape(2, -1), (slip / film / fluidity).ravel())
        mean, moment = (each.reshape(difference.shape) for each in (section.mean, section.moment))
        return cls(liquid, beta, film, fluidity, mean, difference, moment)

    def stress(self, level: ArrayLike) -> Array:
        """Shear stress at a level, 0 (substrate) to 1 (sphere), shape (2, …), in units of ηv over the unit of height."""
        return self.beta * self._stress(np.asarray(level) - 0.5)

    def rate(self, level: ArrayLike) -> Array:
        """Shear rate at a level, shape (2, …), in units of v over the unit of height."""
        return self.beta * self.fluidity * self._rate(np.asarray(level) - 0.5)

    def _stress(self, place: Array) -> Array:
        return np.stack([mean + place * change for mean, change in zip(self.mean, self.difference, strict=True)])

    def _rate(self, place: Array) -> Array:
        stress = self._stress(place)
        size = np.maximum(np.hypot(*stress), 1e-150)
        return np.exp(self.liquid.fluidity_at(size)[0]) * stress

    def velocity(self, level: ArrayLike, wall: float) -> Array:
        """Velocity at a level less that of a wall, the substrate (0) or the sphere (1), shape (2, …), in units of v."""
        square = np.maximum(np.sum(self.difference**2, axis=0), 1e-300)
        least = np.clip(-np.sum(self.mean * self.difference, axis=0) / square, -0.5, 0.5)
        end = np.asarray(level) - 0.5 + 0 * least
        ends = end, np.full_like(end, wall - 0.5)
        upper, lower = (self._integral(least, end) for end in ends)
        return self.beta * self.film * self.fluidity * (upper - lower)

    def _integral(self, start: Array, end: Array) -> Array:
        """∫ ψτ dζ by Gauss's rule after ζ → y², from where the stress is least."""
        x, weight = leggauss(POINTS)
        total = 0.0
        for y, share in zip((x + 1) / 2, weight / 2, strict=True):
            total = total + 2 * y * share * self._rate(start + (end - start) * y * y)
        return (end - start) * total

    @property
    def mean_velocity(self) -> Array:
        """What the pressure adds to the velocity averaged through the film, shape (2, …), in units of v."""
        return -self.beta * self.film * self.fluidity / 12 * self.moment


def across_at(solution: Solution, r: ArrayLike, theta: ArrayLike) -> Across:
    """The flow across the film at polar coordinates (broadcast)."""
    r, theta = np.broadcast_arrays(np.asarray(r, dtype=float), np.asarray(theta, dtype=float))
    fields = solution.fields
    gradient = np.stack(cartesian(*driving_gradient(solution, r, theta), theta))
    film, pressure = fields.film_at(r, theta), fields.pressure_at(r, theta)
    return Across.at(fields.liquid, fields.beta, fields.slip, film, pressure, gradient)


def cartesian(along_r: Array, along_theta: Array, theta: ArrayLike) -> tuple[Array, Array]:
    """Cartesian components of a vector from its polar ones."""
    cosine, sine = np.cos(theta), np.sin(theta)
    return cosine * along_r - sine * along_theta, sine * along_r + cosine * along_theta
