"""An elastic layer on a rigid base."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, ClassVar, Literal, get_args

from softlube.errors import InputError
from softlube.model.inputs import LENGTH, given
from softlube.model.lazy import numpy as np
from softlube.model.substrates.base import Array, Kernel, Orders, SubstratePart

Base = Literal["bonded", "frictionless"]

LARGEST_WAVENUMBER = 18.0
"""κ beyond which C(κ) − 1 ~ κ² e^(−2κ) is below round-off."""
PANEL_POINTS, PANEL_PHASE = 16, 20.0
"""Gauss quadrature over κ in panels: points on each, and radians that the fastest wave may turn on each."""
SHORTEST_REACH = 8.0
"""Distance, over the thickness, up to which waves are seen at least: C itself varies over κ of the order of one."""
SCREENED = 30.0
"""Distance, over the thickness, beyond which the layer's kernel is zero to round-off: the nearest pole of C has Im κ > 1."""
TABLE_STEP = 0.02
"""Spacing of the table of the remainder, over the thickness; the cubic spline through it is good to 10⁻⁹."""
EVEN: Any = ((1, 0.0), "not-a-knot")
"""Ends of a spline that is even about the first."""
ROUND = 20.0
"""Points on the half-circle times the width η of the remainder: harmonics fall like e^(−mη), e^(−20) is left out."""
LARGEST_BATCH = 2_000_000
"""Values of the remainder held at a time."""


