"""The Petrusevich spike as a refinement of the ladder: a second refined zone at its place, and meshes of its own."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import ClassVar

from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.discretization.measure import FRICTIONS
from softlube.model.quantities import QUANTITIES, Quantity
from softlube.solvers.progress import Listener
from softlube.steady.error_estimate import Convergence
from softlube.steady.level import Solved
from softlube.steady.refinements.base import Refinement
from softlube.steady.refinements.spike.crest import at_least, layer_beside_spike, spike_quantities
from softlube.steady.refinements.spike.detection import (
    SPIKE_QUANTITIES,
    doubts,
    fall_from_top,
    is_compressible,
    is_needle,
    outlet_crest,
    outlet_spike,
    ridge_error,
)
from softlube.steady.regime import Regime

OF_THE_LIQUID = (*FRICTIONS, "friction_viscous")
"""Frictions that the viscosity in a pressure spike determines; the last is there on substrates that remember."""
DETERMINED = ("pressure_max", "boundary_layer", *OF_THE_LIQUID)
"""Quantities that the tip of a pressure spike determines, or the viscosity in it."""
FIRST_ANGLES = 18
"""Angular intervals of the coarsest grid that sees where the spike will stand."""
CREST_WIDTH, CREST_WIDTH_COMPRESSIBLE = 0.05, 0.01
"""Width of the refined zone at a crest, over the contact radius: in a compressible liquid the spike has a height to resolve."""
CREST_STEP = 0.4
"""Crests of meshes are multiples of this times that width, so that neighbouring problems share a grid and its operators."""
LIKE_SPACING = Convergence(order=1)
"""What a spike determines converges like the spacing only."""


class Spike(Refinement):
    """The crest of the pressure ahead of the outlet, under a liquid that thickens with the pressure."""

    feature: ClassVar[str] = "the pressure spike"

    def adjust(self, grid: PolarGrid, before: Solved | None) -> PolarGrid:
        """A second refined zone at the crest that the coarser grid shows."""
        if before is None or before.grid.n_theta < FIRST_ANGLES:
            return grid
        crest = crest_of(self.regime, before.fields, before.grid.crest * before.grid.edge)
        if not crest:
            return grid
        return replace(grid, crest=crest / grid.edge, crest_width=crest_width(self.regime) / grid.edge)

    def determines(self, fields: Fields, values: Mapping[str, float]) -> Mapping[str, Convergence]:
        """What a spike determines that is not smooth on the grid; nothing is known where it is a needle."""
        if not fields.is_sharp:
            return {}
        determined = [name for name in DETERMINED if name in values]
        if is_needle(fields):
            return dict.fromkeys(determined, replace(LIKE_SPACING, least=math.inf))
        ridge = replace(LIKE_SPACING, least=ridge_error(fall_from_top(fields)))
        return dict.fromkeys(determined, LIKE_SPACING) | {"pressure_max": ridge}

    def is_settled(self, solved: Sequence[Solved], errors: Mapping[str, float]) -> bool:
        """Whether a spike on the outlet axis was there on the coarser grid, too: its height has an error from two grids on."""
        before, finest = solved[-2:]
        # Without the mesh's zone a crest is no spike: the border of a flat face has one under any liquid.
        return not finest.grid.crest or outlet_spike(finest.fields) is None or outlet_spike(before.fields) is not None

    def amend(
        self, solved: Sequence[Solved], quantities: Mapping[str, Quantity], progress: Listener | None
    ) -> Mapping[str, Quantity]:
        """Height and place of the spike, and what it determines, from the grids or from meshes about it."""
        if not solved[-1].grid.crest:
            return {}
        return spike_quantities(self.regime, [each.fields for each in solved], quantities, progress)

    def renormalise(
        self,
        own: Mapping[str, Quantity],
        on_grid: Mapping[str, float],
        fields: Fields,
        values: Mapping[str, float],
        unit: float,
        edge: float,
    ) -> Mapping[str, Quantity]:
        """What meshes about the spike gave, in the other unit."""
        result = {name: QUANTITIES[name].unit.rescaled(own[name], unit) for name in SPIKE_QUANTITIES if name in own}
        result["pressure_max"] = at_least(values["pressure_center"], result["pressure_max"])
        for name in values.keys() & {*OF_THE_LIQUID}:
            # The disc is another one, but both hold the spike, and so the part that the grid has missed.
            missed = QUANTITIES[name].unit.rescaled(Quantity(own[name] - on_grid[name], own[name].error), unit)
            result[name] = Quantity(values[name] + missed, missed.error)
        result["boundary_layer"] = layer_beside_spike(fields, result["pressure_max"], edge)
        return result

    def doubts(
        self, finest: Solved, quantities: Mapping[str, Quantity], errors: Mapping[str, float], accuracy: float
    ) -> tuple[str, ...]:
        """What is not known of a spike, and why."""
        return doubts(finest.fields, quantities)


def crest_width(regime: Regime) -> float:
    """Width of the refined zone at a crest, over the mesh's unit of length."""
    return CREST_WIDTH_COMPRESSIBLE if is_compressible(regime.problem.liquid) else CREST_WIDTH


def crest_of(regime: Regime, fields: Fields, before: float = 0.0) -> float:
    """Radius of the pressure's crest on the outlet axis, over the mesh's unit of length, where it may be a spike; else 0.

    The crest of the mesh stays where it was `before`, if the pressure's is within the refined zone: a needle does not like to
    be moved.
    """
    if not regime.thick or regime.over_gap:
        return 0.0
    here, width = outlet_crest(fields) / math.sqrt(regime.unit), crest_width(regime)
    step = CREST_STEP * width
    return step * round((before if abs(here - before) < width else here) / step)
