"""The flow across the film at one place, for a liquid whose viscosity depends on the shear stress.

By the momentum balance the shear stress goes along a straight line in the plane of its two components, τ(ζ) = τm + ζ b with
b = u∇p, from one wall of the film (ζ = −1/2) to the other (ζ = 1/2).  The shear rate is ψ(|τ|) τ times the fluidity at rest,
ψ ≥ 0 the fluidity over that at rest.  Divided by the latter, the two conditions of the film are

    ∫ ψ τ dζ = c e_x,           m = 12 ∫ ζ ψ τ dζ,

c the stress that the walls' relative motion would cause at rest: it fixes the mean stress τm, and m takes the place of b in the
flux.  Constant viscosity, ψ = 1, gives τm = c e_x and m = b.

τm is the minimum of a convex function, found by Newton's method at all places at once.  The line is cut where it is nearest to
zero stress, where a power law has its kink, and each part has Gauss's points after ζ → y², which takes away what is left of it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from softlube.model.liquids import Liquid

Array = NDArray[np.floating]
Fluidity = Callable[[Array], tuple[Array, Array]]

POINTS = 10
"""Gauss's points on each part of the film: m is exact to some 1e-6 where the stress goes from a thousandth of what the liquid
thins at to a thousand times that, and to 1e-10 with `EXACT` (tests/model/test_film_section.py)."""
EXACT = 30
STRAIGHT, STRAIGHT_POINTS = 0.3, 6
"""Ratio of b to the mean stress below which ψ is smooth across the film, and Gauss's points for the whole of it then."""
SHORT = 1e-6
"""Relative step of the mean stress that is the last one: what it leaves is its square."""
MOST_STEPS = 60
"""Steps of Newton's method at most; four are usual."""
LONGEST = 0.5
"""Largest change of the mean stress in one step, over the largest stress at the place."""


@cache
def _whole() -> tuple[Array, Array]:
    """Places and weights on the whole film, in columns."""
    x, weight = leggauss(STRAIGHT_POINTS)
    return x[:, None] / 2, weight[:, None] / 2


@cache
def _rule(points: int) -> tuple[Array, Array]:
    """Places ζ = y² on a part of unit length, in a column, and their weights."""
    x, weight = leggauss(points)
    return (((x + 1) / 2) ** 2)[:, None], (weight * (x + 1) / 2)[:, None]


class Section(NamedTuple):
    """The flow across the film at some places.

    Attributes
    ----------
    mean : ndarray, shape (2, n)
        Mean stress τm.
    moment : ndarray, shape (2, n)
        m.
    by_difference : ndarray, shape (2, 2, n)
        ∂m/∂b, symmetric.
    by_drag : ndarray, shape (2, n)
        ∂m/∂c.
    """

    mean: Array
    moment: Array
    by_difference: Array
    by_drag: Array


def viscosity_at(liquid: Liquid, rate: Array | float) -> Array:
    """Viscosity over that at rest where the shear rate times the viscosity at rest is `rate`, a stress."""
    rate = np.maximum(np.asarray(rate, dtype=float), 1e-150)
    return liquid.flow_curve(rate) / rate


def film_section(liquid: Liquid, difference: Array, drag: Array, points: int = POINTS) -> Section:
    """Solve for the flow across the film.

    Parameters
    ----------
    liquid : Liquid
        Its ψ, see `softlube.model.liquids.base.Liquid.fluidity_at`.
    difference : ndarray, shape (2, n)
        b, Cartesian; x is the direction in which the walls slide along each other.
    drag : ndarray, shape (n,)
        c.
    points : int
        Points of the quadrature on each part of the film.
    """
    fluidity, n = liquid.fluidity_at, drag.size
    b_x, b_y = difference
    size = np.hypot(b_x, b_y)
    # Both are above the mean stress, from where Newton's method comes down to it.
    with np.errstate(divide="ignore", over="ignore"):
        along = np.minimum(liquid.flow_curve(np.abs(drag)), np.abs(drag) * np.exp(-fluidity(np.maximum(size / 4, 1e-300))[0]))
    mean = np.stack([np.copysign(along, drag), np.zeros(n)])
    moment, by_difference, by_drag = np.empty((2, n)), np.empty((2, 2, n)), np.empty((2, n))
    still = size == 0  # sheared only
    if np.any(still):
        ln_psi, slope = fluidity(np.maximum(along[still], 1e-150))
        psi = np.exp(ln_psi)
        zero = np.zeros(psi.size)
        moment[:, still], by_drag[:, still] = 0.0, 0.0
        by_difference[:, :, still] = np.array([[psi * (1 + slope), zero], [zero, psi]])
    found = Section(mean, moment, by_difference, by_drag)
    straight = ~still & (size < STRAIGHT * along)
    for places, whole in ((straight, True), (~still & ~straight, False)):
        _converge(fluidity, difference, size, drag, found, np.flatnonzero(places), points, whole)
    return found


