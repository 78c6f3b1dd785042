"""A density that rises with the pressure like that of mineral oils."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from softlube.model.lazy import numpy as np
from softlube.model.liquids.base import Array, DensityPart, LawOver, Liquid, check_positive

DENSITY_PRESSURE = 5.9e8
"""Pressure [Pa] at which half of the densest liquid's compression has been had, in Dowson & Higginson's law."""
DENSITY_RISE = 0.34
"""What an endless pressure adds to ρ/ρ₀ in that law."""


@dataclass(frozen=True)
class DowsonHigginsonLaw(LawOver):
    """ρ/ρ₀ = 1 + 0.34 p/(p₁ + p), p₁ = 0.59 GPa: mineral oils (Dowson & Higginson 1966).

    Parameters
    ----------
    liquid : Liquid
        What has the viscosity.
    reference : float
        p₁ over the unit of pressure.
    """

    reference: float
    kind: ClassVar[str] = "dowson-higginson"

    def __post_init__(self) -> None:
        check_positive("reference", self.reference)

    @classmethod
    def of(cls, liquid: Liquid, pressure_unit: float) -> DowsonHigginsonLaw:
        """With the unit of pressure in Pa."""
        return cls(liquid, DENSITY_PRESSURE / pressure_unit)

    def in_units(self, unit: float) -> DowsonHigginsonLaw:
        """The same liquid with another unit of height."""
        return replace(self, liquid=self.liquid.in_units(unit), reference=self.reference / math.sqrt(unit))

    def density(self, pressure: Array) -> tuple[Array, Array]:
        """ρ/ρ₀ and its derivative; a liquid under tension is as dense as at −p₁/2, where the law is not meant to reach."""
        compressed = np.maximum(pressure / self.reference, -0.5)
        slope = np.where(compressed > -0.5, DENSITY_RISE / (self.reference * (1 + compressed) ** 2), 0.0)
        return 1 + DENSITY_RISE * compressed / (1 + compressed), slope


class DowsonHigginson(DensityPart):
    """A density that rises by a third at most, as in mineral oils: ρ₀ [1 + 0.34 p/(0.59 GPa + p)]."""

    kind: ClassVar[str] = "dowson-higginson"

    def law(self, liquid: Liquid, pressure_unit: float) -> DowsonHigginsonLaw:
        """The liquid with this density."""
        return DowsonHigginsonLaw.of(liquid, pressure_unit)
