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


class Precision(NamedTuple):
    """How exactly the flow across the film is found.

    Attributes
    ----------
    points : int
        Gauss's points on each part of the film.
    short : float
        Relative step of the mean stress that is the last one; what it leaves is some 30 times its square.
    """

    points: int
    short: float


USUAL, EXACT = Precision(10, 1e-5), Precision(30, 1e-6)
"""Precisions: m is exact to some 1e-6 where the stress goes from a thousandth of what the liquid thins at to a thousand times
that, and to 1e-10 (tests/model/test_film_section.py)."""
MOST_STEPS = 60
"""Steps of Newton's method at most; three are usual, and one from the mean stress of a state close by."""
LONGEST = 0.5
"""Largest change of the mean stress in one step, over the largest stress at the place."""
FIRST_STEPS = 3
"""Steps to the first guess of the mean stress, at one stress each."""
BLOCK = 500
"""Places at which ψ is taken across the film at once: with larger arrays most of the time would go into their memory."""
LEAST = 1e-150
"""Stress that stands for none where a logarithm is taken."""


@cache
def _rule(points: int) -> tuple[Array, Array]:
    """Places y² on a part of unit length, in a column, and their weights for the moments 0 to 4, shape (5, points)."""
    x, weight = leggauss(points)
    place = ((x + 1) / 2) ** 2
    return place[:, None], weight * (x + 1) / 2 * place ** np.arange(5)[:, None]


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


def film_section(
    liquid: Liquid, difference: Array, drag: Array, precision: Precision = USUAL, guess: Array | None = None
) -> Section:
    """Solve for the flow across the film.

    Parameters
    ----------
    liquid : Liquid
        Its ψ, see `softlube.model.liquids.base.Liquid.fluidity_at`.
    difference : ndarray, shape (2, n)
        b, Cartesian; x is the direction in which the walls slide along each other.
    drag : ndarray, shape (n,)
        c.
    precision : Precision
        Of the quadrature and of the mean stress.
    guess : ndarray, shape (2, n), optional
        Mean stress of a state close by, where Newton's method starts.
    """
    n, size = drag.size, np.hypot(*difference)
    mean = _first_mean(liquid, difference, drag) if guess is None else guess.copy()
    found = Section(mean, np.zeros((2, n)), np.empty((2, 2, n)), np.zeros((2, n)))
    still = size == 0  # sheared only
    if np.any(still):
        stress = np.copysign(liquid.flow_curve(np.abs(drag[still])), drag[still])
        ln_psi, slope = liquid.fluidity_at(np.maximum(np.abs(stress), LEAST))
        psi, zero = np.exp(ln_psi), np.zeros(stress.size)
        mean[:, still] = stress, zero
        found.by_difference[:, :, still] = np.array([[psi * (1 + slope), zero], [zero, psi]])
    _converge(liquid.fluidity_at, difference, drag, found, np.flatnonzero(~still), precision)
    return found


def _first_mean(liquid: Liquid, difference: Array, drag: Array) -> Array:
    """About the mean stress: what the drag causes with ψ of one stress.

    The square of that stress is (τm)² + (3b_x² + b_y²)/12, which is right for a liquid that hardly thins.
    """
    sheared = np.maximum(np.abs(drag), LEAST)
    pushed = (3 * difference[0] ** 2 + difference[1] ** 2) / 12
    goal, ln_mean = np.log(sheared), np.log(np.maximum(liquid.flow_curve(sheared), LEAST))
    share = slope = np.zeros(drag.size)
    for _ in range(FIRST_STEPS):
        own = np.exp(2 * ln_mean)
        share = pushed / (own + pushed)
        ln_psi, slope = liquid.fluidity_at(np.sqrt(own + pushed))
        ln_mean = np.maximum(ln_mean - (ln_mean + ln_psi - goal) / (1 + slope * (1 - share)), np.log(LEAST))
    mean = np.where(drag == 0, 0.0, np.copysign(np.exp(ln_mean), drag))
    # Where b is the larger, ψ(1 + slope) is what resists along b, ψ what resists across it.
    along, across = np.where(share > 0, difference / np.sqrt(np.maximum(12 * pushed, LEAST**2)), 0.0)
    return np.stack([mean, -mean * slope * share * along * across])


