"""A viscosity that rises with the pressure like that of mineral oils, slower than exponentially."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, ClassVar

from softlube.errors import InputError
from softlube.model.lazy import numpy as np
from softlube.model.liquids.base import LARGEST_EXPONENT, Array, Law, Thickening, check_not_negative, check_positive

if TYPE_CHECKING:
    from scipy.interpolate import CubicHermiteSpline

ROELANDS_PRESSURE = 1.962e8
"""Roelands' reference pressure [Pa], 1/(5.1e-9 Pa⁻¹)."""
ROELANDS_VISCOSITY = 6.31e-5
"""Viscosity [Pa s] that every Roelands liquid has at p = −`ROELANDS_PRESSURE`: ln η₀ + 9.67 = ln(η₀/6.31e-5)."""
SMALLEST_RATIO, LARGEST_RATIO = 1e-3, 1e4
"""Bounds of 1 + p/p₀, so that a wild iterate of Newton's method raises no overflow."""


@dataclass(frozen=True)
class RoelandsLaw(Law):
    """η = η₀ exp{(αp₀/z)[(1 + p/p₀)^z − 1]} (Roelands 1966).

    Parameters
    ----------
    alpha : float
        ᾱ, the slope of ln η at zero pressure, as in `BarusLaw`.
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
        check_not_negative("alpha", self.alpha)
        if not 0 < self.exponent <= 1:
            raise InputError(f"exponent: expected Roelands' z, a number between 0 and 1, got {self.exponent!r}")
        check_positive("reference", self.reference)

    @classmethod
    def of(cls, alpha: float, viscosity: float, pressure_unit: float) -> RoelandsLaw:
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

    def in_units(self, unit: float) -> RoelandsLaw:
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
        x, weight = np.polynomial.legendre.leggauss(8)
        near = self.fluidity(np.asarray(pressure)[..., None] * (x + 1) / 2)[0] @ weight / 2 * pressure
        start, spline = _roelands_rest(self.alpha * self.reference, self.exponent)
        ratio = np.clip(1 + pressure / self.reference, SMALLEST_RATIO, LARGEST_RATIO)
        far = self.reference * (start - np.exp(spline(np.log(ratio))))
        return np.where((self.alpha * pressure < 0.5) & (pressure < self.reference), near, far)

    def weakened(self, share: float) -> RoelandsLaw:
        """The law with a share of α."""
        return replace(self, alpha=self.alpha * share)


class Roelands(Thickening):
    """A liquid whose viscosity rises by Roelands' law."""

    kind: ClassVar[str] = "roelands"

    def law(self, pressure_unit: float) -> RoelandsLaw:
        """Its law, see `RoelandsLaw.of`."""
        return RoelandsLaw.of(self.pressure_viscosity, self.viscosity, pressure_unit)


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
    x, weight = np.polynomial.legendre.leggauss(6)
    points = knots[:-1, None] + np.diff(knots)[:, None] * (x + 1) / 2

    def fluidity(log_ratio: Array) -> Array:
        value = steepness / exponent * np.expm1(exponent * log_ratio)
        return np.exp(-np.clip(value, -LARGEST_EXPONENT, LARGEST_EXPONENT) + log_ratio)

    parts = fluidity(points) @ weight * np.diff(knots) / 2
    # Beyond the table the liquid counts as solid to double precision, or the law is no longer one.
    rest = np.cumsum(np.append(parts, fluidity(knots[-1:]))[::-1])[::-1]
    spline = CubicHermiteSpline(knots, np.log(rest), -fluidity(knots) / rest)
    return float(np.exp(spline(0.0))), spline
