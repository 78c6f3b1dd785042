"""A contact whose film changes with time: the steady equations with ∂u/∂t, one implicit step at a time.

    ∂u/∂t + R(p, u) ≥ 0,     p ≥ 0,     p (∂u/∂t + R) = 0,     R = −∇·(u³∇p) − (1/β) ∂u/∂x.

Each step is a complementarity problem, which Newton's method for the steady problem solves, too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from softlube.discretization.differences import Sparse
from softlube.discretization.system import ContactSystem, LinearisedContact

Array = NDArray[np.floating]


def mass_matrix(system: ContactSystem) -> Sparse:
    """What ∂u/∂t on all nodes adds to the balances of the cells, shape (n_unknown, n).

    The balance is taken per unit of ξ and s.  In the innermost ring it leaves out 1/12 of the mean flux through the ring's
    edge (see `softlube.discretization.reynolds`), so the same share of what that flux fills is left out here.
    """
    grid = system.grid
    n, n_angles = grid.n_unknown, grid.shape[1]
    r = grid.r[: grid.n_r]
    metric = np.outer(r * grid.dr_dxi(r), grid.dtheta_ds(grid.s))
    mean = np.full(n_angles, 1 / grid.n_theta)
    mean[[0, -1]] /= 2
    first = np.diag(metric[0]) - np.outer(np.ones(n_angles), mean * metric[0]) / 12
    inner = sparse.block_diag([first, sparse.diags_array(metric[1:].ravel())])
    return Sparse(sparse.hstack([inner, sparse.csr_array((n, grid.r.size * n_angles - n))]))


@dataclass(frozen=True)
class LinearisedStep(LinearisedContact):
    """Residual and Jacobian of one implicit step, (∂u/∂t)ₙ₊₁ = weight uₙ₊₁ + known; a `softlube.solvers.newton.Linearised`."""

    mass: Sparse
    weight: float
    known: Array

    @cached_property
    def residual(self) -> Array:
        """Reynolds residual with the film's rate, then the load's defect under load control."""
        growth = self.mass @ (self.weight * self.film + self.known)
        return super().residual + (np.append(growth, 0.0) if self.system.problem.load_controlled else growth)

    @cached_property
    def scale(self) -> Array:
        """Size of the Jacobian's diagonal, with the film's rate."""
        scale, held = super().scale.copy(), self.weight * self.mass.diagonal()
        scale[: held.size] += held * self.system.self_deflection[: held.size]
        return scale

    def change(self, pressure: Array, film: Array) -> Array:
        """Change of the balances of the cells with changes of pressure and film on all nodes."""
        return super().change(pressure, film) + self.weight * (self.mass @ film)

    def balance_entries(self) -> Array:
        """Entries of the approximate Jacobian by the film, with what the cells hold."""
        entries = super().balance_entries()
        entries[self.system.balance.diagonal] += self.weight * self.mass.diagonal()
        return entries


class Step:
    """One implicit step as a `softlube.solvers.newton.System`; see `LinearisedStep`."""

    def __init__(self, system: ContactSystem, mass: Sparse, weight: float, known: Array) -> None:
        self.system, self.mass, self.weight, self.known = system, mass, weight, known
        self.constrained = system.constrained

    def linearise(self, x: Array) -> LinearisedStep:
        """Residual and Jacobian at x."""
        return LinearisedStep(self.system, x, self.mass, self.weight, self.known)


def implicit_steps(system: ContactSystem) -> Callable[[Array, float], Step]:
    """Implicit Euler steps of a contact: a function of the state before the step and the step's length.

    Time is in the unit in which the equation at the head of this module holds.
    """
    mass = mass_matrix(system)
    return lambda state, length: Step(system, mass, 1 / length, -system.film(state) / length)
