"""The mesh that suits a contact's regime."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from softlube.discretization.grid import PolarGrid
from softlube.steady.regime import Regime

RADIAL_STEP = 5.2
"""Spacing of ξ times the number of angular intervals."""
RADIAL_STEP_LIGHT = 3.5
"""Radial step under a sphere that hardly touches the substrate or does not."""
LIGHT = 50.0
"""β below which a sphere hardly touches."""
RADIAL_STEP_STEEP, STEEP_LIGHT = 4.3, (3.0, 30.0)
"""Radial step on layers up to larger β, where the film is thinnest on the outlet axis, at the free boundary; and by how much
larger the β are for the light step and for this one, times the share of the dry pressure's rise at the edge that is theirs."""
RADIAL_STEP_SUCTION = 3.2
"""Radial step of contacts that are not `Regime.deep`, without the Reynolds condition: the suction behind the contact is
narrower than the boundary layer at its edge."""
STEEP_SHIFT, STEEP_CROWDING, STEEP_ANGLES, STEEP_STEP = 0.95, 3.0, 0.35, 1.2
"""What `Regime.steepness` adds to the mesh: by how much its zone at the edge moves outwards, over β^(−2/5); crowding at the
sides; angular intervals and, with its square, radial spacing, both as a fraction."""
DEEP_ANGLES = 31 / 26
"""Angular intervals on a layer over the half-space's at least, in a `Regime.deep` contact, for the error that the free
boundary leaves of the film at the sides (`softlube.steady.error_estimate`)."""
STIFFEST_EDGE = 4.6
"""Rise of the dry pressure at the edge over Hertz's beyond which rings are added in proportion, so that the rings within the
contact stay as narrow as the layer is thick."""
COARSEST = 0.43
"""Spacing of ξ that `STEEP_STEP` does not go beyond, lest the first grid be no start for the second."""


def angles_for(regime: Regime, n_theta: int) -> int:
    """Angular intervals that do for a contact what `n_theta` do on a half-space; always odd."""
    factor = 1 + STEEP_ANGLES * regime.steepness
    if regime.steepness > 0 and regime.deep:
        factor = max(factor, DEEP_ANGLES)
    return 2 * int(n_theta * factor / 2) + 1


def grid_for(regime: Regime, n_theta: int, adjustments: Iterable[Callable[[PolarGrid], PolarGrid]] = ()) -> PolarGrid:
    """Grid with the refinement that the regime calls for.

    The boundary layers at the contact edge are β^(−2/5) wide at the inlet and outlet and β^(−1/2) at the sides, where they
    take an angle of β^(−1/4).  The grading changes in steps of 2 (of √2 in angle), so that neighbouring β share a grid and its
    elastic operator.  On a layer the grading follows the steepness, too: with the refined zone at the film and its free
    boundary fewer rings are enough, and the mesh can have more angles.

    Parameters
    ----------
    regime : Regime
        The kind of contact.
    n_theta : int
        Angular intervals over 0 ≤ θ ≤ π.
    adjustments : iterable of callable
        Each changes the grid, for instance by a second refined zone, before the rings are counted; see
        `softlube.steady.refinements.Refinement.adjust`.
    """
    beta = 1.0 if regime.over_gap else max(regime.beta, 1.0)
    octave = np.round(np.log2(beta**-0.4) - 0.2)  # a little early: too fine costs less than too coarse
    steep, rise = regime.steepness, regime.dry.substrate_rise
    edge = 1 + float(min(STEEP_SHIFT * steep * 2.0**octave, 0.25))
    grid = PolarGrid(
        n_r=8,
        n_theta=n_theta,
        edge_width=0.5 if regime.over_gap else float(min(0.4 * 2.0**octave, 0.25 * min(1.0, 2 / regime.dry.exponent))),
        side_width=float(min((2.4 if regime.deep else 1.4) * 2.0 ** (octave * 0.625), 1.0)),
        side_clustering=(1.2 if regime.deep else 0.7) + STEEP_CROWDING * steep,
        reach=60.0 if regime.over_gap else 20.0,  # u = h₀ + r²/2 becomes r²/2 later under a gap
        edge=edge,
    )
    for adjust in adjustments:
        grid = adjust(grid)
    light, less_light = (LIGHT * (1 + factor * (1 - 1 / rise)) for factor in STEEP_LIGHT)
    step = RADIAL_STEP_LIGHT if beta < light else RADIAL_STEP_STEEP if beta < less_light else RADIAL_STEP
    if not regime.suction:
        step = max(step, min(step * (1 + STEEP_STEP * steep**2), COARSEST * n_theta))
    elif not (regime.over_gap or regime.deep):
        step = RADIAL_STEP_SUCTION
    if not regime.over_gap:
        step *= min(1.0, STIFFEST_EDGE / rise)
    return grid.resized(int(np.ceil(grid.xi_of(grid.reach * edge) * n_theta / step)), n_theta)