def _converge(
    fluidity: Fluidity,
    difference: Array,
    size: Array,
    drag: Array,
    found: Section,
    open_: NDArray[np.integer],
    points: int,
    whole: bool,
) -> None:
    """Newton's method at some places, from the mean stresses there; all is written to what is found."""
    mean, moment, by_difference, by_drag = found
    b_x, b_y = difference
    for _ in range(MOST_STEPS):
        if not open_.size:
            return
        m_x, m_y = mean[:, open_]
        first, second = _integrals(fluidity, m_x, m_y, b_x[open_], b_y[open_], size[open_], points, whole)
        rate, turned = first  # ∫ψτ, ∫ζψτ
        a0, a1, a2 = second  # ∫T, ∫ζT, ∫ζ²T as xx, xy, yy
        step = _solve(a0, np.stack([rate[0] - drag[open_], rate[1]]))
        largest = np.hypot(m_x, m_y) + size[open_] / 2
        length = np.hypot(step[0], step[1])
        step = step * np.minimum(1.0, LONGEST * largest / np.maximum(length, 1e-300))
        mean[:, open_] -= step
        last = length <= SHORT * largest
        if np.any(last):
            done = open_[last]
            a0, a1, a2 = a0[:, last], a1[:, last], a2[:, last]
            moment[:, done] = 12 * (turned[:, last] - _times(a1, step[:, last]))
            columns = np.stack([_solve(a0, a1[:2]), _solve(a0, a1[1:])], axis=1)  # A0⁻¹ A1
            product = np.stack([_times(a1, columns[:, 0]), _times(a1, columns[:, 1])], axis=1)
            by_difference[:, :, done] = 12 * (np.stack([a2[:2], a2[1:]]) - product)
            unit = np.stack([np.ones(done.size), np.zeros(done.size)])
            by_drag[:, done] = 12 * _times(a1, _solve(a0, unit))
            open_ = open_[~last]


def _integrals(
    fluidity: Fluidity, m_x: Array, m_y: Array, b_x: Array, b_y: Array, size: Array, points: int, whole: bool
) -> tuple[Array, Array]:
    """∫ζⁱψτ for i = 0, 1, and ∫ζⁱT, T = d(ψτ)/dτ, for i = 0, 1, 2 in its components xx, xy and yy."""
    if whole:
        place, weight = _whole()
    else:
        at, share = _rule(points)
        cut = np.clip(-(m_x * b_x + m_y * b_y) / size**2, -0.5, 0.5)
        below, above = 0.5 + cut, 0.5 - cut
        place = np.concatenate([cut - below * at, cut + above * at])
        weight = np.concatenate([below * share, above * share])
    x, y = m_x + place * b_x, m_y + place * b_y
    square = np.maximum(x * x + y * y, 1e-300)
    ln_psi, slope = fluidity(np.sqrt(square))
    psi = weight * np.exp(ln_psi)
    turn = psi * slope / square
    along, across = turn * x, turn * y
    integrands = np.stack([psi * x, psi * y, psi + along * x, along * y, psi + across * y])  # ψτ, then T
    once = integrands * place
    first = np.stack([integrands[:2].sum(1), once[:2].sum(1)])
    return first, np.stack([integrands[2:].sum(1), once[2:].sum(1), (once[2:] * place).sum(1)])


def _times(matrix: Array, vector: Array) -> Array:
    """Symmetric matrices (xx, xy, yy) times vectors."""
    xx, xy, yy = matrix
    return np.stack([xx * vector[0] + xy * vector[1], xy * vector[0] + yy * vector[1]])


def _solve(matrix: Array, vector: Array) -> Array:
    """Symmetric positive matrices (xx, xy, yy) by vectors; zero where the matrix is."""
    xx, xy, yy = matrix
    determinant = xx * yy - xy * xy
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.stack([yy * vector[0] - xy * vector[1], xx * vector[1] - xy * vector[0]]) / determinant
    return np.where(determinant > 0, found, 0.0)
