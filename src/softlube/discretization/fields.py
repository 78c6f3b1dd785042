"""Pressure and film as smooth functions of position: all that a read-out, a picture or a file knows of a discretisation."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import RectBivariateSpline

from softlube.model.liquids import Liquid, NewtonianLaw
from softlube.model.problem import Cavitation

Array = NDArray[np.floating]

SHARP = 0.3
"""Change of ln η from a node to the next along r, in the outlet half, up to which the pressure counts as smooth on the grid.

Beyond it a cubic interpolant overshoots between the flanks of a spike (docs/notes/viscosity.md; measured with
benchmarks/spike_sphere.py)."""


class Chart(Protocol):
    """Coordinates (ξ, s) in which fields are interpolated: ξ odd in r, θ(s) mapping [0, π] onto itself."""

    def xi_of(self, r: ArrayLike) -> Array: ...
    def r_of(self, xi: ArrayLike) -> Array: ...
    def dr_dxi(self, r: ArrayLike) -> Array: ...
    def s_of(self, theta: ArrayLike) -> Array: ...
    def theta_of(self, s: ArrayLike) -> Array: ...
    def dtheta_ds(self, s: ArrayLike) -> Array: ...
    def scaled(self, factor: float) -> Chart: ...


@dataclass(frozen=True)
class Fields:
    """Pressure and film on the nodes of a polar mesh, normalised as in the paper, Eq. (4), with |h₀| or another unit of height.

    Parameters
    ----------
    chart : Chart
        Smooth coordinates of the mesh.
    r : ndarray, shape (n_r,)
        Radii of the nodes, increasing; 0 may be among them.
    theta : ndarray, shape (n_theta,)
        Angles of the nodes from the inlet, 0 … π.
    pressure, film : ndarray, shape (n_r, n_theta)
        p̄ and ū.
    beta : float
        β, Eq. (6d), with the unit of height in place of |h₀|.
    cavitation : {"reynolds", "none"}
    load : float
        ∫p dA over the whole plane, taken by the discretisation's own quadrature.
    height : float
        h₀ over the unit of height: −1 in the paper's normalisation.
    liquid : Liquid
        The law of the viscosity.
    """

    chart: Chart
    r: Array
    theta: Array
    pressure: Array
    film: Array
    beta: float
    cavitation: Cavitation
    load: float
    height: float = -1.0
    liquid: Liquid = field(default_factory=NewtonianLaw)

    def in_units(self, unit: float) -> Fields:
        """The same fields normalised with another unit of height, given over the present one; Eq. (4)."""
        return Fields(
            chart=self.chart.scaled(unit**-0.5),
            r=self.r * unit**-0.5,
            theta=self.theta,
            pressure=self.pressure * unit**-0.5,
            film=self.film / unit,
            beta=self.beta * unit**2,
            cavitation=self.cavitation,
            load=self.load * unit**-1.5,
            height=self.height / unit,
            liquid=self.liquid.in_units(unit),
        )

    @cached_property
    def steepest_fall(self) -> float:
        """Largest change of ln η from a node to the next along r, in the outlet half: 0 for constant viscosity."""
        outlet = self.pressure[:, self.theta > np.pi / 2]
        return float(np.max(np.abs(np.diff(np.log(self.liquid.viscosity(outlet)), axis=0))))

    @property
    def is_sharp(self) -> bool:
        """Whether the pressure is not smooth on its grid, because of a spike, whose height converges like the spacing only."""
        return self.steepest_fall > SHARP

    def _spline(self, values: Array) -> RectBivariateSpline:
        """Cubic spline through nodal values, continued evenly across θ = 0 and π and through the centre."""
        start = 1 if self.r[0] == 0 else 0
        xi = self.chart.xi_of(self.r)
        s = self.chart.s_of(self.theta)
        margin = 5
        values = np.concatenate([values[start:][::-1, ::-1], values])
        values = np.concatenate([values[:, margin:0:-1], values, values[:, -2 : -2 - margin : -1]], axis=1)
        xi = np.concatenate([-xi[start:][::-1], xi])
        s = np.concatenate([-s[margin:0:-1], s, 2 * np.pi - s[-2 : -2 - margin : -1]])
        return RectBivariateSpline(xi, s, values, kx=3, ky=3, s=0)

    @cached_property
    def pressure_spline(self) -> RectBivariateSpline:
        """p̄(ξ, s)."""
        return self._spline(self.pressure)

    @cached_property
    def reduced_spline(self) -> RectBivariateSpline:
        """Reduced pressure q = ∫ η₀/η dp (ξ, s): its gradient drives the flow, and it is smooth at a spike of p̄."""
        reduced = self.liquid.reduced_pressure(self.pressure)
        return self.pressure_spline if reduced is self.pressure else self._spline(reduced)

    @cached_property
    def film_spline(self) -> RectBivariateSpline:
        """ū(ξ, s)."""
        return self._spline(self.film)

    def _place(self, r: ArrayLike, theta: ArrayLike) -> tuple[Array, Array]:
        r, theta = np.broadcast_arrays(np.asarray(r, dtype=float), np.asarray(theta, dtype=float))
        if np.any(r < 0) or np.any(r > self.r[-1]):
            raise ValueError(f"r: the solution reaches from 0 to {self.r[-1]:.4g}, got {np.min(r):.4g} to {np.max(r):.4g}")
        folded = np.abs(np.remainder(theta + np.pi, 2 * np.pi) - np.pi)
        return self.chart.xi_of(r), self.chart.s_of(folded)

    def pressure_at(self, r: ArrayLike, theta: ArrayLike) -> Array:
        """p̄ at polar coordinates (broadcast); any θ, the field being even.

        Under the Reynolds condition the interpolant's tiny undershoot at the free boundary is cut off.
        """
        xi, s = self._place(r, theta)
        pressure = self.pressure_spline(xi, s, grid=False)
        return np.maximum(pressure, 0) if self.cavitation == "reynolds" else pressure

    def film_at(self, r: ArrayLike, theta: ArrayLike) -> Array:
        """ū at polar coordinates (broadcast)."""
        xi, s = self._place(r, theta)
        return self.film_spline(xi, s, grid=False)

    def viscosity_on(self, xi: Array, s: Array) -> Array:
        """η(p)/η₀ on the product of chart coordinates."""
        return self.liquid.viscosity(self.pressure_spline(xi, s))

    def gradient_on(self, xi: Array, s: Array, spline: RectBivariateSpline | None = None) -> tuple[Array, Array]:
        """Cartesian gradient of the pressure, or of another spline, on the product of chart coordinates ξ > 0 and s."""
        spline = self.pressure_spline if spline is None else spline
        r, theta = self.chart.r_of(xi), self.chart.theta_of(s)
        by_r = spline(xi, s, dx=1) / self.chart.dr_dxi(r)[:, None]
        by_theta = spline(xi, s, dy=1) / self.chart.dtheta_ds(s) / r[:, None]
        return np.cos(theta) * by_r - np.sin(theta) * by_theta, np.sin(theta) * by_r + np.cos(theta) * by_theta
