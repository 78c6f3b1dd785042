"""Elasticity of the substrate: from pressure to surface displacement, Eqs. (2) and (6b).

In polar coordinates the kernel depends on θ − θ′ only, so each harmonic p_m(r) cos mθ of the pressure displaces the surface by
one of the same order, w_m(r) = −∫ k_m(r, r′) p_m(r′) r′ dr′.  On a half-space k_m is a ring's potential, singular like
ln|r − r′| (`softlube.discretization.potentials`); other substrates add a smooth remainder.  The integrals are taken in
`softlube.discretization.radial`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from softlube.discretization.grid import RIM, PolarGrid
from softlube.discretization.potentials import ring_kernels
from softlube.discretization.radial import EVERY_ORDER, radial_operators, sampled_orders
from softlube.model.exact import far_field_profile
from softlube.model.substrates import Remainder

Array = NDArray[np.floating]

BEYOND_NYQUIST = 1.15
"""Number of harmonics over π divided by the smallest angular interval, the highest harmonic that this interval resolves.

At β = 10⁸ 1.3 and 1.6 change quantities by 10⁻⁵ at most, 1.0 by 2·10⁻⁵ (docs/notes/numerical-method.md)."""
ORDERS, RINGS, UNSEEN = 64, 28, 1e-7
"""Orders and rings of a block of `HighHarmonics`, and what is left out of it over the largest entry of a row.

At β = 10⁸ the blocks hold half of all entries; smaller ones hold less and are slower."""
FINE_ANGLES = 4000
"""Points on the half-circle for the cosine coefficients of the far field's profile, whose second derivative jumps."""


def angular_transform(grid: PolarGrid) -> tuple[Array, Array]:
    """Matrices between nodal values in θ and cosine coefficients.

    The nodal values define a trigonometric polynomial in the uniform coordinate s; its coefficients in cos mθ are computed by
    the trapezoidal rule, which converges geometrically here.

    Returns
    -------
    synthesis : ndarray, shape (n_theta + 1, n_modes)
        cos(mθ_k).
    analysis : ndarray, shape (n_modes, n_theta + 1)
        Nodal values to coefficients.
    """
    m_nodal = np.arange(grid.n_theta + 1)
    half = np.where((m_nodal == 0) | (m_nodal == grid.n_theta), 0.5, 1.0)
    nodal = np.cos(np.outer(m_nodal, grid.s)) * half * half[:, None] * 2 / grid.n_theta
    n_modes = 1 + max(grid.n_theta, int(BEYOND_NYQUIST * np.pi / np.min(np.diff(grid.theta))))
    n_fine = 4 * n_modes
    s = np.arange(n_fine + 1) * np.pi / n_fine
    weight = np.full(n_fine + 1, 2.0 / n_fine)
    weight[[0, -1]] /= 2
    m = np.arange(n_modes)
    analysis = (np.cos(np.outer(m, grid.theta_of(s))) * (weight * grid.dtheta_ds(s))) @ (np.cos(np.outer(s, m_nodal)) @ nodal)
    analysis[0] /= 2
    return np.cos(np.outer(grid.theta, m)), analysis


@dataclass(frozen=True)
class ElasticOperator:
    """Displacement of a substrate under the nodal pressures of a grid and the far field beyond it.

    Attributes
    ----------
    radial : ndarray, shape (n_low, N, N)
        Ring operators of the low harmonics, see `radial_operators`; N radii with the rim.
    radial_high : HighHarmonics
        Ring operators of the other harmonics.
    synthesis, analysis : ndarray
        From harmonics to nodal values in θ and back, see `angular_transform`.
    load_weights : ndarray, shape (n,)
        Weights of ∫p dA over the disc inside the outermost node, whole plane (both halves); n nodes with the rim.
    far_pressure : ndarray, shape (2, n)
        Far field at the nodes per unit of 1/β: p = (far_pressure[0] + h₀ far_pressure[1])/β.
    far_displacement : ndarray, shape (2, n)
        Displacement, sign reversed, by the far field beyond the outermost node; the rows are as in `far_pressure`.
    far_load : ndarray, shape (2,)
        Load carried beyond the outermost node; the entries are as the rows of `far_pressure`.
    """

    radial: Array
    radial_high: HighHarmonics
    synthesis: Array
    analysis: Array
    load_weights: Array
    far_pressure: Array
    far_displacement: Array
    far_load: Array

    def deflection(self, pressure: Array) -> Array:
        """Displacement of the surface, sign reversed, at all nodes under nodal pressures, Eq. (6b).

        Parameters
        ----------
        pressure : ndarray, shape (k,)
            On the innermost rings, as many as there are; zero beyond.  Harmonic by harmonic, so that this costs the number of
            harmonics times the square of the number of rings.

        Returns
        -------
        ndarray, shape (n,)
        """
        n_low, n_rings, n_angles = len(self.radial), self.radial.shape[1], self.analysis.shape[1]
        harmonics = np.zeros((self.analysis.shape[0], n_rings), dtype=pressure.dtype)
        rings = pressure.reshape(-1, n_angles)
        np.matmul(self.analysis, rings.T, out=harmonics[:, : len(rings)])
        low = np.matmul(self.radial, harmonics[:n_low, :, None])[:, :, 0]
        displaced = np.concatenate([low, self.radial_high @ harmonics[n_low:]])
        return (self.synthesis @ displaced).T.ravel()

    def ring_coupling(self, target: int, sources: slice) -> Array:
        """Matrices from the pressures on some rings to the deflection of one, shape (number of sources, n_angles, n_angles)."""
        radial = np.concatenate([self.radial[:, target, sources], self.radial_high.row(target)[:, sources]])
        return np.matmul(self.synthesis * radial.T[:, None, :], self.analysis)


