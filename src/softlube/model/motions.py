"""How the indenter moves along the substrate.  A new motion is a class here."""

from __future__ import annotations

from typing import ClassVar

from softlube.model.inputs import SPEED, given
from softlube.model.parts import Part


class Sliding(Part):
    """Sliding at a constant speed."""

    slot: ClassVar[str] = "motion"
    kind: ClassVar[str] = "sliding"
    speed: float = given("Sliding speed", SPEED, "0.1 mm/s", synonyms=("velocity", "sliding_speed", "sliding_velocity"))
