"""The elastic half-space."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from softlube.model.lazy import numpy as np
from softlube.model.substrates.base import Array, Kernel, SubstratePart


@dataclass(frozen=True)
class HalfSpaceKernel(Kernel):
    """The elastic half-space, the paper's substrate.  Its Poisson ratio acts through the effective modulus alone."""

    kind: ClassVar[str] = "half-space"
    words: ClassVar[str] = "an elastic half-space"

    def in_units(self, unit: float) -> HalfSpaceKernel:
        """Itself: it has no length."""
        return self

    @property
    def remainder(self) -> None:
        """None."""

    def spectrum(self, reach: float = 0.0) -> tuple[Array, Array]:
        """Nothing: C = 1."""
        return np.empty(0), np.empty(0)


class HalfSpace(SubstratePart):
    """A substrate much thicker than the contact is wide."""

    kind: ClassVar[str] = "half-space"

    def kernel(
        self, length_unit: float, share: float = 1.0, speed: float | None = None, time_unit: float = 1.0
    ) -> HalfSpaceKernel:
        """The half-space's, whatever the unit: under an elastic ball it is one of the sum of both compliances."""
        return HalfSpaceKernel()
