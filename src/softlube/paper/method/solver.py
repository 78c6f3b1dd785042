"""The way in: a `Problem` goes in, a `Solution` by the paper's method comes out."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from softlube.discretization.fields import Fields
from softlube.discretization.measure import measure
from softlube.errors import InputError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.indenters import Paraboloid
from softlube.model.liquids import NewtonianLaw
from softlube.model.problem import Cavitation, Problem
from softlube.model.quantities import Quantity
from softlube.model.substrates import HalfSpaceKernel
from softlube.paper.method.cartesian import CartesianMesh, CartesianScheme, Elasticity
from softlube.paper.method.mesh import PaperMesh
from softlube.paper.method.polar import PolarScheme
from softlube.paper.method.relaxation import FIRST_BETA, REYNOLDS_FLOORS, SOMMERFELD_FLOORS, approach, march
from softlube.solvers.progress import Listener
from softlube.steady.level import Level
from softlube.steady.solution import Solution

LARGEST_BETA = 1e6
"""Above β = 10⁴ the method is expected to fail, and to say so; beyond this it is not tried."""
PRESSURE_TOLERANCE = 1e-4
"""Relative error of the pressure left by the iteration."""
FILM_PER_PRESSURE = 20.0
"""What a relative error of the pressure makes of other quantities': the film is a small difference of gap and displacement."""


def solve_relaxation(
    problem: Problem,
    *,
    n_r: int = 50,
    n_theta: int = 30,
    mesh_error: bool = False,
    cold: bool = False,
    tolerance: float = PRESSURE_TOLERANCE,
    progress: Listener | None = None,
) -> Solution:
    """Solve by the paper's method: polar mesh (12), stencil (A4), signed triangles (18), relaxation (19), march in β.

    Parameters
    ----------
    problem : Problem
        With β given, 10 or more; the method is known to work up to 10⁴.
    n_r, n_theta : int
        Radial and angular spacings.  The paper's mesh is 50 × 30.
    mesh_error : bool
        Also solve on two thirds of the spacings, and give the change as the quantities' error (second order would make it
        0.8 of that), with FILM_PER_PRESSURE times the tolerance for the iteration.  It knows nothing of the domain cut at
        r = 2, the larger error below β ~ 300.  The coarser mesh is the first to fail at large β.  Otherwise the error of a
        quantity is nan: one mesh does not tell.
    cold : bool
        Start at β at once, without the march.
    tolerance : float
        Relative error of the pressure left by the iteration.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each run of sweeps.

    Returns
    -------
    Solution
        With method "relaxation"; `levels[-1].history` is a tuple of `softlube.paper.method.relaxation.Sweeps`.

    Raises
    ------
    InputError
        If the load is prescribed, or β is out of range, or the mesh is impossible.
    softlube.paper.method.relaxation.RelaxationError
        If the iteration fails; a NotConvergedError with the `history`.
    """
    beta = _checked_beta(problem)
    betas = [beta] if cold else approach(beta)
    solved = [
        _whole_march(_polar_scheme(*size), betas, problem.cavitation, tolerance, progress)
        for size in _sizes(n_r, n_theta, mesh_error)
    ]
    return _solution(solved, "relaxation", tolerance)


def march_relaxation(
    betas: Sequence[float],
    *,
    cavitation: Cavitation = "reynolds",
    n_r: int = 50,
    n_theta: int = 30,
    tolerance: float = PRESSURE_TOLERANCE,
    progress: Listener | None = None,
) -> Iterator[Solution]:
    """One march of the paper's method that yields every solution on its way, each the next one's start.

    Parameters
    ----------
    betas : sequence of float
        Increasing; a first one near 10 and steps of about 3 are safe.
    cavitation, n_r, n_theta, tolerance, progress
        As for `solve_relaxation`.

    Yields
    ------
    Solution
        For each β; its history is that since the solution before.

    Raises
    ------
    InputError, softlube.paper.method.relaxation.RelaxationError
        As `solve_relaxation`.
    """
    betas = [_checked_beta(Problem(beta=beta)) for beta in betas]
    if not betas or any(after <= before for before, after in pairwise(betas)):
        raise InputError("betas: expected at least one, in increasing order")
    for solved in _marched(_polar_scheme(n_r, n_theta), betas, cavitation, tolerance, progress):
        yield _solution([solved], "relaxation", tolerance)


