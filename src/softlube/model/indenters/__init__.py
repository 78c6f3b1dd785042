"""Indenters: surfaces of revolution of height f(r) over their lowest point, a module each.

Everything the solver sees is normalised: heights with the unit of height H, lengths in the plane with √(RH), where R is the
reduced radius of the contact, 1/R = 1/R₁ + 1/R₂ with the indenter's reference radius R₁.  So the paper's sphere, which is a
paraboloid, has f = r²/2.

A new shape is a module here: its shape (a `Shape`, what the solver calls), its part (an `IndenterPart`, that declares what is
given in SI), and a test beside it.  Every module of this folder is imported, so that the part is known to `softlube.Contact`,
the command line, plans of sweeps and files.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from softlube.model.indenters.base import Curved, IndenterPart, Shape
from softlube.model.named import to_plain
from softlube.model.parts import members

if TYPE_CHECKING:
    from softlube.model.indenters.cone import RoundedCone, RoundedConeShape
    from softlube.model.indenters.power import PowerProfile, PowerShape
    from softlube.model.indenters.profile import Profile, SplineShape
    from softlube.model.indenters.punch import RoundedPunch, RoundedPunchShape
    from softlube.model.indenters.sphere import Paraboloid, Sphere, SphereShape

__all__ = [
    "Curved",
    "IndenterPart",
    "Paraboloid",
    "PowerProfile",
    "PowerShape",
    "Profile",
    "RoundedCone",
    "RoundedConeShape",
    "RoundedPunch",
    "RoundedPunchShape",
    "Shape",
    "Sphere",
    "SphereShape",
    "SplineShape",
    "from_plain",
    "to_plain",
]

from_plain = Shape.from_plain
globals().update(members(__name__, __path__, (Shape, IndenterPart)))
