"""What lies between: a liquid is a law of its viscosity, and of its density, against the pressure.

Laws are normalised: η and ρ over their values η₀ and ρ₀ at zero pressure, pressures with 4πG√(unit of height/R) (E* in place
of 4G).  The Reynolds equation has the fluidity φ = η₀/η as a factor of u³∇p; with the reduced pressure q = ∫ φ dp (Grubin)
that is u³∇q, bounded however steeply the viscosity rises.  ρ is a factor of the whole flux.  Shear stresses have η/η₀ as a
factor of the Couette part.  A new law is a new class here; nothing else in the package knows its name.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from softlube.errors import InputError

if TYPE_CHECKING:
    from scipy.interpolate import CubicHermiteSpline

Array = NDArray[np.floating]

ROELANDS_PRESSURE = 1.962e8
"""Roelands' reference pressure [Pa], 1/(5.1e-9 Pa⁻¹)."""
ROELANDS_VISCOSITY = 6.31e-5
"""Viscosity [Pa s] that every Roelands liquid has at p = −`ROELANDS_PRESSURE`: ln η₀ + 9.67 = ln(η₀/6.31e-5)."""
LARGEST_EXPONENT = 200.0
"""Bound of |ln η/η₀|, so that a wild iterate of Newton's method raises no overflow."""
DENSITY_PRESSURE = 5.9e8
"""Pressure [Pa] at which half of the densest liquid's compression has been had, in Dowson & Higginson's law."""
DENSITY_RISE = 0.34
"""What an endless pressure adds to ρ/ρ₀ in that law."""
SMALLEST_RATIO, LARGEST_RATIO = 1e-3, 1e4
"""Bounds of 1 + p/p₀ in Roelands' law, for the same reason."""


class Liquid(Protocol):
    """What the solver asks of a liquid."""

    kind: ClassVar[str]

    def in_units(self, unit: float) -> Liquid:
        """The same with another unit of height, given over the present one; pressures scale with its root."""
        ...

    def viscosity(self, pressure: Array) -> Array:
        """η(p)/η₀."""
        ...

    def fluidity(self, pressure: Array) -> tuple[Array, Array]:
        """φ = η₀/η(p) and dφ/dp."""
        ...

    def reduced_pressure(self, pressure: Array) -> Array:
        """Grubin's q = ∫ φ dp from 0 to p; p itself for constant viscosity."""
        ...

    def density(self, pressure: Array) -> tuple[Array, Array]:
        """ρ(p)/ρ₀ and its derivative."""
        ...

    def weakened(self, share: float) -> Liquid:
        """The law with a share (0 to 1) of its viscosity's rise, for marching up to it; constant viscosity for 0."""
        ...


class Incompressible:
    """Constant density."""

    def density(self, pressure: Array) -> tuple[Array, Array]:
        """1 and 0."""
        return np.ones_like(pressure), np.zeros_like(pressure)


@dataclass(frozen=True)
class Newtonian(Incompressible):
    """Constant viscosity, the paper's liquid."""

    kind: ClassVar[str] = "newtonian"

    def in_units(self, unit: float) -> Newtonian:
        """Itself: it has no pressure."""
        return self

    def viscosity(self, pressure: Array) -> Array:
        """1."""
        return np.ones_like(pressure)

    def fluidity(self, pressure: Array) -> tuple[Array, Array]:
        """1 and 0."""
        return np.ones_like(pressure), np.zeros_like(pressure)

    def reduced_pressure(self, pressure: Array) -> Array:
        """The pressure itself."""
        return pressure

    def weakened(self, share: float) -> Newtonian:
        """Itself: nothing depends on the pressure."""
        return self


def _checked(name: str, value: float) -> None:
    if not (math.isfinite(value) and value >= 0):
        raise InputError(f"{name}: expected a finite number that is not negative, got {value!r}")


