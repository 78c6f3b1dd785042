"""Inputs that belong to no part: how a contact is loaded, how a sphere is moved in time, what a rig measures.

Importing this module makes every part of the package known.  A new input of an experiment is a line here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from inspect import Parameter, Signature, signature
from typing import Any, TypeVar, get_args

from softlube.errors import InputError
from softlube.model import cylinders, indenters, liquids, motions, substrates
from softlube.model.inputs import FORCE, LENGTH, LINE_LOAD, SPEED, TIME, Declaring, Input, given
from softlube.model.inputs import declared as declared
from softlube.model.parts import vocabulary
from softlube.model.problem import Cavitation

Documented = TypeVar("Documented")

BODIES = (indenters.IndenterPart.slot, substrates.SubstratePart.slot, liquids.LiquidPart.slot, liquids.DensityPart.slot)
"""Slots of what there is, moving or not."""
SLIDING_BODIES = (*BODIES, motions.SteadyMotion.slot)
"""Slots of a contact that slides."""
SLIDING_LINE = (cylinders.Cylinder.slot, *SLIDING_BODIES[1:])
"""Slots of a line contact that slides."""


class Loading(Declaring):
    """How a sphere that slides steadily is held."""

    load = given("Normal load", FORCE, "100 mN", default=None, synonyms=("normal_load", "normal_force"))
    indentation = given(
        'Depth of the sphere\'s lowest point below the undeformed surface instead; "-1 um" is a gap',
        LENGTH,
        "50 um",
        default=None,
        signed=True,
        remark="or '-1 um' for a gap",
    )
    roughness = given("Roughness height; a film below it is warned of", LENGTH, "20 nm", default=None)
    cavitation = given("Cavitation: no negative pressure, or any", default="reynolds", choices=get_args(Cavitation))


class LineLoading(Declaring):
    """How a cylinder that slides steadily is loaded."""

    load_per_length = given("Normal load per length of the cylinder", LINE_LOAD, "5 N/mm")
    roughness = Loading.roughness
    cavitation = Loading.cavitation


class Approach(Declaring):
    """How a sphere is moved up and down in time."""

    load = given("Constant load", FORCE, "100 mN", default=None)
    approach_speed = given(
        "Constant speed of approach; negative for separation",
        SPEED,
        "10 um/s",
        default=None,
        signed=True,
        remark="or '-10 um/s' for separation",
    )
    history = given(
        'CSV file with columns headed "time, load" or "time, height"; units in brackets if not SI, as in "time [ms]"',
        default=None,
    )
    initial_height = given("Height of the lowest point over the undeformed surface at first", LENGTH, "100 um", default=None)
    duration = given("How long to follow", TIME, "10 s", default=None)
    film_limit = given("Minimum film at which to stop", LENGTH, "20 nm", default=None)


class StartOfSliding(Declaring):
    """What a sphere that starts to slide has besides its approach and its speed."""

    pressed = given(
        "How long the sphere is pressed, by the load of time 0, before it slides",
        TIME,
        "1 s",
        default=None,
        signed=True,
        absent="not at all",
    )
    cavitation = Loading.cavitation


class Measured(Declaring):
    """What a rig measures and sets."""

    friction = given("Friction force", FORCE, "5 mN", signed=True, synonyms=("friction_force",))
    entrainment_speed = motions.Rolling.entrainment_speed


def check_names(given: Iterable[str], slots: Sequence[str], *groups: type[Declaring]) -> None:
    """Refuse names that are no input.

    Raises
    ------
    InputError
        The message names the nearest inputs.
    """
    from difflib import get_close_matches

    known = [*slots, *names_of(slots, *groups)]
    for name in given:
        if name not in known:
            close = get_close_matches(name, known) or [each for each in known if each.startswith(name)] or known
            raise InputError(f"{name}: no input; expected {' or '.join(close)}")


def names_of(slots: Sequence[str], *groups: type[Declaring]) -> dict[str, Input]:
    """Inputs of the parts of some slots and of some groups, by their names."""
    return vocabulary(slots) | {name: each for group in groups for name, each in group.inputs.items()}


class Taking:
    """The signature of a class that takes parts and inputs by their names, as `inspect.signature` and editors show it."""

    def __init__(self, slots: Sequence[str], *groups: type[Declaring]) -> None:
        self._slots, self._groups = slots, groups

    def __get__(self, instance: object, owner: type) -> Signature:
        return Signature(_keywords(self._slots, self._groups))


def _keywords(slots: Sequence[str], groups: Sequence[type[Declaring]]) -> list[Parameter]:
    return [Parameter(name, Parameter.KEYWORD_ONLY, default=None) for name in [*slots, *names_of(slots, *groups)]]


def documented(slots: Sequence[str], *groups: type[Declaring]) -> Callable[[Documented], Documented]:
    """Write the inputs for {inputs} in a docstring and, for a function that takes them as ``**given``, into its signature."""

    def write(target: Any) -> Any:
        lines = []
        for name, each in names_of(slots, *groups).items():
            kind = "str" if each.is_text else "str, float or pint.Quantity" if each.unit else "float"
            lines += [f"{name} : {kind}, optional", f"    {each.help}"]
        target.__doc__ = (target.__doc__ or "").replace("{inputs}", "\n    ".join(lines))
        if not isinstance(target, type):
            own = [each for each in signature(target).parameters.values() if each.kind is not Parameter.VAR_KEYWORD]
            target.__signature__ = Signature([*own, *_keywords(slots, groups)])
        return target

    return write
