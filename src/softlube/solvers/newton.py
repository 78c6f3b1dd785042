"""Semismooth Newton-Krylov method for complementarity problems; knows vectors, no physics.

Find x with, for every constrained unknown, x ≥ 0, R(x) ≥ 0 and x·R(x) = 0, and R(x) = 0 for the others.  With scales c > 0
this is x = max(0, x − R/c): the unknowns with x − R/c ≤ 0 form the active set, where the step goes to x = 0; on the others
Newton's equation holds, and preconditioned GMRES solves it.  The active set settles after a few steps, and the convergence is
then as fast as the linear equations are solved well (Hintermüller, Ito & Kunisch 2003).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from softlube.solvers import budget
from softlube.solvers.threads import one_thread

Array = NDArray[np.floating]
Mask = NDArray[np.bool_]

LINEAR_TOLERANCE, FIRST_TOLERANCE = 1e-3, 1e-2
"""Reduction of the (preconditioned) linear residual in each Newton step: after a short step, and before."""
REUSE_BELOW = 0.1
"""Size of a step that is short: after it the preconditioner is good for the next one too."""
DOUBT = 1.25
"""Size of a step over what the preconditioner alone says of it, at least: the last step that was short told how much it is."""
WORST_REDUCTION = 0.1
"""What may be left of a linear residual for a small step to mean convergence."""
NEGLIGIBLE = 1e-8
"""Size of a step that means convergence even while some unknowns still change sides: on the free boundary, by round-off."""
SAME_STEP, LONGEST_CIRCLE = 0.03, 12
"""Relative difference up to which two steps are the same, and number of steps at most in a circle, in which unknowns come into
the active set and leave it for ever."""
LEAVING, LEFT = 0.5, 0.05
"""Fraction of the steps that leave a circle, and their size over the circle's from which on whole steps are taken again."""
LARGEST_KRYLOV = 60
"""Iterations of GMRES at most; some ten are usual."""


class LinearEquation(Protocol):
    """J step = r on some unknowns, in a form near to the identity for GMRES, which need not have step as its unknown."""

    def right(self, residual: Array) -> Array:
        """Right-hand side from r, a whole vector, zero on the other unknowns."""
        ...

    def operator(self, unknown: Array) -> Array:
        """Left-hand side."""
        ...

    def step(self, unknown: Array) -> Array:
        """The step, a whole vector, zero on the other unknowns."""
        ...

    def at(self, times: Callable[[Array], Array]) -> LinearEquation:
        """The same with another J close by, whose product with a vector is given, and the old preconditioner."""
        ...


@dataclass(frozen=True)
class DenseEquation:
    """A `LinearEquation` for a matrix small enough to factorise.

    Parameters
    ----------
    times : callable
        J times a vector.
    free : ndarray of bool
        The unknowns it is for.
    factors : tuple
        LU factors (`scipy.linalg.lu_factor`) of the rows and columns `free` of J, or of a J close by.
    """

    times: Callable[[Array], Array]
    free: Mask
    factors: tuple[Array, NDArray[np.integer]]

    @classmethod
    def of(cls, matrix: Array, free: Mask) -> DenseEquation:
        """The equation of a square matrix."""
        return cls(lambda x: matrix @ x, free, lu_factor(matrix[np.ix_(free, free)]))

    def right(self, residual: Array) -> Array:
        """J⁻¹ r."""
        return lu_solve(self.factors, residual[self.free])

    def operator(self, unknown: Array) -> Array:
        """J⁻¹ J."""
        return self.right(self.times(self.step(unknown)))

    def step(self, unknown: Array) -> Array:
        """The unknowns in their places."""
        whole = np.zeros(self.free.size)
        whole[self.free] = unknown
        return whole

    def at(self, times: Callable[[Array], Array]) -> DenseEquation:
        """Another J, the old factors."""
        return replace(self, times=times)


class Linearised(Protocol):
    """Residual and exact Jacobian at one x."""

    @property
    def residual(self) -> Array:
        """R(x)."""
        ...

    @property
    def scale(self) -> Array:
        """Positive, about the diagonal of the Jacobian."""
        ...

    def times(self, step: Array) -> Array:
        """Jacobian times a vector."""
        ...

    def equation(self, free: Mask) -> LinearEquation:
        """Newton's equation on the unknowns `free`, preconditioned."""
        ...

    def reach(self, step: Array) -> tuple[float, float]:
        """How large a step is, relative to the state (the largest of its parts), and the largest fraction of it that keeps the
        state admissible.
        """
        ...


class System(Protocol):
    """A square system of equations with bounds."""

    constrained: Mask

    def linearise(self, x: Array) -> Linearised:
        """Evaluate residual and Jacobian."""
        ...


@dataclass(frozen=True)
class Iteration:
    """One Newton step: relative size of the full step, fraction taken, active unknowns, iterations of GMRES."""

    step: float
    fraction: float
    n_active: int
    krylov: int

    @property
    def count(self) -> int:
        """Number of steps: 1."""
        return 1

    def summary(self) -> dict[str, Any]:
        """The step in plain values."""
        return asdict(self)


@dataclass(frozen=True)
class NewtonResult:
    """Where Newton's method ended.

    Attributes
    ----------
    x : ndarray
        Last iterate; exact zeros on the active set when converged.
    converged : bool
        Whether the steps have come down to the tolerance: with the active set at rest, or so far that what still changes sides
        is round-off.
    history : tuple of Iteration
    """

    x: Array
    converged: bool
    history: tuple[Iteration, ...]


