"""A viscosity that goes with a power of the shear rate."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from softlube.errors import InputError
from softlube.model import units
from softlube.model.inputs import Dimension, Input, read_quantity
from softlube.model.lazy import numpy as np
from softlube.model.liquids.base import Array, Liquid, check_positive_number
from softlube.model.liquids.thinning import Thinning, ThinningLaw, check_index, index_input

SECONDS = re.compile(r"(?P<pressure>.*?)(?: ?[·⋅*.] ?| )s(?:(?:\^|\*\*)(?:\((?P<bracket>n|[0-9.,]+)\)|(?P<power>n|[0-9.,]+)))?")
"""A unit of pressure times a power of the second, with a number before it or not; "n" stands for the index."""


SAME_POWER = 1e-6
"""Difference of the index from the power of the second in the unit that is a matter of rounding."""


class Consistency(float):
    """A consistency in Pa sⁿ that knows the power of the second that it was written with, None where no text told it."""

    power: float | None = None


class ConsistencyInput(Input):
    """The input of a consistency: a pressure times a power of the second, which is the index of the liquid."""

    def read(self, value: object, name: str | None = None) -> Consistency:
        """The value in Pa sⁿ, see `Input.read`."""
        name, power = name or self.name, None
        if isinstance(value, str):
            found = SECONDS.fullmatch(" ".join(value.split()))
            if found is None:
                raise InputError(f"{name}: cannot read {value!r}; expected {self.expected}")
            written = found["power"] or found["bracket"] or "1"
            power = None if written == "n" else read_quantity(name, written, "", self.expected)
            value = read_quantity(name, found["pressure"], "Pa", self.expected)
        result = Consistency(super().read(value, name))
        result.power = power
        return result

    def factor(self, unit: str) -> float:
        """What a number in a unit such as "mPa s^n" is multiplied by to be in Pa sⁿ."""
        found = SECONDS.fullmatch(unit)
        if found is None:
            raise InputError(f"cannot read the unit {unit!r}; expected one such as {self.unit!r}")
        return units.unit_factor(found["pressure"], "Pa")


@dataclass(frozen=True)
class OstwaldLaw(ThinningLaw):
    """τ = Kγ̇ⁿ (Ostwald & de Waele).

    It has no viscosity at rest; η₀ is that at the shear rate 1/s.  In pure rolling the mobility goes to zero with the pressure
    gradient, and is bounded.

    Parameters
    ----------
    stress : float
        Stress at the shear rate 1/s over the unit of stress.
    index : float
        n, 0 < n ≤ 1.
    """

    stress: float
    index: float
    kind: ClassVar[str] = "power-law"

    def __post_init__(self) -> None:
        check_positive_number("stress", self.stress)
        check_index(self.index)

    def in_units(self, unit: float) -> OstwaldLaw:
        """The same liquid with another unit of height."""
        return replace(self, liquid=self.liquid.in_units(unit), stress=self.stress / unit)

    def fluidity_at(self, stress: Array) -> tuple[Array, Array]:
        """(1/n − 1) ln t/t₁, and 1/n − 1."""
        power = 1 / self.index - 1
        return power * np.log(stress / self.stress), np.full_like(stress, power)

    def flow_curve(self, rate: Array) -> Array:
        """t₁ (γ̇/γ̇₁)ⁿ."""
        return self.stress * (rate / self.stress) ** self.index


class PowerLaw(Thinning):
    """A liquid whose shear stress is Kγ̇ⁿ at every shear rate."""

    kind: ClassVar[str] = "power-law"
    consistency: Any = ConsistencyInput(
        "Consistency of a power-law liquid, its viscosity at 1/s", Dimension("Pa s^n", "a consistency"), "0.5 Pa s^0.8"
    )
    index: float = index_input()

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values, if the consistency was written with the index as the power of the second."""
        consistency, index = values["consistency"], values["index"]
        power = getattr(consistency, "power", None)
        if power is not None and abs(power - index) > SAME_POWER:
            raise InputError(f"consistency, index: a unit of Pa s^{power:g} goes with the index {power:g}, not with {index:g}")
        return values | {"consistency": float(consistency)}

    @property
    def reference_viscosity(self) -> float:
        """K, the viscosity at the shear rate 1/s [Pa s]."""
        return self.consistency

    def sheared(self, law: Liquid, pressure_unit: float, stress_unit: float) -> OstwaldLaw:
        """On top of the law at rest."""
        return OstwaldLaw(law, self.consistency / stress_unit, self.index)
