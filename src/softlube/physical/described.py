"""What a contact in SI says of itself: its inputs, as they can be given again."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Self

from softlube.errors import InputError
from softlube.model.motions import SteadyMotion
from softlube.model.parts import Part, resolve
from softlube.model.prefixes import shown
from softlube.model.summary import Summarised, Summary
from softlube.physical.inputs import declared
from softlube.physical.materials import Materials

if TYPE_CHECKING:
    import pandas


class Described(Materials, Summarised):
    """Bodies and a liquid that move steadily, described by the inputs that are given."""

    if TYPE_CHECKING:

        @property
        def motion(self) -> SteadyMotion: ...

    @property
    def given(self) -> dict[str, float | str]:
        """Its inputs in SI by their names, without those that are absent, have their default, or follow from the others."""
        known = declared()
        found = {
            name: value
            for name, value in self.inputs().items()
            if value is not None and value != known[name].default and not known[name].kept
        }
        for part in vars(self).values():
            if isinstance(part, Part) and part.selector in found:
                others = {name: value for name, value in found.items() if name != part.selector}
                try:
                    if resolve([part.slot], others)[part.slot] == part:
                        found = others
                except InputError:  # several kinds have these inputs
                    continue
        return found

    def __repr__(self) -> str:
        known = declared()
        texts = ", ".join(f"{name}={_written(value, known[name].unit)!r}" for name, value in self.given.items())
        return f"{type(self).__name__}({texts})"

    @property
    def headline(self) -> str:
        """What slides or rolls over what."""
        return f"Contact: {self.indenter.kind} on {self.substrate.kind}, {self.liquid.kind} liquid, {self.motion.kind}"

    def summary(self) -> Summary:
        """Every input that is given, with its SI unit and a prefix."""
        known = declared()
        rows = [(name, str(_written(value, known[name].unit)), known[name].title) for name, value in self.given.items()]
        return Summary(self.headline, ("input", "value", "words"), tuple(rows))

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each input that is given, by its name: value in SI, unit and words."""
        import pandas as pd

        known = declared()
        rows = [(value, known[name].unit, known[name].title) for name, value in self.given.items()]
        return pd.DataFrame(rows, index=pd.Index(list(self.given), name="input"), columns=["value", "unit", "words"])

    @property
    def speed_sum(self) -> float:
        """Sum of the surface speeds [m/s]: v in Reynolds' equation, the speed of a body that slides without turning."""
        return self.motion.speed_sum

    @property
    def substrate_speed(self) -> float:
        """Speed of the substrate's surface, seen from the contact [m/s]."""
        return self.motion.substrate_speed

    @property
    def slide_to_roll(self) -> float:
        """Difference of the surface speeds over their mean, see `softlube.Rolling`; 2 for sliding."""
        return self.motion.slide_to_roll

    @classmethod
    def from_inputs(cls, inputs: Mapping[str, Any]) -> Self:
        """Inverse of `inputs`; takes those of earlier versions, too, which name every input of parts that are not there.

        Raises
        ------
        InputError
            If there is an input that no part has.
        """
        return cls(**{name: value for name, value in inputs.items() if value is not None})


def _written(value: float | str, unit: str) -> float | str:
    """An input as it can be given again: text with a unit, a plain number, or a text."""
    return shown(value, unit) if unit and not isinstance(value, str) else value