def solve_cartesian(
    problem: Problem,
    *,
    n_x: int = 100,
    n_y: int = 50,
    elasticity: Elasticity = "fft",
    mesh_error: bool = False,
    cold: bool = False,
    tolerance: float = PRESSURE_TOLERANCE,
    progress: Listener | None = None,
) -> Solution:
    """Solve by the same iteration on a uniform Cartesian grid over |x| ≤ 2, 0 ≤ y ≤ 2, the paper's comparison.

    The fields are then interpolated to polar nodes, with bicubic splines, so that they are read like any other solution; the
    load is summed over the square.

    Parameters
    ----------
    problem, mesh_error, cold, tolerance, progress
        As for `solve_relaxation`.
    n_x, n_y : int
        Spacings along x and y; the paper compares with 100 × 50.
    elasticity : {"fft", "dense"}
        Convolution, or the full matrix of influence coefficients; the same numbers to round-off.

    Returns
    -------
    Solution
        With method "cartesian"; otherwise as for `solve_relaxation`.

    Raises
    ------
    InputError
        If the load is prescribed, or β is out of range, or the grid or the elasticity is impossible.
    softlube.paper.method.relaxation.RelaxationError
        If the iteration fails.
    """
    beta = _checked_beta(problem)
    betas = [beta] if cold else approach(beta)
    solved = [
        _whole_march(_cartesian_scheme(*size, elasticity), betas, problem.cavitation, tolerance, progress)
        for size in _sizes(n_x, n_y, mesh_error)
    ]
    return _solution(solved, "cartesian", tolerance)


def _sizes(n_1: int, n_2: int, mesh_error: bool) -> list[tuple[int, int]]:
    return [(2 * n_1 // 3, 2 * n_2 // 3), (n_1, n_2)] if mesh_error else [(n_1, n_2)]


def _checked_beta(problem: Problem) -> float:
    if (problem.substrate, problem.liquid) != (HalfSpaceKernel(), NewtonianLaw()):
        raise InputError("method: the paper's methods know the half-space and constant viscosity only; leave it out")
    if problem.indenter != Paraboloid():
        raise InputError("method: the paper's methods know the paraboloid only; leave it out")
    if problem.beta is None:
        raise InputError("beta_load: the paper's method fixes the sphere's height and cannot prescribe the load; give beta")
    if not FIRST_BETA <= problem.beta <= LARGEST_BETA:
        raise InputError(
            f"beta: the paper's method marches up from {FIRST_BETA:g} and is known to work up to 1e4; "
            f"expected {FIRST_BETA:g} to {LARGEST_BETA:g}, got {problem.beta:g}"
        )
    return problem.beta


def _polar_scheme(n_r: int, n_theta: int) -> PolarScheme:
    try:
        return PolarScheme(PaperMesh(n_r, n_theta))
    except ValueError as error:
        raise InputError(str(error)) from error


def _cartesian_scheme(n_x: int, n_y: int, elasticity: Elasticity) -> CartesianScheme:
    try:
        return CartesianScheme(CartesianMesh(n_x, n_y), elasticity)
    except ValueError as error:
        raise InputError(str(error)) from error


def _marched(
    scheme: PolarScheme | CartesianScheme,
    betas: Sequence[float],
    cavitation: Cavitation,
    tolerance: float,
    progress: Listener | None,
) -> Iterator[tuple[Level, Fields]]:
    """The march, its solutions measured."""
    began = time.perf_counter()
    floors = REYNOLDS_FLOORS if cavitation == "reynolds" else SOMMERFELD_FLOORS
    marching = march(scheme, scheme.guess(), betas, floors=floors, tolerance=tolerance, progress=progress)
    for beta, (pressure, history) in zip(betas, marching, strict=True):
        seconds = time.perf_counter() - began
        fields = scheme.fields(pressure, beta, cavitation)
        n_1, n_2 = scheme.mesh.shape
        yield Level(n_1 - 1, n_2 - 1, measure(fields), history, seconds), fields
        began = time.perf_counter()


def _whole_march(
    scheme: PolarScheme | CartesianScheme,
    betas: Sequence[float],
    cavitation: Cavitation,
    tolerance: float,
    progress: Listener | None,
) -> tuple[Level, Fields]:
    """The end of the march, with the history and the time of all of it."""
    solved = list(_marched(scheme, betas, cavitation, tolerance, progress))
    level, fields = solved[-1]
    history = tuple(run for level, _ in solved for run in level.history)
    return replace(level, history=history, seconds=sum(level.seconds for level, _ in solved)), fields


def _solution(solved: Sequence[tuple[Level, Fields]], method: str, tolerance: float) -> Solution:
    levels = tuple(level for level, _ in solved)
    fields = solved[-1][1]
    values = levels[-1].values
    errors = dict.fromkeys(values, math.nan)
    if len(levels) > 1:
        iteration = FILM_PER_PRESSURE * tolerance
        errors = {name: abs(value - levels[0].values[name]) + iteration * abs(value) for name, value in values.items()}
    return Solution(
        problem=Problem(beta=fields.beta, cavitation=fields.cavitation),
        fields=fields,
        quantities={name: Quantity(value, errors[name]) for name, value in values.items()},
        beta=fields.beta,
        beta_load=fields.beta * (fields.load / HERTZ_LOAD) ** (4 / 3),
        accuracy=math.nan,
        levels=levels,
        method=method,
    )
