"""Plain polar coordinates as the chart in which the paper's fields are interpolated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PolarChart:
    """Plain polar coordinates, ξ = r and s = θ; a `softlube.discretization.fields.Chart`."""

    def xi_of(self, r: ArrayLike) -> Array:
        """Coordinate ξ = r."""
        return np.asarray(r, dtype=float)

    def r_of(self, xi: ArrayLike) -> Array:
        """Radius r = ξ."""
        return np.asarray(xi, dtype=float)

    def dr_dxi(self, r: ArrayLike) -> Array:
        """1."""
        return np.ones_like(np.asarray(r, dtype=float))

    def s_of(self, theta: ArrayLike) -> Array:
        """Coordinate s = θ."""
        return np.asarray(theta, dtype=float)

    def theta_of(self, s: ArrayLike) -> Array:
        """Angle θ = s."""
        return np.asarray(s, dtype=float)

    def dtheta_ds(self, s: ArrayLike) -> Array:
        """1."""
        return np.ones_like(np.asarray(s, dtype=float))

    def scaled(self, factor: float) -> PolarChart:
        """The same chart: plain coordinates have no scale."""
        return self
