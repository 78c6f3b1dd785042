"""A viscosity that rises exponentially with the pressure."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from softlube.model.lazy import numpy as np
from softlube.model.liquids.base import LARGEST_EXPONENT, Array, Law, Thickening, check_not_negative


@dataclass(frozen=True)
class BarusLaw(Law):
    """η = η₀ e^{αp} (Barus 1893).

    Parameters
    ----------
    alpha : float
        ᾱ = 4πGα√(unit of height/R) ≥ 0, the pressure-viscosity coefficient over the unit of 1/pressure.
    """

    alpha: float
    kind: ClassVar[str] = "barus"

    def __post_init__(self) -> None:
        check_not_negative("alpha", self.alpha)

    def in_units(self, unit: float) -> BarusLaw:
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

    def weakened(self, share: float) -> BarusLaw:
        """The law with a share of α."""
        return replace(self, alpha=self.alpha * share)


class Barus(Thickening):
    """A liquid whose viscosity is η₀ e^{αp}."""

    kind: ClassVar[str] = "barus"
    usual: ClassVar[bool] = True

    def law(self, pressure_unit: float) -> BarusLaw:
        """Its α over the unit of 1/pressure."""
        return BarusLaw(self.pressure_viscosity * pressure_unit)
