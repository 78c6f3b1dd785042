"""Potentials of rings: the kernel 1/|x − x′| of a half-space, Eqs. (2) and (6b), harmonic by harmonic.

    k_m(r, r′) = ∫₀^{2π} cos mφ dφ/√(r² + r′² − 2rr′ cos φ) = 2 Q_{m−1/2}(χ)/√(rr′),      χ = (r² + r′²)/(2rr′),

with the Legendre function of the second kind.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipe, ellipkm1

from softlube.model.substrates import Orders

Array = NDArray[np.floating]

NEGLIGIBLE = 30.0
"""mη beyond which Q_{m−1/2} ~ e^{−mη} is taken for zero."""
FORWARD = 6.0
"""mη up to which the forward recurrence is good to 10⁻¹² of Q_{−1/2}."""


def ring_kernels(orders: Orders, r: Array, r_source: Array) -> Array:
    """Ring kernels k_m(r, r′) of some orders m.

    Parameters
    ----------
    orders : ndarray of int
        Orders, ascending from 0.
    r, r_source : ndarray
        Radii of target and source, positive, of shapes that broadcast; r ≠ r_source.

    Returns
    -------
    ndarray, shape (n_orders, ...)

    Notes
    -----
    The three-term recurrence of Q_{m−1/2} loses a factor e^{2mη} of accuracy forwards, while Q falls like e^{−mη}: that is
    good enough close to χ = cosh η = 1.  Elsewhere the ratios Q_{m+1/2}/Q_{m−1/2} come from the backward recurrence (Miller),
    started so far up that the start is forgotten.  Both are anchored at Q_{−1/2} and Q_{1/2}, which are complete elliptic
    integrals (Abramowitz & Stegun 8.13).  In the order of η, the points that still have a harmonic are neighbours.
    """
    # (χ − 1)/2 = (r − r′)²/(4rr′) is formed without cancellation.
    excess = np.maximum((r - r_source) ** 2 / (2 * r * r_source), 1e-30)
    shape, place = excess.shape, np.argsort(excess, axis=None)
    excess = excess.ravel()[place]
    chi, eta = 1 + excess, np.log1p(excess + np.sqrt(excess * (2 + excess)))
    q = np.zeros((orders.size, excess.size))
    q[0] = np.sqrt(2 / (chi + 1)) * ellipkm1(excess / (chi + 1))
    near = int(np.searchsorted(eta, FORWARD / max(orders[-1], 1)))
    _forward(orders, q[:, :near], chi[:near])
    _backward(orders, q[:, near:], chi[near:], eta[near:])
    result = np.empty_like(q)
    result[:, place] = q
    result = result.reshape(orders.size, *shape)
    result *= 2 / np.sqrt(r * r_source)
    return result


def _forward(orders: Orders, q: Array, chi: Array) -> None:
    """Fill the rows Q_{m−1/2}(χ) from the first one upwards."""
    before, here = q[0], chi * q[0] - np.sqrt(2 * (chi + 1)) * ellipe(2 / (chi + 1))
    row = 1
    for m in range(1, orders[-1] + 1):
        if m == orders[row]:
            q[row] = here
            row += 1
        before, here = here, (4 * m / (2 * m + 1)) * chi * here - ((2 * m - 1) / (2 * m + 1)) * before


def _backward(orders: Orders, q: Array, chi: Array, eta: Array) -> None:
    """Fill the rows Q_{m−1/2}(χ) from the first one by their ratios; η ascends, χ = cosh η."""
    # From where Q is negligible, or from so far beyond the last that what is left of the start is no more than that.
    first = np.ceil(np.minimum(NEGLIGIBLE / eta, (orders[-1] + NEGLIGIBLE / eta) / 2)).astype(int)
    highest = int(np.max(first, initial=0))
    reached = np.searchsorted(-first, -np.arange(max(highest, orders[-1]) + 1), side="right")
    ratio = np.exp(-eta)

    def down_to(m: int) -> Array:
        """Q_{m−1/2} over Q_{m−3/2} from the ratio above it."""
        here = ratio[: reached[m]]
        here *= -(2 * m + 1) / (2 * m - 1)
        here += 4 * m / (2 * m - 1) * chi[: reached[m]]
        return np.reciprocal(here, out=here)

    for m in range(highest, orders[-1], -1):
        down_to(m)
    for row in range(orders.size - 1, 0, -1):
        known = reached[orders[row]]
        q[row, :known] = 1
        for m in range(orders[row], orders[row - 1], -1):
            q[row, :known] *= down_to(m)[:known]
    for row in range(1, orders.size):
        known = reached[orders[row]]
        q[row, :known] *= q[row - 1, :known]
