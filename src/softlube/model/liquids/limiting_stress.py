"""A limit of the shear stress that a liquid bears."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

from softlube.model.inputs import NUMBER, PRESSURE, given
from softlube.model.lazy import numpy as np
from softlube.model.liquids.base import Array, LawOver, Liquid, Lubricant, check_not_negative, check_positive_number


@dataclass(frozen=True)
class LimitingStressLaw(LawOver):
    """|τ| = τL (1 − e^(−τ′/τL)), τ′ the stress by the law underneath and τL = τL0 + ζp (Bair & Winer 1979).

    The limit is put on the mean stress across the film, which is the friction.  The flux is that of the law underneath: a film
    sheared at the limit slips on one of its walls, on which of them the sign of the pressure gradient decides, and none of that
    is known to shear rates.  Where the film is made, in the inlet, stresses are far below the limit.

    Parameters
    ----------
    stress : float
        τL0 over the unit of stress.
    coefficient : float
        ζ times the unit of pressure over that of stress.
    """

    stress: float
    coefficient: float
    kind: ClassVar[str] = "limiting-stress"

    @property
    def linear(self) -> bool:
        """False."""
        return False

    def __post_init__(self) -> None:
        check_positive_number("stress", self.stress)
        check_not_negative("coefficient", self.coefficient)

    def in_units(self, unit: float) -> LimitingStressLaw:
        """The same liquid with another unit of height."""
        ratio = math.sqrt(unit)  # of the unit of stress over that of pressure
        return replace(self, liquid=self.liquid.in_units(unit), stress=self.stress / unit, coefficient=self.coefficient / ratio)

    def limited(self, stress: Array, pressure: Array) -> Array:
        """τL (1 − e^(−|τ′|/τL)) with the sign of τ′."""
        limit = self.stress + self.coefficient * np.maximum(pressure, 0.0)
        return -np.copysign(limit, stress) * np.expm1(-np.abs(self.liquid.limited(stress, pressure)) / limit)


class LimitingStress(Lubricant):
    """Any liquid, up to a limiting shear stress that rises with the pressure."""

    kind: ClassVar[str] = "limiting-stress"
    over: ClassVar[str] = "liquid"
    stress: float = given("Limiting shear stress of a liquid at zero pressure", PRESSURE, "5 MPa", flat="limiting_stress")
    coefficient: float = given(
        "Rise of the limiting shear stress with the pressure",
        NUMBER,
        "0.05",
        default=0.0,
        between=(0.0, 1.0),
        flat="limiting_coefficient",
    )

    if TYPE_CHECKING:
        liquid: Lubricant

    @property
    def reference_viscosity(self) -> float:
        """That of the liquid [Pa s]."""
        return self.liquid.reference_viscosity

    def law(self, pressure_unit: float) -> Liquid:
        """The liquid's law at rest."""
        return self.liquid.law(pressure_unit)

    def sheared(self, law: Liquid, pressure_unit: float, stress_unit: float) -> LimitingStressLaw:
        """On top of all that the liquid's law says."""
        below = self.liquid.sheared(law, pressure_unit, stress_unit)
        return LimitingStressLaw(below, self.stress / stress_unit, self.coefficient * pressure_unit / stress_unit)
