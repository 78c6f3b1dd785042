"""The film of a solution at polar coordinates: its walls, the gradients that drive it, levels across it.

Normalised as in the paper, see `softlube.readout.flow`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.discretization.splines import Spline
from softlube.errors import InputError
from softlube.readout.free_boundary import is_wet, polar
from softlube.steady.solution import Solution

Array = NDArray[np.floating]


def sphere_height(solution: Solution, r: ArrayLike) -> Array:
    """Height h̄ of the indenter's surface over the undeformed substrate, Eq. (6c)."""
    return solution.fields.height + solution.problem.indenter.height(r)


def substrate_height(solution: Solution, r: ArrayLike, theta: ArrayLike) -> Array:
    """Height w̄ of the substrate's surface, h̄ − ū, Eq. (1c)."""
    return sphere_height(solution, r) - solution.fields.film_at(r, theta)


def pressure_gradient(solution: Solution, r: ArrayLike, theta: ArrayLike) -> tuple[Array, Array]:
    """∂p̄/∂r and (1/r) ∂p̄/∂θ at polar coordinates (broadcast); zero behind the free boundary."""
    return _gradient(solution, solution.fields.pressure_spline, r, theta)


def driving_gradient(solution: Solution, r: ArrayLike, theta: ArrayLike) -> tuple[Array, Array]:
    """∂q̄/∂r and (1/r) ∂q̄/∂θ of the reduced pressure q, with (η/η₀)∇q = ∇p, at polar coordinates (broadcast).

    It drives the flow, and is smooth even where the pressure has a spike.
    """
    return _gradient(solution, solution.fields.reduced_spline, r, theta)


def _gradient(solution: Solution, spline: Spline, r: ArrayLike, theta: ArrayLike) -> tuple[Array, Array]:
    chart = solution.fields.chart
    radius, angle, side = polar(r, theta)
    xi, s = chart.xi_of(radius), chart.s_of(angle)
    wet = is_wet(solution, r, theta)
    by_r = spline(xi, s, dx=1, grid=False) / chart.dr_dxi(radius)
    # At the centre every angle is the same place, and what a spline makes of it there is no gradient.
    innermost = solution.fields.r[solution.fields.mesh.centre]
    off_centre = spline(np.zeros_like(xi), s, dy=1, grid=False) * np.maximum(1 - radius / innermost, 0.0)
    by_theta = (spline(xi, s, dy=1, grid=False) - off_centre) / chart.dtheta_ds(s) / radius
    return np.where(wet, by_r, 0.0), np.where(wet, side * by_theta, 0.0)


def levels(
    solution: Solution, r: ArrayLike, theta: ArrayLike, z: ArrayLike | None, level: ArrayLike | None
) -> tuple[Array, Array]:
    """Level ζ and 1 − ζ, each exactly zero on its wall; nan outside the film."""
    if (z is None) == (level is None):
        raise InputError("z, level: give exactly one of them")
    if level is not None:
        zeta = np.asarray(level, dtype=float)
        inside = (zeta >= 0) & (zeta <= 1)
        return np.where(inside, zeta, np.nan), np.where(inside, 1 - zeta, np.nan)
    film = solution.fields.film_at(r, theta)
    above = np.asarray(z, dtype=float) - substrate_height(solution, r, theta)
    below = sphere_height(solution, r) - np.asarray(z, dtype=float)
    inside = (above >= 0) & (below >= 0)
    low = above < below
    zeta = np.where(low, above / film, 1 - below / film)
    rest = np.where(low, 1 - above / film, below / film)
    return np.where(inside, zeta, np.nan), np.where(inside, rest, np.nan)


def viscosity_at_rest(solution: Solution, r: ArrayLike, theta: ArrayLike) -> Array:
    """η/η₀ at polar coordinates."""
    return solution.fields.liquid.viscosity(solution.fields.pressure_at(r, theta))
