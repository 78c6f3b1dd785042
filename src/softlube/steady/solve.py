"""solve(): the public way to a solution of the dimensionless contact."""

from __future__ import annotations

import numpy as np

from softlube.errors import InputError, NotConvergedError, warn
from softlube.model.indenters import Paraboloid, Shape
from softlube.model.liquids import Liquid, NewtonianLaw
from softlube.model.motions import FIXED_BALL
from softlube.model.problem import Problem
from softlube.model.substrates import HalfSpaceKernel, Substrate
from softlube.solvers import budget as time_budget
from softlube.solvers.budget import DEFAULT_BUDGET
from softlube.solvers.notebook import watched
from softlube.solvers.progress import Listener
from softlube.solvers.threads import one_thread
from softlube.steady.ladder import LARGEST_ACCURACY, rounded_up, solve_on_ladder
from softlube.steady.regime import Regime
from softlube.steady.solution import Solution

DEFAULT_ACCURACY = 1e-3
FINEST_ACCURACY = 1e-4
"""What the finest grids of the ladder reach."""
LARGEST_BETA = 1e9
SMALLEST_BETA = 1e-6
MORE_TIME = 3.0
"""Factor of the time that is advised where it did not do."""
THINNEST = 2e-3
"""Depth of a substrate's remainder over the mesh's unit of length (a layer's: twice its thickness) that the grids resolve."""
THICKEST = 55.0
"""ln η/η₀ under a dry contact's largest pressure up to which the continuation in the viscosity is known to arrive."""


@watched
def solve(
    beta: float | None = None,
    *,
    beta_load: float | None = None,
    cavitation: str = "reynolds",
    substrate: Substrate | None = None,
    liquid: Liquid | None = None,
    indenter: Shape | None = None,
    slide_to_roll: float = FIXED_BALL,
    accuracy: float = DEFAULT_ACCURACY,
    method: str = "newton",
    budget: float = DEFAULT_BUDGET,
    progress: Listener | None = None,
) -> Solution:
    """Solve one dimensionless contact.

    Parameters
    ----------
    beta : float
        β = (2/3)(h₀²/R) πG/(ηv), Eq. (6d), for a prescribed indentation.
    beta_load : float
        Instead of `beta`: the same with the Hertz indentation of a prescribed load, Eq. (30).
    cavitation : {"reynolds", "none"}
        Reynolds condition, or negative pressures allowed.
    substrate : Substrate, optional
        Of `softlube.substrates`; the half-space if none.
    liquid : Liquid, optional
        Of `softlube.model.liquids`; constant viscosity if none.
    indenter : Shape, optional
        Of `softlube.model.indenters`; the paraboloid of the paper if none.
    slide_to_roll : float
        Difference of the surface speeds over their mean, see `softlube.Rolling`: films of liquids that thin with shear depend
        on it.  Quantities of other liquids are those of a ball that does not turn, 2.
    accuracy : float
        Relative error aimed at (film_min and shear_rate_max: three times that, ten times beyond β = 3·10⁶).  Grids follow
        from it.
    method : {"newton", "relaxation", "cartesian"}
        This solver, or the paper's own method on its polar mesh of 50 × 30 or on a Cartesian one of 100 × 50
        (docs/theory/paper-method.md): slower, with one mesh and so without errors, for comparison.
    budget : float
        Seconds of processor time after which this solver gives up; the paper's method takes as long as it takes.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each grid, for instance ``print``.

    Returns
    -------
    Solution

    Raises
    ------
    InputError
        If an input is not as described (a ValueError).
    NotConvergedError
        If no grid reaches the accuracy, or Newton's method fails, or the budget is spent.

    Examples
    --------
    >>> import softlube
    >>> solution = softlube.solve(beta=1000)
    >>> round(solution.film_center, 5), solution.film_center.error < 1e-5
    (0.01615, True)
    """
    problem = Problem(
        beta,
        beta_load,
        cavitation,  # type: ignore[arg-type]
        substrate=substrate or HalfSpaceKernel(),
        liquid=liquid or NewtonianLaw(),
        indenter=indenter or Paraboloid(),
        slide_to_roll=slide_to_roll,
    )
    return solve_problem(problem, accuracy=accuracy, method=method, budget=budget, progress=progress)


