"""The ladder of grids: ever finer grids, the errors that they tell, and the grid that is fine enough."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from softlube.discretization.fields import Fields
from softlube.discretization.measure import FRICTIONS, measure
from softlube.discretization.system import ContactSystem
from softlube.errors import NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.motions import FIXED_BALL
from softlube.model.problem import Problem
from softlube.model.quantities import Quantity, places_of
from softlube.solvers import budget
from softlube.solvers.progress import Listener, Progress
from softlube.steady.error_estimate import (
    COARSE_BETA,
    GRIDS,
    VALLEY,
    Convergence,
    convergence_of,
    estimate_errors,
    looser,
    scheme_order,
    too_uncertain,
    unresolved,
    valley_error,
)
from softlube.steady.level import STEEP_STEPS, Level, Solved, solve_level
from softlube.steady.mesh import angles_for, grid_for, has_face
from softlube.steady.refinements import Refinement, refinements_for
from softlube.steady.regime import Regime
from softlube.steady.solution import Solution

LADDER, LADDER_NARROW, LADDER_DEEP = (9, 17, 29, 39, 61, 91), (9, 17, 33, 43, 65, 95), (15, 23, 35, 49, 69, 95)
"""Angular intervals of the nested grids, coarse to fine; where the minimum at the sides is narrow, beyond `NARROW_BETA` and in
deep contacts under a flat face; and beyond `COARSE_BETA`, where the rings that go with fewer than 15 cannot hold the boundary
layers together.  On a layer a few more, see `softlube.steady.mesh.angles_for`.  All are odd, so that the sides, at 90°, lie
half-way between two nodes of every grid."""
NARROW_BETA = 7e5
"""β′ beyond which the film's minimum at the sides is so narrow that 29 angles tell errors above 10⁻³ for it, and 33 less."""
REFINED_ANGLES = 39
"""Angular intervals from which on a grid can be fine enough although a refinement determines some quantities on it."""
LARGEST_PASSED_OVER = 3000
"""Unknowns of a grid without a solution beyond which finer ones are not tried: each would take minutes to have none either."""
FAR_LOAD = (
    "{share:.2g} of the load is borne beyond the mesh because the viscosity rises there, where the liquid is hardly sheared; "
    "under a power law that depends on where the liquid ends, and {rest}"
)
"""What is said of a liquid that thins whose far field bears a load; the rest is about a prescribed height, or a load."""
REST = "the load within the contact does not", "so does all else under a prescribed load, by about that share"
LARGEST_ACCURACY = 0.1
"""Largest relative error that can be asked for."""


def ladder_of(regime: Regime) -> tuple[int, ...]:
    """Angular intervals of a contact's grids on a half-space, see `softlube.steady.mesh.angles_for`."""
    if regime.steep_like > COARSE_BETA:
        return LADDER_DEEP
    return LADDER_NARROW if regime.blunt_like > NARROW_BETA or (regime.deep and has_face(regime)) else LADDER


def climb(regime: Regime, progress: Listener | None = None) -> Iterator[Solved]:
    """Solve on ever finer grids, each starting from the one before.

    A grid may be too coarse to have a solution at all, where the film is thinnest in a short strip at a thin layer's sides; so
    the finer ones are tried, too.

    Raises
    ------
    NotConvergedError
        If a grid that should be fine enough has no solution.
    """
    before: Solved | None = None
    refinements = refinements_for(regime)
    ladder = ladder_of(regime)
    fewest = max(GRIDS, 1 + sum(each < REFINED_ANGLES for each in ladder)) if refinements else GRIDS
    for number, n_theta in enumerate(ladder, 1):
        adjustments = [partial(each.adjust, before=before) for each in refinements]
        grid = grid_for(regime, angles_for(regime, n_theta), adjustments)
        began = time.thread_time()
        try:
            solved = solve_level(regime, grid, before)
        except NotConvergedError as error:
            if grid.n_unknown > LARGEST_PASSED_OVER:
                advice = " ".join(each.advice for each in refinements if each.advice)
                advice = advice or "No accuracy changes these grids; report the input."
                raise NotConvergedError(f"{error} {advice}") from None
            if progress is not None:
                progress(Progress(f"{grid.n_r} x {grid.n_theta} cells are too few: no solution found on them", number))
            continue
        if progress is not None:
            progress(Progress(f"{grid.n_r} x {grid.n_theta} cells solved in {solved.level.seconds:.2f} s", number))
        yield solved
        if before is not None and len(solved.level.history) > STEEP_STEPS:
            # The coarser solution was no start.  It will be none for the next grids either, and they have more unknowns.
            seconds = time.thread_time() - began
            budget.check(ahead=seconds * sum((each / n_theta) ** 2 for each in ladder[number:fewest]))
        before = solved


