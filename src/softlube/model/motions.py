"""How the two surfaces move along each other.  A new motion is a class here.

Seen from the contact, the ball's surface passes with the speed v₁ and the substrate's with v₂, counted in the direction in
which the liquid is carried.  The film depends on v₁ + v₂ alone, which takes the place of v in Reynolds' equation; the Couette
shear depends on v₂ − v₁.
"""

from __future__ import annotations

from typing import ClassVar

from softlube.model.inputs import NUMBER, SPEED, given
from softlube.model.parts import Part

FIXED_BALL = 2.0
"""Slide-to-roll ratio of a ball that does not turn, as in the paper: v₁ = 0."""


class SteadyMotion(Part):
    """A motion that does not change with time."""

    slot: ClassVar[str] = "motion"
    slide_to_roll: float

    @property
    def speed_sum(self) -> float:
        """Sum of the surface speeds v₁ + v₂ [m/s], which is v in Eq. (1)."""
        raise NotImplementedError

    @property
    def substrate_speed(self) -> float:
        """Speed v₂ of the substrate's surface [m/s]: all of the sum where the ball does not turn."""
        return self.speed_sum * (2 + self.slide_to_roll) / 4


class Sliding(SteadyMotion):
    """Sliding at a constant speed, without rolling: the ball does not turn.  Either of ball and substrate may be at rest."""

    kind: ClassVar[str] = "sliding"
    speed: float = given("Sliding speed", SPEED, "0.1 mm/s", synonyms=("velocity", "sliding_speed", "sliding_velocity"))
    slide_to_roll: ClassVar[float] = FIXED_BALL  # type: ignore[misc]

    @property
    def speed_sum(self) -> float:
        """The sliding speed v [m/s]: one of the two surfaces is at rest, seen from the contact."""
        return self.speed


class Rolling(SteadyMotion):
    """Rolling with any sliding: both surfaces may move.

    The slide-to-roll ratio is S = (v₂ − v₁)/U with the entrainment speed U = (v₁ + v₂)/2.  S = 2: the ball does not turn,
    `Sliding` with v = 2U.  S = 0: pure rolling.  S = −2: the ball turns on a substrate that is at rest.
    """

    kind: ClassVar[str] = "rolling"
    entrainment_speed: float = given("Mean of the surface speeds instead", SPEED, "0.05 mm/s")
    slide_to_roll: float = given(
        "Speed of the substrate's surface less the ball's, over their mean; 0 is pure rolling",
        NUMBER,
        "0.5",
        default=FIXED_BALL,
        signed=True,
        absent="2, a ball that does not turn",
    )

    @property
    def speed_sum(self) -> float:
        """Twice the entrainment speed [m/s]."""
        return 2 * self.entrainment_speed
