"""What the solver asks of a liquid, and what every law has: its name in files."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, TypeAlias

from softlube.errors import InputError
from softlube.model.lazy import numpy as np

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
        Law.kinds[cls.kind] = cls

    def density(self, pressure: Array) -> tuple[Array, Array]:
        """1 and 0."""
        return np.ones_like(pressure), np.zeros_like(pressure)


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
