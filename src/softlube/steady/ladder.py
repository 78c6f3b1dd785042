"""solve(): picks the grids, starts Newton's method, estimates the error, and refuses what it cannot vouch for."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.discretization.measure import measure
from softlube.discretization.system import ContactSystem
from softlube.errors import InputError, NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.liquids import Liquid, NewtonianLaw
from softlube.model.problem import Problem
from softlube.model.quantities import Quantity
from softlube.model.substrates import HalfSpaceKernel, Substrate
from softlube.solvers.newton import Iteration, newton
from softlube.solvers.progress import Listener, Progress
from softlube.steady.continuation import settle, thicken
from softlube.steady.error_estimate import (
    COARSE_BETA,
    estimate_errors,
    floors_for,
    front_bound,
    front_doubts,
    has_front,
    looser,
    spike_bound,
    too_vague,
    unresolved,
    withheld,
)
from softlube.steady.mesh import (
    THICK,
    THICKEST,
    angles_for,
    contact_edge,
    crest_of,
    dry_under,
    first_height,
    grid_for,
    like_hertz,
    thickening,
    unit_for,
)
from softlube.steady.solution import Level, Solution
from softlube.steady.spike.crest import in_other_unit, spike_quantities
from softlube.steady.spike.detection import doubts

Array = NDArray[np.floating]

DEFAULT_ACCURACY = 1e-3
LADDER = (12, 18, 26, 39, 58)
"""Angular intervals of the nested grids, coarse to fine; on a layer a few more, see `softlube.steady.mesh.angles_for`."""
FIRST_ANGLES = 18
SPIKE_ANGLES = 39
"""What a spike is resolved with, or by no grid of the ladder."""
COARSE_TOLERANCE, FINE_TOLERANCE = 1e-4, 1e-6
"""Of Newton's method: on grids of so many angles, which mostly start the next ones, and on those that give numbers."""
NO_FRONT = "On so thin a layer a front at the sides is too sharp for these grids; other beta are solved (docs/layers.md)."
LARGEST_PASSED_OVER = 3000
"""Unknowns of a grid without a solution beyond which finer ones are not tried: each would take minutes to have none either."""
STEPS, STEEP_STEPS = 40, 90
"""Newton's at most on one grid, without and with a spike that must first move to where its nodes are; a march takes more."""
FINEST_ACCURACY = 1.4e-4
"""What the free boundary allows on the finest grid of the ladder (the film on the outlet axis is the first to fail)."""
LARGEST_ACCURACY = 0.1
DEEP = 1e3
"""β_load beyond which a load is first taken for an indentation."""
LARGEST_BETA = 1e9
SMALLEST_BETA = 1e-6


def prolong(x: Array, coarse: PolarGrid, fine: PolarGrid, problem: Problem) -> Array:
    """Interpolate unknowns from one grid to another."""
    values = x[: coarse.n_unknown].reshape(coarse.n_r, -1)
    mirrored = np.concatenate([values[:2][::-1, ::-1], values])
    xi = (np.arange(-2, coarse.n_r) + 0.5) * coarse.d_xi
    degree = 1 if thickening(problem) > THICK else 3  # a cubic rings at a spike, and the viscosity with it
    spline = RectBivariateSpline(xi, coarse.s, mirrored, kx=degree, ky=degree, s=0)
    result = spline(np.minimum(coarse.xi_of(fine.r[: fine.n_r]), xi[-1]), coarse.s_of(fine.theta))
    if problem.cavitation == "reynolds":
        result = np.maximum(result, 0)
    return np.append(result.ravel(), x[-1]) if problem.load_controlled else result.ravel()


@dataclass(frozen=True)
class Solved:
    """One rung of the ladder."""

    level: Level
    fields: Fields
    x: Array
    grid: PolarGrid


def solve_level(problem: Problem, grid: PolarGrid, start: Array | None) -> Solved:
    """Solve on one grid, from a given first guess or from the system's own."""
    began = time.perf_counter()
    history: list[Iteration] = []
    x = _unknowns(problem, grid, start, history)
    fields = ContactSystem(problem, grid, unit_for(problem)).fields(x)
    level = Level(
        grid.n_r, grid.n_theta, measure(fields, contact_edge(problem)), tuple(history), time.perf_counter() - began, fields
    )
    return Solved(level, fields, x, grid)


