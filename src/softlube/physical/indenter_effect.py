"""What the shape of an indenter does to a contact: of a sphere its true shape, of a measured profile its smoothing.

Dry contacts are compared exactly, film and friction by the laws of the Hertz limit (`softlube.theory.profiles`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from softlube.model.indenters import Profile, Shape, Sphere, SphereShape
from softlube.model.prefixes import shown
from softlube.physical.materials import effects_of
from softlube.steady.regime import Regime

if TYPE_CHECKING:
    from softlube.model.dry import DryContact
    from softlube.physical.contact import Contact
    from softlube.physical.materials import Materials
    from softlube.physical.squeeze import Setup
    from softlube.transient.motion import Motion

WIDE_FOR_A_PARABOLA = 0.1
"""Contact radius over the sphere's beyond which it is said what the true shape changes: the film by half a percent there."""
LIMIT = 300.0
"""β′ from which on the laws of the Hertz limit tell a difference."""
LAW_ERROR = 1.2
"""Error of a difference by these laws, over the difference and β′^(−1/5), the order of what they leave out.

Differences of solved contacts lie within it (docs/theory/indenters.md)."""


WOULD_CHANGE = (
    "the contact's radius is {share:.2g} R, and the sphere is taken for its paraboloid; its true shape (true_shape) would "
    "change: {effects}"
)


@dataclass(frozen=True)
class Note:
    """A sentence on the indenter, without a full stop.

    Attributes
    ----------
    text : str
        The sentence.
    changes : mapping of str to pair of float
        By what share another shape would change the contact, and the errors of that.
    """

    text: str
    changes: Mapping[str, tuple[float, float]] = field(default_factory=dict)

    def sentence(self) -> str:
        """With a capital and a full stop."""
        return f"{self.text[0].upper()}{self.text[1:]}."

    def plain(self) -> dict[str, Any]:
        """For JSON."""
        changes = {name: {"value": value, "error": error} for name, (value, error) in self.changes.items()}
        return {"text": self.text, "relative_changes": changes}


def notes(contact: Contact) -> list[Note]:
    """What is to be said of a contact's indenter; nothing of a sphere's narrow contact."""
    indenter, said = contact.indenter, list[Note]()
    radius = contact.dry_radius
    if not isinstance(indenter, Sphere):
        said.append(
            Note(
                f"lengths are normalised with the reference radius of the indenter, {_short(indenter.reference_radius)}, "
                "as with the radius of a sphere"
            )
        )
    elif (true := _true_shape(contact, contact.unit_height, radius)) is not None:
        changes = effect(contact, true)
        said.append(Note(WOULD_CHANGE.format(share=radius / indenter.radius, effects=effects_of(changes)), changes))
    if isinstance(indenter, Profile) and radius:
        chosen, coarser = indenter.smoothed
        if chosen.scatter:
            said.append(
                Note(
                    "the profile is a map's mean over the angle, from which its heights differ by "
                    f"{_short(chosen.scatter)} (root mean square)"
                )
            )
        if coarser != chosen:
            reference = indenter.reference_radius
            other = coarser.shape(contact.unit_height / reference, contact.reduced_radius / reference, reference)
            changes = effect(contact, other)
            text = (
                f"the profile is smoothed to {_short(chosen.deviation)} (root mean square); with the next coarser smoothing, "
                f"to {_short(coarser.deviation)}, would change: {effects_of(changes)}"
            )
            said.append(Note(text, changes))
    return said


def notes_in_time(setup: Setup, motion: Motion) -> list[Note]:
    """What is to be said of the indenter of a squeeze film: how the true sphere's deepest dry contact differs."""
    here = motion.deepest
    if here is None or not isinstance(setup.indenter, Sphere):
        return []
    radius = here.radius * setup.units["length"][0]
    true = _true_shape(setup, setup.unit_height, radius)
    if true is None:
        return []
    there = replace(motion, indenter=true).deepest
    assert there is not None
    changes = _dry_changes(here, there, by_load=motion.control == "load")
    return [Note(WOULD_CHANGE.format(share=radius / setup.indenter.radius, effects=effects_of(changes)), changes)]


def _true_shape(materials: Materials, unit_height: float, radius: float) -> SphereShape | None:
    """The true shape of a sphere that is taken for its paraboloid, if the contact's radius [m] is so large that it matters."""
    ball = materials.indenter
    if not isinstance(ball, Sphere) or ball.true_shape or not radius > WIDE_FOR_A_PARABOLA * ball.radius:
        return None
    return SphereShape(unit_height / ball.radius, materials.reduced_radius / ball.radius)


def _dry_changes(here: DryContact, there: DryContact, *, by_load: bool) -> dict[str, tuple[float, float]]:
    """By what share one dry contact differs from another one, exactly."""
    changes = {"contact radius": (there.radius / here.radius - 1, 0.0)}
    if by_load:
        return changes | {"indentation of a dry contact": (there.indentation / here.indentation - 1, 0.0)}
    return changes | {"load of a dry contact": (there.load / here.load - 1, 0.0)}


def effect(contact: Contact, other: Shape) -> dict[str, tuple[float, float]]:
    """By what share another indenter would change a contact.

    Parameters
    ----------
    contact : Contact
        With an indentation or a load.
    other : Shape
        The other indenter's, in the units of the contact's problem.

    Returns
    -------
    dict of str to pair of float
        Relative changes and their errors: of the dry contact, which are exact, and from β′ = 300 on of film and friction.
    """
    from softlube.theory import profiles

    problem = contact.problem()
    here, there = Regime.of(problem).dry, Regime.of(replace(problem, indenter=other)).dry
    changes = _dry_changes(here, there, by_load=problem.load_controlled)
    beta = here.like_hertz(problem.parameter)
    if beta < LIMIT:
        return changes
    ratios: Mapping[str, float] = {
        "film at the centre": float(profiles.film_center(there, 1.0, 1) / profiles.film_center(here, 1.0, 1)),
        "minimum film": float(profiles.film_min(there, 1.0) / profiles.film_min(here, 1.0)),
        "friction over the contact": float(profiles.friction_contact(there, 1.0) / profiles.friction_contact(here, 1.0)),
    }
    return changes | {name: (ratio - 1, LAW_ERROR * beta**-0.2 * abs(ratio - 1)) for name, ratio in ratios.items()}


def _short(length: float) -> str:
    """A length [m] with a prefix and four digits."""
    return str(shown(float(f"{length:.4g}"), "m"))
