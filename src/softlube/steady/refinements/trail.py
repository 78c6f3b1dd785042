"""The edge of a contact on a substrate that remembers: nearer to the axis at the outlet than at the inlet."""

from __future__ import annotations

from typing import ClassVar

from softlube.discretization.grid import PolarGrid
from softlube.steady.level import Solved, sketch
from softlube.steady.mesh import with_trail
from softlube.steady.refinements.base import Refinement


class Trail(Refinement):
    """The outlet where the substrate has not come back yet: the free boundary stands there, and the film is thinnest."""

    feature: ClassVar[str] = "the contact's edge at the outlet"

    def adjust(self, grid: PolarGrid, before: Solved | None) -> PolarGrid:
        """The grid with its zones where the sketch of the contact has its edge, the same on all grids."""
        problem = self.regime.problem
        if problem.substrate.memory is None or self.regime.over_gap:
            return grid
        return with_trail(grid, sketch(problem).fields, self.regime.unit)
