"""The paper's polar mesh: uniform in θ, graded in r towards the contact edge r = 1; Eq. (12)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]

EDGE = 1.0
"""Radius where the mesh is dense: the Hertz contact edge."""
OUTER = 2.0
"""Outer radius of the paper's domain, where p = 0; Eq. (17b)."""
TRANSITION = 0.2
"""Length L of the graded segments on either side of the edge.  The paper does not print its own."""
SHARE = 0.28
"""Share of the spacings in the core, and in each of the two graded segments; the rest lie beyond.  Not printed either."""
FEWEST = 20
"""Fewest radial spacings for which the shares make a mesh."""


def _coefficient(fill: Callable[[float], float]) -> float:
    """The root a ≥ 0 of an error of length that falls or rises with a from its value at 0."""
    high, at_zero = 1.0, fill(0.0)
    if abs(at_zero) < 1e-12:
        return 0.0
    while fill(high) * at_zero > 0:
        high *= 2
    return float(brentq(fill, 0.0, high, xtol=1e-14, rtol=1e-14))


def growing_spacings(n: int, length: float, before: float) -> Array:
    """Spacings d_1 … d_n that grow from a given d_0 and fill a segment, Eq. (12) with b = 0.

    d_j = λ_j d_{j−1} with λ_j = 1 + (a/L) d_{j−1}; the coefficient a is found.

    Parameters
    ----------
    n : int
        Number of spacings.
    length : float
        Length L of the segment.
    before : float
        Spacing d_0 before the segment, at most L/n.

    Returns
    -------
    ndarray, shape (n,)

    Raises
    ------
    ValueError
        If n spacings of d_0 are longer than the segment.
    """
    _check(n, 0 < before * n <= length * (1 + 1e-12), f"at most {length / max(n, 1):.3g} before it, not {before:.3g}")

    def spacings(a: float) -> Array:
        d = np.empty(n + 1)
        d[0] = before
        for j in range(1, n + 1):
            d[j] = d[j - 1] * (1 + a / length * d[j - 1])
        return d[1:]

    return spacings(_coefficient(lambda a: spacings(a).sum() - length))


def graded_spacings(n: int, length: float, after: float) -> Array:
    """Spacings d_0 … d_{n−1} that fill a segment and grow towards a given d_n, Eq. (12) with b = 0.

    The rule of `growing_spacings` solved for d_{j−1}: here the spacing is known at the coarse end, and the fine end follows.

    Parameters
    ----------
    n, length : int, float
        Number of spacings and length L of the segment.
    after : float
        Spacing d_n after the segment, at least L/n.

    Returns
    -------
    ndarray, shape (n,)

    Raises
    ------
    ValueError
        If n spacings of d_n are shorter than the segment.
    """
    _check(n, after * n >= length * (1 - 1e-12), f"at least {length / max(n, 1):.3g} after it, not {after:.3g}")

    def spacings(a: float) -> Array:
        d = np.empty(n + 1)
        d[n] = after
        for j in range(n, 0, -1):
            d[j - 1] = 2 * d[j] / (1 + np.sqrt(1 + 4 * a / length * d[j]))
        return d[:n]

    return spacings(_coefficient(lambda a: spacings(a).sum() - length))


def _check(n: int, possible: bool, need: str) -> None:
    if n < 1 or not possible:
        raise ValueError(f"a segment of {n} spacings needs one of {need}")


def radial_nodes(n_r: int) -> Array:
    """Nodes r_0 = 0 … r_n = 2: a uniform core, two graded segments that meet at r = 1, and a segment that grows outwards.

    Spacings follow (12) throughout, also from one segment to the next, except at r = 1 itself, where λ = 1: inside, the same
    rule holds towards the centre.

    Parameters
    ----------
    n_r : int
        Number of spacings, at least FEWEST.

    Returns
    -------
    ndarray, shape (n_r + 1,)
    """
    if n_r < FEWEST:
        raise ValueError(f"n_r: expected at least {FEWEST}, got {n_r!r}")
    n = round(SHARE * n_r)
    core = np.full(n, (EDGE - TRANSITION) / n)
    graded = graded_spacings(n, TRANSITION, core[0])
    outside = growing_spacings(n_r - 3 * n, OUTER - EDGE - TRANSITION, core[0])
    r = np.concatenate([[0.0], np.cumsum(np.concatenate([core, graded[::-1], graded, outside]))])
    r[[2 * n, n_r]] = EDGE, OUTER
    return r


@dataclass(frozen=True)
class PaperMesh:
    """Nodes (r_j, θ_i) over the half domain r ≤ 2, 0 ≤ θ ≤ π.  Fields on it have shape (n_r + 1, n_theta + 1), radius first.

    Parameters
    ----------
    n_r, n_theta : int
        Numbers of spacings: the paper's "50 × 30".  The centre r = 0 is one node, repeated along θ in a field.
    """

    n_r: int = 50
    n_theta: int = 30

    def __post_init__(self) -> None:
        if self.n_r < FEWEST or self.n_theta < 4:
            raise ValueError(f"n_r, n_theta: expected at least {FEWEST} x 4, got {self.n_r!r} x {self.n_theta!r}")

    @cached_property
    def r(self) -> Array:
        """Radii r_j, shape (n_r + 1,)."""
        return radial_nodes(self.n_r)

    @cached_property
    def d(self) -> Array:
        """Spacings d_j = r_{j+1} − r_j, shape (n_r,)."""
        return np.diff(self.r)

    @cached_property
    def ratio(self) -> Array:
        """λ_j = d_j / d_{j−1} at the inner nodes j = 1 … n_r − 1, shape (n_r − 1,)."""
        return self.d[1:] / self.d[:-1]

    @property
    def d_theta(self) -> float:
        """Δθ."""
        return np.pi / self.n_theta

    @cached_property
    def theta(self) -> Array:
        """Angles θ_i from the inlet, shape (n_theta + 1,)."""
        return np.linspace(0, np.pi, self.n_theta + 1)

    @property
    def shape(self) -> tuple[int, int]:
        """Shape of a field on the nodes."""
        return self.n_r + 1, self.n_theta + 1
