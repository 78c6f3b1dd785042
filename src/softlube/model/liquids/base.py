"""What the solver asks of a liquid, what every law has, and the parts of an experiment that have a law."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, TypeAlias

from softlube.errors import InputError
from softlube.model.inputs import DENSITY, INVERSE_PRESSURE, VISCOSITY, given
from softlube.model.lazy import numpy as np
from softlube.model.parts import Part

if TYPE_CHECKING:
    from numpy.typing import NDArray

Array: TypeAlias = "NDArray[np.floating]"

LARGEST_EXPONENT = 200.0
"""Bound of |ln η/η₀|, so that a wild iterate of Newton's method raises no overflow."""


class Liquid(Protocol):
    """What the solver asks of a liquid."""

    kind: ClassVar[str]

    def in_units(self, unit: float) -> Liquid:
        """The same liquid with another unit of height, given over the present one; pressures scale with its root."""
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
        """The law with a share (0 to 1) of its viscosity's rise, for marching up to it; constant viscosity for 0."""
        ...


class Law:
    """A law that files know by its `kind`, of a liquid whose density is constant unless the law says otherwise."""

    kinds: ClassVar[dict[str, type[Any]]] = {}
    """Every law by its name in files."""
    kind: ClassVar[str]

    def __init_subclass__(cls) -> None:
        if "kind" in vars(cls):  # not yet where a worker of a sweep puts a class together
            Law.kinds[cls.kind] = cls

    def density(self, pressure: Array) -> tuple[Array, Array]:
        """1 and 0."""
        return np.ones_like(pressure), np.zeros_like(pressure)


class LiquidPart(Part):
    """A liquid as a part of an experiment, in SI."""

    slot: ClassVar[str] = "liquid"
    selector: ClassVar[str] = "viscosity_law"
    viscosity: float = given("Dynamic viscosity of the liquid", VISCOSITY, "2 Pa s")

    def law(self, pressure_unit: float) -> Liquid:
        """The law of its viscosity, normalised with a pressure [Pa]."""
        raise NotImplementedError


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


def to_plain(liquid: Liquid) -> dict[str, Any]:
    """A liquid in plain values, for files."""
    return {"kind": liquid.kind} | {
        name: to_plain(value) if hasattr(value, "kind") else value for name, value in vars(liquid).items()
    }


def from_plain(values: dict[str, Any] | None) -> Liquid:
    """Inverse of `to_plain`; constant viscosity where nothing was written.

    Raises
    ------
    InputError
        If no law has the name that is written.
    """
    written = dict(values or {"kind": "newtonian"})
    kind = written.pop("kind")
    if kind not in Law.kinds:
        raise InputError(f"liquid: no law {kind!r} is known; expected {' or '.join(map(repr, sorted(Law.kinds)))}")
    return Law.kinds[kind](**{name: from_plain(value) if isinstance(value, dict) else value for name, value in written.items()})
