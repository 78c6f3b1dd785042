"""Liquids whose viscosity depends on the shear stress: what their laws and their parts have in common.

At the pressure p and the shear stress t the viscosity is η = η(p)/ψ(t), η(p) that of the liquid at rest and ψ ≥ 1, so that the
shear rate is γ̇ = ψ(t) t/η(p).  So the pressure multiplies the viscosity at equal stress, and shortens no relaxation time but
with it: the shear modulus η/λ of the liquid does not depend on the pressure.

Stresses are normalised with T = (2π/3) G (unit of height)/R and shear rates with T/η₀ (E* in place of 4G), in which τ = γ̇ for
constant viscosity; neither depends on the speed.
"""

from __future__ import annotations

from dataclasses import dataclass

from softlube.errors import InputError
from softlube.model.inputs import INVERSE_PRESSURE, NUMBER, given
from softlube.model.lazy import numpy as np
from softlube.model.liquids.barus import Barus
from softlube.model.liquids.base import Array, LawOver, Liquid, LiquidPart, Lubricant
from softlube.model.liquids.newtonian import Newtonian
from softlube.model.liquids.roelands import Roelands

LAWS = {each.kind: each for each in (Barus, Roelands)}
"""Laws by which the viscosity at rest may rise with the pressure."""


@dataclass(frozen=True)
class ThinningLaw(LawOver):
    """A law ψ(t) on top of the liquid at rest.

    Parameters
    ----------
    liquid : Liquid
        The liquid at rest: how its viscosity and its density depend on the pressure.
    """

    @property
    def linear(self) -> bool:
        """False."""
        return False

    @property
    def thins(self) -> bool:
        """True."""
        return True

    def fluidity_at(self, stress: Array) -> tuple[Array, Array]:
        """Ln ψ, and its derivative by ln t, not negative."""
        raise NotImplementedError

    def flow_curve(self, rate: Array) -> Array:
        """The stress t at which ψ(t) t has a value."""
        raise NotImplementedError


@dataclass(frozen=True)
class Tempered(LawOver):
    """A share of what another law thins, on the way to it from a viscosity that is the same at every shear stress.

    Parameters
    ----------
    liquid : Liquid
        The other law.
    share : float
        Power of its ψ; the rest is the power of `even`.
    even : float
        ψ for no share.
    """

    share: float
    even: float

    def fluidity_at(self, stress: Array) -> tuple[Array, Array]:
        """Logarithm of ψ, and its derivative by ln t."""
        value, slope = self.liquid.fluidity_at(stress)
        return self.share * value + (1 - self.share) * np.log(self.even), self.share * slope

    def flow_curve(self, rate: Array) -> Array:
        """The stress, exactly for no share and for all of it."""
        return self.liquid.flow_curve(rate) ** self.share * (rate / self.even) ** (1 - self.share)


class Thinning(Lubricant):
    """A liquid that thins with shear, alone or on top of a viscosity that rises with the pressure."""

    pressure_viscosity: float | None = given(
        "Pressure-viscosity coefficient", INVERSE_PRESSURE, "20 GPa^-1", default=None, absent="constant viscosity"
    )
    pressure_law: str = given(
        "How the viscosity at rest of a liquid that thins with shear rises with the pressure",
        default=Barus.kind,
        choices=tuple(LAWS),
    )

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        last = ("pressure_viscosity", "pressure_law")  # what it is comes first
        cls.inputs = dict(sorted(cls.inputs.items(), key=lambda item: item[0] in last))

    @property
    def at_rest(self) -> Lubricant:
        """The liquid at rest."""
        if self.pressure_viscosity is None:
            return Newtonian(self.reference_viscosity)
        return LAWS[self.pressure_law](self.reference_viscosity, pressure_viscosity=self.pressure_viscosity)

    def law(self, pressure_unit: float) -> Liquid:
        """The law at rest."""
        return self.at_rest.law(pressure_unit)


class WithViscosity(LiquidPart, Thinning):
    """A liquid that thins with shear and has a viscosity at rest."""


def index_input() -> float:
    """The input of a power-law index."""
    return given("Power-law index of a liquid that thins with shear, up to 1", NUMBER, "0.5", between=(0.05, 1.0))


def check_index(index: float) -> None:
    """Refuse a power-law index that is not above 0 and at most 1."""
    if not 0 < index <= 1:
        raise InputError(f"index: expected a number above 0 and up to 1, for a liquid that thins with shear, got {index!r}")
