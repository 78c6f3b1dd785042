"""The polar grid: graded towards the contact edge r = 1 and towards the sides θ = 90°.

Both directions are smooth images of uniform coordinates, r(ξ) and θ(s), so that every difference formula is one for a
uniform mesh (mesh grading by a mapping).  The grid knows no physics.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipkinc

Array = NDArray[np.floating]

RIM = 2
"""Rows of nodes beyond the outermost cell, where the far field is imposed."""


THINNING, WIDE = 0.8, 2.0
"""Coefficient of the last term of ξ(r), by which the mesh is thinned beyond the contact, and the radius from which on it is.

A coefficient of 1 takes a fifth of the rings away and trebles the error of the load; 0.8 is the compromise
(docs/notes/numerical-method.md)."""


BAND_ENDS = 0.1
"""Width over which a band of even cells begins and ends, over its own, at least."""


@dataclass(frozen=True)
class PolarGrid:
    """Half of the plane, 0 ≤ θ ≤ π, in cells that are uniform in (ξ, s).

    Radially, with ρ = r/`edge` and d = `edge_width`, ξ(r) = asinh((ρ − 1)/d) + asinh((ρ + 1)/d) − 0.8 asinh(ρ/2): cells are
    about d wide (over `edge`, in units of Δξ) at the contact edge and grow in proportion to the distance from it, faster far
    outside where the pressure is a power of r.  A `crest` adds a second zone of the same kind, and a `core` one about the
    centre, asinh(ρ/core) − asinh(ρ/2), which adds nothing far outside.  A `band` adds cells of even width between two radii,
    for an edge that moves.  ξ is odd in r, so the mesh continues smoothly through the centre to the opposite side,
    (−r, θ) = (r, π − θ).

    Angularly, ds/dθ ∝ 1 + c/√(w² + cos²θ) with w = `side_width` and c = `side_clustering`: intervals shrink in proportion to
    the distance from 90°, down to a zone of angle w around it.  The number of angles that it takes to resolve a narrow feature
    thus grows only like the logarithm of its width.  Functions even and periodic in θ are so in s.

    Parameters
    ----------
    n_r, n_theta : int
        Number of cells along r, and of intervals along θ (n_theta + 1 nodes, the axis included at both ends).
    edge_width : float
        Width of the refined zone at the contact edge, relative to `edge`.
    side_width : float
        Angle of the refined zone at θ = 90°, in radians.
    side_clustering : float
        How strongly the angles are clustered there, c above.
    reach : float
        Outer radius of the last cell, relative to `edge`.
    edge : float
        Radius of the contact edge in the units of the problem.
    crest : float
        Radius, relative to `edge`, at which the mesh is refined once more, 0 for nowhere.
    crest_width : float
        Width of the refined zone there, relative to `edge`.
    thinning : float
        Coefficient of the last term of ξ(r), by which the mesh is thinned beyond the contact.
    core : float
        Width of the refined zone about the centre, relative to `edge`; `WIDE` for none.
    band : float
        Inner radius of a band up to the edge, relative to `edge`, over which cells of even width are spread; 1 for none.
    band_share : float
        How much ξ grows by them, see `xi_of`.
    """

    n_r: int
    n_theta: int
    edge_width: float = 0.05
    side_width: float = 0.5
    side_clustering: float = 0.5
    reach: float = 20.0
    edge: float = 1.0
    crest: float = 0.0
    crest_width: float = 0.05
    thinning: float = THINNING
    core: float = WIDE
    band: float = 1.0
    band_share: float = 0.0

    def __post_init__(self) -> None:
        if self.n_r < 8 or self.n_theta < 6:
            raise ValueError(f"a polar grid needs n_r >= 8 and n_theta >= 6, not {self.n_r} x {self.n_theta}")
        if not min(self.edge_width, self.side_width, self.side_clustering, self.reach - 1, self.edge, self.crest_width) > 0:
            raise ValueError("a polar grid needs widths > 0, side_clustering > 0, reach > 1 and edge > 0")
        if not 0 < self.core <= WIDE:
            raise ValueError(f"a polar grid needs a core of up to {WIDE:g}")
        if not (0 < self.band <= 1 and self.band_share >= 0):
            raise ValueError("a polar grid needs a band that begins between its centre and its edge, and a share >= 0")
        if not 0 <= self.crest < self.reach:
            raise ValueError("a polar grid needs a crest between 0 and its reach")

    # --- radial direction -------------------------------------------------------------------------------------------

    @property
    def _zones(self) -> list[tuple[float, float]]:
        """Place and width of the refined zones, over `edge`."""
        return [(1.0, self.edge_width), *([(self.crest, self.crest_width)] if self.crest else [])]

    @property
    def _band_ends(self) -> float:
        """Width over which the band begins and ends; no narrower than the zone at the edge, so that ξ stays smooth."""
        return max(BAND_ENDS * (1 - self.band), self.edge_width)

    def xi_of(self, r: ArrayLike) -> Array:
        """Uniform radial coordinate ξ of radius r."""
        rho = np.asarray(r, dtype=float) / self.edge
        fine = sum(np.arcsinh((rho - place) / d) + np.arcsinh((rho + place) / d) for place, d in self._zones)
        if self.core < WIDE:
            fine = fine + np.arcsinh(rho / self.core) - np.arcsinh(rho / WIDE)
        if self.band < 1:
            smooth = self._band_ends
            # √(d² + (ρ − b)²) − √(d² + (ρ + b)²), without cancellation
            inner, outer = (
                -4 * place * rho / (np.hypot(smooth, rho - place) + np.hypot(smooth, rho + place)) for place in (self.band, 1.0)
            )
            fine = fine + self.band_share / (2 * (1 - self.band)) * (inner - outer)
        return fine - self.thinning * np.arcsinh(rho / WIDE)

    @cached_property
    def _radii(self) -> tuple[Array, Array]:
        """A table of ξ and r/`edge`, dense around the refined zones."""
        d = self.edge_width
        table = 1 + d * np.sinh(np.linspace(-np.arcsinh(1 / d), np.arcsinh(2 * self.reach / d), 800))
        if self.core < WIDE:
            table = np.union1d(table, self.core * np.sinh(np.linspace(0, np.arcsinh(1 / self.core), 201)))
        if self.crest:
            # Newton's method needs a table that has seen the zones.
            near = self.crest + self.crest_width * np.sinh(np.linspace(-5, 5, 201))
            table = np.union1d(table, near[near > 0])
        if self.band < 1:
            table = np.union1d(table, np.linspace(2 * self.band - 1, 2 - self.band, 401).clip(0))
        table[0] = 0
        return self.xi_of(table * self.edge), table

    def r_of(self, xi: ArrayLike) -> Array:
        """Radius r of the uniform coordinate ξ (Newton's method on `xi_of`, to round-off)."""
        xi = np.asarray(xi, dtype=float)
        rho = np.interp(np.abs(xi), *self._radii)
        for _ in range(20):
            step = (self.xi_of(rho * self.edge) - np.abs(xi)) * self.dr_dxi(rho * self.edge) / self.edge
            rho = np.abs(rho - step)
            if np.all(np.abs(step) <= 1e-10 * rho):  # quadratic: the next step would be round-off
                break
        return np.sign(xi) * rho * self.edge

    def dr_dxi(self, r: ArrayLike) -> Array:
        """Derivative dr/dξ at radius r."""
        rho = np.asarray(r, dtype=float) / self.edge
        fine = sum(1 / np.hypot(d, rho - place) + 1 / np.hypot(d, rho + place) for place, d in self._zones)
        if self.core < WIDE:
            fine = fine + 1 / np.hypot(self.core, rho) - 1 / np.hypot(WIDE, rho)
        if self.band < 1:
            smooth = self._band_ends
            inner, outer = (
                (rho - place) / np.hypot(smooth, rho - place) - (rho + place) / np.hypot(smooth, rho + place)
                for place in (self.band, 1.0)
            )
            fine = fine + self.band_share / (2 * (1 - self.band)) * (inner - outer)
        return self.edge / (fine - self.thinning / np.hypot(WIDE, rho))

    @cached_property
    def d_xi(self) -> float:
        """Spacing of ξ."""
        return float(self.xi_of(self.reach * self.edge)) / self.n_r

    @cached_property
    def xi(self) -> Array:
        """ξ at the nodes (cell centres, then RIM nodes beyond the rim), shape (n_r + RIM,)."""
        return (np.arange(self.n_r + RIM) + 0.5) * self.d_xi

    @cached_property
    def r(self) -> Array:
        """Radius of the nodes, shape (n_r + RIM,)."""
        return self.r_of(self.xi)

    @cached_property
    def r_face(self) -> Array:
        """Radius of the cell faces, from the centre outwards, shape (n_r + RIM,)."""
        return self.r_of(np.arange(self.n_r + RIM) * self.d_xi)

    # --- angular direction ------------------------------------------------------------------------------------------

    def _clustered(self, angle: Array) -> Array:
        """∫ (1 + c/√(w² + sin²φ)) dφ from 90° to an angle from there, an elliptic integral."""
        return angle + self.side_clustering / self.side_width * ellipkinc(angle, -1 / self.side_width**2)

    @cached_property
    def _stretch(self) -> float:
        """Length of the quarter circle in the clustered measure, over its length in s."""
        return float(self._clustered(np.array(np.pi / 2))) / (np.pi / 2)

    @cached_property
    def _angles(self) -> tuple[Array, Array]:
        """A table of s and θ, dense around 90°."""
        angle = np.geomspace(1e-6 * self.side_width, np.pi / 2, 1000)
        theta = np.pi / 2 + np.concatenate([-angle[::-1], [0.0], angle])
        return self.s_of(theta), theta

    def s_of(self, theta: ArrayLike) -> Array:
        """Uniform coordinate s of angle θ in [0, π]."""
        return np.pi / 2 + self._clustered(np.asarray(theta, dtype=float) - np.pi / 2) / self._stretch

    def theta_of(self, s: ArrayLike) -> Array:
        """Angle θ of the uniform coordinate s in [0, π] (Newton's method on `s_of`, to round-off)."""
        s = np.asarray(s, dtype=float)
        theta = np.interp(s, *self._angles)
        for _ in range(20):
            step = (self.s_of(theta) - s) * self.slope(theta)
            theta = theta - step
            if np.all(np.abs(step) <= 1e-9 * self.side_width):  # quadratic: the next step would be round-off
                break
        return theta

    def slope(self, theta: Array) -> Array:
        """Derivative dθ/ds at angle θ."""
        return self._stretch / (1 + self.side_clustering / np.hypot(self.side_width, np.cos(theta)))

    def dtheta_ds(self, s: ArrayLike) -> Array:
        """Derivative dθ/ds at s in [0, π]."""
        return self.slope(self.theta_of(s))

    @cached_property
    def d_s(self) -> float:
        """Spacing of s."""
        return np.pi / self.n_theta

    @cached_property
    def s(self) -> Array:
        """Coordinate s of the nodes, 0 … π, shape (n_theta + 1,)."""
        return np.arange(self.n_theta + 1) * self.d_s

    @cached_property
    def s_face(self) -> Array:
        """Coordinate s half-way between the nodes, shape (n_theta,)."""
        return (np.arange(self.n_theta) + 0.5) * self.d_s

    @cached_property
    def theta(self) -> Array:
        """Angle of the nodes, shape (n_theta + 1,)."""
        return self.theta_of(self.s)

    # --- the whole --------------------------------------------------------------------------------------------------

    @property
    def shape(self) -> tuple[int, int]:
        """Shape of a field on the nodes, rim included."""
        return self.n_r + RIM, self.n_theta + 1

    @property
    def n_unknown(self) -> int:
        """Number of nodes where the pressure is unknown (all but the rim)."""
        return self.n_r * (self.n_theta + 1)

    def scaled(self, factor: float) -> PolarGrid:
        """The same grid with every radius multiplied by `factor`."""
        return replace(self, edge=self.edge * factor)

    def resized(self, n_r: int, n_theta: int) -> PolarGrid:
        """The same grading with other numbers of cells."""
        return replace(self, n_r=n_r, n_theta=n_theta)
