"""What the solver asks of a liquid, what every law has, and the parts of an experiment that have a law."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, TypeAlias

from softlube.errors import InputError
from softlube.model.inputs import DENSITY, INVERSE_PRESSURE, VISCOSITY, given
from softlube.model.lazy import numpy as np
from softlube.model.named import Named
from softlube.model.parts import Part

if TYPE_CHECKING:
    from typing import Self

    from numpy.typing import NDArray

Array: TypeAlias = "NDArray[np.floating]"

LARGEST_EXPONENT = 200.0
"""Bound of |ln η/η₀|, so that a wild iterate of Newton's method raises no overflow."""


class Liquid(Protocol):
    """What the solver asks of a liquid."""

    kind: ClassVar[str]

    @property
    def linear(self) -> bool:
        """Whether shear stress and shear rate are in proportion."""
        ...

    @property
    def thins(self) -> bool:
        """Whether the viscosity depends on the shear rate, and with it the flux; see `fluidity_at`."""
        ...

    def in_units(self, unit: float) -> Liquid:
        """The same liquid with another unit of height, given over the present one; pressures scale with its root, stresses
        with the unit itself.
        """
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
        """The law with a share (0 to 1) of its viscosity's rise with the pressure, for marching up to it; none for 0."""
        ...

    def fluidity_at(self, stress: Array) -> tuple[Array, Array]:
        """Logarithm of ψ, the fluidity at a shear stress t > 0 over that at rest, and its derivative by ln t, not negative."""
        ...

    def flow_curve(self, rate: Array) -> Array:
        """The shear stress t at which ψ(t) t has a value, which is the shear rate times the viscosity at rest."""
        ...

    def limited(self, stress: Array, pressure: Array) -> Array:
        """The shear stress that the liquid bears, from that of its law of viscosity."""
        ...


class Law(Named):
    """A law that files know by its `kind`, of a liquid whose density is constant unless the law says otherwise."""

    kinds: ClassVar[dict[str, type[Any]]] = {}
    usual: ClassVar[str] = "newtonian"
    unknown: ClassVar[str] = "liquid: no law"

    @property
    def linear(self) -> bool:
        """True: shear stress and shear rate are in proportion."""
        return True

    @property
    def thins(self) -> bool:
        """False: the viscosity does not depend on the shear rate."""
        return False

    def density(self, pressure: Array) -> tuple[Array, Array]:
        """1 and 0."""
        return np.ones_like(pressure), np.zeros_like(pressure)

    def fluidity_at(self, stress: Array) -> tuple[Array, Array]:
        """0 and 0: the viscosity does not depend on the shear stress."""
        return np.zeros_like(stress), np.zeros_like(stress)

    def flow_curve(self, rate: Array) -> Array:
        """The rate."""
        return rate

    def limited(self, stress: Array, pressure: Array) -> Array:
        """The stress itself: the liquid bears any."""
        return stress


@dataclass(frozen=True)
class LawOver(Law):
    """A law on top of another, which has all that this one does not say.

    Parameters
    ----------
    liquid : Liquid
        The other law.
    """

    liquid: Liquid

    @property
    def linear(self) -> bool:
        """The other's."""
        return self.liquid.linear

    @property
    def thins(self) -> bool:
        """The other's."""
        return self.liquid.thins

    def in_units(self, unit: float) -> Self:
        """The same liquid with another unit of height."""
        return replace(self, liquid=self.liquid.in_units(unit))

    def viscosity(self, pressure: Array) -> Array:
        """The other's."""
        return self.liquid.viscosity(pressure)

    def fluidity(self, pressure: Array) -> tuple[Array, Array]:
        """The other's."""
        return self.liquid.fluidity(pressure)

    def reduced_pressure(self, pressure: Array) -> Array:
        """The other's."""
        return self.liquid.reduced_pressure(pressure)

    def density(self, pressure: Array) -> tuple[Array, Array]:
        """The other's."""
        return self.liquid.density(pressure)

    def weakened(self, share: float) -> Self:
        """This law, on top of a share of the other's rise with the pressure."""
        return replace(self, liquid=self.liquid.weakened(share))

    def fluidity_at(self, stress: Array) -> tuple[Array, Array]:
        """The other's."""
        return self.liquid.fluidity_at(stress)

    def flow_curve(self, rate: Array) -> Array:
        """The other's."""
        return self.liquid.flow_curve(rate)

    def limited(self, stress: Array, pressure: Array) -> Array:
        """The other's."""
        return self.liquid.limited(stress, pressure)


class Lubricant(Part):
    """Any liquid as a part of an experiment, in SI."""

    slot: ClassVar[str] = "liquid"
    selector: ClassVar[str] = "viscosity_law"

    @property
    def reference_viscosity(self) -> float:
        """Dynamic viscosity that the problem is normalised with [Pa s]: at rest, where the liquid has one there."""
        raise NotImplementedError

    def law(self, pressure_unit: float) -> Liquid:
        """The law of its viscosity at rest, normalised with a pressure [Pa]."""
        raise NotImplementedError

    def sheared(self, law: Liquid, pressure_unit: float, stress_unit: float) -> Liquid:
        """What shear adds to its law at rest, normalised with a pressure and a shear stress [Pa]: nothing.

        The unit of stress is that of `softlube.model.liquids.thinning`, that of shear rates the stress over the viscosity.
        """
        return law


class LiquidPart(Lubricant):
    """A liquid with a viscosity at rest, as a part of an experiment, in SI."""

    viscosity: float = given("Dynamic viscosity of the liquid", VISCOSITY, "2 Pa s")

    @property
    def reference_viscosity(self) -> float:
        """That at rest [Pa s]."""
        return self.viscosity


class Thickening(LiquidPart):
    """A liquid whose viscosity rises with the pressure, from η₀ with the slope α of ln η."""

    pressure_viscosity: float = given(
        "Pressure-viscosity coefficient", INVERSE_PRESSURE, "20 GPa^-1", absent="constant viscosity"
    )


class DensityPart(Part):
    """How the density of a liquid depends on the pressure, as a part of an experiment, in SI."""

    slot: ClassVar[str] = "compressibility"
    selector: ClassVar[str] = "density_law"
    density: float = given("Density of the liquid, for the warning of inertia", DENSITY, "970 kg/m^3", default=1000)

    def law(self, liquid: Liquid, pressure_unit: float) -> Liquid:
        """A liquid with this density, normalised with a pressure [Pa]."""
        raise NotImplementedError


def check_not_negative(name: str, value: float) -> None:
    """Refuse a parameter of a law that is negative or not finite."""
    if not (math.isfinite(value) and value >= 0):
        raise InputError(f"{name}: expected a finite number that is not negative, got {value!r}")


def check_positive(name: str, value: float) -> None:
    """Refuse a reference pressure of a law that is not positive and finite."""
    if not (math.isfinite(value) and value > 0):
        raise InputError(f"{name}: expected a positive, finite pressure, got {value!r}")


def check_positive_number(name: str, value: float) -> None:
    """Refuse a parameter of a law that is not positive and finite."""
    if not (math.isfinite(value) and value > 0):
        raise InputError(f"{name}: expected a positive, finite number, got {value!r}")