def check_accuracy(accuracy: float) -> None:
    """Refuse an accuracy that no grid reaches, or that says nothing.

    Raises
    ------
    InputError
        If it is not between `FINEST_ACCURACY` and `LARGEST_ACCURACY`.
    """
    if not (np.isfinite(accuracy) and FINEST_ACCURACY <= accuracy <= LARGEST_ACCURACY):
        bounds = f"{FINEST_ACCURACY:g} and {LARGEST_ACCURACY:g}"
        raise InputError(f"accuracy: expected a relative error between {bounds}, got {accuracy!r}")


@one_thread
def solve_problem(
    problem: Problem,
    *,
    accuracy: float = DEFAULT_ACCURACY,
    method: str = "newton",
    budget: float = DEFAULT_BUDGET,
    progress: Listener | None = None,
) -> Solution:
    """Solve a `Problem` by one of the methods; see `solve`."""
    if method == "newton":
        check_accuracy(accuracy)
        if isinstance(budget, (bool, str)) or not budget > 0:
            raise InputError(f"budget: expected a number of seconds above 0, got {budget!r}")
        try:
            with time_budget.within(budget):
                solution = solve_on_ladder(_regime(problem), accuracy, progress)
        except time_budget.OutOfTime as spent:
            name = "beta_load" if problem.load_controlled else "beta"
            advice = f"accuracy={rounded_up(spent.reached)} or " if spent.reached <= LARGEST_ACCURACY else ""
            raise NotConvergedError(
                f"{name} = {problem.parameter:.4g}: it would take more than {budget:g} s of processor time. Try {advice}"
                f"budget={MORE_TIME * budget:g}."
            ) from None
        warn(solution.warnings)
        return solution
    if method not in ("relaxation", "cartesian"):
        raise InputError(f"method: expected 'newton', 'relaxation' or 'cartesian', got {method!r}")
    if accuracy != DEFAULT_ACCURACY:
        raise InputError(f"accuracy: method {method!r} has one mesh and takes no accuracy; leave it out")
    from softlube.paper import method as paper

    return (paper.solve_relaxation if method == "relaxation" else paper.solve_cartesian)(problem, progress=progress)


def _regime(problem: Problem) -> Regime:
    """The regime of a problem within the range that is resolved."""
    regime = Regime.of(problem)
    own = problem.parameter / regime.viscosity
    if not SMALLEST_BETA <= own <= LARGEST_BETA:
        name = "beta_load" if problem.load_controlled else "beta"
        formed = ", formed with the liquid's viscosity at the inlet," if problem.liquid.thins else ""
        raise NotConvergedError(
            f"{name} = {own:.4g}{formed} is outside the range that is resolved, {SMALLEST_BETA:g} to {LARGEST_BETA:g}. "
            "Beyond it the limits of softlube.limits hold: a rigid sphere below, a Hertz contact above."
        )
    remainder = problem.substrate.remainder
    if remainder is not None and (depth := remainder.smooth_over / np.sqrt(regime.unit)) < THINNEST:
        raise NotConvergedError(
            f"the layer is {THINNEST / depth:.2g} times thinner, beside the width of the pressure, than what grids resolve. "
            + (
                "It hardly yields: softlube.limits has the film of a rigid sphere."
                if regime.over_gap
                else "Check its thickness."
            )
        )
    if regime.thickening > THICKEST:
        raise NotConvergedError(
            f"the viscosity would rise by a factor of e^{regime.thickening:.0f} under the dry contact's pressure; contacts are "
            f"solved up to e^{THICKEST:.0f} (docs/how-to/viscosity.md)"
        )
    return regime
