"""Liquids: laws of the viscosity and of the density against the pressure, a module each.

Laws are normalised: η and ρ over their values η₀ and ρ₀ at zero pressure, pressures with 4πG√(unit of height/R) (E* in place
of 4G).  The Reynolds equation has the fluidity φ = η₀/η as a factor of u³∇p; with the reduced pressure q = ∫ φ dp (Grubin)
that is u³∇q, bounded however steeply the viscosity rises.  ρ is a factor of the whole flux.  Shear stresses have η/η₀ as a
factor of the Couette part.
"""

from softlube.model.liquids.barus import BarusLaw
from softlube.model.liquids.base import Law, Liquid, from_plain, to_plain
from softlube.model.liquids.dowson_higginson import DowsonHigginsonLaw
from softlube.model.liquids.newtonian import NewtonianLaw
from softlube.model.liquids.roelands import RoelandsLaw

__all__ = ["BarusLaw", "DowsonHigginsonLaw", "Law", "Liquid", "NewtonianLaw", "RoelandsLaw", "from_plain", "to_plain"]
