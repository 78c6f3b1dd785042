"""A flat punch with a rounded edge."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from softlube.model.indenters.base import Array, Curved, IndenterPart
from softlube.model.inputs import LENGTH, given
from softlube.model.lazy import numpy as np


@dataclass(frozen=True)
class RoundedPunchShape(Curved):
    """Flat up to a radius b, then F = (x − b)²/2, the parabola of the rounded edge (Schubert 1942, Ciavarella 1999).

    Parameters
    ----------
    face : float
        Radius b of the flat face over the reference radius, which is the radius of curvature of the edge.
    """

    face: float
    kind: ClassVar[str] = "rounded-punch"
    words: ClassVar[str] = "a rigid flat punch with a rounded edge"

    @property
    def own_corners(self) -> tuple[float, ...]:
        """B."""
        return (self.face,)

    @property
    def flat(self) -> float:
        """b, unless the substrate is a ball."""
        return self.face / self._length if self.share == 1 else 0.0

    def outline(self, x: Array) -> tuple[Array, Array, Array]:
        """(x − b)²/2 beyond b, and its derivatives."""
        beyond = np.maximum(x - self.face, 0)
        return beyond**2 / 2, beyond, (x > self.face).astype(float)


class RoundedPunch(IndenterPart):
    """A flat punch whose edge is rounded: f = 0 up to the radius of the face, (r − face)²/(2 edge) beyond."""

    kind: ClassVar[str] = "rounded-punch"
    face_radius: float = given("Radius of the flat face of a punch", LENGTH, "1 mm")
    edge_radius: float = given("Radius of curvature of the rounded edge of a punch", LENGTH, "0.5 mm")

    @property
    def reference_radius(self) -> float:
        """Radius of curvature of the edge [m]."""
        return self.edge_radius

    def shape(self, unit: float, share: float) -> RoundedPunchShape:
        """The face and its edge."""
        return RoundedPunchShape(unit, share, self.face_radius / self.edge_radius)
