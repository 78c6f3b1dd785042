"""What a substrate's kernel has beyond the half-plane's, along a line.

In Fourier space a substrate has C(k) times the half-plane's compliance, so that along a line its kernel is

    2∫₀^∞ C(k) cos(kd)/k dk = −2 ln d + G(d),     G(d) = 2∫₀^∞ (C(k) − 1) (cos kd − 1)/k dk,

up to a constant.  G is smooth; far away it grows like a logarithm, so that a layer on a rigid base hardly yields there.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from softlube.discretization.line.panels import Panels
from softlube.model.substrates import Substrate

Array = NDArray[np.floating]

REACH = 20.0
"""Distance, over the length on which the remainder is smooth, beyond which it is a logarithm."""
STEP = 0.01
"""Spacing of its table over that length; the cubic spline through it is good to 10⁻⁹."""
MOST_PARTS = 32
"""Parts at most in which a panel that is long beside that length is cut for the quadrature.  Longer panels are far from the
contact, where pressures are small."""


def remainder_potential(substrate: Substrate, panels: Panels, places: Array, degree: int) -> Array:
    """∫ f(s′) G(|s − s′|) ds′ at some places, as a matrix on the Legendre coefficients of f on the panels.

    Parameters
    ----------
    substrate : Substrate
        With a remainder.
    panels : Panels
        Where f is.
    places : ndarray, shape (n,)
        Places s.
    degree : int
        Of f.

    Returns
    -------
    ndarray, shape (n, panels, degree + 1)
    """
    assert substrate.remainder is not None
    smooth = substrate.remainder.smooth_over
    reach = REACH * smooth
    k, weight = substrate.spectrum(reach)
    distance = np.arange(0.0, REACH + STEP, STEP) * smooth
    table = CubicSpline(distance, -4 * np.sin(np.outer(distance, k) / 2) ** 2 @ (weight / k))
    growth = float(reach * table(reach, 1))
    t, own = legendre.leggauss(degree + 6)
    result = np.empty((places.size, panels.number, degree + 1))
    for number, (middle, half) in enumerate(zip(panels.middle, panels.half, strict=True)):
        parts = min(int(np.ceil(half / smooth)), MOST_PARTS)
        edges = np.linspace(-1, 1, parts + 1)
        sources = (((edges[1:] + edges[:-1])[:, None] + t / parts * 2) / 2).ravel()
        rule = legendre.legvander(sources, degree) * np.tile(own / parts, parts)[:, None]
        apart = np.abs(places[:, None] - middle - half * sources)
        values = table(np.minimum(apart, reach)) + growth * np.log(np.maximum(apart / reach, 1.0))
        result[:, number] = half * values @ rule
    return result
