"""The dry contact of an indenter on any substrate, without friction: the limit β → ∞ of loads, depths and pressures.

The pressure's Hankel transform is written as p̃(k) = ∫₀^a φ(s) cos ks ds, which makes p vanish beyond the contact radius a.
The displacement −w = 2π∫C(k) p̃(k) J₀(kr) dk = δ − f(r) inside, with the indenter's shape f, becomes by Abel's transformation
a Fredholm equation of the second kind (Lebedev & Ufliand 1958 for layers),

    φ(x) + (2/π) ∫₀^a M(x, s) φ(s) ds = (δ − g(x))/π²,      M(x, s) = ∫₀^∞ (C(k) − 1) cos kx cos ks dk,

with the transform g(x) = x ∫₀ˣ f′(r)/√(x² − r²) dr, x² of the paraboloid, and p stays finite at the edge if φ(a) = 0.  On the
half-space, C = 1, that is the contact of Galin (1946) and Sneddon (1965): δ = g(a), and Hertz's for the paraboloid, δ = a².
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from softlube.errors import NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.indenters import Paraboloid, Shape
from softlube.model.substrates import Substrate
from softlube.model.substrates.layer import EVEN

Array = NDArray[np.floating]

FEWEST_POINTS, MOST_POINTS = 24, 1500
"""Quadrature points at least; and at most: a layer that needs more is too thin for the grids of the lubricated contact, too."""
DEGREE, ROUND_OFF = 240, 1e-13
"""Degree of the polynomial that keeps the transform of a shape on each piece of a contact, and what of its coefficients is left
out, over the largest.  Smooth shapes need 20 to 80; the degree is for the knots of a measured profile, 10⁻⁶ of the largest."""
POINTS_PER_WAVE = 0.2
"""Quadrature points for each radian that the shortest wave of the remainder turns over the contact."""


@dataclass(frozen=True)
class DryContact:
    """An indenter pressed on a substrate, dry.

    Attributes
    ----------
    radius : float
        Contact radius a, in units of length.
    indentation : float
        Depth δ of the indenter's lowest point below the undeformed surface, in units of height.
    load : float
        ∫p dA.
    edge_rise : float
        Pressure close inside the edge over that of the Hertz contact of the same radius, p = edge_rise (2/π²) √(2a(a − r)).
    slope : callable
        φ′(s) for 0 ≤ s ≤ a, with the stiffness.
    shape_rise : float
        `edge_rise` of the indenter's contact of the same radius on a half-space, g′(a)/2a; 1 for the paraboloid.
    exponent : float
        Local exponent a g′(a)/g(a) of that contact's depth with its radius; 2 for the paraboloid, the larger the narrower the
        zone at the edge in which the pressure rises.
    corners : tuple of float
        Radii within the contact at which a derivative of the shape jumps or changes fast.
    stiffness : float
        How many times as stiff as its relaxed self the substrate is, about: 1 on elastic ones.
    """

    radius: float
    indentation: float
    load: float
    edge_rise: float
    slope: Callable[[Array], Array]
    shape_rise: float = 1.0
    exponent: float = 2.0
    corners: tuple[float, ...] = ()
    stiffness: float = 1.0

    @property
    def substrate_rise(self) -> float:
        """How much of `edge_rise` is the substrate's: 1 on a half-space, whatever the indenter."""
        return self.edge_rise / self.shape_rise

    @property
    def highest_pressure(self) -> float:
        """Largest pressure on 101 places, between which it is smooth."""
        return float(np.max(self.pressure(self.radius * np.linspace(0, 1, 101))))

    def like_hertz(self, beta: float) -> float:
        """β of the lubricated half-space whose boundary layers at the contact edge are as wide over the contact radius.

        Close to the edge every substrate acts like the half-space, and p = A√s.  With u ~ Aℓ^(3/2) the boundary layer is
        ℓ ~ (βA³)^(−2/5) wide.  Stiffer, A grows by the stiffness and u ~ Aℓ^(3/2) over it.
        """
        return beta * self.radius**4 * self.edge_rise**3 * self.stiffness

    def pressure(self, r: ArrayLike) -> Array:
        """Pressure at a distance r from the axis, −∫_r^a φ′(s)/√(s² − r²) ds."""
        y = np.asarray(r, dtype=float) / self.radius
        return self.smooth_part(np.minimum(y, 1)) * np.sqrt(np.maximum(1 - y**2, 0))

    def smooth_part(self, y: ArrayLike) -> Array:
        """Pressure at r = ya, 0 ≤ y ≤ 1, over √(1 − y²)."""
        r = self.radius * np.asarray(y, dtype=float)[..., None]
        x, weight = _gauss(48)
        # s² = r² + τ² takes the root away; φ′(s)/s is smooth between corners.
        if not self.corners:
            s = np.sqrt(r**2 + (self.radius**2 - r**2) * ((x + 1) / 2) ** 2)
            return -self.radius / 2 * np.sum(self.slope(s) / np.maximum(s, 1e-12) * weight, axis=-1)
        whole = np.sqrt(np.maximum(self.radius**2 - r**2, 1e-300))
        edges = [0 * whole, *(np.sqrt(np.clip(each**2 - r**2, 0, whole**2)) for each in self.corners), whole]
        # Cubic in the place within a piece: φ′ may begin there like a root.
        t = (x + 1) / 2
        place, weight = t**2 * (3 - 2 * t), 3 * t * (1 - t) * weight
        total = np.zeros(r.shape[:-1])
        for low, high in pairwise(edges):
            s = np.sqrt(r**2 + (low + (high - low) * place) ** 2)
            total += np.sum(self.slope(s) / np.maximum(s, 1e-12) * weight * (high - low), axis=-1)
        return -self.radius * total / whole[..., 0]


