"""What the ladder of grids asks of a refinement."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.model.quantities import Quantity
from softlube.solvers.progress import Listener
from softlube.steady.error_estimate import Convergence
from softlube.steady.level import Solved
from softlube.steady.regime import Regime


@dataclass(frozen=True)
class Refinement:
    """A feature narrower than the grids of a contact, and what is done about it.  As it stands it is a feature that is absent.

    The ladder asks every refinement the questions below, on every grid, and knows none of them by name.  A subclass overrides
    the methods that concern its feature, and is entered in `softlube.steady.refinements.KINDS`.

    Parameters
    ----------
    regime : Regime
        The contact.

    Attributes
    ----------
    feature : str
        Words for the feature in messages.
    """

    regime: Regime
    feature: ClassVar[str] = "a narrow feature"

    def adjust(self, grid: PolarGrid, before: Solved | None) -> PolarGrid:
        """The grid with what the feature needs, for instance a refined zone.

        Parameters
        ----------
        grid : PolarGrid
            The grid without it; its rings are counted afterwards.
        before : Solved or None
            The solution on the next coarser grid.
        """
        return grid

    def determines(self, fields: Fields, values: Mapping[str, float]) -> Mapping[str, Convergence]:
        """Quantities that the feature determines, and how they converge; empty where the feature is absent or resolved.

        Such quantities do not decide when a grid is fine enough.  They are nan in the solution where their error is too large.

        Parameters
        ----------
        fields, values
            Solution on the finest grid, and its quantities.
        """
        return {}

    def is_settled(self, solved: Sequence[Solved], errors: Mapping[str, float]) -> bool:
        """Whether a result that is accurate enough otherwise needs no finer grid for the sake of the feature."""
        return True

    def amend(
        self, solved: Sequence[Solved], quantities: Mapping[str, Quantity], progress: Listener | None
    ) -> Mapping[str, Quantity]:
        """Quantities that are better known by other means than from the grids of the ladder.

        Parameters
        ----------
        solved : sequence of Solved
            Solutions on the grids, coarse to fine.
        quantities : mapping of str to Quantity
            What the grids give; nan for what they do not give.
        progress : callable or None
            Called with a `softlube.solvers.progress.Progress` after each solved mesh.
        """
        return {}

    def renormalise(
        self,
        own: Mapping[str, Quantity],
        on_grid: Mapping[str, float],
        fields: Fields,
        values: Mapping[str, float],
        unit: float,
        edge: float,
    ) -> Mapping[str, Quantity]:
        """The amended quantities normalised with another unit of height.

        Parameters
        ----------
        own : mapping of str to Quantity
            All quantities of the solution.
        on_grid : mapping of str to float
            What the finest grid gave for them.
        fields, values
            Solution on the finest grid and its quantities, in the other unit.
        unit : float
            The other unit of height over the solution's own.
        edge : float
            `Regime.edge_radius` in the other unit.
        """
        return {}

    def doubts(
        self, finest: Solved, quantities: Mapping[str, Quantity], errors: Mapping[str, float], accuracy: float
    ) -> tuple[str, ...]:
        """Warnings of the solution about quantities that the feature determines.

        Parameters
        ----------
        finest : Solved
            Solution on the finest grid.
        quantities : mapping of str to Quantity
            All quantities of the solution, amended; nan for those that are not given.
        errors : mapping of str to float
            Errors on the finest grid, also of quantities that are not given.
        accuracy : float
            Relative error that was asked for.
        """
        return ()

    @property
    def advice(self) -> str:
        """A sentence for the message that no solution was found; empty where the feature is not the reason."""
        return ""
