"""Film and pressure that depend on r only: the squeeze film on the rings of a polar grid.

Normalised as in Eq. (4) with the time in units of T = 3ηR^{3/2}/(πG H^{3/2}) (H is the unit of height), the equations have no
parameter:

    ∂u/∂t = (1/r) ∂(r φu³ ∂p/∂r)/∂r,      u = h₀ + f + K p,

but those of the substrate in K, of the fluidity φ(p), 1 for constant viscosity, and of the indenter's shape f(r), r²/2 for the
paraboloid.

The film on the nodes is the unknown, less the shape: the lift l = u − f = h₀ + K p, which keeps what a nearly rigid
indenter's small deflections say from drowning in f.  It gives the pressure by p = K⁻¹(l − h₀), and h₀ under a given load N
by ∫p dA = N, both linear.  So no algebraic equation is left for the time integrator.

A substrate with the creep compliance J₀ + ΣJᵢ (1 − e^(−t/τᵢ)) remembers s = ΣJᵢ pᵢ of the pressure,

    l = h₀ + K (J₀ p + s),      τᵢ dpᵢ/dt = p − pᵢ,

so that J₀ p + s = K⁻¹(l − h₀), whose load is J₀ N + ∫s dA.  What is remembered joins the lift: lift, s and, under a load, ∫s dA
make the state on which everything depends linearly.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.discretization.grid import RIM, PolarGrid
from softlube.discretization.radial import radial_operators
from softlube.discretization.reynolds import ReynoldsOperator
from softlube.model.creep import Creep
from softlube.model.dry import PARABOLOID
from softlube.model.film_section import film_section
from softlube.model.indenters import Shape
from softlube.model.liquids import Liquid, NewtonianLaw
from softlube.model.substrates import HalfSpaceKernel, Substrate

Array = NDArray[np.floating]
Control = Literal["load", "height"]

DECAY = 4
"""Far outside the film is the parabola and the flux that of a falling disc, so p → V/r⁴ (V speed of descent)."""
ANGLES = 6
"""Angular intervals of the grid from which the rings are taken; any number does."""


def radial_moment(liquid: Liquid, difference: Array) -> tuple[Array, Array]:
    """M of `softlube.model.film_section` where the walls do not slide, and its derivative by b."""
    section = film_section(liquid, np.stack([difference, np.zeros_like(difference)]), np.zeros_like(difference))
    return section.moment[0], section.by_difference[0, 0]


@dataclass(frozen=True)
class SqueezeFilm:
    """The discrete squeeze film; vectors live on the n rings whose film is unknown, or on all N = n + RIM, or are states.

    Attributes
    ----------
    grid : PolarGrid
        Grid of the steady solver whose radial nodes are the rings.
    control : {"load", "height"}
        What is prescribed as a function of time, q below: the load ∫p dA or the height h₀.
    shape : ndarray, shape (N,)
        Height f of the indenter's surface over its lowest point, r²/2 for the paraboloid.
    creep : Creep
        Of the substrate.
    pressure_by_state, pressure_by_drive : ndarray, shape (N, k) and (N,)
        p = pressure_by_state z + pressure_by_drive q.  The state z is the lift on n rings; if the substrate creeps, the
        remembered pressure s on them and, under a load, ∫s dA come after it.
    height_by_state, height_by_drive : ndarray, shape (k,), and float
        h₀ = height_by_state z + height_by_drive q.
    rim_by_state, rim_by_drive : ndarray, shape (RIM, k) and (RIM,)
        Lift on the RIM rings at the rim = rim_by_state z + rim_by_drive q.
    compliance : ndarray, shape (N, N)
        Deflection by pressure.
    load_weights, ring_weights : ndarray, shape (N,) and (n,)
        Weights of ∫p dA over the whole plane, of the pressure on all rings and on n of them, whose last says how it goes on.
    slope, midpoint, divergence : ndarray
        Differences of the Reynolds equation, see `softlube.discretization.reynolds.ReynoldsOperator`.
    conductance, across : ndarray
        Metric factor of u³∂p on the faces, and of ∂p/∂r in it.
    cell : ndarray, shape (n,)
        Measure of the cells: 2π ∑ cell u is the liquid's volume, and what the fluxes conserve.
    liquid : Liquid
        Its fluidity is taken at the pressure on the faces.
    """

    grid: PolarGrid
    control: Control
    shape: Array
    creep: Creep
    pressure_by_state: Array
    pressure_by_drive: Array
    height_by_state: Array
    height_by_drive: float
    rim_by_state: Array
    rim_by_drive: Array
    compliance: Array
    load_weights: Array
    ring_weights: Array
    slope: Array
    midpoint: Array
    divergence: Array
    conductance: Array
    across: Array
    cell: Array
    liquid: Liquid

    @classmethod
    def on(
        cls,
        grid: PolarGrid,
        control: Control,
        substrate: Substrate | None = None,
        liquid: Liquid | None = None,
        indenter: Shape = PARABOLOID,
    ) -> SqueezeFilm:
        """Build the equations of a grid (only its radii are used); a half-space and constant viscosity where not given."""
        grid = grid.resized(grid.n_r, ANGLES)
        n = grid.n_r
        substrate = substrate or HalfSpaceKernel()
        kernels, measure = radial_operators(grid, np.arange(1), substrate.remainder)

        # Beyond the last ring the pressure falls like r⁻⁴.  Its load is counted, its deflection (of order reach⁻³) is not.
        extend = np.vstack([np.eye(n), np.zeros((RIM, n))])
        extend[n:, -1] = (grid.r[n - 1] / grid.r[n:]) ** DECAY
        weights = 2 * np.pi * measure
        weights[-1] += 2 * np.pi * grid.r[-1] ** 2 / (DECAY - 2)
        compliance = kernels[0] @ extend
        stiffness = np.linalg.inv(compliance[:n])
        punch, ring_weights = stiffness.sum(axis=1), weights @ extend
        if control == "load":
            # A uniform shift of the film changes the load by `lift`: h₀ is eliminated.
            lift = ring_weights @ punch
            height_by_lift, height_by_drive = ring_weights @ stiffness / lift, -1 / lift
        else:
            height_by_lift, height_by_drive = np.zeros(n), 1.0
        by_film = stiffness - np.outer(punch, height_by_lift)
        by_drive = -punch * height_by_drive
        rim_by_lift, rim_by_drive = compliance[n:] @ by_film + height_by_lift, compliance[n:] @ by_drive + height_by_drive

        # All that is true of J₀ p + s, which carries J₀ times the load and ∫s dA.
        creep = substrate.creep
        states = 2 * n + (control == "load") if creep.terms else n
        lifts, remembered, more_load = np.eye(n, states), np.eye(n, states, n), np.zeros(states)
        more_load[2 * n :] = 1
        carried = creep.instantaneous if control == "load" else 1.0

        operator = ReynoldsOperator.on(grid)
        angles = grid.shape[1]
        spin = float(grid.dtheta_ds(0.0))  # the two-dimensional balance is one in s, not in θ

        def rings(matrix: Array) -> Array:
            """A matrix of the plane for what does not depend on θ."""
            return matrix[::angles].reshape(matrix.shape[0] // angles, -1, angles).sum(axis=2)

        differences, radial = operator.differences, slice((n + 2) * angles)
        divergence = rings(differences.divergence[:, radial].toarray())
        cell = grid.r[:n] * grid.dr_dxi(grid.r[:n])
        # What the balance of the innermost cell leaves out, so that the fluxes telescope, its volume leaves out too.
        cell[0] *= 11 / 12
        return cls(
            grid=grid,
            control=control,
            shape=indenter.height(grid.r),
            creep=creep,
            pressure_by_state=extend @ (by_film @ lifts - remembered + np.outer(by_drive, more_load)) / creep.instantaneous,
            pressure_by_drive=extend @ by_drive * (carried / creep.instantaneous),
            height_by_state=height_by_lift @ lifts + height_by_drive * more_load,
            height_by_drive=float(height_by_drive) * carried,
            rim_by_state=rim_by_lift @ lifts + np.outer(rim_by_drive, more_load),
            rim_by_drive=rim_by_drive * carried,
            compliance=kernels[0],
            load_weights=weights,
            ring_weights=ring_weights,
            slope=rings(differences.slope[radial].toarray()),
            midpoint=rings(differences.midpoint[radial].toarray()),
            divergence=divergence,
            conductance=operator.conductance[radial].reshape(-1, angles)[:, 0] / spin,
            across=1 / grid.dr_dxi(grid.r_face[: n + 2]),
            cell=cell,
            liquid=liquid or NewtonianLaw(),
        )

    @property
    def n(self) -> int:
        """Number of rings whose film is unknown."""
        return self.grid.n_r

    def pressure(self, state: Array, drive: ArrayLike) -> Array:
        """Pressure on all N rings, (..., N), in some states, (..., k), and under what is prescribed with each."""
        return state @ self.pressure_by_state.T + np.multiply.outer(drive, self.pressure_by_drive)

    def height(self, state: Array, drive: ArrayLike) -> Array:
        """Height h₀ of the sphere's lowest point over the undeformed surface."""
        return state @ self.height_by_state + np.multiply(drive, self.height_by_drive)

    def load(self, pressure: Array) -> float:
        """∫p dA over the whole plane."""
        return float(self.load_weights @ pressure)

    def whole_film(self, state: Array, drive: ArrayLike) -> Array:
        """Film on all N rings, (..., N)."""
        rim = state @ self.rim_by_state.T + np.multiply.outer(drive, self.rim_by_drive)
        return self.shape + np.concatenate([state[..., : self.n], rim], axis=-1)

    def lift_under(self, pressure: Array, height: float) -> Array:
        """Lift on the n rings under a pressure on all N that has acted for long, Eq. (6c)."""
        return height + (self.compliance @ pressure)[: self.n]

    @cached_property
    def _on_faces(self) -> tuple[Array, Array, Array, Array]:
        """Film and slope of the pressure on the faces by the state, (faces, k), and by the drive, (faces,)."""
        film_by_state = self.midpoint[:, self.n :] @ self.rim_by_state
        film_by_state[:, : self.n] += self.midpoint[:, : self.n]
        film_by_drive = self.midpoint[:, self.n :] @ self.rim_by_drive
        return film_by_state, film_by_drive, self.slope @ self.pressure_by_state, self.slope @ self.pressure_by_drive

    @cached_property
    def _shape_on_faces(self) -> Array:
        return self.midpoint @ self.shape

    def _films_and_slopes(self, state: Array, drive: float) -> tuple[Array, Array]:
        film_by_state, film_by_drive, slope_by_state, slope_by_drive = self._on_faces
        film = self._shape_on_faces + film_by_state @ state + drive * film_by_drive
        return film, slope_by_state @ state + drive * slope_by_drive

    def _fluidity(self, state: Array, drive: float) -> tuple[Array, Array]:
        """Fluidity on the faces, and its change with the pressure there."""
        if isinstance(self.liquid, NewtonianLaw):
            return np.ones(1), np.zeros(1)
        return self.liquid.fluidity(self.midpoint @ self.pressure(state, drive))

    def _driven(self, state: Array, drive: float) -> tuple[Array, Array, Array, Array]:
        """Flux on the faces, and its derivatives by the slope of the pressure, by the film and by the pressure there.

        A liquid that thins with shear has φu²m/6 in place of φu³∂p/∂r, see `softlube.model.film_section`.
        """
        film, slope = self._films_and_slopes(state, drive)
        fluidity, thickening = self._fluidity(state, drive)
        if not self.liquid.thins:
            mobility = self.conductance * film**3
            pushed = 3 * self.conductance * fluidity * film**2 * slope
            return mobility * fluidity * slope, mobility * fluidity, pushed, mobility * thickening * slope
        moment, mobility = radial_moment(self.liquid, difference := 6 * film * slope * self.across)
        size = self.conductance / self.across * film / 6
        return (
            size * fluidity * film * moment,
            self.conductance * fluidity * film**3 * mobility,
            size * fluidity * (2 * moment + mobility * difference),
            size * thickening * film * moment,
        )

    def flux(self, state: Array, drive: float) -> Array:
        """Flux r φu³ ∂p/∂r on the faces: the inflow, over 2π."""
        return self._driven(state, drive)[0]

    def flux_derivative(self, state: Array, drive: float) -> Array:
        """∂flux/∂z, exact, shape (faces, k)."""
        _, by_slope, by_film, by_pressure = self._driven(state, drive)
        film_by_state, _, slope_by_state, _ = self._on_faces
        by_state = by_film[:, None] * film_by_state
        by_state += by_slope[:, None] * slope_by_state
        if np.any(by_pressure):
            by_state += by_pressure[:, None] * self._pressure_on_faces
        return by_state

    @cached_property
    def _pressure_on_faces(self) -> Array:
        """Pressure on the faces by the state."""
        return self.midpoint @ self.pressure_by_state

    def rate(self, flux: Array) -> Array:
        """∂u/∂t on the n rings from the fluxes (or its derivatives, from theirs)."""
        return (self.divergence @ flux) / (self.cell if flux.ndim == 1 else self.cell[:, None])

    def inflow_weights(self, rings: int) -> Array:
        """Weights that make of the fluxes the growth of the volume within a number of rings; zero but near its edge."""
        weights = 2 * np.pi * self.grid.d_xi * self.divergence[:rings].sum(axis=0)
        return np.where(np.abs(weights) > 1e-9, weights, 0.0)

    def volume_weights(self, rings: int) -> Array:
        """Weights of the liquid's volume within a number of rings, shape (n,)."""
        return np.where(np.arange(self.n) < rings, 2 * np.pi * self.grid.d_xi * self.cell, 0.0)
