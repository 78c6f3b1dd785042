"""What makes a line contact: a long cylinder, such as a roller, a wiper's edge or a journal, pressed by a load per length."""

from __future__ import annotations

from typing import Any, ClassVar

from softlube.errors import InputError
from softlube.model.inputs import LENGTH, NUMBER, PRESSURE, given
from softlube.model.parts import Part


class Cylinder(Part):
    """A cylinder, rigid or elastic, much longer than the contact is wide.

    Among the inputs of an experiment its modulus and its ratio are `cylinder_young_modulus` and `cylinder_poisson_ratio`.
    """

    slot: ClassVar[str] = "cylinder"
    kind: ClassVar[str] = "cylinder"
    radius: float = given("Radius of the cylinder", LENGTH, "10 mm")
    young_modulus: float | None = given(
        "Young's modulus of the cylinder", PRESSURE, "210 GPa", default=None, absent="rigid", flat="cylinder_young_modulus"
    )
    poisson_ratio: float = given(
        "Poisson's ratio of the cylinder, 0 to 0.5",
        NUMBER,
        "0.3",
        default=0.5,
        between=(0, 0.5),
        flat="cylinder_poisson_ratio",
    )

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values; a Poisson's ratio means nothing for a rigid cylinder."""
        if values["young_modulus"] is None and values["poisson_ratio"] != type(self).inputs["poisson_ratio"].default:
            names = "cylinder_poisson_ratio, cylinder_young_modulus"
            raise InputError(f"{names}: the first means nothing without the second; give both or neither")
        return values

    @property
    def reference_radius(self) -> float:
        """The radius [m]."""
        return self.radius

    @property
    def compliance(self) -> float:
        """4(1 − ν²)/E [1/Pa], the inverse of the `contact_modulus` that a substrate of this material has; 0 if rigid."""
        return 0.0 if self.young_modulus is None else 4 * (1 - self.poisson_ratio**2) / self.young_modulus
