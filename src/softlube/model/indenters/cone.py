"""A cone with a rounded tip."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from softlube.errors import InputError
from softlube.model.indenters.base import Array, Curved, IndenterPart
from softlube.model.inputs import LENGTH, NUMBER, given
from softlube.model.lazy import numpy as np


@dataclass(frozen=True)
class RoundedConeShape(Curved):
    """The hyperboloid F = m (√(x² + m²) − m): x²/2 at the tip, the cone of slope m beyond x ~ m.

    Its transform is m x arctan(x/m), (π/2) m x of the sharp cone.

    Parameters
    ----------
    incline : float
        Slope m of the flank: the tangent of its angle with the substrate.
    base : float
        Radius of the cone's base over the reference radius, which is the tip's radius of curvature; the flank ends there.
    """

    incline: float
    base: float
    kind: ClassVar[str] = "rounded-cone"
    words: ClassVar[str] = "a rigid cone with a rounded tip"

    @property
    def end(self) -> float:
        """Radius of the base."""
        return self.base

    def outline(self, x: Array) -> tuple[Array, Array, Array]:
        """The hyperboloid without cancellation, and its derivatives."""
        m = self.incline
        root = np.hypot(x, m)
        return m * x**2 / (root + m), m * x / root, (m / root) ** 3


class RoundedCone(IndenterPart):
    """A cone whose tip is rounded, a hyperboloid; where its flank ends, the surface turns up as the paraboloid touching it."""

    kind: ClassVar[str] = "rounded-cone"
    tip_radius: float = given("Radius of curvature of the tip of a cone", LENGTH, "0.1 mm")
    flank_angle: float = given(
        "Angle between the flank of a cone and the substrate, in degrees", NUMBER, "5", between=(0.1, 60)
    )
    base_radius: float = given("Radius at which the flank of a cone ends", LENGTH, "2 mm")

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values; the tip is narrower than the base."""
        tip = values["tip_radius"] * math.tan(math.radians(values["flank_angle"]))
        if not values["base_radius"] > tip:
            raise InputError(
                f"base_radius, tip_radius: the tip reaches up to a radius of {tip:.3g} m, beyond the base; take a wider one"
            )
        return super().checked(values)

    @property
    def reference_radius(self) -> float:
        """Radius of curvature of the tip [m]."""
        return self.tip_radius

    def shape(self, unit: float, share: float) -> RoundedConeShape:
        """The tip and the flank."""
        incline = math.tan(math.radians(self.flank_angle))
        return RoundedConeShape(unit, share, incline, self.base_radius / self.tip_radius)