@dataclass(frozen=True)
class Estimate:
    """What nested grids tell of the errors.

    Attributes
    ----------
    values, errors : mapping of str to float
        Quantities on the finest grid and their absolute errors.
    determined : mapping of str to Convergence
        Quantities that a refinement determines, see `softlube.steady.refinements.Refinement.determines`.
    """

    values: Mapping[str, float]
    errors: Mapping[str, float]
    determined: Mapping[str, Convergence]

    @classmethod
    def of(
        cls,
        regime: Regime,
        fields: Sequence[Fields],
        levels: Sequence[Mapping[str, float]],
        angles: Sequence[int],
        exact: str,
    ) -> Estimate:
        """Estimate the errors of the last of some levels.

        Parameters
        ----------
        regime : Regime
            The contact.
        fields : sequence of Fields
            Solutions on the grids, coarse to fine.
        levels : sequence of mapping
            Quantities on the grids, coarse to fine; at least `softlube.steady.error_estimate.GRIDS`.
        angles : sequence of int
            Angular intervals of the grids.
        exact : str
            The quantity that is prescribed.
        """
        determined: dict[str, Convergence] = {}
        for refinement in refinements_for(regime):
            determined |= refinement.determines(fields[-1], levels[-1])
        smooth, rates = scheme_order(regime), convergence_of(regime) | determined
        least = dict.fromkeys(VALLEY, valley_error(fields, levels[-1], angles, smooth))
        return cls(levels[-1], estimate_errors(levels, angles, exact, rates, smooth, least), determined)

    @classmethod
    def from_grids(cls, regime: Regime, solved: Sequence[Solved]) -> Estimate:
        """Estimate the errors of the finest of some solved grids."""
        exact = "load" if regime.problem.load_controlled else "height"
        levels = [each.level for each in solved]
        fields = [each.fields for each in solved]
        return cls.of(regime, fields, [each.values for each in levels], [each.n_theta for each in levels], exact)

    @property
    def withheld(self) -> tuple[str, ...]:
        """Names of the quantities that are too uncertain to be given, and of their places."""
        names = too_uncertain(self.determined, self.values, self.errors)
        return names + tuple(place for name in names for place in places_of(name))

    def unresolved(self, accuracy: float, regime: Regime) -> dict[str, float]:
        """Relative errors of the quantities that decide and are not accurate enough."""
        deciding = {name: error for name, error in self.errors.items() if name not in self.determined}
        values = dict(self.values)
        if regime.problem.slide_to_roll != FIXED_BALL:  # one of the frictions may vanish, not all of them
            values |= dict.fromkeys(FRICTIONS, max(abs(values[name]) for name in FRICTIONS))
        return unresolved(values, deciding, accuracy, looser(regime))

    def accuracy(self, regime: Regime) -> float:
        """The accuracy that is reached: the least that could have been asked for."""
        factors, errors = looser(regime), self.unresolved(0.0, regime)
        return max((np.nan_to_num(error, nan=np.inf) / factors.get(name, 1.0) for name, error in errors.items()), default=0.0)

    def quantities(self) -> dict[str, Quantity]:
        """Values with their errors; nan for those that are withheld."""
        withheld = self.withheld
        return {
            name: Quantity(np.nan) if name in withheld else Quantity(value, self.errors[name])
            for name, value in self.values.items()
        }


def solve_on_ladder(regime: Regime, accuracy: float, progress: Listener | None = None) -> Solution:
    """Climb the ladder until a grid is fine enough.

    A result is accepted only where every quantity that decides is as accurate as asked on a grid that can be judged.

    Raises
    ------
    NotConvergedError
        If no grid is fine enough; the message says which quantities are not accurate enough, and which accuracy was reached.
    OutOfTime
        If the budget is spent before; it knows which accuracy was reached.
    """
    solved: list[Solved] = []
    refinements = refinements_for(regime)
    enough, best, left = 0, math.inf, dict[str, float]()
    narrow: list[Refinement] = []
    try:
        for grid in climb(regime, progress):
            solved.append(grid)
            if len(solved) < GRIDS:
                continue
            estimate = Estimate.from_grids(regime, solved)
            if estimate.determined and grid.grid.n_theta < REFINED_ANGLES:
                narrow = [each for each in refinements if each.determines(grid.fields, grid.level.values)]
                continue
            reached = estimate.accuracy(regime)
            if reached <= accuracy:
                enough = len(solved)
                if all(each.is_settled(solved, estimate.errors) for each in refinements):
                    break
            elif not reached >= best:
                best, left = reached, estimate.unresolved(accuracy, regime)
    except NotConvergedError:
        if not (enough or left):
            raise
    except budget.OutOfTime as spent:
        spent.reached = best
        if not enough:
            raise
    if enough:
        return solution_of(regime, solved[:enough], accuracy, progress)
    if len(solved) < GRIDS:
        raise NotConvergedError("too few grids have a solution, and nothing tells its error; report the input.")
    if not left:
        features = " and ".join(each.feature for each in narrow) or "the contact"
        raise NotConvergedError(f"no grid is fine enough for {features}, and nothing tells the errors; report the input.")
    worst = ", ".join(f"{name} {value:.1e}" for name, value in sorted(left.items(), key=lambda item: -item[1])[:3])
    raise NotConvergedError(
        f"the finest grid does not reach the accuracy {accuracy:g} at {regime.problem.parameter:.4g}: {worst} (relative). "
        + (f"Try accuracy={rounded_up(best)}." if best <= LARGEST_ACCURACY else "No accuracy that can be asked for would do.")
    )


