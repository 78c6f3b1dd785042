"""Constant viscosity."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from softlube.model.lazy import numpy as np
from softlube.model.liquids.base import Array, Law, LiquidPart


@dataclass(frozen=True)
class NewtonianLaw(Law):
    """Constant viscosity, the paper's liquid."""

    kind: ClassVar[str] = "newtonian"

    def in_units(self, unit: float) -> NewtonianLaw:
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

    def weakened(self, share: float) -> NewtonianLaw:
        """Itself: nothing depends on the pressure."""
        return self


class Newtonian(LiquidPart):
    """A liquid of constant viscosity."""

    kind: ClassVar[str] = "newtonian"

    def law(self, pressure_unit: float) -> NewtonianLaw:
        """Constant viscosity, whatever the unit."""
        return NewtonianLaw()
