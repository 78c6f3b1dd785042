"""Contacts that differ in β alone, solved in parallel and kept: the nodes of curves over β.

A node is small and plain: every quantity with its error, and the friction within every radius.  It is kept in the cache folder
(`softlube.files.cache`) by the process that solves it, the moment it is solved, under a digest of the problem, of the accuracy
and of the code that computes it.  So whatever is killed, nothing that was solved is lost, and two processes that compute the
same curve find each other's nodes.
"""

from __future__ import annotations

import hashlib
import json
import warnings
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from typing import Any, TypeAlias

import numpy as np
from scipy.interpolate import CubicSpline

from softlube.discretization.measure import DOMAIN, friction_profile
from softlube.errors import SoftlubeError, ValidityWarning
from softlube.files.cache import Cache
from softlube.model.problem import Problem
from softlube.solvers.code_version import STEADY, code_version
from softlube.solvers.processes import Processes, cores
from softlube.steady.ladder import LARGEST_ACCURACY
from softlube.steady.regime import Regime
from softlube.steady.solution import Solution
from softlube.steady.solve import solve_problem

Number: TypeAlias = tuple[float, float]
"""A value and its absolute error."""

CODE = (*STEADY, "experiments/nodes.py")
"""Files that decide on a node."""
LOOSER = 5.0
"""Factor of the accuracy that is tried where the accuracy itself cannot be reached."""
ALONE = 3
"""Number of contacts up to which this process solves them itself: to start others takes longer."""


@dataclass(frozen=True)
class Node:
    """One solved contact, normalised like its problem.

    Attributes
    ----------
    quantities : mapping of str to (value, error)
        See `softlube.model.quantities.STEADY`.
    radii : tuple of float
        Radii over the dry contact's, from 0.
    couette, poiseuille : tuple of float
        Parts of the friction within the radii, see `softlube.discretization.measure.friction_parts`.
    spike : (float, float)
        Couette part that the contact's own grid misses in a pressure spike, and the spike's radius over the dry contact's.
    reason : str
        Why there is no solution; empty if there is one.
    """

    quantities: Mapping[str, Number]
    radii: tuple[float, ...] = ()
    couette: tuple[float, ...] = ()
    poiseuille: tuple[float, ...] = ()
    spike: Number = (0.0, 0.0)
    reason: str = ""

    @classmethod
    def of(cls, solution: Solution) -> Node:
        """The node that a solution makes."""
        fields, edge = solution.fields, Regime.of(solution.problem).edge_radius
        couette, poiseuille = friction_profile(fields)
        place = float(solution.quantities["spike_radius"]) if "spike_radius" in solution.quantities else 0.0
        return cls(
            {name: (float(each), each.error) for name, each in solution.quantities.items()},
            (0.0, *(fields.r / edge).tolist()),
            tuple(couette.tolist()),
            tuple(poiseuille.tolist()),
            (solution.friction_missed(float(fields.r[-1])), place / edge),
        )

    def friction(self, region: float) -> dict[str, Number]:
        """Friction over r ≤ `region` radii of the dry contact, whole and on the sphere alone, with errors.

        Both are for sliding without rolling: "total" is the Couette less the Poiseuille part, "sphere" their sum.  Over
        `DOMAIN` they are the quantities of the solution; over other discs their errors are relatively as large.  If the
        substrate remembers, the total has what the substrate makes, too, and is "viscous" without it.
        """
        known = {"total": self.quantities["friction_total"], "sphere": self.quantities["friction_domain"]}
        if "friction_viscous" in self.quantities:
            known["viscous"] = self.quantities["friction_viscous"]
        if region == DOMAIN:
            return known
        if region > self.radii[-1]:
            return dict.fromkeys(known, (np.nan, np.nan))
        spline = CubicSpline(self.radii, np.array([self.couette, self.poiseuille]).T)
        couette, poiseuille = (float(each) for each in spline(region))
        missed, place = self.spike
        couette += missed if region > place else 0.0
        by_substrate = self.quantities.get("friction_hysteresis", (0.0, 0.0))[0]
        found = {"total": couette - poiseuille + by_substrate, "sphere": couette + poiseuille}
        if "viscous" in known:
            found["viscous"] = couette - poiseuille
        return {name: (value, abs(value / known[name][0]) * known[name][1]) for name, value in found.items()}