@dataclass(frozen=True)
class LayerKernel(Kernel):
    """An elastic layer on a rigid base.

    Parameters
    ----------
    thickness : float
        t over √(R × unit of height).
    poisson_ratio : float
        0 ≤ ν ≤ 1/2.
    base : {"bonded", "frictionless"}
        How it lies on the base.  Without friction ν acts through the effective modulus alone.
    share : float
        What part of the compliance of both bodies, were both half-spaces, is the layer's, 0 < share ≤ 1; the rest is that of an
        elastic ball, which is a half-space.

    Raises
    ------
    InputError
        If an input is not as described.

    Notes
    -----
    With κ = kt (Hannah 1951 for the frictionless base; Meijers 1968, Johnson 1985 §5.8, Persson 2001 for the bonded one):

    - bonded: C = [(3 − 4ν) sinh 2κ − 2κ]/[(3 − 4ν) cosh 2κ + 2κ² + 5 − 12ν + 8ν²];
    - frictionless: C = (cosh 2κ − 1)/(sinh 2κ + 2κ).

    The compliances of two bodies add in wavenumber space: share C(κ) + (1 − share), over that of two half-spaces.

    Long waves: C → κ (1 − 2ν)/(2(1 − ν)²) bonded and compressible, 2κ³/3 bonded and incompressible, κ/2 frictionless.
    """

    thickness: float
    poisson_ratio: float = 0.5
    base: Base = "bonded"
    share: float = 1.0
    kind: ClassVar[str] = "layer"
    words: ClassVar[str] = "an elastic layer"

    def __post_init__(self) -> None:
        if not (math.isfinite(self.thickness) and self.thickness > 0):
            raise InputError(f"thickness: expected a positive, finite number, got {self.thickness!r}")
        Layer.inputs["poisson_ratio"].read(self.poisson_ratio)
        Layer.inputs["base"].read(self.base)
        if not 0 < self.share <= 1:
            raise InputError(f"share: expected a number above 0 and up to 1, got {self.share!r}")

    def in_units(self, unit: float) -> LayerKernel:
        """The same layer with another unit of height, given over the present one."""
        return replace(self, thickness=self.thickness / math.sqrt(unit))

    def spectrum(self, reach: float = 0.0) -> tuple[Array, Array]:
        """Wavenumbers k and weights (C(k) − 1) dk."""
        panels = math.ceil(LARGEST_WAVENUMBER * max(SHORTEST_REACH, reach / self.thickness) / PANEL_PHASE)
        kappa, weight = _spectrum(self.poisson_ratio, self.base, panels)
        return kappa / self.thickness, self.share * weight / self.thickness

    @property
    def remainder(self) -> LayerKernel:
        """Itself."""
        return self

    @property
    def smooth_over(self) -> float:
        """Twice the thickness, as far as an image of the surface in the base."""
        return 2 * self.thickness

    def ring_remainder(self, orders: Orders, r: Array, r_source: Array) -> Array:
        """Harmonics ∫₀^{2π} cos mφ G(|x − x′|) dφ of the remainder G, see `softlube.discretization.potentials.ring_kernels`.

        It is analytic up to a distance of 2t off the real plane, so the midpoint rule on the half-circle converges
        geometrically: its harmonics fall like e^(−mη), cosh η = 1 + [(r − r′)² + 4t²]/(2rr′).
        """
        from scipy.fft import dct, next_fast_len  # slow to import, and half-spaces do without

        inner, outer = np.broadcast_arrays(r, r_source)
        result = np.zeros((orders.size, *inner.shape))
        whole = result.reshape(orders.size, -1)  # a view
        inner, outer = inner.ravel(), outer.ravel()
        difference, product = (inner - outer) ** 2, inner * outer
        excess = (difference + 4 * self.thickness**2) / (2 * product)
        eta = np.log1p(excess + np.sqrt(excess * (2 + excess)))
        half_octave = np.ceil(2 * np.log2(np.maximum(ROUND / eta, 8))).astype(int)
        for number in np.unique(half_octave):
            n = next_fast_len(math.floor(2 ** (number / 2)), real=True)
            # ρ² = (r − r′)² + 4rr′ sin²(φ/2)
            chord = 4 * np.sin((np.arange(n) + 0.5) * np.pi / (2 * n)) ** 2
            own = np.flatnonzero(half_octave == number)
            kept = orders[orders < n]
            for some in np.array_split(own, max(1, own.size * n // LARGEST_BATCH)):
                distance = np.sqrt(difference[some, None] + product[some, None] * chord)
                harmonics = dct(self._remainder(distance), type=2, axis=1, overwrite_x=True)
                whole[: kept.size, some] = (np.pi / n) * harmonics[:, kept].T
        return result

    def _remainder(self, distance: Array) -> Array:
        """∫₀^∞ (C − 1) J₀(kρ) dk."""
        s = distance / self.thickness
        value = -1 / np.maximum(s, SCREENED)
        near = s < SCREENED
        # Knots at equal distances need not be searched for.
        x = s[near] / TABLE_STEP
        knot = x.astype(np.intp)
        x -= knot
        cubic, square, slope, here = (c[knot] for c in _remainder_table(self.poisson_ratio, self.base))
        value[near] = ((cubic * x + square) * x + slope) * x + here
        value *= self.share
        value /= self.thickness
        return value


class Layer(SubstratePart):
    """An elastic layer on a rigid base: a slab on a plate, a coating."""

    kind: ClassVar[str] = "layer"
    thickness: float = given("Thickness of the substrate, a layer on a rigid base", LENGTH, "2 mm", absent="a half-space")
    base: Base = given("How a layer lies on its base", default="bonded", choices=get_args(Base))

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values; a layer on a ball is thinner than the ball is round."""
        check_thickness(values)
        return super().checked(values)

    def kernel(self, length_unit: float, share: float = 1.0, speed: float | None = None, time_unit: float = 1.0) -> LayerKernel:
        """Its thickness over the unit, its Poisson ratio, its base and its share."""
        return LayerKernel(self.thickness / length_unit, self.poisson_ratio, self.base, share)


def check_thickness(values: Mapping[str, Any]) -> None:
    """Check the inputs of a layer: one on a ball is thinner than the ball is round.

    Raises
    ------
    InputError
        If it is not.
    """
    radius, thickness = values["radius"], values["thickness"]
    if radius is not None and 0 < radius <= thickness:
        raise InputError(
            f"thickness, substrate_radius: the layer, {thickness:.4g} m thick, fills the ball whose outer radius is "
            f"{radius:.4g} m; leave the thickness out"
        )


def compliance_defect(kappa: Array, poisson_ratio: float = 0.5, base: Base = "bonded") -> Array:
    """C(κ) − 1 of a layer, see `LayerKernel`, without overflow and without cancellation at large κ > 0."""
    decay = np.exp(-2 * kappa)
    if base == "frictionless":
        return decay * (decay - 1 - 2 * kappa) / ((1 - decay**2) / 2 + 2 * kappa * decay)
    a, b = 3 - 4 * poisson_ratio, 5 - 12 * poisson_ratio + 8 * poisson_ratio**2
    below = a * (1 + decay**2) / 2 + (2 * kappa**2 + b) * decay
    return -decay * (a * decay + 2 * kappa * (1 + kappa) + b) / below


@lru_cache(maxsize=16)
def _spectrum(poisson_ratio: float, base: Base, panels: int) -> tuple[Array, Array]:
    """κ and (C − 1) dκ of composite Gauss quadrature."""
    x, weight = np.polynomial.legendre.leggauss(PANEL_POINTS)
    width = LARGEST_WAVENUMBER / panels
    kappa = (width * (np.arange(panels)[:, None] + (x + 1) / 2)).ravel()
    return kappa, np.tile(width * weight / 2, panels) * compliance_defect(kappa, poisson_ratio, base)


@lru_cache(maxsize=16)
def _remainder_table(poisson_ratio: float, base: Base) -> Array:
    """The remainder of a layer of unit thickness: coefficients of cubics, shape (4, n), in `TABLE_STEP` from each knot."""
    from scipy.interpolate import CubicSpline  # slow to import, and half-spaces do without
    from scipy.special import j0

    kappa, weight = LayerKernel(1.0, poisson_ratio, base).spectrum(SCREENED)
    s = np.arange(0, SCREENED + 2 * TABLE_STEP, TABLE_STEP)
    spline = CubicSpline(s, j0(np.outer(s, kappa)) @ weight, bc_type=EVEN)
    return spline.c * TABLE_STEP ** np.arange(3.0, -1.0, -1.0)[:, None]
