"""Any quantity of any contact as a function of β: solutions where they are needed, in parallel, kept; splines between them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from softlube.errors import InputError, NotConvergedError
from softlube.experiments.adaptive import Interpolant, Numbers, place
from softlube.experiments.nodes import Node, Nodes, at, solving
from softlube.model.problem import Problem
from softlube.model.quantities import STEADY
from softlube.solvers.notebook import watched
from softlube.solvers.progress import Listener, Progress
from softlube.steady.solve import check_accuracy

WIDEST = (1e-4, 1e8)
"""Range of β outside which nothing is solved for a curve."""


def clipped(low: float, high: float) -> tuple[float, float]:
    """A range of β within `WIDEST`.

    Raises
    ------
    InputError
        If it is no range.
    NotConvergedError
        If all of it lies beyond.
    """
    if not 0 < low <= high < math.inf:
        raise InputError(f"beta: expected a range of positive numbers, got {low!r} to {high!r}")
    if high <= WIDEST[0] or low >= WIDEST[1]:
        raise NotConvergedError(
            f"the curve from beta = {low:.3g} to {high:.3g} cannot be had: curves reach from {WIDEST[0]:g} to {WIDEST[1]:g}"
        )
    low, high = (min(max(end, WIDEST[0]), WIDEST[1]) for end in (low, high))
    return low, high


@dataclass
class Computing:
    """Curves that are computed one after the other by the same processes.

    Attributes
    ----------
    nodes : Nodes
        Where the solutions come from.
    accuracy : float
        Of the solutions, see `softlube.solve`, and of what is interpolated between them.  Where it cannot be reached, five
        times that is tried.
    progress : callable or None
        Called with a `softlube.solvers.progress.Progress` after each solution.
    done, asked : int
        Solutions so far, and those that were asked for.
    """

    nodes: Nodes
    accuracy: float
    progress: Listener | None
    done: int = 0
    asked: int = 0

    def curves(
        self,
        problem: Problem,
        low: float,
        high: float,
        names: Sequence[str],
        read: Callable[[Node], Numbers],
        rows: Sequence[float] = (),
    ) -> dict[str, Interpolant]:
        """What is read off the solutions of a problem, as functions of β.

        Parameters
        ----------
        problem : Problem
            Its β counts for nothing.
        low, high : float
            Range wanted; the curves cover as much of it as can be solved.
        names : sequence of str
            What the curves are of.
        read : callable
            Gives values and absolute errors of a solution by name, nan where it has none.
        rows : sequence of float
            See `softlube.experiments.adaptive.place`.

        Raises
        ------
        NotConvergedError
            If one of the curves has too few solutions.
        """
        reasons: list[str] = []

        def solve(betas: Sequence[float]) -> dict[float, Numbers | None]:
            self.asked += len(betas)
            problems = {beta: at(problem, beta) for beta in betas}
            found = self.nodes.get(problems.values(), self.accuracy, self._tell)
            reasons.extend(found[each].reason for each in problems.values())
            return {beta: None if found[each].reason else read(found[each]) for beta, each in problems.items()}

        curves = place(solve, low, high, names, self.accuracy, [row for row in rows if low <= row <= high])
        missing = [name for name in names if name not in curves]
        if missing:
            reason = next(filter(None, reversed(reasons)), f"{', '.join(missing)}: no grid resolves it")
            which = "beta_load" if problem.load_controlled else "beta"
            raise NotConvergedError(f"the curve from {which} = {low:.3g} to {high:.3g} cannot be had: {reason}")
        return curves

    def _tell(self) -> None:
        self.done += 1
        if self.progress is not None:
            self.progress(Progress("solving the curve", self.done, self.asked))


def available(problem: Problem) -> list[str]:
    """Names of the quantities that are functions of β: all but the one that is prescribed, and places, which jump."""
    prescribed = "load" if problem.load_controlled else "height"
    return [name for name, row in STEADY.items() if name != prescribed and not row.place]


@watched
def quantity_curves(
    problem: Problem,
    low: float,
    high: float,
    names: Sequence[str],
    *,
    accuracy: float = 1e-3,
    progress: Listener | None = None,
) -> Mapping[str, Interpolant]:
    """Quantities as functions of β.

    Parameters
    ----------
    problem : Problem
        Substrate, liquid, cavitation, and whether the load or the height is prescribed; its β counts for nothing.
    low, high : float
        Range of β, or of β_load where the load is prescribed; the curves cover as much of it as can be solved.
    names : sequence of str
        Of `available`.
    accuracy, progress
        See `Computing`.

    Returns
    -------
    mapping of str to Interpolant
        Functions of β that give the value and its absolute error.

    Raises
    ------
    InputError
        If a quantity is not available, or the range or the accuracy is none.
    NotConvergedError
        If too little of the range can be solved.
    """
    unknown = [name for name in names if name not in available(problem)]
    if unknown:
        raise InputError(f"quantity: {unknown[0]} is no function of beta here; one of {', '.join(available(problem))}")
    check_accuracy(accuracy)
    low, high = clipped(low, high)
    with solving() as nodes:
        return Computing(nodes, accuracy, progress).curves(problem, low, high, names, lambda node: node.quantities)