def rounded_up(value: float) -> str:
    """A positive number with two digits, rounded up."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.ceil(value / unit) * unit:.1e}"


def solution_of(regime: Regime, solved: Sequence[Solved], accuracy: float, progress: Listener | None = None) -> Solution:
    """The solution that some solved grids give.

    Parameters
    ----------
    regime : Regime
        The contact.
    solved : sequence of Solved
        Grids, coarse to fine; at least two.
    accuracy : float
        Relative error that was asked for.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each mesh that a refinement solves.
    """
    finest = solved[-1]
    fields, refinements = finest.fields, refinements_for(regime)
    estimate = Estimate.from_grids(regime, solved)
    quantities = estimate.quantities()
    for refinement in refinements:
        quantities |= refinement.amend(solved, quantities, progress)
    levels = tuple(each.level for each in solved)
    doubt = ContactSystem(regime.problem, finest.grid, regime.unit).load_in_doubt(finest.x)
    warnings = sum((each.doubts(finest, quantities, estimate.errors, accuracy) for each in refinements), ())
    if doubt > accuracy:
        warnings += (FAR_LOAD.format(share=doubt, rest=REST[regime.problem.load_controlled]),)
    if not regime.problem.load_controlled:
        quantities["load"] = Quantity(quantities["load"], max(quantities["load"].error, doubt * quantities["load"]))
    # Eq. (29): the load N̄ has the Hertz indentation δ = |h₀| (N̄/(4/3π))^(2/3), and β_load goes with δ².
    return Solution(
        problem=regime.problem,
        fields=fields,
        quantities=quantities,
        beta=fields.beta * fields.height**2,
        beta_load=fields.beta * max(fields.load / HERTZ_LOAD, 0.0) ** (4 / 3),
        accuracy=accuracy,
        levels=levels,
        renormalise=partial(renormalised, regime, levels, quantities),
        warnings=warnings,
    )


def renormalised(regime: Regime, levels: Sequence[Level], own: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Quantities normalised with |h₀| where the load is prescribed, with the load where |h₀| is; none for h₀ ≥ 0.

    Parameters
    ----------
    regime : Regime
        The contact.
    levels : sequence of Level
        The grids with their fields, coarse to fine.
    own : mapping of str to Quantity
        Quantities in the problem's own normalisation; a refinement's are taken from there.
    """
    problem = regime.problem
    fields = [level.fields for level in levels if level.fields is not None]
    if any(each.height >= 0 for each in fields):
        return {}
    # The other unit of height over the problem's own: |h₀|, or the Hertz indentation of the load.
    by_load = problem.load_controlled
    units = [-each.height if by_load else float((each.load / HERTZ_LOAD) ** (2 / 3)) for each in fields]
    other, unit = [each.in_units(unit) for each, unit in zip(fields, units, strict=True)], units[-1]
    models: dict[str, Any] = {"substrate": problem.substrate.in_units(unit), "indenter": problem.indenter.in_units(unit)}
    edge = Regime.of(Problem(beta=1.0 if by_load else None, beta_load=None if by_load else 1.0, **models)).edge_radius
    values = [measure(each, edge) for each in other]
    estimate = Estimate.of(
        regime, fields, values, [level.n_theta for level in levels[-len(values) :]], "height" if by_load else "load"
    )
    found = estimate.quantities()
    lacking = {*estimate.withheld, *(own.keys() - found.keys())}
    if lacking:
        for refinement in refinements_for(regime):
            known = refinement.renormalise(own, levels[-1].values, other[-1], values[-1], unit, edge)
            found |= {name: each for name, each in known.items() if name in lacking}
    return found
