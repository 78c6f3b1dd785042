"""Logarithmic potentials of polynomials on panels, exact to round-off however near the panel is.

On −1 … 1 the potential of a Legendre polynomial follows from Legendre functions of the second kind, since
P_k = (P_{k+1} − P_{k−1})′/(2k + 1) and pv∫ P_k(t)/(z − t) dt = 2 Q_k(z):

    ∫ P_k(t) ln|z − t| dt = 2 [Q_{k+1}(z) − Q_{k−1}(z)]/(2k + 1),  k ≥ 1.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from softlube.discretization.line.panels import Panels

Array = NDArray[np.floating]

NEAR = 1.8
"""Distance from a panel's middle over its half-length within which Gauss's rule is not good enough."""
EXTRA_POINTS = 8
"""Points of the rule for far panels beside twice those of a panel: good to 10⁻¹⁵ from `NEAR` on."""
FORWARD = 1.02
"""|z| up to which the forward recurrence of Q_k loses no more than two digits."""
BACKWARD = 100
"""Orders above the wanted ones at which the backward recurrence starts: (z + √(z² − 1))⁻²⁰⁰ < 10⁻¹⁶ from `FORWARD` on."""


def second_kind(z: Array, highest: int) -> Array:
    """Legendre functions Q_0 … Q_highest; between −1 and 1 those on the cut.

    Parameters
    ----------
    z : ndarray, shape (n,)
        Real arguments.
    highest : int
        Highest order.

    Returns
    -------
    ndarray, shape (highest + 1, n)
    """
    z = np.where(np.abs(np.abs(z) - 1) < 1e-15, z * (1 + 3e-15), z)  # the logarithms at ±1 cancel in what is formed of them
    result = np.empty((highest + 1, z.size))
    result[0] = np.log(np.abs((z + 1) / (z - 1))) / 2
    near = np.abs(z) < FORWARD
    x = z[near]
    if highest > 0:
        result[1, near] = x * result[0, near] - 1
    for k in range(1, highest):
        result[k + 1, near] = ((2 * k + 1) * x * result[k, near] - k * result[k - 1, near]) / (k + 1)
    x = z[~near]
    ratio = np.zeros((highest + 1, x.size))
    below = np.zeros(x.size)
    for k in range(highest + BACKWARD, 0, -1):  # Q_k/Q_{k−1}
        below = k / ((2 * k + 1) * x - (k + 1) * below)
        if k <= highest:
            ratio[k] = below
    for k in range(1, highest + 1):
        result[k, ~near] = result[k - 1, ~near] * ratio[k]
    return result


def log_moments(z: Array, highest: int) -> Array:
    """∫ P_k(t) ln|z − t| dt over −1 … 1 for k = 0 … highest, shape (n, highest + 1)."""
    q = second_kind(z, highest + 1)
    result = np.empty((z.size, highest + 1))
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = [np.where(y == 0, 0.0, y * np.log(np.abs(y))) for y in (z + 1, z - 1)]
    result[:, 0] = ends[0] - ends[1] - 2
    k = np.arange(1, highest + 1)
    result[:, 1:] = (2 * (q[2:] - q[:-2]) / (2 * k + 1)[:, None]).T
    return result


def log_potential(panels: Panels, places: Array, degree: int) -> Array:
    """∫ f(s′) ln|s − s′| ds′ at some places, as a matrix on the Legendre coefficients of f on the panels.

    Parameters
    ----------
    panels : Panels
        Where f is.
    places : ndarray, shape (n,)
        Places s, on the panels or not.
    degree : int
        Of f.

    Returns
    -------
    ndarray, shape (n, panels, degree + 1)
    """
    z = (places[:, None] - panels.middle) / panels.half
    near = np.abs(z) < NEAR
    t, weight = legendre.leggauss(2 * degree + EXTRA_POINTS)
    result = np.log(np.abs(np.where(near, 5.0, z)[:, :, None] - t)) @ (legendre.legvander(t, degree) * weight[:, None])
    result[near] = log_moments(z[near], degree)
    result[:, :, 0] += 2 * np.log(panels.half)
    return result * panels.half[:, None]