@dataclass(frozen=True)
class Barus(Incompressible):
    """η = η₀ e^{αp} (Barus 1893).

    Parameters
    ----------
    alpha : float
        ᾱ = 4πGα√(unit of height/R) ≥ 0, the pressure-viscosity coefficient over the unit of 1/pressure.
    """

    alpha: float
    kind: ClassVar[str] = "barus"

    def __post_init__(self) -> None:
        _checked("alpha", self.alpha)

    def in_units(self, unit: float) -> Barus:
        """The same liquid with another unit of height."""
        return replace(self, alpha=self.alpha * math.sqrt(unit))

    def viscosity(self, pressure: Array) -> Array:
        """e^{αp}."""
        return np.exp(np.clip(self.alpha * pressure, -LARGEST_EXPONENT, LARGEST_EXPONENT))

    def fluidity(self, pressure: Array) -> tuple[Array, Array]:
        """e^{−αp} and its derivative."""
        value = np.exp(-np.clip(self.alpha * pressure, -LARGEST_EXPONENT, LARGEST_EXPONENT))
        return value, -self.alpha * value

    def reduced_pressure(self, pressure: Array) -> Array:
        """(1 − e^{−αp})/α."""
        exponent = np.clip(self.alpha * pressure, -LARGEST_EXPONENT, LARGEST_EXPONENT)
        return -np.expm1(-exponent) / self.alpha if self.alpha > 0 else pressure

    def weakened(self, share: float) -> Barus:
        """The law with a share of α."""
        return replace(self, alpha=self.alpha * share)


@dataclass(frozen=True)
class Roelands(Incompressible):
    """η = η₀ exp{(αp₀/z)[(1 + p/p₀)^z − 1]} (Roelands 1966).

    Parameters
    ----------
    alpha : float
        ᾱ, the slope of ln η at zero pressure, as in `Barus`.
    exponent : float
        Roelands' z, 0 < z ≤ 1; αp₀/z = ln η₀ + 9.67 with η₀ in Pa s.
    reference : float
        p₀ = 0.1962 GPa over the unit of pressure.
    """

    alpha: float
    exponent: float
    reference: float
    kind: ClassVar[str] = "roelands"

    def __post_init__(self) -> None:
        _checked("alpha", self.alpha)
        if not 0 < self.exponent <= 1:
            raise InputError(f"exponent: expected Roelands' z, a number between 0 and 1, got {self.exponent!r}")
        if not (math.isfinite(self.reference) and self.reference > 0):
            raise InputError(f"reference: expected a positive, finite pressure, got {self.reference!r}")

    @classmethod
    def of(cls, alpha: float, viscosity: float, pressure_unit: float) -> Roelands:
        """From the coefficient α [1/Pa], the viscosity η₀ [Pa s] and the unit of pressure [Pa].

        Raises
        ------
        InputError
            If no exponent between 0 and 1 goes with them.
        """
        steepness = math.log(viscosity / ROELANDS_VISCOSITY)
        exponent = alpha * ROELANDS_PRESSURE / steepness if steepness > 0 else math.inf
        if not exponent <= 1:
            raise InputError(
                f"viscosity_law: Roelands' law has no exponent z between 0 and 1 for a viscosity of {viscosity:g} Pa s and a "
                f"pressure-viscosity coefficient of {alpha:g} 1/Pa; use 'barus'"
            )
        return cls(alpha * pressure_unit, exponent, ROELANDS_PRESSURE / pressure_unit)

    def in_units(self, unit: float) -> Roelands:
        """The same liquid with another unit of height."""
        return replace(self, alpha=self.alpha * math.sqrt(unit), reference=self.reference / math.sqrt(unit))

    def _logarithm(self, pressure: Array) -> tuple[Array, Array]:
        """Ln η/η₀ and its derivative."""
        ratio = np.maximum(1 + pressure / self.reference, SMALLEST_RATIO)
        power = ratio ** (self.exponent - 1)
        value = self.alpha * self.reference / self.exponent * (power * ratio - 1)
        return np.clip(value, -LARGEST_EXPONENT, LARGEST_EXPONENT), self.alpha * power

    def viscosity(self, pressure: Array) -> Array:
        """η/η₀."""
        return np.exp(self._logarithm(pressure)[0])

    def fluidity(self, pressure: Array) -> tuple[Array, Array]:
        """η₀/η and its derivative."""
        value, slope = self._logarithm(pressure)
        fluidity = np.exp(-value)
        return fluidity, -slope * fluidity

    def reduced_pressure(self, pressure: Array) -> Array:
        """∫ φ dp, by Gauss's rule where αp is small, else from a table of the logarithm of what is left of it."""
        x, weight = leggauss(8)
        near = self.fluidity(np.asarray(pressure)[..., None] * (x + 1) / 2)[0] @ weight / 2 * pressure
        start, spline = _roelands_rest(self.alpha * self.reference, self.exponent)
        ratio = np.clip(1 + pressure / self.reference, SMALLEST_RATIO, LARGEST_RATIO)
        far = self.reference * (start - np.exp(spline(np.log(ratio))))
        return np.where((self.alpha * pressure < 0.5) & (pressure < self.reference), near, far)

    def weakened(self, share: float) -> Roelands:
        """The law with a share of α."""
        return replace(self, alpha=self.alpha * share)


