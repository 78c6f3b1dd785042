"""What a feature of a contact changes in films and friction, where the contact without it is known without solving.

The other contact is read off the master curve: a paraboloid on a half-space under a liquid of constant viscosity.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, TypeAlias

import numpy as np

from softlube.errors import InputError
from softlube.model.dry import PARABOLOID
from softlube.model.liquids import LiquidPart
from softlube.model.liquids.newtonian import Newtonian, NewtonianLaw
from softlube.model.prefixes import shown
from softlube.model.quantities import Quantity
from softlube.model.substrates.half_space import HalfSpace
from softlube.model.substrates.layer import LayerKernel
from softlube.physical.materials import LARGEST_LAYER_EFFECT, dry_effect, effects_of, layer_doubt

Contact: TypeAlias = Any
"""A `softlube.physical.contact.Contact`: its module asks this one."""
WORDS = {"film_center": "film at the centre", "film_min": "minimum film", "friction_total": "friction"}
"""What is compared."""
THINS = "the liquid thins with shear; compared with a constant viscosity of {viscosity} that changes: {effects}"
"""What is said of a liquid that thins."""


def thickness_effect(contact: Contact, substrate: LayerKernel, dimensional: Mapping[str, Quantity]) -> list[str]:
    """What the finite thickness of the substrate changes.

    Parameters
    ----------
    contact : Contact
        On a layer.
    substrate : LayerKernel
        Normalised with the contact's unit of height.
    dimensional : mapping of str to Quantity
        Quantities of the contact in SI.
    """
    shape = contact.shape_for(contact.unit_height)
    dry, changes = dry_effect(substrate, by_load=contact.load is not None, indenter=shape)
    thick = HalfSpace(**{name: value for name, value in vars(contact.substrate).items() if name in HalfSpace.inputs})
    half_space = _with(contact, substrate=thick)
    problem = half_space.problem()
    if problem.liquid == NewtonianLaw() and problem.indenter == PARABOLOID:
        changes |= _changes(dimensional, half_space)
    return layer_doubt(dry, substrate, changes)


def thinning_effect(contact: Contact, dimensional: Mapping[str, Quantity]) -> list[str]:
    """What it changes that a liquid thins with shear, beside one of its viscosity at rest.

    Nothing is said where the other contact is not on the master curve, or nothing changes by more than 5 % and its error.

    Parameters
    ----------
    contact : Contact
        Under any liquid.
    dimensional : mapping of str to Quantity
        Its quantities in SI.
    """
    if not (contact.problem().liquid.thins and isinstance(contact.liquid, LiquidPart)):
        return []
    viscosity = contact.liquid.viscosity
    try:
        changes = _changes(dimensional, _with(contact, liquid=Newtonian(viscosity)))
    except InputError:  # no paraboloid on a half-space, or β beyond the curve
        return []
    if not any(abs(change) > max(LARGEST_LAYER_EFFECT, error) for change, error in changes.values()):
        return []
    return [THINS.format(viscosity=shown(viscosity, "Pa s"), effects=effects_of(changes))]


def _with(contact: Contact, **other: object) -> Contact:
    """The contact with another part."""
    return type(contact)(**{each.name: getattr(contact, each.name) for each in fields(contact)} | other)


def _changes(ours: Mapping[str, Quantity], contact: Contact) -> dict[str, tuple[float, float]]:
    """Relative changes beside a contact on the master curve, with their errors."""
    from softlube.theory import master_curve as curve

    theirs = contact.dimensional(curve.quantities(contact.problem()))
    return {
        text: (ours[name] / theirs[name] - 1, ours[name].error / abs(ours[name]) + theirs[name].error / abs(theirs[name]))
        for name, text in WORDS.items()
        if np.isfinite(ours[name])
    }