def _unknowns(problem: Problem, grid: PolarGrid, start: Array | None, history: list[Iteration]) -> Array:
    """The converged unknowns; Newton's steps are added to `history`."""
    steep = thickening(problem) > THICK
    if start is None and steep:
        return _thickened(problem, grid, history)
    system = ContactSystem(problem, grid, unit_for(problem))
    if start is None:
        start = system.start(first_height(problem) / system.scale)
        if like_hertz(problem) > DEEP and problem.load_controlled:
            # The step from a guess is safer with the height held, and the height is the dry one but for β^(−3/5).
            depth = dry_under(problem).indentation
            pressed = replace(
                problem,
                beta=problem.parameter * depth**2,
                beta_load=None,
                substrate=problem.substrate.in_units(depth),
                liquid=problem.liquid.in_units(depth),
            )
            held = newton(ContactSystem(pressed, grid, system.scale / depth), start[:-1])
            history += held.history
            start = np.append(held.x, -depth / system.scale)
    result = newton(
        system,
        start,
        tolerance=COARSE_TOLERANCE if grid.n_theta <= FIRST_ANGLES else FINE_TOLERANCE,
        max_iterations=STEEP_STEPS if steep else STEPS,
    )
    history += result.history
    if result.converged:
        return result.x
    return _thickened(problem, grid, history) if steep else _second_attempt(problem, grid, history)


def _thickened(problem: Problem, grid: PolarGrid, history: list[Iteration]) -> Array:
    """Solve with constant viscosity, then march up to the problem's own liquid."""
    plain = _unknowns(replace(problem, liquid=problem.liquid.weakened(0.0)), grid, None, history)
    result = None
    for result in thicken(problem, grid, plain, thickening(problem), scale=unit_for(problem)):
        history += result.history
    if result is None or not result.converged:
        raise _not_converged(problem, grid, history)
    return result.x


def _other_unit(problem: Problem, fields: Fields) -> float:
    """|h₀|, or the Hertz indentation of the load where the height is prescribed, over the problem's own unit."""
    return -fields.height if problem.load_controlled else float((fields.load / HERTZ_LOAD) ** (2 / 3))


def _second_attempt(problem: Problem, grid: PolarGrid, history: list[Iteration]) -> Array:
    """Let the film settle in time where the direct start failed."""
    system, result = ContactSystem(problem, grid, unit_for(problem)), None
    for result in settle(system, system.start(first_height(problem) / system.scale)):
        history += result.history
    if result is None or not result.converged:
        raise _not_converged(problem, grid, history)
    return result.x


def _not_converged(problem: Problem, grid: PolarGrid, history: Sequence[Iteration]) -> NotConvergedError:
    last = history[-1] if history else Iteration(np.nan, np.nan, 0, 0)
    name = "beta_load" if problem.load_controlled else "beta"
    return NotConvergedError(
        f"Newton's method did not converge at {name} = {problem.parameter:.4g} "
        f"on {grid.n_r} x {grid.n_theta} cells: after {len(history)} steps the last was {last.step:.1e} "
        f"(fraction {last.fraction:.2g}). "
        + (NO_FRONT if has_front(problem) else "Try another accuracy (it changes the grid), or report the input.")
    )


def climb(problem: Problem, progress: Listener | None = None) -> Iterator[Solved]:
    """Solve on ever finer grids, each starting from the one before.

    A grid may be too coarse to have a solution at all, where the film is thinnest in a short strip at a thin layer's sides; so
    the finer ones are tried, too.
    """
    before, crest = None, 0.0
    # Twelve intervals cannot hold the layers of a very large β together.
    ladder = LADDER[1:] if like_hertz(problem) > COARSE_BETA else LADDER
    for number, n_theta in enumerate(ladder, 1):
        grid = grid_for(problem, angles_for(problem, n_theta), crest)
        try:
            solved = solve_level(problem, grid, None if before is None else prolong(before.x, before.grid, grid, problem))
        except NotConvergedError:
            if grid.n_unknown > LARGEST_PASSED_OVER:
                raise
            if progress is not None:
                progress(Progress(f"{grid.n_r} x {grid.n_theta} cells are too few: no solution found on them", number))
            continue
        if progress is not None:
            progress(Progress(f"{grid.n_r} x {grid.n_theta} cells solved in {solved.level.seconds:.2f} s", number))
        yield solved
        before = solved
        if n_theta >= FIRST_ANGLES:  # the coarsest that sees where it will stand
            crest = crest_of(problem, solved.fields, crest)


