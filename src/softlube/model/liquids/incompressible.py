"""A constant density."""

from __future__ import annotations

from typing import ClassVar

from softlube.model.liquids.base import DensityPart, Liquid


class Incompressible(DensityPart):
    """A constant density."""

    kind: ClassVar[str] = "constant"
    usual: ClassVar[bool] = True

    def law(self, liquid: Liquid, pressure_unit: float) -> Liquid:
        """The liquid itself: laws of the viscosity have a constant density."""
        return liquid
