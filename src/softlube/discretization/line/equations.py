"""The equations of a lubricated line contact, and their exact Jacobian; Eqs. (6) in one dimension.

Normalised like the contact of a sphere, with the unit of height b²/R, where b is half the width of the dry contact under the
load (Hertz): lengths over b, films over b²/R, pressures over 4πG b/R (E* in place of 4G).  Then

    β u³ φ(p) p′ = −(u − m/ρ(p))       Reynolds equation, integrated once; m is the flux of mass
                                       (a liquid that thins with shear: see `softlube.discretization.line.flow`)
    u = h + x²/2 − w,  w = 2∫ p ln|x − x′| dx′       gap and elasticity of a half-plane
    ∫ p dx = 1/4                        load

The inlet is at large x.  With the Reynolds condition the film ends at x = f, where p = p′ = 0; without it, far downstream.
A half-plane's displacement has no datum, so that h is a height over a level that depends on the unit of length alone.

Unknowns are p′ at the nodes of a mesh that moves along with its downstream end, h, m, and the free boundary f.  The mesh knows
nothing of f, so that f enters the equations through the parabola alone, and Newton's method finds it with the rest.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.line.displacement import Displacement, displacement
from softlube.discretization.line.flow import NOTHING, Beyond, beyond, driven
from softlube.discretization.line.panels import Panels
from softlube.model.exact import LINE_LOAD
from softlube.model.problem import Problem
from softlube.solvers.newton import DenseEquation

Array = NDArray[np.floating]

LARGEST_FALL = 0.7
"""Part of the film that a step may take away."""


@dataclass(frozen=True)
class LineState:
    """Unknowns of a line contact.

    Attributes
    ----------
    gradient : ndarray, shape (size,)
        dp/dx at the nodes.
    height : float
        h, the height of the cylinder's lowest point over the level of the logarithm.
    flux : float
        m, the flux of mass over that of a film of height 1 under simple shear; the film at the free boundary.
    front : float
        Place x of the mesh's origin s = 0: the free boundary; without one, a place that is kept.
    """

    gradient: Array
    height: float
    flux: float
    front: float


@dataclass(frozen=True, eq=False)
class LineEquations:
    """The equations on a mesh.

    Parameters
    ----------
    problem : Problem
        A load that is prescribed, and the laws of substrate and liquid.
    panels : Panels
        The mesh; its downstream end is the free boundary at s = 0, or far downstream.
    scale : LineState
        A state that is near, for the size of the unknowns.
    """

    problem: Problem
    panels: Panels
    scale: LineState

    @property
    def beta(self) -> float:
        """β of Eq. (6d) formed with b²/R."""
        return self.problem.parameter

    @property
    def free_boundary(self) -> bool:
        """Whether the downstream end is a free boundary to be found."""
        return self.problem.cavitation == "reynolds"

    @cached_property
    def displacement(self) -> Displacement:
        """Of the substrate, on the mesh."""
        return displacement(self.problem.substrate, self.panels)

    @property
    def constrained(self) -> NDArray[np.bool_]:
        """No unknown has a bound: the free boundary is an unknown itself."""
        return np.zeros(self.panels.size + 2 + self.free_boundary, dtype=bool)

    @cached_property
    def units(self) -> Array:
        """Size of each unknown."""
        film = self.film(self.scale)[:-1]
        others = [1.0, self.scale.flux, 1.0][: 2 + self.free_boundary]
        return np.append(1 / (1 + self.beta * film**2), others)

    def vector(self, state: LineState) -> Array:
        """A state as the vector of Newton's method."""
        return np.append(state.gradient, [state.height, state.flux, state.front][: 2 + self.free_boundary]) / self.units

    def state(self, vector: Array) -> LineState:
        """The state of a vector."""
        values = vector * self.units
        n = self.panels.size
        front = float(values[n + 2]) if self.free_boundary else self.scale.front
        return LineState(values[:n], float(values[n]), float(values[n + 1]), front)

    @cached_property
    def outside(self) -> tuple[Beyond, Beyond]:
        """What lies beyond the downstream and the upstream end; nothing behind a free boundary."""
        downstream, upstream = (self.scale.front + edge for edge in self.panels.edges[[0, -1]])
        return NOTHING if self.free_boundary else beyond(self.problem, downstream), beyond(self.problem, upstream)

    @property
    def ends(self) -> Array:
        """Pressure at the downstream and at the upstream end."""
        return np.array([each.pressure for each in self.outside])

    @property
    def load_beyond(self) -> float:
        """Load beyond the mesh."""
        return sum(each.load for each in self.outside)

    def film(self, state: LineState) -> Array:
        """Film at the nodes and at the downstream end, shape (size + 1,)."""
        x = state.front + self.displacement.places
        return state.height + x**2 / 2 - self.displacement.of(state.gradient, self.ends)

    def pressure(self, state: LineState) -> Array:
        """Pressure at the nodes."""
        panels = self.panels
        return panels.integral_at_nodes @ state.gradient + panels.of_ends(panels.values_at_nodes) @ self.ends

    def linearise(self, vector: Array) -> LineLinearised:
        """Residual and Jacobian; see `softlube.solvers.newton`."""
        state, n = self.state(vector), self.panels.size
        film, pressure, gradient = self.film(state), self.pressure(state), state.gradient
        u, x = film[:-1], state.front + self.displacement.places
        flow = driven(self.problem, u, gradient, pressure)
        density, density_slope = self.problem.liquid.density(pressure)
        ends, loading = self.ends, self.displacement

        matrix = np.zeros((n + 3, n + 3))
        residual = np.zeros(n + 3)
        residual[:n] = flow.flux + u - state.flux / density
        by_film, by_pressure = flow.by_film + 1, flow.by_pressure + state.flux * density_slope / density**2
        matrix[:n, :n] = by_pressure[:, None] * self.panels.integral_at_nodes - by_film[:, None] * self.displacement.matrix[:-1]
        matrix[np.arange(n), np.arange(n)] += flow.by_gradient
        matrix[:n, n], matrix[:n, n + 1], matrix[:n, n + 2] = by_film, -1 / density, by_film * x[:-1]
        residual[n] = loading.load @ gradient + loading.load_of_ends @ ends + self.load_beyond - LINE_LOAD
        matrix[n, :n] = loading.load
        residual[n + 1] = ends[1] - ends[0] - self.panels.weights @ gradient
        matrix[n + 1, :n] = -self.panels.weights
        if self.free_boundary:  # p′ = 0 there
            residual[n + 2] = film[-1] - state.flux
            matrix[n + 2, :n] = -loading.matrix[-1]
            matrix[n + 2, n:] = 1.0, -1.0, x[-1]
        else:
            matrix, residual = matrix[:-1, :-1], residual[:-1]
        rows = np.ones(residual.size)
        rows[:n] = 1 / u
        matrix *= rows[:, None]
        matrix *= self.units
        return LineLinearised(self, film, x, state.flux, residual * rows, matrix)


@dataclass(frozen=True, eq=False)
class LineLinearised:
    """Residual and Jacobian at one state."""

    equations: LineEquations
    film: Array
    x: Array
    flux: float
    residual: Array
    matrix: Array

    @property
    def scale(self) -> Array:
        """1: no unknown has a bound."""
        return np.ones(self.residual.size)

    def times(self, step: Array) -> Array:
        """Jacobian times a vector."""
        return self.matrix @ step

    def equation(self, free: NDArray[np.bool_]) -> DenseEquation:
        """Newton's equation, by factorisation."""
        return DenseEquation.of(self.matrix, free)

    def reach(self, step: Array) -> tuple[float, float]:
        """Largest relative change of film and flux, and the fraction of the step that keeps the film open."""
        equations = self.equations
        change, n = step * equations.units, equations.panels.size
        film = change[n] - equations.displacement.matrix @ change[:n]
        if equations.free_boundary:
            film += change[n + 2] * self.x
        ratio = np.append(film / self.film, change[n + 1] / self.flux)
        falling = -np.min(ratio, initial=0.0)
        return float(np.max(np.abs(ratio))), min(1.0, LARGEST_FALL / falling) if falling > 0 else 1.0