def solve(
    beta: float | None = None,
    *,
    beta_load: float | None = None,
    cavitation: str = "reynolds",
    substrate: Substrate | None = None,
    liquid: Liquid | None = None,
    accuracy: float = DEFAULT_ACCURACY,
    method: str = "newton",
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
    accuracy : float
        Relative error aimed at (film_min and shear_rate_max: three times that, ten times beyond β = 3·10⁶).  Grids follow
        from it.
    method : {"newton", "relaxation", "cartesian"}
        This solver, or the paper's own method on its polar mesh of 50 × 30 or on a Cartesian one of 100 × 50
        (docs/paper-method.md): slower, with one mesh and so without errors, for comparison.
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
        If no grid reaches the accuracy, or Newton's method fails, or the load is too light for h₀ < 0.

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
    )
    return solve_problem(problem, accuracy=accuracy, method=method, progress=progress)


def solve_problem(
    problem: Problem,
    *,
    accuracy: float = DEFAULT_ACCURACY,
    method: str = "newton",
    progress: Listener | None = None,
) -> Solution:
    """Solve a `Problem` by one of the methods; see `solve`."""
    if method == "newton":
        return _solve_newton(problem, accuracy, progress)
    if method not in ("relaxation", "cartesian"):
        raise InputError(f"method: expected 'newton', 'relaxation' or 'cartesian', got {method!r}")
    if accuracy != DEFAULT_ACCURACY:
        raise InputError(f"accuracy: method {method!r} has one mesh and takes no accuracy; leave it out")
    from softlube.paper import method as paper

    return (paper.solve_relaxation if method == "relaxation" else paper.solve_cartesian)(problem, progress=progress)


def _solve_newton(problem: Problem, accuracy: float, progress: Listener | None) -> Solution:
    if not (np.isfinite(accuracy) and FINEST_ACCURACY <= accuracy <= LARGEST_ACCURACY):
        bounds = f"{FINEST_ACCURACY:g} and {LARGEST_ACCURACY:g}"
        raise InputError(f"accuracy: expected a relative error between {bounds}, got {accuracy!r}")
    _check_range(problem)
    solved: list[Solved] = []
    worst: dict[str, float] = {}
    accepted = False
    for rung in climb(problem, progress):
        solved.append(rung)
        if len(solved) < 2:
            continue
        values, errors = rung.level.values, _errors(problem, solved)
        front = front_bound(problem, values)
        slow = (*spike_bound(rung.fields), *front)
        if slow and rung.grid.n_theta < SPIKE_ANGLES:
            continue
        known = {name: error for name, error in errors.items() if name not in slow}
        worst = unresolved(values, known, accuracy, looser(problem))
        # What a front decides may stay less accurate than asked: the solution then says so, or does not give it.
        accepted = not worst
        if accepted and not too_vague(front, values, errors):
            break
    if len(solved) < 2:
        raise NotConvergedError("only the finest grid has a solution, and nothing tells its error; report the input.")
    if accepted:
        return solution_of(problem, solved, accuracy, progress)
    if not worst:
        raise NotConvergedError(
            "no grid is fine enough for the pressure spike, and nothing tells the errors; report the input."
        )
    reached = ", ".join(f"{name} {value:.1e}" for name, value in sorted(worst.items(), key=lambda item: -item[1])[:3])
    enough = 2 * max(value / looser(problem).get(name, 1) for name, value in worst.items())
    raise NotConvergedError(
        f"the finest grid does not reach the accuracy {accuracy:g} at {problem.parameter:.4g}: {reached} (relative). "
        + (f"Try accuracy={enough:.0e}." if enough <= LARGEST_ACCURACY else "No accuracy that can be asked for would do.")
    )


