"""Features that are narrower than the grids of a contact: each refinement finds one and takes care of its quantities.

Depends on: the other modules of `softlube.steady` but the ladder.  A new refinement is a module or a package here, and an entry
of `KINDS`.
"""

from softlube.steady.refinements.base import Refinement
from softlube.steady.refinements.front import Front
from softlube.steady.refinements.spike.refinement import Spike
from softlube.steady.refinements.trail import Trail
from softlube.steady.regime import Regime

KINDS = (Trail, Spike, Front)
"""All refinements."""


def refinements_for(regime: Regime) -> tuple[Refinement, ...]:
    """The refinements of a contact."""
    return tuple(kind(regime) for kind in KINDS)
