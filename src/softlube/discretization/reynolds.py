"""The Reynolds equation (1b), (6a) on the polar grid, conservative and of fourth order.

    ∇·(ρφu³∇p) + (1/β) ∂(ρu)/∂x = 0,

ρ the density and φ = η₀/η(p) the liquid's fluidity, 1 in the paper, and φ∇p = ∇q with the reduced pressure q of
`softlube.model.liquids`.  In the uniform coordinates (ξ, s) the flux f = ρu³∇q + (ρu/β) e_x balances as
∂_ξ(θ′ r f_r) + ∂_s(r′ f_θ) = 0 with r′ = dr/dξ and θ′ = dθ/ds.  Fluxes live on the faces of the cells: gradient and film come
from the four nearest nodes, the divergence from the four nearest faces.  The metric factors of the Couette flux are
differences of sin θ and r themselves, so that a uniform film carries no pressure, exactly.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from softlube.discretization.grid import PolarGrid
from softlube.model.liquids import Liquid, NewtonianLaw

Array = NDArray[np.floating]
Sparse = sparse.csr_array

CONSTANT = NewtonianLaw()


@dataclass(frozen=True)
class Formulas:
    """Staggered formulas for a uniform mesh: weights of the nodes by their offsets from a face, which lies before node 0.

    Attributes
    ----------
    midpoint, slope : mapping of int to float
        Value and derivative on the face.
    upstream : mapping of int to float
        Added to `midpoint`, it gives a value from upstream, where the index is higher.
    """

    midpoint: dict[int, float]
    slope: dict[int, float]
    upstream: dict[int, float]


FOURTH = Formulas(
    midpoint={-2: -1 / 16, -1: 9 / 16, 0: 9 / 16, 1: -1 / 16},
    slope={-2: 1 / 24, -1: -27 / 24, 0: 27 / 24, 1: -1 / 24},
    # The value of the quadratic through two nodes upstream and one downstream: third order, as in QUICK (Leonard 1979).
    upstream={-2: 1 / 16, -1: -3 / 16, 0: 3 / 16, 1: -1 / 16},
)
"""Formulas of the equation that is solved."""
SECOND = Formulas(midpoint={-1: 0.5, 0: 0.5}, slope={-1: -1.0, 0: 1.0}, upstream={-1: -0.5, 0: 0.5})
"""Formulas of second order from the nearest nodes only, for preconditioning, and at the rim."""


@dataclass(frozen=True)
class Differences:
    """Differences of one order on one grid, as sparse matrices; faces are the radial ones, then the angular ones.

    Attributes
    ----------
    slope, midpoint, upstream : sparse matrix, shape (faces, n)
        Difference and value on the faces, and what makes of the value the upwind-biased one; of one pattern.
    divergence : sparse matrix, shape (n_unknown, faces)
        From the fluxes to the balance of each cell.
    """

    slope: Sparse
    midpoint: Sparse
    upstream: Sparse
    divergence: Sparse

    @classmethod
    def on(cls, grid: PolarGrid, formulas: Formulas) -> Differences:
        """The differences on a grid by some formulas."""
        n_r, (n_nodes, n_angles), n_gaps = grid.n_r, grid.shape, grid.n_theta
        n_radial = (n_r + 2) * n_angles
        shape = n_radial + n_r * n_gaps, n_nodes * n_angles
        offsets = np.array(list(formulas.slope))
        # From the nodes to the radial faces but the outermost, through the centre to the opposite side, …
        i, k, o = (each.ravel() for each in np.indices((n_r + 1, n_angles, offsets.size)))
        ring = i + offsets[o]
        across = ring < 0
        places = [(i * n_angles + k, np.where(across, -1 - ring, ring) * n_angles + np.where(across, n_angles - 1 - k, k))]
        # … to that one, which has one node beyond it, not two, and where p is the far field's, …
        last = (n_r + 1) * n_angles + np.tile(np.arange(n_angles), 2)
        places.append((last, last - np.repeat([n_angles, 0], n_angles)))
        # … and to the angular faces, reflected at θ = 0 and π.
        gap_i, gap_k, gap_o = (each.ravel() for each in np.indices((n_r, n_gaps, offsets.size)))
        angle = np.abs(gap_k + 1 + offsets[gap_o])
        angle = np.where(angle > n_gaps, 2 * n_gaps - angle, angle)
        places.append((n_radial + gap_i * n_gaps + gap_k, gap_i * n_angles + angle))
        rows, columns = (np.concatenate(each) for each in zip(*places, strict=True))

        def matrix(name: str, radial: Array | float, outermost: Array | float, angular: float) -> Sparse:
            weights = np.array([getattr(formulas, name)[each] for each in offsets])
            end = np.repeat([getattr(SECOND, name)[-1], getattr(SECOND, name)[0]], n_angles)
            return Sparse(
                (np.concatenate([weights[o] * radial, end * outermost, weights[gap_o] * angular]), (rows, columns)), shape
            )

        # The liquid comes from +x: upstream is at higher r in the inlet half, and at lower θ.
        inlet = np.sign(np.cos(grid.theta))[k]
        return cls(
            slope=matrix("slope", 1 / grid.d_xi, 1 / grid.d_xi, 1 / grid.d_s),
            midpoint=matrix("midpoint", 1.0, 1.0, 1.0),
            upstream=matrix("upstream", inlet, 0.0, -1.0),
            divergence=_divergence(grid, formulas.slope),
        )

    @cached_property
    def face(self) -> NDArray[np.integer]:
        """The face of each entry of the pattern."""
        return np.repeat(np.arange(self.slope.shape[0]), np.diff(self.slope.indptr))

    @property
    def node(self) -> NDArray[np.integer]:
        """The node of each entry of the pattern."""
        return self.slope.indices

    @cached_property
    def span(self) -> Sparse:
        """The divergence with every weight positive."""
        return abs(self.divergence)

    @cached_property
    def diagonal(self) -> Sparse:
        """From a matrix of the pattern to the diagonal of the divergence times it, shape (n_unknown, entries)."""
        number = self.with_entries(np.arange(1.0, self.slope.nnz + 1))
        cell, face = self.divergence.nonzero()
        entry = np.asarray(number[face, cell]).astype(int) - 1
        own = entry >= 0
        shape = self.divergence.shape[0], self.slope.nnz
        return Sparse((self.divergence.data[own], (cell[own], entry[own])), shape)

    def with_entries(self, entries: Array) -> Sparse:
        """The matrix of some entries in the pattern."""
        return Sparse((entries, self.slope.indices, self.slope.indptr), self.slope.shape)


def _sloping(values: Array) -> Array:
    """Differences of fourth order of equidistant values, half-way between them."""
    n = values.size - 3
    return np.sum([weight * values[2 + offset :][:n] for offset, weight in FOURTH.slope.items()], axis=0)


def _divergence(grid: PolarGrid, slope: dict[int, float]) -> Sparse:
    """From the fluxes on the faces to the balance of each cell."""
    n_r, n_angles, n_gaps = grid.n_r, grid.shape[1], grid.n_theta
    n_radial = (n_r + 2) * n_angles
    offsets, weights = np.array(list(slope)), np.array(list(slope.values()))
    i, k, o = (each.ravel() for each in np.indices((n_r, n_angles, offsets.size)))
    circle = i + 1 + offsets[o]
    radial = np.abs(circle) * n_angles + np.where(circle < 0, n_angles - 1 - k, k)
    # Summed over a ring the fourth order leaves 1/12 of the flux through its first circle at the centre, where no liquid can
    # stay.  Without that mean the fluxes telescope exactly.
    ring = np.full(n_angles, 1 / n_gaps)
    ring[[0, -1]] /= 2
    lost = np.sum(weights[o][np.abs(circle) == 1]) / n_angles * ring
    centre, first = (each.ravel() for each in np.indices((n_angles, n_angles)))
    # Fluxes across θ = 0 and π change their sign with the side.
    gap = k + offsets[o]
    outside = (gap < 0) | (gap >= n_gaps)
    gap = np.where(gap < 0, -1 - gap, np.where(gap >= n_gaps, 2 * n_gaps - 1 - gap, gap))
    angular = np.where(outside, -weights[o], weights[o]) / grid.d_s
    cell = i * n_angles + k
    entries = np.concatenate([weights[o] / grid.d_xi, -lost[first] / grid.d_xi, angular])
    rows = np.concatenate([cell, centre, cell])
    columns = np.concatenate([radial, n_angles + first, n_radial + i * n_gaps + gap])
    divergence = Sparse((entries, (rows, columns)), (grid.n_unknown, n_radial + n_r * n_gaps))
    divergence.eliminate_zeros()
    return divergence


@dataclass(frozen=True)
class ReynoldsOperator:
    """The Reynolds equation on one grid.

    Attributes
    ----------
    differences : Differences
        Those of the equation, of fourth order.
    nearest : Differences
        Those of second order, for a preconditioner with a narrow band.
    conductance, drag : ndarray, shape (faces,)
        Metric factors of u³∂p and of u/β on the faces.
    """

    differences: Differences
    nearest: Differences
    conductance: Array
    drag: Array

    @classmethod
    def on(cls, grid: PolarGrid) -> ReynoldsOperator:
        """Build the operator of a grid."""
        n_r, n_faces = grid.n_r, grid.n_r + 2  # from the centre (no area) to the one beyond the last cell, for fourth order
        r, r_face = grid.r[:n_r], grid.r_face[:n_faces]
        theta_face = grid.theta_of(grid.s_face)
        # Metric factors are differences themselves, of functions that are odd: of sin θ, θ′ cos θ, and of r, r′.
        sine = np.sin(theta_face)
        cosine = _sloping(np.concatenate([-sine[1::-1], sine, -sine[:-3:-1]])) / grid.d_s
        stretch = _sloping(np.concatenate([-r_face[1:2], r_face])) / grid.d_xi
        radial = np.outer(r_face / grid.dr_dxi(r_face), grid.dtheta_ds(grid.s))
        angular = np.outer(grid.dr_dxi(r) / r, 1 / grid.dtheta_ds(grid.s_face))
        return cls(
            differences=Differences.on(grid, FOURTH),
            nearest=Differences.on(grid, SECOND),
            conductance=np.concatenate([radial.ravel(), angular.ravel()]),
            drag=np.concatenate([np.outer(r_face, cosine).ravel(), -np.outer(stretch, np.sin(theta_face)).ravel()]),
        )

    def at(self, pressure: Array, film: Array, speed: float, liquid: Liquid = CONSTANT) -> Flow:
        """The flow between the nodes.

        Parameters
        ----------
        pressure, film : ndarray, shape (n,)
            On all nodes, rim included.
        speed : float
            1/β, the normalised speed.
        liquid : Liquid
            Of its reduced pressure q and its density ρ the flux is ρu³∇q.
        """
        return Flow(self, pressure, film, speed, liquid)

    def residual(self, pressure: Array, film: Array, speed: float, liquid: Liquid = CONSTANT) -> Array:
        """Minus the balance of (6a) at the unknown nodes, see `Flow.residual`; the parameters are those of `at`."""
        return self.at(pressure, film, speed, liquid).residual


class Flow:
    """Fluxes between the nodes under one pressure and film, and their exact derivatives.

    A difference of the pressure times a fluidity between the nodes is wrong where the fluidity falls by orders of magnitude
    from one to the next, and lets the solution hang on which node is highest; a difference of the reduced pressure q is
    bounded.

    Where the fluidity goes to zero nothing but ∂(ρu)/∂x is left of the equation, and a central formula does not see a film
    that alternates from node to node.  So the transported ρu is upwind-biased there, with the weight 1 − φ: not at all for
    constant viscosity.

    Parameters
    ----------
    operator : ReynoldsOperator
        The differences.
    pressure, film, speed, liquid
        See `ReynoldsOperator.at`.
    """

    def __init__(self, operator: ReynoldsOperator, pressure: Array, film: Array, speed: float, liquid: Liquid) -> None:
        differences = operator.differences
        self._operator = operator
        self._drag = speed * operator.drag
        self._film = film
        self._on_faces = carried = differences.midpoint @ film
        self._gradient = differences.slope @ liquid.reduced_pressure(pressure)
        self._fluidity, self._thickening = liquid.fluidity(pressure)  # q′(p) and its change
        self._density, self._compression = liquid.density(pressure)
        self._constant = not (np.any(self._thickening) or np.any(self._compression))
        self._density_on_faces, self._weight, self._bias = np.ones(1), np.zeros(1), np.zeros(1)
        if not self._constant:
            carried = differences.midpoint @ (self._density * film)
            self._density_on_faces = differences.midpoint @ self._density
            self._weight = np.clip(1 - differences.midpoint @ self._fluidity, 0.0, 1.0)
            self._bias = differences.upstream @ (self._density * film)
        self._mobility = operator.conductance * self._on_faces**3
        poiseuille = self._density_on_faces * self._mobility * self._gradient
        self._flux = poiseuille + self._drag * (carried + self._weight * self._bias)

    @cached_property
    def residual(self) -> Array:
        """Minus the balance of (6a) at the unknown nodes; positive where the film would be starved (p = 0)."""
        return -(self._operator.differences.divergence @ self._flux)

    def entries(self, differences: Differences) -> tuple[Array, Array]:
        """Derivatives of the fluxes by pressure and by film, as entries of the pattern of some differences."""
        face, node = differences.face, differences.node
        slope, midpoint = differences.slope.data, differences.midpoint.data
        pushed = 3 * self._density_on_faces * self._operator.conductance * self._on_faces**2 * self._gradient
        by_pressure = (self._density_on_faces * self._mobility)[face] * slope
        if self._constant:
            return by_pressure, (pushed + self._drag)[face] * midpoint
        weight = self._weight
        transport = self._drag[face] * midpoint + (self._drag * weight)[face] * differences.upstream.data  # ∂/∂(ρu)
        steep = np.where((weight > 0) & (weight < 1), self._drag * self._bias, 0.0)
        pressed = (self._mobility * self._gradient)[face] * midpoint + transport * self._film[node]
        by_pressure = by_pressure * self._fluidity[node] - steep[face] * midpoint * self._thickening[node]
        by_pressure += pressed * self._compression[node]
        return by_pressure, pushed[face] * midpoint + transport * self._density[node]

    @cached_property
    def derivatives(self) -> tuple[Sparse, Sparse]:
        """Derivatives of the fluxes by pressure and by film, exact, each of shape (faces, n)."""
        differences = self._operator.differences
        by_pressure, by_film = self.entries(differences)
        return differences.with_entries(by_pressure), differences.with_entries(by_film)

    def change(self, pressure: Array, film: Array) -> Array:
        """Change of `residual` with changes of pressure and film on all nodes."""
        by_pressure, by_film = self.derivatives
        return -(self._operator.differences.divergence @ (by_pressure @ pressure + by_film @ film))

    def diagonal(self, deflection: Array) -> Array:
        """Size of the residual's derivative by the own pressure of a node.

        Parameters
        ----------
        deflection : ndarray, shape (n,)
            What the pressure on a node does to the film there.
        """
        differences = self._operator.differences
        by_pressure, by_film = self.derivatives
        own = np.abs(differences.diagonal @ by_pressure.data)
        through = Sparse((np.abs(by_film.data), by_film.indices, by_film.indptr), by_film.shape) @ deflection
        return own + differences.span @ through