@one_thread
def newton(system: System, start: Array, *, tolerance: float = 1e-7, max_iterations: int = 40) -> NewtonResult:
    """Solve a complementarity problem from a starting point.

    Parameters
    ----------
    system : System
        Residual, Jacobian, bounds.
    start : ndarray
        First iterate.
    tolerance : float
        Size (see `Linearised.size`) that the next step would have, to go by the last two.
    max_iterations : int
        Steps before giving up.

    Raises
    ------
    softlube.solvers.budget.OutOfTime
        If the time is spent that the caller allows.
    """
    x = np.array(start, dtype=float)
    history: list[Iteration] = []
    before: Mask | None = None
    equation: LinearEquation | None = None
    said, doubt, until = 0.0, DOUBT, math.inf

    def ended(converged: bool) -> NewtonResult:
        return NewtonResult(np.where(system.constrained, np.maximum(x, 0.0), x) if converged else x, converged, tuple(history))

    for _ in range(max_iterations):
        budget.check()
        at = system.linearise(x)
        active = system.constrained & (x - at.residual / at.scale <= 0)
        free = ~active
        settled = before is not None and np.array_equal(active, before)
        step = np.where(active, -x, 0.0)
        residual = np.where(free, -at.residual - (at.times(step) if step.any() else 0.0), 0.0)
        short = bool(history) and history[-1].step < REUSE_BELOW
        near = settled and short
        equation = equation.at(at.times) if near and equation is not None else at.equation(free)
        right = equation.right(residual)
        if near:
            rough = step + equation.step(right)
            said = at.reach(rough)[0]
            if doubt * said < tolerance:  # a whole step would only confirm it
                x = x + rough
                return ended(True)
        unknown, krylov, left = gmres(equation.operator, right, LINEAR_TOLERANCE if short else FIRST_TOLERANCE)
        step += equation.step(unknown)
        if not np.all(np.isfinite(step)):
            break
        size, fraction = at.reach(step)
        if _circling(history, size, int(active.sum())):
            until = LEFT * size
        if size > until:
            fraction *= LEAVING
        else:
            until = math.inf
        if near:
            doubt = max(DOUBT, size / max(said, 1e-300))
        contraction = min(1.0, size / max(history[-1].step, 1e-300)) if history and settled else 1.0
        history.append(Iteration(size, fraction, int(active.sum()), krylov))
        x = x + fraction * step
        if fraction == 1:
            x[active] = 0.0
        at_rest = settled and size * contraction < tolerance
        if fraction == 1 and left < WORST_REDUCTION and (at_rest or size < min(tolerance, NEGLIGIBLE)):
            return ended(True)
        if fraction < 1e-6:
            break
        before = active
    return ended(False)


def _circling(history: list[Iteration], size: float, n_active: int) -> bool:
    """Whether a step is one that was taken a few steps ago: the active set goes round and round."""
    earlier = history[-LONGEST_CIRCLE:-1]
    return any(each.n_active == n_active and abs(size - each.step) < SAME_STEP * each.step for each in earlier)


def gmres(operator: Callable[[Array], Array], right: Array, tolerance: float) -> tuple[Array, int, float]:
    """Solve operator(x) = right for a linear operator near to the identity (Saad & Schultz 1986).

    It starts from x = right, so what the operator does as the identity would is right from the beginning: the preconditioner
    meets a load exactly, and so does every iterate.

    Parameters
    ----------
    operator : callable
        Of a vector of the shape of `right`.
    right : ndarray, shape (n,)
        Right-hand side.
    tolerance : float
        Residual, relative to the right-hand side, at which to stop; after `LARGEST_KRYLOV` iterations it stops anyway.

    Returns
    -------
    solution : ndarray, shape (n,)
    iterations : int
        Products with the operator.
    left : float
        Relative residual.
    """
    scale = _norm(right)
    if scale == 0:
        return right, 0, 0.0
    residual = right - operator(right)
    norm = _norm(residual)
    basis = np.empty((LARGEST_KRYLOV, right.size))
    hessenberg = np.zeros((LARGEST_KRYLOV, LARGEST_KRYLOV - 1))
    basis[0] = residual / max(norm, 1e-300)
    # The vector that is orthogonal to the columns of the Hessenberg matrix tells the residual, by its norm.
    normal = np.zeros(LARGEST_KRYLOV)
    normal[0] = 1.0
    k = 0
    while k < LARGEST_KRYLOV - 1 and norm > tolerance * scale * _norm(normal):
        new = operator(basis[k])
        k += 1
        hessenberg[:k, k - 1] = along = basis[:k] @ new
        new -= along @ basis[:k]
        length = _norm(new)
        if not length > 1e-14 * _norm(along):  # nothing new: the equation is solved, or singular
            break
        hessenberg[k, k - 1] = length
        basis[k] = new / length
        normal[k] = -(normal[:k] @ along) / length
    goal, matrix = norm * np.eye(k + 1, 1)[:, 0], hessenberg[: k + 1, :k]
    if not np.all(np.isfinite(matrix)) or not np.isfinite(norm):
        return np.full_like(right, np.nan), k + 1, np.inf
    weights = np.linalg.lstsq(matrix, goal)[0]
    return right + weights @ basis[:k], k + 1, _norm(goal - matrix @ weights) / scale


def _norm(vector: Array) -> float:
    return math.sqrt(vector @ vector)
