"""solve(): picks the grids, starts Newton's method, estimates the error, and refuses what it cannot vouch for."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

from softlube.continuation import march
from softlube.dry import DryContact, dry_contact_at
from softlube.errors import InputError, NotConvergedError
from softlube.fields import Fields
from softlube.fluids import Fluid, Newtonian
from softlube.grid import PolarGrid
from softlube.limits import HERTZ_LOAD
from softlube.newton import Iteration, NewtonResult, newton
from softlube.problem import Problem
from softlube.quantities import BOUNDARY_LAYER_LEVEL, measure
from softlube.solution import Level, Quantity, Solution
from softlube.substrates import HalfSpace, Substrate
from softlube.system import ContactSystem

Array = NDArray[np.floating]

DEFAULT_ACCURACY = 1e-3
LADDER = (12, 18, 26, 39, 58)
"""Angular intervals of the nested grids, coarse to fine."""
FIRST_ANGLES = 18
COARSE_TOLERANCE, FINE_TOLERANCE = 1e-4, 1e-6
"""Of Newton's method: on grids of so many angles, which mostly start the next ones, and on those that give numbers."""
RADIAL_STEP = 6.0
"""Spacing of ξ times the number of angular intervals."""
RADIAL_STEP_GAP = 4.0
"""The same under a sphere that does not touch, where the mesh also reaches farther: u = h₀ + r²/2 becomes r²/2 later."""
LOOSER = {"film_min": 3.0}
LOOSER_DEEP = {"film_min": 10.0}
"""Quantities whose error may exceed the accuracy by this factor: the extremum in the thinnest layer, which takes
more angles the larger β is; the second beyond `COARSE_BETA`."""
REPORTED_ONLY = ("film_min_radius", "film_min_angle_deg", "shear_rate_max")
"""Quantities that carry an error but do not decide when the grid is fine enough."""
FREE_BOUNDARY = {
    "load": 0.1,
    "load_contact": 0.1,
    "height": 0.05,
    "film_center": 0.03,
    "film_min": 0.75,
    "film_min_radius": 1.0,
    "film_min_angle_deg": 150.0,
    "film_inlet": 0.041,
    "film_outlet_min": 0.5,
    "pressure_center": 0.08,
    "pressure_max": 0.06,
    "pressure_gradient_inlet": 0.24,
    "boundary_layer": 0.15,
    "friction_contact": 0.07,
    "friction_domain": 0.08,
    "shear_rate_max": 1.6,
}
"""Least error, times n_theta², that a grid leaves because the free boundary falls between its nodes: in terms of `yardstick`.
Measured against finer grids by benchmarks/calibrate_errors.py; see docs/verification.md."""
FREE_BOUNDARY_GAP = {
    "load_contact": 0.56,
    "height": 0.18,
    "film_center": 0.35,
    "film_min": 0.35,
    "film_min_angle_deg": 1.2e5,
    "film_inlet": 0.35,
    "film_outlet_min": 0.35,
    "pressure_center": 0.56,
    "pressure_max": 0.55,
    "pressure_gradient_inlet": 0.71,
    "boundary_layer": 0.21,
    "friction_contact": 0.36,
    "friction_domain": 0.36,
}
"""The same under a sphere that hardly touches or does not: the boundary passes close by, the minimum film sits on the axis."""
FREE_BOUNDARY_DEEP = {"film_min": 2.0}
"""The same for a very large β, where few angles share the layer with the minimum film."""
SUCTION = {"film_min": 1.0, "shear_rate_max": 25.0}
"""The same without the Reynolds condition, where it differs: the largest shear lies in the suction behind the contact."""
FINEST_ACCURACY = 1.4e-4
"""What the free boundary allows on the finest grid of the ladder (the film on the outlet axis is the first to fail)."""
DEEP = 1e3
"""β_load beyond which a load is first taken for an indentation."""
TOUCHING = 4.5
"""β_load at which h₀ = 0 under the Reynolds condition, about."""
DEEP_BETA = 3e4
COARSE_BETA = 3e6
"""β up to which the coarsest grid is of use."""
LARGEST_BETA = 1e9
SMALLEST_BETA = 1e-6