@dataclass(frozen=True)
class HighHarmonics:
    """Ring operators of harmonics that reach a few rings only: those of some orders and some rings, from the rings they reach.

    They are most of the work, and so small a part of the displacement that single precision changes films by 10⁻⁹.

    Attributes
    ----------
    shape : tuple of int
        Number of orders and of rings.
    blocks : tuple of (slice, slice, slice, ndarray)
        Orders, target rings, source rings, and the matrices between them in single precision.
    """

    shape: tuple[int, int]
    blocks: tuple[tuple[slice, slice, slice, Array], ...]

    @classmethod
    def of(cls, weights: Array, sampled: Array) -> HighHarmonics:
        """The operators that some weights, shape (orders, sampled), make of sampled ones, shape (sampled, rings, rings)."""
        shape, blocks = (len(weights), sampled.shape[1]), []
        for order in range(0, shape[0], ORDERS):
            orders = slice(order, min(order + ORDERS, shape[0]))
            whole = (weights[orders] @ sampled.reshape(len(sampled), -1)).reshape(-1, *sampled.shape[1:])
            reached = np.any(np.abs(whole) > UNSEEN * np.max(np.abs(whole), axis=2, keepdims=True), axis=0)
            for ring in range(0, shape[1], RINGS):
                targets = slice(ring, min(ring + RINGS, shape[1]))
                near = np.flatnonzero(reached[targets].any(axis=0))
                sources = slice(int(near[0]), int(near[-1]) + 1)
                blocks.append((orders, targets, sources, whole[:, targets, sources].copy()))
        return cls(shape, tuple(blocks))

    def __matmul__(self, harmonics: Array) -> Array:
        """Displacement, shape (orders, rings), by the harmonics of the pressure on the rings."""
        kind = self.blocks[0][3].dtype if self.blocks else harmonics.dtype
        result, harmonics = np.empty(self.shape, kind), harmonics.astype(kind)
        for orders, targets, sources, matrices in self.blocks:
            result[orders, targets] = np.matmul(matrices, harmonics[orders, sources, None])[:, :, 0]
        return result

    def row(self, target: int) -> Array:
        """What the displacement of one ring takes from all, shape (orders, rings)."""
        result = np.zeros(self.shape)
        for orders, targets, sources, matrices in self.blocks:
            if targets.start <= target < targets.stop:
                result[orders, sources] = matrices[:, target - targets.start]
        return result


def elastic_operator(grid: PolarGrid, cavitation: str, remainder: Remainder | None = None) -> ElasticOperator:
    """Assemble the elastic operator of a grid, Eq. (6b): the half-space's, or that of the substrate with a given remainder."""
    synthesis, analysis = angular_transform(grid)
    n_modes = analysis.shape[0]
    orders, spread = sampled_orders(n_modes)
    kernels, weights = radial_operators(grid, orders, remainder)
    single = spread[EVERY_ORDER:].astype(np.float32), kernels.astype(np.float32)

    # Beyond the contact u = h₀ + r²/2 up to O(1/r), so p = f(θ)/(βr³)·(1 − 4h₀/r²), Eq. (9) with its first correction
    # (from Kapitza's solution).  With r′ = a/t the integral over (a, ∞) becomes one over t in (0, 1).
    profile = far_field_profile(grid.theta, cavitation)
    far_pressure = np.stack([np.outer(grid.r**-3.0, profile), np.outer(-4 * grid.r**-5.0, profile)]).reshape(2, -1)
    a = grid.r[-1]
    x, x_weight = leggauss(24)
    t = 1 - ((x + 1) / 2) ** 3
    dt = 3 * ((x + 1) / 2) ** 2 * x_weight / 2
    kernel = ring_kernels(orders, grid.r[:, None], a / t)
    if remainder is not None:
        kernel += remainder.ring_remainder(orders, grid.r[:, None], a / t)
    kernel *= dt / a
    # The profile has a kink in its second derivative at the front, so its coefficients are taken on a fine mesh.
    angle = (np.arange(FINE_ANGLES) + 0.5) * np.pi / FINE_ANGLES
    profile = far_field_profile(angle, cavitation)
    waves = np.fft.rfft(np.concatenate([profile, profile[::-1]]))[:n_modes]
    harmonics = (waves * np.exp(-0.5j * np.pi / FINE_ANGLES * np.arange(n_modes))).real / FINE_ANGLES
    harmonics[0] /= 2
    parts = spread @ np.stack([kernel.sum(-1), kernel @ (-4 * (t / a) ** 2)])
    far_displacement = (parts.swapaxes(1, 2) @ (harmonics[:, None] * synthesis.T)).reshape(2, -1)

    return ElasticOperator(
        radial=kernels[: min(n_modes, EVERY_ORDER)].copy(),
        radial_high=HighHarmonics.of(*single),
        synthesis=synthesis,
        analysis=analysis,
        load_weights=2 * np.pi * np.outer(weights, analysis[0]).ravel(),
        far_pressure=far_pressure,
        far_displacement=far_displacement,
        far_load=2 * np.pi * harmonics[0] * np.array([1 / a, -4 / (3 * a**3)]),
    )


def rim_slice(grid: PolarGrid) -> slice:
    """The rim nodes in a flattened field."""
    return slice(grid.n_unknown, grid.n_unknown + RIM * grid.shape[1])
