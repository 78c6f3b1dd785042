"""The dry contact of a sphere on any substrate, without friction: the limit β → ∞ of loads, depths and pressures.

The pressure's Hankel transform is written as p̃(k) = ∫₀^a φ(s) cos ks ds, which makes p vanish beyond the contact radius a.
The displacement −w = 2π∫C(k) p̃(k) J₀(kr) dk = δ − r²/2 inside becomes, by Abel's transformation, a Fredholm equation of
the second kind (Lebedev & Ufliand 1958 for layers),

    φ(x) + (2/π) ∫₀^a M(x, s) φ(s) ds = (δ − x²)/π²,      M(x, s) = ∫₀^∞ (C(k) − 1) cos kx cos ks dk,

and p stays finite at the edge if φ(a) = 0.  The half-space, C = 1, is Hertz's contact: δ = a².
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from softlube.errors import NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.substrates import Substrate
from softlube.model.substrates.layer import EVEN

Array = NDArray[np.floating]

FEWEST_POINTS, MOST_POINTS = 24, 1500
"""Quadrature points at least; and at most: a layer that needs more is too thin for the grids of the lubricated contact, too."""
POINTS_PER_WAVE = 0.2
"""Quadrature points for each radian that the shortest wave of the remainder turns over the contact."""


@dataclass(frozen=True)
class DryContact:
    """A sphere pressed on a substrate, dry.

    Attributes
    ----------
    radius : float
        Contact radius a, in units of length.
    indentation : float
        Depth δ of the sphere's lowest point below the undeformed surface, in units of height.
    load : float
        ∫p dA.
    edge_rise : float
        Pressure close inside the edge over that of the Hertz contact of the same radius, p = edge_rise (2/π²) √(2a(a − r)).
    slope : callable
        φ′(s) for 0 ≤ s ≤ a.
    """

    radius: float
    indentation: float
    load: float
    edge_rise: float
    slope: Callable[[Array], Array]

    def like_hertz(self, beta: float) -> float:
        """β of the lubricated half-space whose boundary layers at the contact edge are as wide over the contact radius.

        Close to the edge every substrate acts like the half-space, and p = A√s.  With u ~ Aℓ^(3/2) the boundary layer is
        ℓ ~ (βA³)^(−2/5) wide.
        """
        return beta * self.radius**4 * self.edge_rise**3

    def pressure(self, r: ArrayLike) -> Array:
        """Pressure at a distance r from the axis, −∫_r^a φ′(s)/√(s² − r²) ds."""
        y = np.asarray(r, dtype=float) / self.radius
        return self.smooth_part(np.minimum(y, 1)) * np.sqrt(np.maximum(1 - y**2, 0))

    def smooth_part(self, y: ArrayLike) -> Array:
        """Pressure at r = ya, 0 ≤ y ≤ 1, over √(1 − y²)."""
        r = self.radius * np.asarray(y, dtype=float)[..., None]
        x, weight = _gauss(48)
        # s² = r² + τ² takes the root away; φ′(s)/s is smooth.
        s = np.sqrt(r**2 + (self.radius**2 - r**2) * ((x + 1) / 2) ** 2)
        return -self.radius / 2 * np.sum(self.slope(s) / np.maximum(s, 1e-12) * weight, axis=-1)


@lru_cache(maxsize=1)
def _gauss(points: int) -> tuple[Array, Array]:
    """Places and weights of Gauss's quadrature on [−1, 1], kept because every first guess wants them."""
    return leggauss(points)


def _of_half_space(s: Array) -> Array:
    """φ′(s) on a half-space."""
    return -2 * s / np.pi**2