def unit_for(problem: Problem) -> float:
    """Unit of height that suits the mesh, over the problem's own: √unit is where the mesh is refined.

    A contact has its edge, as found dry, at r = 1 (on a half-space the units are the same).  Where the film is thicker than
    the indentation, the pressure is as wide as the gap allows
    (the rigid sphere's is largest at r = 0.26 √(2h₀)).
    """
    pressed = _dry(problem).radius ** 2
    if problem.load_controlled:
        return pressed + 0.18 * max(first_height(problem), 0)
    lifted = np.sqrt(TOUCHING / problem.parameter)
    over_contact = pressed * max(1.0, np.sqrt(TOUCHING / like_hertz(problem)))
    return float({-1: over_contact, 0: lifted, 1: 0.2 + lifted}[problem.height])


def _dry(problem: Problem) -> DryContact:
    """The contact without the film, under the problem's load or at its indentation."""
    if problem.load_controlled:
        return dry_contact_at(problem.substrate, load=HERTZ_LOAD)
    return dry_contact_at(problem.substrate, indentation=1.0)


def like_hertz(problem: Problem) -> float:
    """β of the contact on a half-space with the same layers at its edge; the problem's own if it is one."""
    return _dry(problem).like_hertz(problem.parameter)


def _over_a_gap(problem: Problem) -> bool:
    """Whether the sphere stays above the undeformed surface, or about."""
    return problem.height >= 0 or (problem.load_controlled and unit_for(problem) > 1.01 * _dry(problem).radius ** 2)


def grid_for(problem: Problem, n_theta: int) -> PolarGrid:
    """Grid with the refinement that β calls for.

    The layers at the contact edge are β^(−2/5) wide at the inlet and outlet and β^(−1/2) at the sides, where they take an
    angle of β^(−1/4).  The grading changes in steps of 2 (of √2 in angle), so that neighbouring β share a grid and its elastic
    operator.
    """
    gap = _over_a_gap(problem)
    beta = 1.0 if gap else max(like_hertz(problem), 1.0)
    step = np.round(np.log2(beta**-0.4))
    grid = PolarGrid(
        n_r=8,
        n_theta=n_theta,
        layer=0.5 if gap else float(min(0.4 * 2.0**step, 0.25)),
        side_layer=float(min(1.2 * 2.0 ** (step * 0.625), 1.0)),
        reach=60.0 if gap else 20.0,
    )
    return grid.resized(int(np.ceil(grid.xi_of(grid.reach) * n_theta / (RADIAL_STEP_GAP if gap else RADIAL_STEP))), n_theta)


def first_height(problem: Problem) -> float:
    """About the height under a load, in units of the load's Hertz indentation.

    In the Hertz limit h₀ + 1 ~ β^(−3/5), and another substrate is as deep as dry.  A light load is carried by the rigid
    sphere's pressure, which goes like 1/(β√h₀), or
    without the Reynolds condition by what the deformation adds to it, like 1/(β²h₀^(5/2)) (constants measured).
    """
    beta, dry = like_hertz(problem), _dry(problem)
    if beta > TOUCHING / 2:
        return 2.6 * dry.radius**2 * dry.edge * beta**-0.6 - dry.indentation
    beta = problem.parameter
    return 5.5 / beta**2 if problem.cavitation == "reynolds" else 0.65 / beta**0.8


def fields_of(system: ContactSystem, x: Array) -> Fields:
    """Fields in the problem's own unit of height."""
    grid = system.grid
    fields = Fields(
        chart=grid,
        r=grid.r,
        theta=grid.theta,
        pressure=system.pressure(x).reshape(grid.shape),
        film=system.film(x).reshape(grid.shape),
        beta=system.beta,
        cavitation=system.problem.cavitation,
        load=system.load(x),
        height=system.height(x),
        fluid=system.fluid,
    )
    return fields.in_units(1 / system.scale)


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
    system = ContactSystem(problem, grid, unit_for(problem))
    history: list[Iteration] = []
    if start is None:
        start = system.start(first_height(problem) / system.scale)
        if like_hertz(problem) > DEEP and problem.load_controlled:
            # The step from a guess is safer with the height held, and the height is the dry one but for β^(−3/5).
            depth = _dry(problem).indentation
            pressed = replace(
                problem,
                beta=problem.parameter * depth**2,
                beta_load=None,
                substrate=problem.substrate.in_units(depth),
                fluid=problem.fluid.in_units(depth),
            )
            held = newton(ContactSystem(pressed, grid, system.scale / depth), start[:-1])
            history += held.history
            start = np.append(held.x, -depth / system.scale)
    result = newton(system, start, tolerance=COARSE_TOLERANCE if grid.n_theta <= FIRST_ANGLES else FINE_TOLERANCE)
    history += result.history
    if not result.converged:
        result = _second_attempt(problem, grid, history)
    fields = fields_of(system, result.x)
    level = Level(grid.n_r, grid.n_theta, measure(fields), tuple(history), time.perf_counter() - began, fields)
    return Solved(level, fields, result.x, grid)