def _converge(
    fluidity: Fluidity, difference: Array, drag: Array, found: Section, open_: NDArray[np.integer], precision: Precision
) -> None:
    """Newton's method at some places, from the mean stresses there; all is written to what is found."""
    m, b, c = found.mean.take(open_, axis=1), difference.take(open_, axis=1), drag.take(open_)
    for _ in range(MOST_STEPS):
        if not open_.size:
            return
        rate, turned, a0, a1, a2 = _integrals(fluidity, m, b, precision.points)
        rate[0] -= c
        inverse = _inverse(a0)
        step = _times(inverse, rate)
        largest, length = np.hypot(*m) + np.hypot(*b) / 2, np.hypot(*step)
        m -= step * np.minimum(1.0, LONGEST * largest / np.maximum(length, 1e-300))
        last = length <= precision.short * largest
        near, far = np.flatnonzero(last), np.flatnonzero(~last)
        if near.size:
            a1, a2, inverse = (each.take(near, axis=1) for each in (a1, a2, inverse))
            by_x, by_y = _times(a1, inverse[:2]), _times(a1, inverse[1:])  # the columns of A1 A0⁻¹
            done = open_[near]
            found.mean[:, done] = m.take(near, axis=1)
            found.moment[:, done] = 12 * (turned.take(near, axis=1) - _times(a1, step.take(near, axis=1)))
            found.by_drag[:, done] = 12 * by_x
            found.by_difference[:, 0, done] = 12 * (a2[:2] - by_x * a1[0] - by_y * a1[1])
            found.by_difference[:, 1, done] = 12 * (a2[1:] - by_x * a1[1] - by_y * a1[2])
            open_, m, b, c = open_[far], m.take(far, axis=1), b.take(far, axis=1), c[far]


def _integrals(fluidity: Fluidity, m: Array, b: Array, points: int) -> tuple[Array, Array, Array, Array, Array]:
    """∫ζⁱψτ for i = 0, 1, and ∫ζⁱT, T = d(ψτ)/dτ, for i = 0, 1, 2 in its components xx, xy and yy.

    All are sums of moments of ψ and of its derivative about the cut, ζ = cut + s, where τ = τ(cut) + s b.
    """
    square = b[0] * b[0] + b[1] * b[1]
    cut = np.clip(-(m[0] * b[0] + m[1] * b[1]) / square, -0.5, 0.5)
    c = m + cut * b
    p, q = _moments(fluidity, square, 2 * (c[0] * b[0] + c[1] * b[1]), c[0] * c[0] + c[1] * c[1], cut, points)
    cc, bb, cb = _products(c, c), _products(b, b), 2 * _products(c, b)
    t0, t1, t2 = (cc * q[k] + cb * q[k + 1] + bb * q[k + 2] for k in range(3))
    for k, each in enumerate((t0, t1, t2)):
        each[::2] += p[k]
    rate, turned = c * p[0] + b * p[1], c * p[1] + b * p[2]
    # From moments about the cut to those about the middle.
    return rate, turned + cut * rate, t0, t1 + cut * t0, t2 + cut * (2 * t1 + cut * t0)


def _moments(fluidity: Fluidity, square: Array, linear: Array, constant: Array, cut: Array, points: int) -> tuple[Array, Array]:
    """Moments 0 to 2 of ψ and 0 to 4 of dψ/dτ/τ about the cut, where τ² is a polynomial in the distance s from there."""
    (at, weights), n = _rule(points), cut.size
    p, q = np.zeros((3, n)), np.zeros((5, n))
    for part in (slice(first, first + BLOCK) for first in range(0, n, BLOCK)):
        for end in (-0.5, 0.5):
            length = end - cut[part]
            s = length * at
            stress = np.sqrt(np.maximum(s * (s * square[part] + linear[part]) + constant[part], LEAST**2))
            ln_psi, slope = fluidity(stress)
            psi = np.exp(ln_psi)
            turn = weights @ (psi * slope / (stress * stress))
            power = np.abs(length)
            for k, each in enumerate(weights[:3] @ psi):
                p[k, part] += power * each
                q[k, part] += power * turn[k]
                power = power * length
            q[3, part] += power * turn[3]
            q[4, part] += power * length * turn[4]
    return p, q


def _products(a: Array, b: Array) -> Array:
    """The components xx, xy and yy of the symmetric part of a bᵀ."""
    return np.stack([a[0] * b[0], (a[0] * b[1] + a[1] * b[0]) / 2, a[1] * b[1]])


def _times(matrix: Array, vector: Array) -> Array:
    """Symmetric matrices (xx, xy, yy) times vectors."""
    return matrix[:2] * vector[0] + matrix[1:] * vector[1]


def _inverse(matrix: Array) -> Array:
    """The inverses of symmetric positive matrices (xx, xy, yy); zero where they are."""
    determinant = matrix[0] * matrix[2] - matrix[1] * matrix[1]
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.stack([matrix[2], -matrix[1], matrix[0]]) / determinant
    return np.where(determinant > 0, found, 0.0)
