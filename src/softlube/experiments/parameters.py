"""What can be fitted to measured friction: names, units, and where a search starts."""

from __future__ import annotations

from softlube.model.inputs import declared
from softlube.model.liquids import Lubricant
from softlube.model.parts import vocabulary
from softlube.physical.inputs import BODIES, names_of

OFFSET = "friction_offset"
SHORT = {"modulus": "young_modulus", "offset": OFFSET}
MODULI = ("young_modulus", "shear_modulus")
PRINCIPAL = ("viscosity", "consistency", *MODULI)
"""Parameters that are told with the result where they are held."""
TYPICAL = {"young_modulus": 1e6}
"""What to start from where nothing is given, in SI."""


def parameters() -> tuple[str, ...]:
    """Names of what can be fitted: every positive quantity with a unit that a body has, any of a liquid, and the offset."""
    of_liquid = vocabulary([Lubricant.slot])
    others = [
        name
        for name, each in names_of(BODIES).items()
        if (each.unit or name in of_liquid) and not (each.is_text or each.signed)
    ]
    return tuple(dict.fromkeys(("viscosity", "young_modulus", OFFSET, *others)))


def unit_of(name: str) -> str:
    """SI unit of a parameter."""
    return "N" if name == OFFSET else declared()[name].unit