def _other_unit(problem: Problem, fields: Fields) -> float:
    """|h₀|, or the Hertz indentation of the load where the height is prescribed, over the problem's own unit."""
    return -fields.height if problem.load_controlled else float((fields.load / HERTZ_LOAD) ** (2 / 3))


def _second_attempt(problem: Problem, grid: PolarGrid, history: list[Iteration]) -> NewtonResult:
    """March in β where the direct start failed."""
    result = None
    pressed = _dry(problem).radius ** 2
    for result in march(problem, grid, scale=pressed) if unit_for(problem) == pressed else ():
        history += result.history
    if result is None or not result.converged:
        last = history[-1] if history else Iteration(np.nan, np.nan, 0, 0)
        name = "beta_load" if problem.load_controlled else "beta"
        raise NotConvergedError(
            f"Newton's method did not converge at {name} = {problem.parameter:.4g} "
            f"on {grid.n_r} x {grid.n_theta} cells: after {len(history)} steps the last was {last.step:.1e} "
            f"(fraction {last.fraction:.2g}). Try another accuracy (it changes the grid), or report the input."
        )
    return result


def yardstick(name: str, values: Mapping[str, float]) -> float:
    """What the error of a quantity is compared with: its size, where that cannot vanish.

    The height is compared with the film too, the boundary layer with its place in a dry contact (p/p_max = 5 % at 1 − r =
    0.00125), the place of the minimum film with 1.
    """
    if name.startswith("film_min_"):
        return 1.0
    extra = {"height": values["film_center"], "boundary_layer": BOUNDARY_LAYER_LEVEL**2 / 2}
    return abs(values[name]) + extra.get(name, 0.0)


def floors_for(problem: Problem) -> Mapping[str, float]:
    """Errors, times n_theta² and in terms of `yardstick`, that the estimates of a problem never go below."""
    floors = dict(FREE_BOUNDARY)
    if problem.cavitation == "none":
        floors |= SUCTION
    elif _over_a_gap(problem):
        floors |= FREE_BOUNDARY_GAP
    if like_hertz(problem) > DEEP_BETA and not _over_a_gap(problem):
        floors |= FREE_BOUNDARY_DEEP
    return floors


