"""The Reynolds equation (1b), (6a) on the polar grid, conservative and of fourth order.

    ∇·(ρφu³∇p) + (1/β) ∂(ρu)/∂x = 0,

ρ the density and φ = η₀/η(p) the liquid's fluidity, 1 in the paper, and φ∇p = ∇q with the reduced pressure q of
`softlube.model.liquids`.  In the uniform coordinates (ξ, s) the flux f = ρu³∇q + (ρu/β) e_x balances as
∂_ξ(θ′ r f_r) + ∂_s(r′ f_θ) = 0 with r′ = dr/dξ and θ′ = dθ/ds.  Fluxes live on the faces of the cells: gradient and film come
from the four nearest nodes, the divergence from the four nearest faces.  The metric factors of the Couette flux are
differences of sin θ and r themselves, so that a uniform film carries no pressure, exactly.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from softlube.discretization.grid import PolarGrid
from softlube.model.liquids import Liquid, NewtonianLaw

Array = NDArray[np.floating]
Sparse = sparse.csr_array

CONSTANT = NewtonianLaw()

# Staggered formulas of fourth order: value and derivative half-way between nodes, offsets from the face −2, −1, 0, 1.
MIDPOINT = {-2: -1 / 16, -1: 9 / 16, 0: 9 / 16, 1: -1 / 16}
UPSTREAM = {-2: 1 / 16, -1: -3 / 16, 0: 3 / 16, 1: -1 / 16}
"""Added to `MIDPOINT`, it gives the value of the quadratic through two nodes upstream (at higher index) and one downstream.

