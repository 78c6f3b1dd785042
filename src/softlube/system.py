"""The coupled equations of one problem on one grid: what Newton's method is given.

Unknowns are the pressures at the cell centres and, under load control, the height h₀ of the sphere.  The film follows from them
by (6b) and (6c), so the Jacobian of the Reynolds residual R(p, u) is ∂R/∂p + ∂R/∂u · ∂u/∂p, exact and dense.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from softlube.elasticity import HalfSpace, half_space, rim_slice
from softlube.grid import PolarGrid
from softlube.limits import HERTZ_LOAD, hertz_pressure
from softlube.problem import Problem
from softlube.reynolds import ReynoldsOperator

Array = NDArray[np.floating]

FILM_KEPT = 0.2
"""A step may lower the film to this fraction of itself at most, anywhere."""


@lru_cache(maxsize=6)
def _operators(grid: PolarGrid, cavitation: str) -> tuple[HalfSpace, ReynoldsOperator]:
    return half_space(grid, cavitation), ReynoldsOperator.on(grid)


def forget_operators() -> None:
    """Free the memory of the operators kept for grids that may come again."""
    _operators.cache_clear()


class ContactSystem:
    """Discrete equations (6a)-(6c) with the cavitation condition and the far field.

    Under load control lengths are normalised with the Hertz indentation δ of the load, so that β is β_load, ∫p dA = 4/(3π)
    and h₀ is an unknown; otherwise with |h₀|, so that h₀ = −1.

    Parameters
    ----------
    problem : Problem
    grid : PolarGrid
    """

    def __init__(self, problem: Problem, grid: PolarGrid) -> None:
        self.problem = problem
        self.grid = grid
        self.speed = 1 / problem.parameter
        self.substrate, self.reynolds = _operators(grid, problem.cavitation)
        self.influence = self.substrate.influence[:, : grid.n_unknown]
        n, load_controlled = grid.n_unknown, problem.load_controlled
        self.constrained = np.zeros(n + load_controlled, dtype=bool)
        self.constrained[:n] = problem.cavitation == "reynolds"
        # The far field, and with it the film, is linear in h₀: value = [0] + h₀ [1].
        rim = rim_slice(grid)
        far = self.speed * self.substrate.far_pressure[:, rim]
        self.rim_pressure = far
        self.film_offset = self.speed * self.substrate.far_displacement + far @ self.substrate.influence[:, rim].T
        self.film_offset[0] += np.repeat(grid.r**2 / 2, grid.shape[1])
        self.film_offset[1] += 1
        self.load_offset = self.speed * self.substrate.far_load + far @ self.substrate.load_weights[rim]

    def height(self, x: Array) -> float:
        """Height h₀ of the sphere's lowest point."""
        return float(x[-1]) if self.problem.load_controlled else -1.0

    def pressure(self, x: Array) -> Array:
        """Pressure on all nodes, shape (n,)."""
        return np.concatenate([x[: self.grid.n_unknown], self.rim_pressure[0] + self.height(x) * self.rim_pressure[1]])

    def film(self, x: Array) -> Array:
        """Film thickness on all nodes, Eq. (6c), shape (n,)."""
        return self.influence @ x[: self.grid.n_unknown] + self.film_offset[0] + self.height(x) * self.film_offset[1]

    def load(self, x: Array) -> float:
        """Load ∫p dA over the whole plane."""
        n = self.grid.n_unknown
        return float(self.substrate.load_weights[:n] @ x[:n] + self.load_offset[0] + self.height(x) * self.load_offset[1])

    def linearise(self, x: Array) -> LinearisedContact:
        """Residual and Jacobian at x."""
        return LinearisedContact(self, x)

    def start(self) -> Array:
        """First guess: Hertz contacts of radii spread over the boundary layer, under which the film is positive everywhere.

        The superposition is smooth at the scale β^(−2/5) of the layer, and its strength lifts the film at the centre to
        β^(−3/5), as in the Hertz limit.
        """
        beta = max(self.problem.parameter, 1.0)
        layer = min(0.5, 1.5 * beta**-0.4)
        radius = 1 + layer * np.cos(np.pi * (np.arange(20) + 0.5) / 20)
        profile = hertz_pressure(self.grid.r[: self.grid.n_r, None], radius).mean(axis=1)
        strength = (1 + beta**-0.6) / np.mean(radius**2)
        pressure = np.repeat(profile * strength, self.grid.shape[1])
        return np.append(pressure, -1.0) if self.problem.load_controlled else pressure


@dataclass(frozen=True)
class LinearisedContact:
    """Residual and exact Jacobian of a `ContactSystem` at x; see `softlube.newton.Linearised`."""

    system: ContactSystem
    x: Array

    @cached_property
    def film(self) -> Array:
        """Film thickness on all nodes."""
        return self.system.film(self.x)

    @cached_property
    def residual(self) -> Array:
        """Reynolds residual at the unknown nodes, then the load's defect under load control."""
        system = self.system
        reynolds = system.reynolds.residual(system.pressure(self.x), self.film, system.speed)
        return np.append(reynolds, system.load(self.x) - HERTZ_LOAD) if system.problem.load_controlled else reynolds

    @cached_property
    def _derivatives(self):
        system = self.system
        return system.reynolds.derivatives(system.pressure(self.x), self.film, system.speed)

    @cached_property
    def scale(self) -> Array:
        """Diagonal of ∂R/∂p at fixed film."""
        diagonal = np.abs(self._derivatives[0].diagonal()) + 1e-300
        return np.append(diagonal, 1.0) if self.system.problem.load_controlled else diagonal

    def times(self, step: Array) -> Array:
        """Jacobian times a vector."""
        system, n = self.system, self.system.grid.n_unknown
        by_pressure, by_film = self._derivatives
        result = by_pressure[:, :n] @ step[:n] + by_film @ (system.influence @ step[:n])
        if not system.problem.load_controlled:
            return result
        load = system.substrate.load_weights[:n] @ step[:n] + step[-1] * system.load_offset[1]
        return np.append(result + step[-1] * self._by_height, load)

    @property
    def _by_height(self) -> Array:
        system = self.system
        by_pressure, by_film = self._derivatives
        return by_film @ system.film_offset[1] + by_pressure[:, rim_slice(system.grid)] @ system.rim_pressure[1]

    def dense(self, free: NDArray[np.intp]) -> Array:
        """Rows and columns `free` of the Jacobian, Fortran-ordered for LAPACK."""
        system, n = self.system, self.system.grid.n_unknown
        by_pressure, by_film = self._derivatives
        wet = free[free < n]
        size = wet.size
        matrix = np.empty((free.size, free.size), order="F")
        matrix[:size, :size] = by_film[wet] @ np.take(system.influence, wet, axis=1)
        sparse_part = by_pressure[wet][:, wet].tocoo()
        matrix[sparse_part.row, sparse_part.col] += sparse_part.data
        if system.problem.load_controlled:
            matrix[:size, -1] = self._by_height[wet]
            matrix[-1, :size] = system.substrate.load_weights[wet]
            matrix[-1, -1] = system.load_offset[1]
        return matrix

    def longest_step(self, step: Array) -> float:
        """Fraction of the step down to which the film keeps `FILM_KEPT` of its thickness everywhere."""
        system = self.system
        change = system.influence @ step[: system.grid.n_unknown]
        if system.problem.load_controlled:
            change = change + step[-1] * system.film_offset[1]
        falling = change < 0
        if not falling.any():
            return 1.0
        return min(1.0, float(np.min((1 - FILM_KEPT) * self.film[falling] / -change[falling])))