def estimate_errors(
    levels: Sequence[Mapping[str, float]], n_theta: int, floors: Mapping[str, float] = FREE_BOUNDARY, exact: str = ""
) -> dict[str, float]:
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
    floors : mapping
        See `floors_for`.
    exact : str
        A quantity that is prescribed.

    Returns
    -------
    dict of str to float
        Absolute estimates; at least 95 % of true errors lie below them (docs/verification.md).
    """
    finest, before = levels[-1], levels[-2]
    estimates = {}
    for name, value in finest.items():
        last = abs(value - before[name])
        changes = max(0.6 * last, 0.05 * abs(before[name] - levels[-3][name])) if len(levels) > 2 else last
        estimates[name] = 0.0 if name == exact else max(changes, yardstick(name, finest) * floors[name] / n_theta**2)
    return estimates


def _looser(problem: Problem) -> Mapping[str, float]:
    return LOOSER_DEEP if like_hertz(problem) > COARSE_BETA else LOOSER


def _unresolved(
    values: Mapping[str, float], errors: Mapping[str, float], accuracy: float, looser: Mapping[str, float]
) -> dict[str, float]:
    """Quantities whose error exceeds what was asked for, with the relative error."""
    result = {}
    for name, error in errors.items():
        if name not in REPORTED_ONLY:
            relative = error / yardstick(name, values)
            if not relative <= accuracy * looser.get(name, 1.0):
                result[name] = relative
    return result


def climb(problem: Problem) -> Iterator[Solved]:
    """Solve on ever finer grids, each starting from the one before."""
    start, coarse = None, None
    # Twelve intervals cannot hold the layers of a very large β together.
    for n_theta in LADDER[1:] if like_hertz(problem) > COARSE_BETA else LADDER:
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
    substrate: Substrate | None = None,
    fluid: Fluid | None = None,
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
    substrate : Substrate, optional
        Of `softlube.substrates`; the half-space if none.
    fluid : Fluid, optional
        Of `softlube.fluids`; constant viscosity if none.
    accuracy : float
        Relative error aimed at (film_min: three times that, ten times beyond β = 3·10⁶).  Grids follow from it.
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
    problem = Problem(
        beta,
        beta_load,
        cavitation,  # type: ignore[arg-type]
        substrate=substrate or HalfSpace(),
        fluid=fluid or Newtonian(),
    )
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
    _check_range(problem)
    solved: list[Solved] = []
    worst: dict[str, float] = {}
    for rung in climb(problem):
        solved.append(rung)
        if progress is not None:
            progress(f"{rung.grid.n_r} x {rung.grid.n_theta} cells solved in {rung.level.seconds:.2f} s")
        if len(solved) < 2:
            continue
        errors = _errors(problem, solved)
        worst = _unresolved(rung.level.values, errors, accuracy, _looser(problem))
        if not worst:
            return solution_of(problem, solved, accuracy)
    reached = ", ".join(f"{name} {value:.1e}" for name, value in sorted(worst.items(), key=lambda item: -item[1])[:3])
    raise NotConvergedError(
        f"the finest grid does not reach the accuracy {accuracy:g} at {problem.parameter:.4g}: {reached} (relative). "
        f"Try accuracy={2 * max(value / _looser(problem).get(name, 1) for name, value in worst.items()):.0e}."
    )


def _check_range(problem: Problem) -> None:
    if not SMALLEST_BETA <= problem.parameter <= LARGEST_BETA:
        name = "beta_load" if problem.load_controlled else "beta"
        bounds = f"{SMALLEST_BETA:g} to {LARGEST_BETA:g}"
        raise NotConvergedError(
            f"{name} = {problem.parameter:.4g} is outside the range that is resolved, {bounds}. Beyond it the limits of "
            "softlube.limits hold: a rigid sphere below, a Hertz contact above."
        )


def _errors(problem: Problem, solved: Sequence[Solved]) -> dict[str, float]:
    exact = "load" if problem.load_controlled else "height"
    return estimate_errors([rung.level.values for rung in solved], solved[-1].grid.n_theta, floors_for(problem), exact)


def normalised_otherwise(problem: Problem, levels: Sequence[Level]) -> dict[str, Quantity]:
    """Quantities normalised with |h₀| where the load is prescribed, with the load where |h₀| is; none for h₀ ≥ 0."""
    fields = [level.fields for level in levels if level.fields is not None]
    if any(each.height >= 0 for each in fields):
        return {}
    histories = [measure(each.in_units(_other_unit(problem, each))) for each in fields]
    exact = "height" if problem.load_controlled else "load"
    errors = estimate_errors(histories, levels[-1].n_theta, floors_for(problem), exact)
    return {name: Quantity(value, errors[name]) for name, value in histories[-1].items()}


def solution_of(problem: Problem, solved: Sequence[Solved], accuracy: float) -> Solution:
    """What the grids solved so far, at least two, say of a problem."""
    finest = solved[-1]
    fields = finest.fields
    errors = _errors(problem, solved)
    quantities = {name: Quantity(value, errors[name]) for name, value in finest.level.values.items()}
    # Eq. (29): the load N̄ has the Hertz indentation δ = |h₀| (N̄/(4/3π))^(2/3), and β_load goes with δ².
    return Solution(
        problem=problem,
        fields=fields,
        quantities=quantities,
        beta=fields.beta * fields.height**2,
        beta_load=fields.beta * max(fields.load / HERTZ_LOAD, 0.0) ** (4 / 3),
        accuracy=accuracy,
        levels=tuple(rung.level for rung in solved),
    )
