"""What the solver asks of a substrate, and what every kernel has: its name in files."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, TypeAlias

from softlube.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Array: TypeAlias = "NDArray[np.floating]"
Orders: TypeAlias = "NDArray[np.intp]"


class Remainder(Protocol):
    """What a substrate's kernel has beyond the half-space's."""

    @property
    def smooth_over(self) -> float:
        """Length over which it is smooth: the distance from the real plane up to which it is analytic."""
        ...

    def ring_remainder(self, orders: Orders, r: Array, r_source: Array) -> Array:
        """Its harmonics, see `softlube.discretization.potentials.ring_kernels`."""
        ...


class Substrate(Protocol):
    """What the solver asks of a substrate."""

    kind: ClassVar[str]

    def in_units(self, unit: float) -> Substrate:
        """The same substrate with another unit of height, given over the present one; lengths scale with its root."""
        ...

    @property
    def remainder(self) -> Remainder | None:
        """What its kernel has beyond the half-space's, if anything."""
        ...

    def spectrum(self, reach: float = 0.0) -> tuple[Array, Array]:
        """Wavenumbers k and weights (C(k) − 1) dk of a quadrature of the remainder, good for waves seen as far as `reach`."""
        ...


class Kernel:
    """A kernel that files know by its `kind`."""

    kinds: ClassVar[dict[str, type[Any]]] = {}
    """Every kernel by its name in files."""
    kind: ClassVar[str]

    def __init_subclass__(cls) -> None:
        Kernel.kinds[cls.kind] = cls


def check_poisson_ratio(value: float) -> None:
    """Refuse a Poisson ratio outside 0 … 1/2."""
    if not (math.isfinite(value) and 0 <= value <= 0.5):
        raise InputError(f"poisson_ratio: expected a number between 0 and 0.5, got {value!r}")


def to_plain(substrate: Substrate) -> dict[str, Any]:
    """A substrate in plain values, for files."""
    return {"kind": substrate.kind} | asdict(substrate)  # type: ignore[call-overload]


def from_plain(values: dict[str, Any] | None) -> Substrate:
    """Inverse of `to_plain`; a half-space where nothing was written.

    Raises
    ------
    InputError
        If no substrate has the name that is written.
    """
    written = dict(values or {"kind": "half-space"})
    kind = written.pop("kind")
    if kind not in Kernel.kinds:
        raise InputError(f"substrate: no {kind!r} is known; expected {' or '.join(map(repr, sorted(Kernel.kinds)))}")
    return Kernel.kinds[kind](**written)