def _check_range(problem: Problem) -> None:
    if not SMALLEST_BETA <= problem.parameter <= LARGEST_BETA:
        name = "beta_load" if problem.load_controlled else "beta"
        bounds = f"{SMALLEST_BETA:g} to {LARGEST_BETA:g}"
        raise NotConvergedError(
            f"{name} = {problem.parameter:.4g} is outside the range that is resolved, {bounds}. Beyond it the limits of "
            "softlube.limits hold: a rigid sphere below, a Hertz contact above."
        )
    if (rise := thickening(problem)) > THICKEST:
        raise NotConvergedError(
            f"the viscosity would rise by a factor of e^{rise:.0f} under the dry contact's pressure; contacts are solved up to "
            f"e^{THICKEST:.0f} (docs/viscosity.md)"
        )


def _errors(problem: Problem, solved: Sequence[Solved]) -> dict[str, float]:
    exact = "load" if problem.load_controlled else "height"
    values, finest = [rung.level.values for rung in solved], solved[-1]
    erratic = front_bound(problem, values[-1])
    return estimate_errors(values, finest.grid.n_theta, floors_for(problem), exact, spike_bound(finest.fields), erratic)


def normalised_otherwise(problem: Problem, levels: Sequence[Level], own: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Quantities normalised with |h₀| where the load is prescribed, with the load where |h₀| is; none for h₀ ≥ 0.

    What the grids do not say of a spike is taken from the problem's `own`.
    """
    fields = [level.fields for level in levels if level.fields is not None]
    if any(each.height >= 0 for each in fields):
        return {}
    units = [_other_unit(problem, each) for each in fields]
    by_load, substrate = problem.load_controlled, problem.substrate.in_units(units[-1])
    edge = contact_edge(Problem(beta=1.0 if by_load else None, beta_load=None if by_load else 1.0, substrate=substrate))
    histories = [measure(each.in_units(unit), edge) for each, unit in zip(fields, units, strict=True)]
    exact = "height" if problem.load_controlled else "load"
    erratic = front_bound(problem, histories[-1])
    errors = estimate_errors(histories, levels[-1].n_theta, floors_for(problem), exact, spike_bound(fields[-1]), erratic)
    missing = withheld(problem, fields[-1], histories[-1], errors)
    found = _quantities(histories[-1], errors, missing)
    if not missing and "spike_radius" not in own:
        return found
    known = in_other_unit(own, levels[-1].values, fields[-1].in_units(units[-1]), histories[-1], units[-1], edge)
    return found | {name: each for name, each in known.items() if name in missing or name not in found}


def _quantities(values: Mapping[str, float], errors: Mapping[str, float], missing: Sequence[str]) -> dict[str, Quantity]:
    """Values with their errors; nan for those that are not given."""
    return {name: Quantity(np.nan) if name in missing else Quantity(value, errors[name]) for name, value in values.items()}


def rungs(solved: Sequence[Solved]) -> tuple[Level, ...]:
    """What the grids gave."""
    return tuple(rung.level for rung in solved)


def solution_of(problem: Problem, solved: Sequence[Solved], accuracy: float, progress: Listener | None = None) -> Solution:
    """What the grids solved so far, at least two, say of a problem."""
    finest = solved[-1]
    fields = finest.fields
    errors = _errors(problem, solved)
    values = finest.level.values
    quantities = _quantities(values, errors, withheld(problem, fields, values, errors))
    if finest.grid.crest:
        quantities |= spike_quantities(problem, [rung.fields for rung in solved], quantities, progress)
    # Eq. (29): the load N̄ has the Hertz indentation δ = |h₀| (N̄/(4/3π))^(2/3), and β_load goes with δ².
    return Solution(
        problem=problem,
        fields=fields,
        quantities=quantities,
        beta=fields.beta * fields.height**2,
        beta_load=fields.beta * max(fields.load / HERTZ_LOAD, 0.0) ** (4 / 3),
        accuracy=accuracy,
        levels=rungs(solved),
        warnings=doubts(fields, quantities) + front_doubts(problem, values, errors, accuracy),
    )
