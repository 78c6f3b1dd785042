"""What is pressed against the substrate.  A new shape is a class here."""

from __future__ import annotations

from typing import Any, ClassVar

from softlube.errors import InputError
from softlube.model.inputs import LENGTH, NUMBER, PRESSURE, given
from softlube.model.parts import Part


class Sphere(Part):
    """A ball, rigid or elastic.

    Among the inputs of an experiment its modulus and its ratio are `ball_young_modulus` and `ball_poisson_ratio`.
    """

    slot: ClassVar[str] = "indenter"
    kind: ClassVar[str] = "sphere"
    radius: float = given("Radius of the sphere", LENGTH, "2 mm")
    young_modulus: float | None = given(
        "Young's modulus of the sphere", PRESSURE, "210 GPa", default=None, absent="rigid", flat="ball_young_modulus"
    )
    poisson_ratio: float = given(
        "Poisson's ratio of the sphere, 0 to 0.5", NUMBER, "0.3", default=0.5, between=(0, 0.5), flat="ball_poisson_ratio"
    )

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values; a Poisson's ratio means nothing for a rigid sphere."""
        if values["young_modulus"] is None and values["poisson_ratio"] != type(self).inputs["poisson_ratio"].default:
            raise InputError(
                "ball_poisson_ratio, ball_young_modulus: the first means nothing without the second; give both or neither"
            )
        return values

    @property
    def compliance(self) -> float:
        """4(1 − ν²)/E [1/Pa], the inverse of the `contact_modulus` that a substrate of this material has; 0 if rigid."""
        return 0.0 if self.young_modulus is None else 4 * (1 - self.poisson_ratio**2) / self.young_modulus
