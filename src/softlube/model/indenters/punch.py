"""A flat punch with a rounded edge."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from softlube.model.indenters.base import Array, Curved, IndenterPart
from softlube.model.inputs import LENGTH, given
from softlube.model.lazy import numpy as np

BLEND = 0.4
"""Width, over the face's radius, over which the curvature rises at the border of the face, if none is given.

With 0.4 a contact is solved on the grids of a paraboloid with the same β′; a narrower one takes finer grids, for the steep
pressure at the border."""


@dataclass(frozen=True)
class RoundedPunchShape(Curved):
    """Flat up to a radius b, then the parabola of the rounded edge, F = (x − b)²/2 (Schubert 1942, Ciavarella 1999).

    The curvature rises from 0 to 1 about b over a width w, as F′ = [ρ − b + √((ρ − b)² + w²)] x/2ρ, ρ² = x² + w²; at w = 0
    it jumps.

    Parameters
    ----------
    face : float
        b over the reference radius, which is the radius of curvature of the edge.
    blend : float
        w over the reference radius.
    """

    face: float
    blend: float
    kind: ClassVar[str] = "rounded-punch"
    words: ClassVar[str] = "a rigid flat punch with a rounded edge"

    @property
    def own_corners(self) -> tuple[float, ...]:
        """The border of the face."""
        return (self.face,)

    @property
    def flat(self) -> float:
        """The border of the face if the curvature jumps there, unless the substrate is a ball."""
        return 0.0 if self.blend or self.share != 1 else self.face / self._length

    def outline(self, x: Array) -> tuple[Array, Array, Array]:
        """The face and its edge, and the derivatives."""
        b, w = self.face, self.blend
        if not w:
            beyond = np.maximum(x - b, 0)
            return beyond**2 / 2, beyond, (x > b).astype(float)
        rho = np.hypot(x, w)
        past, root = rho - b, np.hypot(rho - b, w)
        # past + root without cancellation on the face
        rise = np.where(past < 0, w**2 / (root - np.minimum(past, 0)), past + root) / 2
        first = math.hypot(w - b, w)
        height = (past * (past + root) + w**2 * np.arcsinh(past / w)) / 4
        at_axis = ((w - b) * (w - b + first) + w**2 * math.asinh((w - b) / w)) / 4
        bend = (1 + past / root) / 2 * (x / rho) ** 2 + rise * w**2 / rho**3
        return height - at_axis, rise * x / rho, bend


class RoundedPunch(IndenterPart):
    """A flat punch whose edge is rounded: f = 0 up to the radius of the face, (r − face)²/(2 edge) beyond."""

    kind: ClassVar[str] = "rounded-punch"
    face_radius: float = given("Radius of the flat face of a punch", LENGTH, "1 mm")
    edge_radius: float = given("Radius of curvature of the rounded edge of a punch", LENGTH, "0.5 mm")
    blend_width: float = given(
        "Width over which the curvature rises at the border of the face of a punch",
        LENGTH,
        "50 um",
        default=None,
        absent="0.4 of the face's radius",
    )

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values with the width that is usual."""
        if values["blend_width"] is None:
            values["blend_width"] = BLEND * values["face_radius"]
        return super().checked(values)

    @property
    def reference_radius(self) -> float:
        """Radius of curvature of the edge [m]."""
        return self.edge_radius

    def shape(self, unit: float, share: float) -> RoundedPunchShape:
        """The face and its edge."""
        return RoundedPunchShape(unit, share, self.face_radius / self.edge_radius, self.blend_width / self.edge_radius)