@lru_cache(maxsize=16)
def _gauss(points: int) -> tuple[Array, Array]:
    """Places and weights of Gauss's quadrature on [−1, 1], kept because every first guess wants them."""
    return leggauss(points)


PARABOLOID = Paraboloid()


@lru_cache(maxsize=512)
def dry_contact(substrate: Substrate, radius: float = 1.0, indenter: Shape = PARABOLOID) -> DryContact:
    """Dry contact of a given radius.

    Parameters
    ----------
    substrate : Substrate
        Normalised, see `softlube.model.substrates`.
    radius : float
        Contact radius a, in units of length.
    indenter : Shape
        Normalised, see `softlube.model.indenters`.

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
    stiffness = 1 / substrate.compliance(radius)
    corners = tuple(each for each in indenter.corners if each < radius)
    x, weight = _pieces(n, (0.0, *corners, radius))
    n = x.size
    waves = np.cos(np.outer(x, k))
    kernel = 2 / np.pi * ((waves * defect) @ waves.T) * weight
    right = np.stack([np.ones(n), indenter.depth(x)], axis=1)
    flat, bowl = np.linalg.solve(np.eye(n) + kernel, right).T / np.pi**2

    def remainder(phi: Array, at: Array) -> Array:
        """What the substrate adds to the right-hand side over π²: Nyström's interpolation, the equation read elsewhere."""
        cosines = np.cos(np.outer(at, k))
        return -2 / np.pi * cosines @ (defect * (waves.T @ (weight * phi)))

    rim = np.array([radius])
    own, rise = float(indenter.depth(rim)[0]), float(indenter.depth_slope(rim)[0])
    of_flat, of_bowl = (1 / np.pi**2 + remainder(flat, rim)[0], own / np.pi**2 + remainder(bowl, rim)[0])
    depth = float(of_bowl / of_flat)
    phi = depth * flat - bowl

    own_slope = indenter.depth_slope if indenter == PARABOLOID else _tabulated(indenter, float(np.ceil(4 * np.log2(radius))))
    smooth: Callable[[Array], Any] = np.zeros_like
    if k.size:
        from scipy.interpolate import CubicSpline  # slow to import, and half-spaces do without

        s = radius * np.sin(np.linspace(0, np.pi / 2, 2 * n + 1))
        values = remainder(phi, s)
        values[-1] = -(depth - own) / np.pi**2
        smooth = CubicSpline(s, values, bc_type=EVEN).derivative()

    slope = _Slope(stiffness, smooth, own_slope)
    # φ′(a) from the derivative of the equation; −2a/π² for Hertz.
    shape_rise = rise / (2 * radius)
    edge = shape_rise - np.pi / radius * float(np.sin(radius * k) @ (k * defect * (waves.T @ (weight * phi))))
    exponent = radius * rise / own if own > 0 else np.inf
    load = stiffness * float(2 * np.pi * weight @ phi)
    return DryContact(radius, depth, load, edge, slope, shape_rise, exponent, corners, stiffness)


@dataclass(frozen=True)
class _Slope:
    """φ′(s) of `DryContact`: the shape's part, and a smooth one by the substrate; travels between processes."""

    stiffness: float
    smooth: Callable[[Array], Any]
    own: Callable[[Array], Array]

    def __call__(self, s: Array) -> Array:
        return self.stiffness * (self.smooth(s) - self.own(s) / np.pi**2)