def at(problem: Problem, beta: float) -> Problem:
    """A problem at another speed, with the β, or β_load where the load is prescribed, that goes with it.

    So fast passes what the substrate remembers, too: its lengths go like 1/β.
    """
    substrate = problem.substrate.hastened(problem.parameter / beta)
    if problem.load_controlled:
        return replace(problem, beta_load=beta, substrate=substrate)
    return replace(problem, beta=beta, substrate=substrate)


def content_key(problem: Problem, accuracy: float) -> str:
    """Digest of all that determines a node."""
    content = {"problem": problem.to_plain(), "accuracy": accuracy, "code": code_version(CODE)}
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def solve_and_keep(task: tuple[Problem, float]) -> Node:
    """Solve a problem to an accuracy, or to `LOOSER` times that, and keep what comes of it, a failure too."""
    problem, accuracy = task
    node, reason = None, ""
    for attempt in (accuracy, min(LOOSER * accuracy, LARGEST_ACCURACY)):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", ValidityWarning)  # an uncertain quantity has a large error, or none
                node = Node.of(solve_problem(problem, accuracy=attempt))
            break
        except SoftlubeError as error:
            reason = reason or str(error)
    node = node or Node({}, reason=reason)
    Cache().put(content_key(problem, accuracy), asdict(node))
    return node


def _kept(problem: Problem, accuracy: float) -> Node | None:
    found = Cache().get(content_key(problem, accuracy))
    return None if found is None else _from_plain(found)


def _from_plain(found: Mapping[str, Any]) -> Node:
    return Node(
        {name: (value, error) for name, (value, error) in found["quantities"].items()},
        *(tuple(found[name]) for name in ("radii", "couette", "poiseuille", "spike")),
        reason=found["reason"],
    )


class Nodes:
    """Nodes as they are asked for: kept ones at once, others from processes that stay for the next ones."""

    def __init__(self) -> None:
        self._processes: Processes | None = None

    def get(self, problems: Iterable[Problem], accuracy: float, solved: Callable[[], object]) -> dict[Problem, Node]:
        """The nodes of some problems, neighbours beside each other.

        Parameters
        ----------
        problems : iterable of Problem
            In the order in which neighbours share grids.
        accuracy : float
            See `softlube.solve`; where it cannot be reached, `LOOSER` times that is tried.
        solved : callable
            Called whenever there is one more.

        Raises
        ------
        softlube.solvers.processes.WorkerDied
            If a problem ends the process that solves it again and again.
        """
        found: dict[Problem, Node] = {}
        waiting = []
        for problem in problems:
            kept = _kept(problem, accuracy)
            if kept is None:
                waiting.append((problem, accuracy))
            else:
                found[problem] = kept
                solved()
        for (problem, _), node in self._solve(waiting):
            found[problem] = node
            solved()
        return found

    def _solve(self, tasks: list[tuple[Problem, float]]) -> Iterator[tuple[tuple[Problem, float], Node]]:
        if self._processes is None and (len(tasks) <= ALONE or cores() == 1):
            for task in tasks:
                yield task, solve_and_keep(task)
            return
        self._processes = self._processes or Processes()
        yield from self._processes.along(solve_and_keep, tasks)

    def close(self) -> None:
        """End the processes; keep the cache within its bounds."""
        if self._processes is not None:
            self._processes.close()
            Cache().trim()


@contextmanager
def solving() -> Generator[Nodes]:
    """`Nodes` whose processes end with the block."""
    nodes = Nodes()
    try:
        yield nodes
    finally:
        nodes.close()
