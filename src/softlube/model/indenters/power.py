"""Blunt and pointed indenters whose height is a power of the radius."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from softlube.errors import InputError, shown
from softlube.model.indenters.base import Array, Curved, IndenterPart, Shape
from softlube.model.indenters.sphere import Paraboloid
from softlube.model.inputs import NUMBER, Input, given

EXPONENTS = 2.0, 8.0
"""Exponents that are taken: below 2 the tip is pointed, far above the indenter is a flat punch with a sharp edge."""

POWERS = range(-7, 0)
"""Powers of the metre in units of coefficients."""


@dataclass(frozen=True)
class PowerShape(Curved):
    """F = 2 (x/2)ⁿ over the reference radius R₁ = ℓ/2, where ℓ is the radius at which the height is as large: f = ℓ (r/ℓ)ⁿ.

    Parameters
    ----------
    exponent : float
        n; at n = 2 the shape is the paraboloid of radius R₁.
    """

    exponent: float
    kind: ClassVar[str] = "power"
    words: ClassVar[str] = "a rigid indenter of power-law profile"

    def outline(self, x: Array) -> tuple[Array, Array, Array]:
        """2 (x/2)ⁿ and its derivatives."""
        n = self.exponent
        bend = n * (n - 1) / 2 * (x / 2) ** (n - 2)
        return 2 * (x / 2) ** n, n * (x / 2) ** (n - 1), bend

    def transform(self, x: Array) -> tuple[Array, Array]:
        """F and F′ times n ∫ sinⁿ⁻¹t dt over 0 ≤ t ≤ π/2."""
        height, slope, _ = self.outline(x)
        return self._factor * height, self._factor * slope

    @property
    def _factor(self) -> float:
        n = self.exponent
        return n * math.sqrt(math.pi) / 2 * math.gamma(n / 2) / math.gamma((n + 1) / 2)


class InverseLength(float):
    """A number in m^`power`, the power being that of the unit it was given with."""

    power: float


class Coefficient(Input):
    """The coefficient C of f = C rⁿ, whose unit, m^(1−n), depends on the exponent."""

    def read(self, value: object, name: str | None = None) -> float:
        """The value in SI; of a text an `InverseLength`, to be compared with the exponent."""
        if not isinstance(value, str):
            return float(super().read(value, name))
        from softlube.model import units

        for power in POWERS:
            try:
                found = InverseLength(units.read_quantity(value, f"m^{power}" if power != -1 else "1/m"))
            except InputError:
                continue
            found.power = power
            return found
        raise InputError(f"{name or self.name}: expected {self.expected}; got {shown(value)}")


class PowerProfile(IndenterPart):
    """An indenter of height f = C rⁿ: blunt for n > 2, the paraboloid of radius 1/(2C) for n = 2."""

    kind: ClassVar[str] = "power"
    coefficient: Any = Coefficient(
        "Coefficient C of an indenter of height C rⁿ, in m^(1−n)", NUMBER, "2e8 m^-3", flat="profile_coefficient"
    )
    exponent: float = given("Exponent n of an indenter of height C rⁿ", NUMBER, "4", between=EXPONENTS, flat="profile_exponent")

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values with C in SI."""
        coefficient, power = values["coefficient"], 1 - values["exponent"]
        if isinstance(coefficient, InverseLength) and coefficient.power != power:
            raise InputError(
                f"profile_coefficient, profile_exponent: the unit is m^{coefficient.power:g}; with the exponent "
                f"{values['exponent']:g} expected one of m^({power:g}), or a number in SI"
            )
        if not (math.isfinite(coefficient) and coefficient > 0):
            raise InputError(f"profile_coefficient: expected a positive, finite number, got {coefficient:g}")
        values["coefficient"] = float(coefficient)
        return super().checked(values)

    @property
    def reference_radius(self) -> float:
        """Half the radius at which the height is as large as the radius, C^(−1/(n−1))/2 [m]."""
        return self.coefficient ** (-1 / (self.exponent - 1)) / 2

    def shape(self, unit: float, share: float) -> Shape:
        """The power law; the paraboloid itself at n = 2."""
        return Paraboloid() if self.exponent == 2 else PowerShape(unit, share, self.exponent)
