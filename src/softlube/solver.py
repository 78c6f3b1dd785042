"""solve(): picks the grids, starts Newton's method, estimates the error, and refuses what it cannot vouch for."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

from softlube.continuation import march
from softlube.errors import InputError, NotConvergedError
from softlube.fields import Fields
from softlube.grid import PolarGrid
from softlube.limits import HERTZ_LOAD
from softlube.newton import Iteration, NewtonResult, newton
from softlube.problem import Problem
from softlube.quantities import measure
from softlube.solution import Level, Quantity, Solution
from softlube.system import ContactSystem

Array = NDArray[np.floating]

DEFAULT_ACCURACY = 1e-3
LADDER = (12, 18, 26, 39, 58)
"""Angular intervals of the nested grids, coarse to fine."""
RADIAL_STEP = 6.0
"""Spacing of ξ times the number of angular intervals."""
LOOSER = {"film_min": 3.0, "pressure_gradient_inlet": 3.0}
"""Quantities whose error may exceed the accuracy by this factor: extrema in the thinnest layers."""
REPORTED_ONLY = ("film_min_radius", "film_min_angle_deg", "shear_rate_max")
"""Quantities that carry an error but do not decide when the grid is fine enough."""
FREE_BOUNDARY = {
    "load": 0.045,
    "load_contact": 0.035,
    "film_center": 0.027,
    "film_min": 0.57,
    "film_min_radius": 0.6,
    "film_min_angle_deg": 150.0,
    "film_inlet": 0.041,
    "film_outlet_min": 0.46,
    "pressure_center": 0.0115,
    "pressure_max": 0.0115,
    "pressure_gradient_inlet": 0.24,
    "boundary_layer": 0.048,
    "friction_contact": 0.07,
    "friction_domain": 0.054,
    "shear_rate_max": 1.6,
}
"""Least error, times n_theta², that a grid leaves because the free boundary falls between its nodes: relative, but absolute for
the place of the minimum.  Measured against finer grids by benchmarks/calibrate_errors.py; see docs/verification.md."""
SUCTION = {"shear_rate_max": 25.0}
"""The same without the Reynolds condition, where it differs: the largest shear lies in the suction behind the contact."""
FINEST_ACCURACY = 1.4e-4
"""What the free boundary allows on the finest grid of the ladder (the film on the outlet axis is the first to fail)."""
LARGEST_BETA = 3e5
SMALLEST_BETA = 0.3
LIGHTEST_LOAD = 10.0
"""β_load below which a failure is put down to the load: h₀ > 0 below about 4.5, or 1.3 without the Reynolds condition."""


def grid_for(problem: Problem, n_theta: int) -> PolarGrid:
    """Grid with the refinement that β calls for.

    The layers at the contact edge are β^(−2/5) wide at the inlet and outlet and β^(−1/2) at the sides, where they take an
    angle of β^(−1/4).  The grading changes in steps of √2, so that neighbouring β share a grid and its elastic operator.
    """
    beta = max(problem.parameter, 1.0)
    layer = 2.0 ** (np.round(2 * np.log2(0.4 * beta**-0.4)) / 2)
    layer = float(min(layer, 0.25))
    side_spacing = 0.75 if beta < 100 else 0.55
    grid = PolarGrid(n_r=8, n_theta=n_theta, layer=layer, side_spacing=side_spacing)
    return grid.resized(int(np.ceil(grid.xi_of(grid.reach) * n_theta / RADIAL_STEP)), n_theta)


def fields_of(system: ContactSystem, x: Array) -> Fields:
    """Fields normalised with |h₀|, whichever way the system is normalised (s = |h₀| in its units).

    Raises
    ------
    NotConvergedError
        If h₀ ≥ 0, where |h₀| is no scale.
    """
    grid, height = system.grid, system.height(x)
    if height >= 0:
        raise NotConvergedError(
            f"the film lifts the sphere above the undeformed surface (h0 = +{height:.3g} Hertz indentations), and this release "
            "solves h0 < 0 only. Try a larger load, a lower speed or a lower viscosity."
        )
    s = -height
    return Fields(
        chart=grid.scaled(s**-0.5),
        r=grid.r * s**-0.5,
        theta=grid.theta,
        pressure=system.pressure(x).reshape(grid.shape) * s**-0.5,
        film=system.film(x).reshape(grid.shape) / s,
        beta=s**2 * system.problem.parameter,
        cavitation=system.problem.cavitation,
        load=system.load(x) * s**-1.5,
    )


def prolong(x: Array, coarse: PolarGrid, fine: PolarGrid, problem: Problem) -> Array:
    """Interpolate unknowns from one grid to another of the same grading."""
    values = x[: coarse.n_unknown].reshape(coarse.n_r, -1)
    mirrored = np.concatenate([values[:2][::-1, ::-1], values])
    xi = (np.arange(-2, coarse.n_r) + 0.5) * coarse.d_xi
    spline = RectBivariateSpline(xi, coarse.s, mirrored, kx=3, ky=3, s=0)
    result = spline(np.minimum(fine.xi[: fine.n_r], xi[-1]), fine.s)
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
    system = ContactSystem(problem, grid)
    result = newton(system, system.start() if start is None else start)
    if not result.converged:
        result = _second_attempt(problem, grid, result)
    fields = fields_of(system, result.x)
    level = Level(grid.n_r, grid.n_theta, measure(fields), result.history, time.perf_counter() - began)
    return Solved(level, fields, result.x, grid)


def _second_attempt(problem: Problem, grid: PolarGrid, failed: NewtonResult) -> NewtonResult:
    """March in β where the direct start failed."""
    history: list[Iteration] = list(failed.history)
    result = failed
    for result in march(problem, grid):
        history += result.history
    if not result.converged:
        last = history[-1] if history else Iteration(np.nan, np.nan, 0, np.nan)
        name = "beta_load" if problem.load_controlled else "beta"
        advice = "Try another accuracy (it changes the grid), or report the input."
        if problem.load_controlled and problem.parameter < LIGHTEST_LOAD:
            advice = "So light a load probably lifts the sphere above the undeformed surface, h0 > 0: try a larger load."
        raise NotConvergedError(
            f"Newton's method did not converge at {name} = {problem.parameter:.4g} "
            f"on {grid.n_r} x {grid.n_theta} cells: after {len(history)} steps the last was {last.step:.1e} "
            f"(fraction {last.fraction:.2g}, residual {last.residual:.1e}). "
            f"{advice}"
        )
    return NewtonResult(result.x, True, tuple(history))


def estimate_errors(levels: Sequence[Mapping[str, float]], n_theta: int, cavitation: str = "reynolds") -> dict[str, float]:
    """Error of the finest grid's quantities, from how they changed over the grids.

    The scheme is of fourth order where the pressure is smooth, and of second at the free boundary, whose place between the
    nodes makes the change from grid to grid erratic: now and then a quantity hardly changes by chance.  So its error is taken
    from its last change, the change before that, and what the free boundary is known to leave on a grid of that size.

    Parameters
    ----------
    levels : sequence of mapping
        Quantities on successive grids, coarse to fine; at least two.
    n_theta : int
        Angular intervals of the finest.
    cavitation : {"reynolds", "none"}
        Without the Reynolds condition the floor holds for the narrow suction behind the contact.

    Returns
    -------
    dict of str to float
        Absolute estimates; at least 95 % of true errors lie below them (docs/verification.md).
    """
    finest, before = levels[-1], levels[-2]
    estimates = {}
    for name, value in finest.items():
        scale = 1.0 if name.startswith("film_min_") else abs(value)
        last = abs(value - before[name])
        changes = max(0.6 * last, 0.1 * abs(before[name] - levels[-3][name])) if len(levels) > 2 else last
        floor = SUCTION.get(name, FREE_BOUNDARY[name]) if cavitation == "none" else FREE_BOUNDARY[name]
        estimates[name] = max(changes, scale * floor / n_theta**2)
    return estimates


def _unresolved(values: Mapping[str, float], errors: Mapping[str, float], accuracy: float) -> dict[str, float]:
    """Quantities whose error exceeds what was asked for, with the relative error."""
    result = {}
    for name, error in errors.items():
        if name in REPORTED_ONLY:
            continue
        relative = error / abs(values[name]) if values[name] else np.inf
        if not relative <= accuracy * LOOSER.get(name, 1.0):
            result[name] = relative
    return result


def climb(problem: Problem) -> Iterator[Solved]:
    """Solve on ever finer grids, each starting from the one before."""
    start, coarse = None, None
    for n_theta in LADDER:
        grid = grid_for(problem, n_theta)
        if start is not None and coarse is not None:
            start = prolong(start, coarse, grid, problem)
        solved = solve_level(problem, grid, start)
        yield solved
        start, coarse = solved.x, grid


def solve(
    beta: float | None = None,
    *,
    beta_load: float | None = None,
    cavitation: str = "reynolds",
    accuracy: float = DEFAULT_ACCURACY,
    method: str = "newton",
    progress: Callable[[str], None] | None = None,
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
    accuracy : float
        Relative error aimed at (film_min and pressure_gradient_inlet: three times that).  Grids follow from it.
    method : {"newton", "relaxation", "cartesian"}
        This solver, or the paper's own method on its polar mesh of 50 × 30 or on a Cartesian one of 100 × 50
        (docs/paper-method.md): slower, with one mesh and so without errors, for comparison.
    progress : callable, optional
        Called with a line of text after each grid.

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
    problem = Problem(beta, beta_load, cavitation)  # type: ignore[arg-type]
    return solve_problem(problem, accuracy=accuracy, method=method, progress=progress)


def solve_problem(
    problem: Problem,
    *,
    accuracy: float = DEFAULT_ACCURACY,
    method: str = "newton",
    progress: Callable[[str], None] | None = None,
) -> Solution:
    """Solve a `Problem` by one of the methods; see `solve`."""
    if method == "newton":
        return _solve_newton(problem, accuracy, progress)
    if method not in ("relaxation", "cartesian"):
        raise InputError(f"method: expected 'newton', 'relaxation' or 'cartesian', got {method!r}")
    if accuracy != DEFAULT_ACCURACY:
        raise InputError(f"accuracy: method {method!r} has one mesh and takes no accuracy; leave it out")
    from softlube import paper

    return (paper.solve_relaxation if method == "relaxation" else paper.solve_cartesian)(problem, progress=progress)


def _solve_newton(problem: Problem, accuracy: float, progress: Callable[[str], None] | None) -> Solution:
    if not (np.isfinite(accuracy) and FINEST_ACCURACY <= accuracy <= 0.1):
        raise InputError(f"accuracy: expected a relative error between {FINEST_ACCURACY:g} and 0.1, got {accuracy!r}")
    _check_range(problem.parameter)
    solved: list[Solved] = []
    worst: dict[str, float] = {}
    for rung in climb(problem):
        solved.append(rung)
        _check_range(rung.fields.beta)  # under load control known only now
        if progress is not None:
            progress(f"{rung.grid.n_r} x {rung.grid.n_theta} cells solved in {rung.level.seconds:.2f} s")
        if len(solved) < 2:
            continue
        errors = estimate_errors([r.level.values for r in solved], rung.grid.n_theta, problem.cavitation)
        worst = _unresolved(rung.level.values, errors, accuracy)
        if not worst:
            return _solution(problem, solved, errors, accuracy)
    reached = ", ".join(f"{name} {value:.1e}" for name, value in sorted(worst.items(), key=lambda item: -item[1])[:3])
    raise NotConvergedError(
        f"the finest grid does not reach the accuracy {accuracy:g} at {problem.parameter:.4g}: {reached} (relative). "
        f"Try accuracy={2 * max(value / LOOSER.get(name, 1) for name, value in worst.items()):.0e}."
    )


def _check_range(beta: float) -> None:
    if not SMALLEST_BETA <= beta <= LARGEST_BETA:
        bounds = f"{SMALLEST_BETA:g} to {LARGEST_BETA:g}"
        advice = "larger load or indentation" if beta < SMALLEST_BETA else "smaller load or indentation, or a higher speed"
        raise NotConvergedError(f"beta = {beta:.4g} is outside the range this release resolves, {bounds}. Try a {advice}.")


def _solution(problem: Problem, solved: Sequence[Solved], errors: Mapping[str, float], accuracy: float) -> Solution:
    finest = solved[-1]
    beta = finest.fields.beta
    quantities = {name: Quantity(value, errors[name]) for name, value in finest.level.values.items()}
    # Eq. (29): the load N̄ has the Hertz indentation δ = |h₀| (N̄/(4/3π))^(2/3), and β_load goes with δ².
    beta_load = problem.beta_load if problem.beta_load is not None else beta * (finest.fields.load / HERTZ_LOAD) ** (4 / 3)
    return Solution(
        problem=problem,
        fields=finest.fields,
        quantities=quantities,
        beta=beta,
        beta_load=beta_load,
        accuracy=accuracy,
        levels=tuple(rung.level for rung in solved),
    )
