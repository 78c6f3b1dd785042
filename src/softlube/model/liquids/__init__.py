"""Liquids: laws of the viscosity and of the density against the pressure, a module each.

Laws are normalised: η and ρ over their values η₀ and ρ₀ at zero pressure, pressures with 4πG√(unit of height/R) (E* in place
of 4G).  The Reynolds equation has the fluidity φ = η₀/η as a factor of u³∇p; with the reduced pressure q = ∫ φ dp (Grubin)
that is u³∇q, bounded however steeply the viscosity rises.  ρ is a factor of the whole flux.  Shear stresses have η/η₀ as a
factor of the Couette part.

A liquid that thins with shear has besides a fluidity ψ, over that at rest, that depends on the shear stress; see
`softlube.model.liquids.thinning`.

A new liquid is a module here: its law (a `Law`, what the solver calls), its part (a `LiquidPart`, or a `DensityPart`, that
declares what is given in SI), and a test beside it.  Every module of this folder is imported, so that the part is known to
`softlube.Contact`, the command line, plans of sweeps and files.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from softlube.model.liquids.base import DensityPart, Law, Liquid, LiquidPart, Lubricant, Thickening
from softlube.model.named import to_plain
from softlube.model.parts import members

if TYPE_CHECKING:
    from softlube.model.liquids.barus import Barus, BarusLaw
    from softlube.model.liquids.carreau_yasuda import Carreau, CarreauYasuda, CarreauYasudaLaw, Cross
    from softlube.model.liquids.dowson_higginson import DowsonHigginson, DowsonHigginsonLaw
    from softlube.model.liquids.eyring import Eyring, EyringLaw
    from softlube.model.liquids.incompressible import Incompressible
    from softlube.model.liquids.limiting_stress import LimitingStress, LimitingStressLaw
    from softlube.model.liquids.newtonian import Newtonian, NewtonianLaw
    from softlube.model.liquids.power_law import OstwaldLaw, PowerLaw
    from softlube.model.liquids.roelands import Roelands, RoelandsLaw

__all__ = [
    "Barus",
    "BarusLaw",
    "Carreau",
    "CarreauYasuda",
    "CarreauYasudaLaw",
    "Cross",
    "DensityPart",
    "DowsonHigginson",
    "DowsonHigginsonLaw",
    "Eyring",
    "EyringLaw",
    "Incompressible",
    "Law",
    "LimitingStress",
    "LimitingStressLaw",
    "Liquid",
    "LiquidPart",
    "Lubricant",
    "Newtonian",
    "NewtonianLaw",
    "OstwaldLaw",
    "PowerLaw",
    "Roelands",
    "RoelandsLaw",
    "Thickening",
    "from_plain",
    "to_plain",
]

from_plain = Law.from_plain
globals().update(members(__name__, __path__, (Law, Lubricant, DensityPart)))
