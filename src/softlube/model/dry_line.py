"""The dry line contact on a half-space, elastic or with one relaxation time, in closed form (Hertz 1881, Hunter 1961).

A cylinder slides without a film and without friction of its own on a half-space with J(t) = J₀ + J₁(1 − e^(−t/τ)), J₀ + J₁ = 1.
With Q = p − J₀L p′ the condition that the surface follows the cylinder, w′ = x, is 2 pv∫ Q(x′)/(x − x′) dx′ = x − L.  About
the middle m of the contact, ξ = x − m, its solutions are

    Q = (α₀ + α₁ξ + α₂ξ²)/√(c² − ξ²),   α₂ = −1/(2π),   α₁ = (L − m)/(2π),

and two conditions are left: p vanishes at the trailing edge, and the surface that arrives has the cylinder's slope there,

    ∫ e^(−ξ/(J₀L)) Q dξ = 0 over the contact,    ∫ e^(−ξ/L) (α₀ + α₁ξ + α₂ξ²)/√(ξ² − c²) dξ = 0 ahead of it.

They are linear in α₀ and α₁, with modified Bessel functions of the first and of the second kind.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from softlube.errors import InputError
from softlube.model.exact import LINE_LOAD
from softlube.model.substrates import Substrate

Array = NDArray[np.floating]

POINTS = 200
"""Points of the quadrature of a pressure."""


@dataclass(frozen=True)
class DryLine:
    """A dry line contact under the load of Hertz's, lengths over b, pressures over 4πG b/R, G that of long times.

    Attributes
    ----------
    half_width : float
        c, half the width of the contact.
    middle : float
        Place m of its middle; the cylinder slides towards positive x.
    friction_hysteresis : float
        6∫ p ∂w/∂x dx, in units of (2π/3)G (b²/R)²/b.
    instantaneous : float
        J₀; 1 on an elastic half-space.
    length : float
        L.
    numerator : tuple of float
        α₀, α₁, α₂.
    """

    half_width: float
    middle: float
    friction_hysteresis: float
    instantaneous: float
    length: float
    numerator: tuple[float, float, float]

    def pressure(self, x: ArrayLike) -> Array:
        """Pressure at some places; 0 outside the contact."""
        xi = (np.asarray(x, dtype=float) - self.middle) / self.half_width
        inside = np.abs(xi) < 1
        xi = np.where(inside, xi, 0.0)
        first, second, third = self.numerator
        lag = self.instantaneous * self.length / self.half_width
        if lag == 0:
            return np.where(inside, self.half_width * np.sqrt(1 - xi**2) / (2 * np.pi), 0.0)
        # p = ∫ e^(−σ) Q dσ over the way ahead; with y = c cos θ the edge is no singularity.
        t, weight = leggauss(POINTS)
        start = np.arccos(np.minimum(xi + 40 * lag, 1.0))
        theta = start[..., None] + (np.arccos(xi) - start)[..., None] * (t + 1) / 2
        y = np.cos(theta)
        numerator = first + self.half_width * y * (second + self.half_width * y * third)
        whole = np.exp(-(y - xi[..., None]) / lag) * numerator @ weight * (np.arccos(xi) - start) / (2 * lag * self.half_width)
        return np.where(inside, whole, 0.0)


def dry_line(substrate: Substrate) -> DryLine:
    """The dry line contact under the load of Hertz's.

    Parameters
    ----------
    substrate : Substrate
        An elastic half-space, or a viscoelastic one with one time, normalised with b²/R.

    Raises
    ------
    InputError
        If the substrate is another one.
    """
    memory = substrate.memory
    if substrate.remainder is not None or (memory is not None and len(memory.lengths) > 1):
        raise InputError("substrate: a dry line contact is known in closed form on half-spaces with one time at most")
    if memory is None or memory.lengths[0] == 0:
        return DryLine(1.0, 0.0, 0.0, 1.0, 0.0, (1 / (2 * np.pi), 0.0, -1 / (2 * np.pi)))
    from scipy.optimize import brentq

    instantaneous, length = memory.instantaneous, memory.lengths[0]
    # Stiffer than the relaxed half-space, softer than the instantaneous one.
    low, high = 0.9 * math.sqrt(instantaneous), 1.1
    half_width = float(brentq(lambda c: _contact(c, instantaneous, length)[0] - LINE_LOAD, low, high, xtol=1e-15))
    _, numerator = _contact(half_width, instantaneous, length)
    first, second, third = numerator
    middle = length - 2 * np.pi * second
    # ∫ pξ dξ, from Q = p − J₀L p′.
    moment = second * np.pi * half_width**2 / 2 - instantaneous * length * LINE_LOAD
    return DryLine(half_width, middle, 6 * (middle * LINE_LOAD + moment), instantaneous, length, (first, second, third))


def _contact(half_width: float, instantaneous: float, length: float) -> tuple[float, tuple[float, float, float]]:
    """Load, and α₀, α₁, α₂, of a contact of some width."""
    from scipy.special import ive, kve

    inner, outer = half_width / (instantaneous * length), half_width / length
    i0, i1, k0, k1 = float(ive(0, inner)), float(ive(1, inner)), float(kve(0, outer)), float(kve(1, outer))
    third = -1 / (2 * np.pi)
    square = third * half_width**2
    matrix = [[i0, -half_width * i1], [k0, half_width * k1]]
    first, second = np.linalg.solve(matrix, [-square * (i0 - i1 / inner), -square * (k0 + k1 / outer)]).tolist()
    return np.pi * first + square * np.pi / 2, (first, second, third)
