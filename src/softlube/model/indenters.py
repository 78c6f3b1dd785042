"""What is pressed against the substrate.  A new shape is a class here."""

from __future__ import annotations

from typing import ClassVar

from softlube.model.inputs import LENGTH, given
from softlube.model.parts import Part


class Sphere(Part):
    """A rigid sphere."""

    slot: ClassVar[str] = "indenter"
    kind: ClassVar[str] = "sphere"
    radius: float = given("Radius of the sphere", LENGTH, "2 mm")