@lru_cache(maxsize=512)
def dry_contact(substrate: Substrate, radius: float = 1.0) -> DryContact:
    """Dry contact of a given radius.

    Raises
    ------
    NotConvergedError
        If the substrate is so thin beside the radius that the equation needs more than `MOST_POINTS`.

    Examples
    --------
    >>> from softlube.model.substrates import HalfSpaceKernel
    >>> dry_contact(HalfSpaceKernel(), 2.0).indentation
    4.0
    """
    k, defect = substrate.spectrum(2 * radius)
    n = FEWEST_POINTS + int(POINTS_PER_WAVE * radius * float(np.max(k, initial=0.0)))
    if n > MOST_POINTS:
        raise NotConvergedError(
            f"the layer is too thin beside its contact: the dry contact would take {n} points, and {MOST_POINTS} are the most. "
            "Check the units of thickness, radius, load and modulus."
        )
    x, weight = leggauss(n)
    x, weight = radius * (x + 1) / 2, radius * weight / 2
    waves = np.cos(np.outer(x, k))
    kernel = 2 / np.pi * ((waves * defect) @ waves.T) * weight
    flat, bowl = np.linalg.solve(np.eye(n) + kernel, np.stack([np.ones(n), x**2], axis=1)).T / np.pi**2

    def interpolated(phi: Array, right: Array, at: Array) -> Array:
        """Nyström's interpolation: the equation itself, read at other places."""
        cosines = np.cos(np.outer(at, k))
        return right / np.pi**2 - 2 / np.pi * cosines @ (defect * (waves.T @ (weight * phi)))

    rim = np.array([radius])
    depth = float((interpolated(bowl, rim**2, rim) / interpolated(flat, np.ones(1), rim))[0])
    phi = depth * flat - bowl
    slope = _of_half_space
    if k.size:
        from scipy.interpolate import CubicSpline  # slow to import, and half-spaces do without

        s = radius * np.sin(np.linspace(0, np.pi / 2, 2 * n + 1))
        values = interpolated(phi, depth - s**2, s)
        values[-1] = 0.0
        slope = CubicSpline(s, values, bc_type=EVEN).derivative()
    # φ′(a) from the derivative of the equation; −2a/π² for Hertz.
    edge = 1 - np.pi / radius * float(np.sin(radius * k) @ (k * defect * (waves.T @ (weight * phi))))
    return DryContact(radius, depth, float(2 * np.pi * weight @ phi), edge, slope)


@lru_cache(maxsize=512)
def dry_contact_at(substrate: Substrate, *, indentation: float | None = None, load: float | None = None) -> DryContact:
    """Dry contact of a given indentation or a given load, by the secant method in logarithms.

    Examples
    --------
    >>> from softlube.model.substrates import HalfSpaceKernel, LayerKernel
    >>> dry_contact_at(HalfSpaceKernel(), indentation=1.0).radius
    1.0
    >>> dry_contact_at(LayerKernel(1.0), indentation=1.0).load > dry_contact_at(HalfSpaceKernel(), indentation=1.0).load
    True
    """
    if (indentation is None) == (load is None):
        raise ValueError("indentation, load: give exactly one of them")
    if indentation is not None:
        wanted, first = indentation, indentation**0.5
    else:
        wanted = float(load)  # type: ignore[arg-type]
        first = (wanted / HERTZ_LOAD) ** (1 / 3)

    def miss(log_radius: float) -> float:
        contact = dry_contact(substrate, float(np.exp(log_radius)))
        return float(np.log((contact.load if indentation is None else contact.indentation) / wanted))

    here, value, slope = float(np.log(first)), miss(float(np.log(first))), 2.5
    for _ in range(40):
        if abs(value) < 1e-12:
            return dry_contact(substrate, float(np.exp(here)))
        there = here - float(np.clip(value / slope, -0.7, 0.7))
        after = miss(there)
        if there != here and after != value:
            slope = (after - value) / (there - here)
        if abs(there - here) < 1e-14:
            return dry_contact(substrate, float(np.exp(there)))
        here, value = there, after
    raise NotConvergedError(f"the dry contact on {substrate!r} was not found")


SMEARED = 200
"""Contacts in a superposition."""


def smeared_contact(substrate: Substrate, indentation: float, width: float) -> Callable[[ArrayLike], Array]:
    """Mean of dry contacts with radii spread over 1 ± width times that of an indentation, smooth at that scale.

    Each leaves a gap that is nowhere negative, and so do all together, at the mean of their indentations, which is about the
    one given (exactly on a half-space).  How the shape of the pressure changes with the radius is interpolated from three.

    Returns
    -------
    callable
        Pressure at a distance from the axis.
    """
    spread = width * np.cos(np.pi * (np.arange(SMEARED) + 0.5) / SMEARED)
    # δ is about a², so the mean of the depths is about this much more than that of the mean radius.
    radius = dry_contact_at(substrate, indentation=indentation / float(np.mean((1 + spread) ** 2))).radius
    table = np.linspace(0, 1, 201)
    low, middle, high = (dry_contact(substrate, radius * (1 + part)).smooth_part(table) for part in (-width, 0.0, width))
    t = spread / width

    def pressure(r: ArrayLike) -> Array:
        y = np.asarray(r, dtype=float)[..., None] / (radius * (1 + spread))
        inside = np.minimum(y, 1)
        smooth = sum(
            share * np.interp(inside, table, part)
            for share, part in ((t * (t - 1) / 2, low), (1 - t**2, middle), (t * (t + 1) / 2, high))
        )
        return np.mean(smooth * np.sqrt(1 - inside**2), axis=-1)

    return pressure
