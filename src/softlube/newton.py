"""Semismooth Newton method for complementarity problems; knows vectors, no physics.

Find x with, for every constrained unknown, x ≥ 0, R(x) ≥ 0 and x·R(x) = 0, and R(x) = 0 for the others.  With scales c > 0
this is x = max(0, x − R/c): the unknowns with x − R/c ≤ 0 form the active set, where the step goes to x = 0; on the others
Newton's equation holds.  The active set settles after a few steps, and the convergence is then quadratic (Hintermüller, Ito &
Kunisch 2003).
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

Array = NDArray[np.floating]
Mask = NDArray[np.bool_]

REUSE_BELOW = 3e-3
"""Relative size of a step below which the Jacobian is kept for the next one."""


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

    def dense(self, free: NDArray[np.intp]) -> Array:
        """Rows and columns `free` of the Jacobian."""
        ...

    def longest_step(self, step: Array) -> float:
        """Largest fraction of the step that keeps the state admissible."""
        ...


class System(Protocol):
    """A square system of equations with bounds."""

    constrained: Mask

    def linearise(self, x: Array) -> Linearised:
        """Evaluate residual and Jacobian."""
        ...


@dataclass(frozen=True)
class Iteration:
    """One Newton step: relative size of the full step, fraction taken, active unknowns, largest residual on the free ones."""

    step: float
    fraction: float
    n_active: int
    residual: float

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
        Whether the steps have come down to the tolerance with the active set at rest.
    history : tuple of Iteration
    """

    x: Array
    converged: bool
    history: tuple[Iteration, ...]


@dataclass(frozen=True)
class _Factorised:
    """A factorised Jacobian, to be used again while it serves."""

    active: Mask
    scale: Array
    lu: Array
    pivots: NDArray[np.intp]


def newton(system: System, start: Array, *, tolerance: float = 1e-11, max_iterations: int = 40) -> NewtonResult:
    """Solve a complementarity problem from a starting point.

    Near the solution, where the active set has settled, the last factorised Jacobian is used again as long as it shrinks the
    steps tenfold; the residual is always the exact one.

    Parameters
    ----------
    system : System
        Residual, Jacobian, bounds.
    start : ndarray
        First iterate.
    tolerance : float
        Size that the next step would have, to go by the last two, relative to the largest unknown.
    max_iterations : int
        Steps before giving up.
    """
    x = np.array(start, dtype=float)
    history: list[Iteration] = []
    factorised: _Factorised | None = None
    for _ in range(max_iterations):
        at = system.linearise(x)
        scale = at.scale if factorised is None else factorised.scale
        active = system.constrained & (x - at.residual / scale <= 0)
        settled = factorised is not None and np.array_equal(active, factorised.active)
        free = np.flatnonzero(~active)
        step = np.where(active, -x, 0.0)
        right = -at.residual[free]
        if step.any():
            right = right - at.times(step)[free]
        if not settled or factorised is None:
            lu, pivots, singular = lapack.dgetrf(at.dense(free), overwrite_a=True)
            if singular:
                break
            factorised = _Factorised(active, scale, lu, pivots)
        step[free] = lapack.dgetrs(factorised.lu, factorised.pivots, right)[0]
        if not np.all(np.isfinite(step)):
            break
        fraction = at.longest_step(step)
        size = float(np.max(np.abs(step)) / max(np.max(np.abs(x)), 1e-300))
        contraction = min(1.0, size / history[-1].step) if history else 1.0
        history.append(Iteration(size, fraction, int(active.sum()), float(np.max(np.abs(at.residual[free]), initial=0))))
        x = x + fraction * step
        if fraction == 1:
            x[active] = 0.0
        if settled and fraction == 1 and size * contraction < tolerance:
            return NewtonResult(x, True, tuple(history))
        if fraction < 1 or size > REUSE_BELOW or (settled and contraction > 0.1):
            factorised = None
        if fraction < 1e-6:
            break
    return NewtonResult(x, False, tuple(history))
