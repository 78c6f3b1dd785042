"""What a surface remembers: wᵢ(x) = ∫₀^∞ e^(−σ) wₑ(x + Lσ) dσ on panels, exact for polynomials.

That is wᵢ − L ∂wᵢ/∂x = wₑ, bounded ahead.  From the end x₁ of a panel, wᵢ(x) = e^(−(x₁ − x)/L) wᵢ(x₁) + what the panel itself
adds, so that the sum over panels runs downstream and every factor is at most 1.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from softlube.discretization.line.panels import Panels, reference

Array = NDArray[np.floating]

FORGOTTEN = 45.0
"""Distance over L after which nothing is left: e⁻⁴⁵."""
POINTS = 40
"""Points of Gauss's rule over it: good to round-off for polynomials up to degree 20."""


def remembered(panels: Panels, length: float) -> tuple[Array, Array]:
    """The convolution on a mesh, as a matrix.

    Parameters
    ----------
    panels : Panels
        Where wₑ is known.
    length : float
        L > 0.

    Returns
    -------
    matrix : ndarray, shape (size + 1, size)
        From wₑ at the nodes to wᵢ at the nodes and, last, at the downstream end, if wᵢ vanishes at the upstream end.
    left : ndarray, shape (size + 1,)
        What is left there of wᵢ = 1 at the upstream end.
    """
    points, number = panels.points, panels.number
    nodes, _, coefficients, _ = reference(points)
    t = np.append(nodes, -1.0)
    width = length / panels.half
    way = (1 - t) / width[:, None]  # to the panel's end, over L
    sigma, weight = legendre.leggauss(POINTS)
    reach = np.minimum(way, FORGOTTEN)
    sigma = reach[:, :, None] * (sigma + 1) / 2
    weight = reach[:, :, None] * weight / 2 * np.exp(-sigma)
    places = np.minimum(t[:, None] + width[:, None, None] * sigma, 1.0)
    own = np.einsum("ktq,ktqm->ktm", weight, legendre.legvander(places, points - 1)) @ coefficients
    fading = np.exp(-way)

    matrix, left = np.zeros((panels.size + 1, panels.size)), np.empty(panels.size + 1)
    at_end, left_at_end = np.zeros(panels.size), 1.0
    for k in range(number - 1, -1, -1):
        rows = np.outer(fading[k], at_end)
        rows[:, k * points : (k + 1) * points] += own[k]
        matrix[k * points : (k + 1) * points] = rows[:-1]
        left[k * points : (k + 1) * points] = fading[k, :-1] * left_at_end
        at_end, left_at_end = rows[-1], fading[k, -1] * left_at_end
    matrix[-1], left[-1] = at_end, left_at_end
    return matrix, left