Third order, upwind-biased, as in the QUICK scheme (Leonard 1979)."""
SLOPE = {-2: 1 / 24, -1: -27 / 24, 0: 27 / 24, 1: -1 / 24}


def _kron(left: Array, right: Array) -> Sparse:
    """Sparse Kronecker product of two small dense matrices."""
    return sparse.csr_array(sparse.kron(sparse.csr_array(left), sparse.csr_array(right)))


def scaled_rows(matrix: Sparse, factor: Array) -> Sparse:
    """A sparse matrix with each row multiplied by a factor: diag(factor) @ matrix."""
    return sparse.csr_array(
        (matrix.data * np.repeat(factor, np.diff(matrix.indptr)), matrix.indices, matrix.indptr), matrix.shape
    )


def scaled_columns(matrix: Sparse, factor: Array) -> Sparse:
    """A sparse matrix with each column multiplied by a factor: matrix @ diag(factor)."""
    return sparse.csr_array((matrix.data * factor[matrix.indices], matrix.indices, matrix.indptr), matrix.shape)


def _radial(formula: dict[int, float], n_out: int, n_in: int, first: int, mirror: int) -> tuple[Array, Array]:
    """Matrix of a formula along r, split in the part from its own side and the part from across the centre.

    Output i takes input i + first + offset; input j < 0 is the mirror image of input mirror − j.
    """
    own, across = np.zeros((2, n_out, n_in))
    for i in range(n_out):
        for offset, weight in formula.items():
            j = i + first + offset
            (own if j >= 0 else across)[i, j if j >= 0 else mirror - j] += weight
    return own, across


def _angular(formula: dict[int, float], n_out: int, n_in: int, first: int, on_axis: bool, sign: int) -> Array:
    """Matrix of a formula along θ, reflected at θ = 0 and π with the given parity; inputs on the axis, or half-way."""
    matrix = np.zeros((n_out, n_in))
    for k in range(n_out):
        for offset, weight in formula.items():
            j, parity = k + first + offset, 1
            last = n_in - 1
            if j < 0:
                j, parity = (-j if on_axis else -1 - j), sign
            if j > last:
                j, parity = (2 * last - j if on_axis else 2 * last + 1 - j), sign
            matrix[k, j] += parity * weight
    return matrix


@dataclass(frozen=True)
class ReynoldsOperator:
    """Differences of the Reynolds equation on one grid, as sparse matrices (residual rows: unknown nodes).

    Attributes
    ----------
    slope, midpoint : tuple of sparse matrices
        Difference of the pressure and value of the film on the radial and the angular faces.
    upstream : tuple of sparse matrices
        Added to `midpoint`, they give the upwind-biased value.
    divergence : tuple of sparse matrices
        From the fluxes on radial and angular faces to the balance of each cell.
    conductance, drag : tuple of ndarray
        Metric factors of u³∂p and of u/β on the faces.
    """

    slope: tuple[Sparse, Sparse]
    midpoint: tuple[Sparse, Sparse]
    upstream: tuple[Sparse, Sparse]
    divergence: tuple[Sparse, Sparse]
    conductance: tuple[Array, Array]
    drag: tuple[Array, Array]

    @classmethod
    def on(cls, grid: PolarGrid) -> ReynoldsOperator:
        """Build the operator of a grid."""
        n_r, n_nodes, n_angles = grid.n_r, grid.shape[0], grid.shape[1]
        n_faces = n_r + 2  # from the centre (no area) to the one beyond the last cell, which the fourth order wants
        same = np.eye(n_angles)
        flip = same[::-1]

        def both(own: Array, across: Array) -> Sparse:
            return sparse.csr_array(_kron(own, same) + _kron(across, flip))

        # The outermost face has one node beyond it, not two: second order there, where p is the far field's.
        outer = {-1: 0.5, 0: 0.5}, {-1: -1.0, 0: 1.0}
        value = [_radial(MIDPOINT, n_faces - 1, n_nodes, 0, -1), _radial(outer[0], n_faces, n_nodes, 0, -1)]
        slope = [_radial(SLOPE, n_faces - 1, n_nodes, 0, -1), _radial(outer[1], n_faces, n_nodes, 0, -1)]
        value_r = both(*(np.vstack([inner, last[-1:]]) for inner, last in zip(*value, strict=True)))
        slope_r = both(*(np.vstack([inner, last[-1:]]) / grid.d_xi for inner, last in zip(*slope, strict=True)))
        outflow, inflow = _radial(SLOPE, n_r, n_faces, 1, 0)
        balance_r = both(outflow, inflow) / grid.d_xi
        # Summed over a ring the formula leaves 1/12 of the flux through its first circle at the centre, where no liquid can
        # stay.  Without that mean the fluxes telescope exactly.
        ring = np.full(n_angles, 1 / grid.n_theta)
        ring[[0, -1]] /= 2
        lost = np.zeros((n_r, n_faces))
        lost[0, 1] = 1 / 12 / grid.d_xi
        balance_r = sparse.csr_array(balance_r - _kron(lost, np.tile(ring, (n_angles, 1))))

        n_gaps = grid.n_theta
        bias_r = both(*(np.vstack([part, np.zeros((1, n_nodes))]) for part in _radial(UPSTREAM, n_faces - 1, n_nodes, 0, -1)))
        bias_t = _angular(UPSTREAM, n_gaps, n_angles, 1, on_axis=True, sign=1)
        value_t = _angular(MIDPOINT, n_gaps, n_angles, 1, on_axis=True, sign=1)
        slope_t = _angular(SLOPE, n_gaps, n_angles, 1, on_axis=True, sign=1) / grid.d_s
        balance_t = _angular(SLOPE, n_angles, n_gaps, 0, on_axis=False, sign=-1) / grid.d_s
        inner = np.eye(n_r, n_nodes)

        r, r_face = grid.r[:n_r], grid.r_face[:n_faces]
        theta_face = grid.theta_of(grid.s_face)
        cosine = balance_t @ np.sin(theta_face)  # θ′ cos θ
        stretch = (outflow - inflow) @ r_face / grid.d_xi  # r′
        drag = np.outer(r_face, cosine).ravel(), -np.outer(stretch, np.sin(theta_face)).ravel()
        return cls(
            slope=(slope_r, _kron(inner, slope_t)),
            midpoint=(value_r, _kron(inner, value_t)),
            # The liquid comes from +x: a face whose drag is positive has its upstream nodes at higher index.
            upstream=(scaled_rows(bias_r, np.sign(drag[0])), scaled_rows(_kron(inner, bias_t), np.sign(drag[1]))),
            divergence=(balance_r, _kron(np.eye(n_r), balance_t)),
            conductance=(
                np.outer(r_face / grid.dr_dxi(r_face), grid.dtheta_ds(grid.s)).ravel(),
                np.outer(grid.dr_dxi(r) / r, 1 / grid.dtheta_ds(grid.s_face)).ravel(),
            ),
            drag=drag,
        )

    def residual(self, pressure: Array, film: Array, speed: float, liquid: Liquid = CONSTANT) -> Array:
        """Minus the balance of (6a) at the unknown nodes; positive where the film would be starved (p = 0).

        Parameters
        ----------
        pressure, film : ndarray, shape (n,)
            On all nodes, rim included.
        speed : float
            1/β, the normalised speed.
        liquid : Liquid
            Of its reduced pressure q and its density ρ the flux is ρu³∇q.

        Notes
        -----
        A difference of the pressure times a fluidity between the nodes is wrong where the fluidity falls by orders of
        magnitude from one to the next, and lets the solution hang on which node is highest; a difference of q is bounded.

        Where the fluidity goes to zero nothing but ∂(ρu)/∂x is left of the equation, and a central formula does not see a film
        that alternates from node to node.  So the transported ρu is upwind-biased there, with the weight 1 − φ: not at
        all for constant viscosity.
        """
        balance = 0.0
        for face in self._faces(pressure, film, liquid):
            poiseuille = face.density * face.conductance * face.film**3 * face.gradient
            balance = balance + face.divergence @ (poiseuille + speed * face.drag * (face.carried + face.weight * face.bias))
        return -np.asarray(balance)

    def derivatives(self, pressure: Array, film: Array, speed: float, liquid: Liquid = CONSTANT) -> tuple[Sparse, Sparse]:
        """Exact derivatives of `residual` by pressure and by film, each (unknown nodes, all nodes), sparse."""
        shape = (self.divergence[0].shape[0], self.slope[0].shape[1])
        by_reduced, by_film, by_weight, by_density = (sparse.csr_array(shape) for _ in range(4))
        fluidity, thickening = liquid.fluidity(pressure)  # q′(p) and its change
        density, stiffness = liquid.density(pressure)
        compressible = np.any(stiffness)
        for face in self._faces(pressure, film, liquid):
            mobility = face.conductance * face.film**3
            carried = scaled_rows(face.midpoint, speed * face.drag)  # ∂/∂(ρu)
            if np.any(face.weight):
                carried = Sparse(carried + scaled_rows(face.upstream, speed * face.drag * face.weight))
                steep = np.where((face.weight > 0) & (face.weight < 1), speed * face.drag * face.bias, 0.0)
                by_weight = by_weight - face.divergence @ scaled_rows(face.midpoint, steep)
            if compressible:
                pressed = scaled_rows(face.midpoint, mobility * face.gradient)
                by_density = by_density - face.divergence @ (pressed + scaled_columns(carried, film))
                carried = scaled_columns(carried, density)
            pushed = scaled_rows(face.midpoint, 3 * face.density * face.conductance * face.film**2 * face.gradient)
            by_reduced = by_reduced - face.divergence @ scaled_rows(face.slope, face.density * mobility)
            by_film = by_film - face.divergence @ (pushed + carried)
        if not (np.any(thickening) or compressible):
            return by_reduced, by_film
        by_pressure = scaled_columns(by_reduced, fluidity) + scaled_columns(by_weight, -thickening)
        return Sparse(by_pressure + scaled_columns(by_density, stiffness)), by_film

    def _faces(self, pressure: Array, film: Array, liquid: Liquid) -> Iterator[_Faces]:
        """What `residual` and `derivatives` need on the radial faces, then on the angular ones."""
        parts = (self.slope, self.midpoint, self.upstream, self.divergence, self.conductance, self.drag)
        reduced, fluidity = liquid.reduced_pressure(pressure), liquid.fluidity(pressure)[0]
        density = liquid.density(pressure)[0]
        for slope, midpoint, upstream, divergence, conductance, drag in zip(*parts, strict=True):
            yield _Faces(
                slope,
                midpoint,
                upstream,
                divergence,
                conductance,
                drag,
                film=midpoint @ film,
                carried=midpoint @ (density * film),
                density=midpoint @ density,
                gradient=slope @ reduced,
                bias=upstream @ (density * film),
                weight=np.clip(1 - midpoint @ fluidity, 0.0, 1.0),
            )


@dataclass(frozen=True)
class _Faces:
    """Formulas and values on the faces of one direction; see `ReynoldsOperator`."""

    slope: Sparse
    midpoint: Sparse
    upstream: Sparse
    divergence: Sparse
    conductance: Array
    drag: Array
    film: Array
    carried: Array
    density: Array
    gradient: Array
    bias: Array
    weight: Array