@dataclass(frozen=True)
class DowsonHigginson:
    """ρ/ρ₀ = 1 + 0.34 p/(p₁ + p), p₁ = 0.59 GPa: mineral oils (Dowson & Higginson 1966).

    Parameters
    ----------
    liquid : Liquid
        What has the viscosity.
    reference : float
        p₁ over the unit of pressure.
    """

    liquid: Liquid
    reference: float
    kind: ClassVar[str] = "dowson-higginson"

    def __post_init__(self) -> None:
        if not (math.isfinite(self.reference) and self.reference > 0):
            raise InputError(f"reference: expected a positive, finite pressure, got {self.reference!r}")

    @classmethod
    def of(cls, liquid: Liquid, pressure_unit: float) -> DowsonHigginson:
        """With the unit of pressure in Pa."""
        return cls(liquid, DENSITY_PRESSURE / pressure_unit)

    def in_units(self, unit: float) -> DowsonHigginson:
        """The same liquid with another unit of height."""
        return replace(self, liquid=self.liquid.in_units(unit), reference=self.reference / math.sqrt(unit))

    def viscosity(self, pressure: Array) -> Array:
        """The liquid's."""
        return self.liquid.viscosity(pressure)

    def fluidity(self, pressure: Array) -> tuple[Array, Array]:
        """The liquid's."""
        return self.liquid.fluidity(pressure)

    def reduced_pressure(self, pressure: Array) -> Array:
        """The liquid's."""
        return self.liquid.reduced_pressure(pressure)

    def density(self, pressure: Array) -> tuple[Array, Array]:
        """ρ/ρ₀ and its derivative; a liquid under tension is as dense as at −p₁/2, where the law is not meant to reach."""
        compressed = np.maximum(pressure / self.reference, -0.5)
        slope = np.where(compressed > -0.5, DENSITY_RISE / (self.reference * (1 + compressed) ** 2), 0.0)
        return 1 + DENSITY_RISE * compressed / (1 + compressed), slope

    def weakened(self, share: float) -> DowsonHigginson:
        """The same density, a share of the viscosity's rise."""
        return replace(self, liquid=self.liquid.weakened(share))


@lru_cache(maxsize=32)
def _roelands_rest(steepness: float, exponent: float) -> tuple[float, CubicHermiteSpline]:
    """∫ φ dp/p₀ from p upwards, which keeps its digits where φ is 10⁻²⁰: its value at p = 0, its logarithm over ln(1 + p/p₀).

    Parameters
    ----------
    steepness : float
        αp₀.
    exponent : float
        z.
    """
    from scipy.interpolate import CubicHermiteSpline  # slow to import, and few ask for it

    knots = np.linspace(np.log(SMALLEST_RATIO), np.log(LARGEST_RATIO), 6001)
    x, weight = leggauss(6)
    points = knots[:-1, None] + np.diff(knots)[:, None] * (x + 1) / 2

    def fluidity(log_ratio: Array) -> Array:
        value = steepness / exponent * np.expm1(exponent * log_ratio)
        return np.exp(-np.clip(value, -LARGEST_EXPONENT, LARGEST_EXPONENT) + log_ratio)

    parts = fluidity(points) @ weight * np.diff(knots) / 2
    # Beyond the table the liquid counts as solid to double precision, or the law is no longer one.
    rest = np.cumsum(np.append(parts, fluidity(knots[-1:]))[::-1])[::-1]
    spline = CubicHermiteSpline(knots, np.log(rest), -fluidity(knots) / rest)
    return float(np.exp(spline(0.0))), spline


KINDS: dict[str, Any] = {cls.kind: cls for cls in (Newtonian, Barus, Roelands, DowsonHigginson)}
"""Every liquid by its name in files."""


def to_plain(liquid: Liquid) -> dict[str, Any]:
    """A liquid in plain values, for files."""
    return {"kind": liquid.kind} | {
        name: to_plain(value) if hasattr(value, "kind") else value for name, value in vars(liquid).items()
    }


def from_plain(values: dict[str, Any] | None) -> Liquid:
    """Inverse of `to_plain`; constant viscosity where nothing was written."""
    if not values:
        return Newtonian()
    parts = {name: from_plain(value) if isinstance(value, dict) else value for name, value in values.items() if name != "kind"}
    return KINDS[values["kind"]](**parts)
