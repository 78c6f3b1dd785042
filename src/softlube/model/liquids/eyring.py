"""A viscosity by Eyring's theory of flow as a process of activation."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from softlube.model.inputs import PRESSURE, given
from softlube.model.lazy import numpy as np
from softlube.model.liquids.base import LARGEST_EXPONENT, Array, Liquid, check_positive_number
from softlube.model.liquids.thinning import ThinningLaw, WithViscosity


@dataclass(frozen=True)
class EyringLaw(ThinningLaw):
    """γ̇ = (τe/η₀) sinh(τ/τe) (Eyring 1936).

    Parameters
    ----------
    stress : float
        τe over the unit of stress.
    """

    stress: float
    kind: ClassVar[str] = "eyring"

    def __post_init__(self) -> None:
        check_positive_number("stress", self.stress)

    def in_units(self, unit: float) -> EyringLaw:
        """The same liquid with another unit of height."""
        return replace(self, liquid=self.liquid.in_units(unit), stress=self.stress / unit)

    def fluidity_at(self, stress: Array) -> tuple[Array, Array]:
        """Ln (sinh x)/x, x = t/τe, and x coth x − 1."""
        x = np.minimum(stress / self.stress, LARGEST_EXPONENT)
        square = x * x
        small = x < 0.02  # three terms of the series are exact to 1e-15
        safe = np.where(small, 1.0, x)
        value = safe + np.log1p(-np.exp(-2 * safe)) - np.log(2 * safe)
        slope = safe / np.tanh(safe) - 1
        value = np.where(small, square / 6 * (1 - square / 30 * (1 - 4 * square / 63)), value)
        return value, np.where(small, square / 3 * (1 - square / 15 * (1 - 2 * square / 21)), slope)

    def flow_curve(self, rate: Array) -> Array:
        """τe asinh γ̇/τe."""
        return self.stress * np.arcsinh(rate / self.stress)


class Eyring(WithViscosity):
    """A liquid whose shear rate goes with the hyperbolic sine of the shear stress."""

    kind: ClassVar[str] = "eyring"
    stress: float = given("Shear stress from which on an Eyring liquid thins", PRESSURE, "5 MPa", flat="eyring_stress")

    def sheared(self, law: Liquid, pressure_unit: float, stress_unit: float) -> EyringLaw:
        """On top of the law at rest."""
        return EyringLaw(law, self.stress / stress_unit)