@dataclass(frozen=True)
class _Tabulated:
    """A function that is dear to evaluate, by a polynomial on each of some pieces; it may begin there like a root."""

    function: Callable[[Array], Array]
    edges: tuple[float, ...]

    @cached_property
    def polynomials(self) -> list[Chebyshev]:
        """The polynomials, made when they are first asked for: the search for a contact's radius asks for no pressure."""
        pieces = [Chebyshev.interpolate(self._along, DEGREE, [0, 1], args=piece) for piece in pairwise(self.edges)]
        return [piece.trim(ROUND_OFF * np.max(np.abs(piece.coef))) for piece in pieces]

    def _along(self, u: Array, low: float, high: float) -> Array:
        """The function on a piece, over the root of the distance from its beginning."""
        return self.function(low + (high - low) * u**2)

    def __call__(self, x: Array) -> Array:
        found = np.zeros(np.shape(x))
        piece = np.clip(np.searchsorted(self.edges, x, side="right") - 1, 0, len(self.polynomials) - 1)
        for k, (polynomial, (low, high)) in enumerate(zip(self.polynomials, pairwise(self.edges), strict=True)):
            found[piece == k] = polynomial(np.sqrt(np.maximum(np.asarray(x)[piece == k] - low, 0) / (high - low)))
        return found


@lru_cache(maxsize=64)
def _tabulated(indenter: Shape, quarter_octaves: float) -> _Tabulated:
    """g′ of an indenter up to a radius 2^(n/4), a table for many contacts."""
    rim = 2.0 ** (quarter_octaves / 4)
    return _Tabulated(indenter.depth_slope, (0.0, *(each for each in indenter.corners if each < rim), rim))


def _pieces(points: int, edges: tuple[float, ...]) -> tuple[Array, Array]:
    """Places and weights of Gauss's quadrature with some points on each of some pieces."""
    x, weight = _gauss(points)
    low, width = np.array(edges)[:-1, None], np.diff(edges)[:, None]
    return (low + width * (x + 1) / 2).ravel(), (width * weight / 2).ravel()


@lru_cache(maxsize=512)
def dry_contact_at(
    substrate: Substrate,
    *,
    indentation: float | None = None,
    load: float | None = None,
    indenter: Shape = PARABOLOID,
) -> DryContact:
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

    def contact_at(log_radius: float) -> DryContact:
        return dry_contact(substrate, indenter.flat + float(np.exp(log_radius)), indenter)

    def miss(log_radius: float) -> float:
        contact = contact_at(log_radius)
        return float(np.log((contact.load if indentation is None else contact.indentation) / wanted))

    here, value, slope = float(np.log(first)), miss(float(np.log(first))), 2.5
    for _ in range(40):
        if abs(value) < 1e-12:
            return contact_at(here)
        there = here - float(np.clip(value / slope, -0.7, 0.7))
        after = miss(there)
        if there != here and after != value:
            slope = (after - value) / (there - here)
        if abs(there - here) < 1e-14:
            return contact_at(there)
        here, value = there, after
    raise NotConvergedError(f"the dry contact on {substrate!r} was not found")


SMEARED = 200
"""Contacts in a superposition."""


def smeared_contact(
    substrate: Substrate, indentation: float, width: float, indenter: Shape = PARABOLOID, exponent: float = 2.0
) -> Callable[[ArrayLike], Array]:
    """Mean of dry contacts with radii spread over 1 ± width times that of an indentation, smooth at that scale.

    Each leaves a gap that is nowhere negative, and so do all together, at the mean of their indentations, which is about the
    one given (exactly on a half-space under a paraboloid).  How the shape of the pressure changes with the radius is
    interpolated from three.

    Parameters
    ----------
    substrate : Substrate
        Normalised.
    indentation : float
        Depth.
    width : float
        Spread of the radii over their mean.
    indenter : Shape
        Normalised.
    exponent : float
        Power of the radius that the depth goes by, see `DryContact`.

    Returns
    -------
    callable
        Pressure at a distance from the axis.
    """
    spread = width * np.cos(np.pi * (np.arange(SMEARED) + 0.5) / SMEARED)
    # δ is about a², so the mean of the depths is about this much more than that of the mean radius.
    mean = float(np.mean((1 + spread) ** exponent))
    radius = dry_contact_at(substrate, indentation=indentation / mean, indenter=indenter).radius
    table = np.linspace(0, 1, 51)
    low, middle, high = (
        dry_contact(substrate, radius * (1 + part), indenter).smooth_part(table) for part in (-width, 0.0, width)
    )
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
