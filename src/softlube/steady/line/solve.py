"""solve(): the way to a solution of the dimensionless line contact."""

from __future__ import annotations

import math

from softlube.discretization.line.measure import LineFields
from softlube.errors import InputError, NotConvergedError
from softlube.model.liquids import Liquid, NewtonianLaw
from softlube.model.motions import FIXED_BALL
from softlube.model.problem import Problem
from softlube.model.substrates import HalfSpaceKernel, Substrate
from softlube.solvers import budget as time_budget
from softlube.solvers.budget import DEFAULT_BUDGET
from softlube.solvers.progress import Listener
from softlube.solvers.threads import one_thread
from softlube.steady.line.ladder import solve_on_ladder
from softlube.steady.line.solution import LineSolution

DEFAULT_ACCURACY, FINEST_ACCURACY, LARGEST_ACCURACY = 1e-5, 1e-7, 0.1
"""Relative errors that are asked for where nothing is said, and at least and at most."""
SMALLEST_BETA, LARGEST_BETA = 1e-6, 1e10
"""β for which the meshes are known to do; beyond them a rigid cylinder, and a Hertz contact."""

THINNEST = 0.02
"""Depth of a substrate's remainder over b, a layer's: twice its thickness, that the meshes resolve."""


def solve(
    beta_load: float,
    *,
    cavitation: str = "reynolds",
    substrate: Substrate | None = None,
    liquid: Liquid | None = None,
    slide_to_roll: float = FIXED_BALL,
    accuracy: float = DEFAULT_ACCURACY,
    budget: float = DEFAULT_BUDGET,
    progress: Listener | None = None,
) -> LineSolution:
    """Solve one dimensionless line contact.

    Parameters
    ----------
    beta_load : float
        β = (2/3)(H²/R) πG/(ηv), Eq. (6d), with the height H = b²/R that half the width b of the dry contact makes,
        b² = 4N′R/(πE*) for a load N′ per length.
    cavitation : {"reynolds", "none"}
        Reynolds condition, or negative pressures allowed.
    substrate : Substrate, optional
        Of `softlube.substrates`; the half-space if none.
    liquid : Liquid, optional
        Of `softlube.model.liquids`; constant viscosity if none.
    slide_to_roll : float
        Difference of the surface speeds over their mean: films of liquids that thin with shear depend on it.  Quantities of
        other liquids are those of a cylinder that does not turn, 2.
    accuracy : float
        Relative error aimed at.  Meshes follow from it.
    budget : float
        Seconds of processor time after which the solver gives up.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each step of the continuation, for instance ``print``.

    Returns
    -------
    LineSolution

    Raises
    ------
    InputError
        If an input is not as described (a ValueError).
    NotConvergedError
        If there is no solution of the accuracy, or the budget is spent.

    Examples
    --------
    >>> from softlube import line
    >>> solution = line.solve(1e4)
    >>> round(solution.film_center, 7), solution.film_center.error < 1e-8
    (0.0054157, True)
    """
    problem = Problem(
        beta_load=beta_load,
        cavitation=cavitation,  # type: ignore[arg-type]
        substrate=substrate or HalfSpaceKernel(),
        liquid=liquid or NewtonianLaw(),
        slide_to_roll=slide_to_roll,
    )
    return solve_problem(problem, accuracy=accuracy, budget=budget, progress=progress)


@one_thread
def solve_problem(
    problem: Problem,
    *,
    accuracy: float = DEFAULT_ACCURACY,
    budget: float = DEFAULT_BUDGET,
    progress: Listener | None = None,
) -> LineSolution:
    """Solve a line contact given as a `Problem` with a prescribed load; see `solve`."""
    if not (math.isfinite(accuracy) and FINEST_ACCURACY <= accuracy <= LARGEST_ACCURACY):
        bounds = f"{FINEST_ACCURACY:g} and {LARGEST_ACCURACY:g}"
        raise InputError(f"accuracy: expected a relative error between {bounds}, got {accuracy!r}")
    if isinstance(budget, (bool, str)) or not budget > 0:
        raise InputError(f"budget: expected a number of seconds above 0, got {budget!r}")
    if not problem.load_controlled:
        raise InputError("beta: a half-plane yields without end under a line load, so no depth can be given; give beta_load")
    if not SMALLEST_BETA <= problem.parameter <= LARGEST_BETA:
        raise NotConvergedError(
            f"beta_load = {problem.parameter:.4g} is outside the range that is resolved, {SMALLEST_BETA:g} to "
            f"{LARGEST_BETA:g}: a rigid cylinder below, a Hertz contact above."
        )
    remainder = problem.substrate.remainder
    if remainder is not None and remainder.smooth_over < THINNEST:
        raise NotConvergedError(
            f"the layer is {THINNEST / remainder.smooth_over:.2g} times thinner, beside the half-space's contact, than what "
            "the meshes resolve; check its thickness"
        )
    try:
        with time_budget.within(budget):
            stage, quantities = solve_on_ladder(problem, accuracy, progress)
    except time_budget.OutOfTime:
        raise NotConvergedError(
            f"beta_load = {problem.parameter:.4g}: no solution within {budget:g} s of processor time. "
            f"Try budget={3 * budget:g}."
        ) from None
    return LineSolution(problem, LineFields(stage.equations, stage.state), quantities, accuracy)
