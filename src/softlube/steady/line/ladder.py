"""Nested meshes of a line contact, and the errors that they tell by the rule of `softlube.steady.error_estimate`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from softlube.discretization.line.measure import LineFields, measure
from softlube.errors import NotConvergedError
from softlube.model.problem import Problem
from softlube.model.quantities import LINE, Quantity
from softlube.solvers.progress import Listener, Progress
from softlube.steady.error_estimate import error_of
from softlube.steady.line.march import RESOLVED, Stage, march, resolved, solve_on, transferred

LADDER = (8, 11, 14)
"""Points on each panel of the nested meshes."""
REFINEMENT, ROUNDS = 30.0, 4
"""What is asked of the panels when the errors are too large: this factor more, so many times at most."""
ROUND_OFF = 1e-8
"""Least relative error that is claimed, some times what round-off and the end of Newton's method leave."""


def errors_of(levels: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """Absolute errors of the quantities on the last of the nested meshes."""
    values = levels[-1]
    least = {name: ROUND_OFF * LINE[name].size(values) for name in values}
    told = {name: max(error_of([level[name] for level in levels], LADDER), least[name]) for name in values}
    return told | {"load": 0.0}


def solve_on_ladder(problem: Problem, accuracy: float, progress: Listener | None = None) -> tuple[Stage, dict[str, Quantity]]:
    """Solve on three nested meshes whose errors are small enough.

    Raises
    ------
    NotConvergedError
        If there is no solution, or its errors stay too large.
    """
    stage: Stage | None = None
    for number, stage in enumerate(march(problem), 1):
        if progress is not None:
            progress(Progress(f"beta {stage.problem.parameter:.3g} solved on {stage.panels.number} panels", number))
    tolerance, left = RESOLVED, dict[str, float]()
    for _ in range(ROUNDS):
        stage = resolved(stage, tolerance)
        if stage is None:
            break
        nested = []
        finer: Stage | None = stage
        for points in LADDER:
            mesh = stage.panels.with_points(points)
            finer = solve_on(problem, mesh, transferred(finer or stage, mesh))
            if finer is None:
                break
            nested.append(finer)
        if finer is None:
            break
        levels = [measure(LineFields(each.equations, each.state)) for each in nested]
        errors = errors_of(levels)
        left = {
            name: error / LINE[name].size(levels[-1])
            for name, error in errors.items()
            if error > accuracy * LINE[name].size(levels[-1]) and not LINE[name].place
        }
        if not left:
            return finer, {name: Quantity(value, errors[name]) for name, value in levels[-1].items()}
        tolerance /= REFINEMENT
    if not left:
        raise NotConvergedError(f"beta_load = {problem.parameter:.4g}: the line contact was not found on a mesh fine enough.")
    worst = ", ".join(f"{name} {value:.1e}" for name, value in sorted(left.items(), key=lambda item: -item[1])[:3])
    raise NotConvergedError(
        f"beta_load = {problem.parameter:.4g}: the meshes do not reach the accuracy {accuracy:g}: {worst} (relative). "
        f"Try accuracy={2 * max(left.values()):.1g}."
    )
