"""The front in which the constriction at the sides of a contact on a very thin layer ends (docs/how-to/layers.md)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

from softlube.discretization.fields import Fields
from softlube.model.quantities import Quantity
from softlube.steady.error_estimate import Convergence, looser, too_uncertain, unresolved
from softlube.steady.level import Solved
from softlube.steady.refinements.base import Refinement

DETERMINED = ("film_min", "shear_rate_max")
"""Quantities that the front determines."""
ERRATIC = Convergence(order=1)
"""The front lies anywhere between the nodes, so these quantities come nearer in jumps."""
OUTLET_DEGREES = 150.0
"""Angle from the inlet beyond which the film is thinnest on the outlet axis and not at the sides."""
DOUBT = (
    "the layer is so thin that its film at the sides is thinnest at a front a degree wide, which the grids hardly resolve: "
    "{}. Every other quantity is as accurate as asked"
)
ADVICE = "On so thin a layer a front at the sides is too sharp for these grids; other beta are solved (docs/how-to/layers.md)."


class Front(Refinement):
    """A front a degree wide at the sides of a contact on a very thin layer, which uniform finer grids resolve slowly."""

    feature: ClassVar[str] = "the front at the sides"

    def determines(self, fields: Fields, values: Mapping[str, float]) -> Mapping[str, Convergence]:
        """The extrema at the front, where the film is thinnest there."""
        at_the_sides = values["film_min_angle_deg"] < OUTLET_DEGREES
        return dict.fromkeys(DETERMINED, ERRATIC) if self.regime.front and at_the_sides else {}

    def is_settled(self, solved: Sequence[Solved], errors: Mapping[str, float]) -> bool:
        """Whether the extrema at the front can be given."""
        fields, values = solved[-1].fields, solved[-1].level.values
        return not too_uncertain(self.determines(fields, values), values, errors)

    def doubts(
        self, finest: Solved, quantities: Mapping[str, Quantity], errors: Mapping[str, float], accuracy: float
    ) -> tuple[str, ...]:
        """Extrema at the front that are not as accurate as asked."""
        values = finest.level.values
        of_front = {name: errors[name] for name in self.determines(finest.fields, values)}
        left = unresolved(values, of_front, accuracy, looser(self.regime))
        unknown = too_uncertain(of_front, values, errors)
        told = [f"{name} is {'not given' if name in unknown else f'known to {error:.1%}'}" for name, error in left.items()]
        return (DOUBT.format(", ".join(told)),) if told else ()

    @property
    def advice(self) -> str:
        """What to try where the front is possible."""
        return ADVICE if self.regime.front else ""
