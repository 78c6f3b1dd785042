"""The elastic half-space: from pressure to surface displacement, Eqs. (2) and (6b).

In polar coordinates the kernel 1/|x − x′| depends on θ − θ′ only, so each harmonic p_m(r) cos mθ of the pressure displaces the
surface by a harmonic of the same order,

    w_m(r) = −∫ k_m(r, r′) p_m(r′) r′ dr′,      k_m(r, r′) = ∫₀^{2π} cos mφ dφ/√(r² + r′² − 2rr′ cos φ) = 2 Q_{m−1/2}(χ)/√(rr′),

with χ = (r² + r′²)/(2rr′) and Q the Legendre function of the second kind (a ring's potential).  k_m is singular like
ln|r − r′|.  The integrals are taken over a piecewise quintic interpolant of p_m by product integration: Gauss points on every
element, and points graded towards the target on the elements next to it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray
from scipy import sparse
from scipy.special import ellipe, ellipkm1

from softlube.grid import RIM, PolarGrid
from softlube.limits import far_field_profile

Array = NDArray[np.floating]

GAUSS_FAR = 4
GAUSS_NEAR = 14
NEAR = 2
"""Elements on each side of the target that get the graded rule."""
LARGEST_BATCH = 8_000_000
"""Kernel values held at a time."""
NEGLIGIBLE = 37.0
"""mη beyond which Q_{m−1/2} ~ e^{−mη} is below round-off."""
STENCIL = np.arange(-3, 3)
"""Nodes of the quintic through which p is interpolated on an element, relative to its outer node."""


def ring_kernels(n_modes: int, r: Array, r_source: Array) -> Array:
    """Ring kernels k_m(r, r′) for m = 0 … n_modes − 1.

    Parameters
    ----------
    n_modes : int
        Number of harmonics.
    r, r_source : ndarray
        Radii of target and source, positive, of shapes that broadcast; r ≠ r_source.

    Returns
    -------
    ndarray, shape (n_modes, ...)

    Notes
    -----
    The three-term recurrence of Q_{m−1/2} is stable forwards only next to χ = 1; elsewhere the ratios Q_{m+1/2}/Q_{m−1/2} come
    from the backward recurrence (Miller), started so far up that the start is forgotten to round-off.  Both are anchored at
    Q_{−1/2} and Q_{1/2}, which are complete elliptic integrals (Abramowitz & Stegun 8.13).
    """
    # (χ − 1)/2 = (r − r′)²/(4rr′) is formed without cancellation.
    excess = np.maximum((r - r_source) ** 2 / (2 * r * r_source), 1e-30)
    shape, excess = excess.shape, excess.ravel()
    chi = 1 + excess
    q = np.zeros((n_modes, excess.size))
    modulus = np.sqrt(2 / (chi + 1))
    q[0] = modulus * ellipkm1(excess / (chi + 1))
    eta = np.log1p(excess + np.sqrt(excess * (2 + excess)))  # χ = cosh η, Q_{m−1/2} falls like e^{−mη}

    forward = eta < 2.0 / n_modes
    if n_modes > 1 and forward.any():
        x = chi[forward]
        before, here = q[0, forward], x * q[0, forward] - np.sqrt(2 * (x + 1)) * ellipe(2 / (x + 1))
        q[1, forward] = here
        for m in range(1, n_modes - 1):
            before, here = here, (4 * m * x * here - (2 * m - 1) * before) / (2 * m + 1)
            q[m + 1, forward] = here

    # Octaves of η, because the number of steps until the start is forgotten goes like 1/η.
    octave = np.where(forward, -1, np.floor(np.log2(np.maximum(eta * n_modes / 2, 1))))
    for number in np.unique(octave[octave >= 0]) if n_modes > 1 else ():
        band = octave == number
        x, nearest = chi[band], eta[band].min()
        last = min(n_modes, int(NEGLIGIBLE / nearest) + 2)
        ratios = np.empty((last, x.size))
        ratios[0] = q[0, band]
        ratio = np.exp(-eta[band])
        for m in range(last + int(18.5 / nearest) + 2, 0, -1):
            ratio = (2 * m - 1) / (4 * m * x - (2 * m + 1) * ratio)
            if m < last:
                ratios[m] = ratio
        q[:last, band] = np.cumprod(ratios, axis=0)

    q = q.reshape(n_modes, *shape)
    q *= 2 / np.sqrt(r * r_source)
    return q


def _interpolation(grid: PolarGrid, element: NDArray[np.intp], xi: Array) -> tuple[NDArray[np.intp], Array]:
    """Quintic interpolation of nodal values to points of some elements.

    Parameters
    ----------
    grid : PolarGrid
        Whose nodes carry the values.
    element : ndarray, shape (n,)
        Element e lies between nodes e − 1 and e, the first one between the centre and node 0.
    xi : ndarray, shape (n, k)
        Points on each.

    Returns
    -------
    node : ndarray, shape (n, 6)
        Nodes; −1, −2, … are the mirror images of 0, 1, … beyond the centre.
    weight : ndarray, shape (n, k, 6)
        Lagrange weights.
    """
    last = grid.shape[0] - 1
    node = element[:, None] + STENCIL
    node = node - np.maximum(0, node[:, -1:] - last)
    x = xi / grid.d_xi - 0.5 - element[:, None]  # in units of the spacing, from the element's outer node
    place = (node - element[:, None])[:, None, :]
    weight = np.ones((*xi.shape, STENCIL.size))
    for a in range(STENCIL.size):
        for b in range(STENCIL.size):
            if a != b:
                weight[..., a] *= (x - place[..., b]) / (place[..., a] - place[..., b])
    return node, weight


Kernels = Callable[[int, Array, Array], Array]
"""Harmonics of a substrate's kernel, called like `ring_kernels`."""


def radial_operators(grid: PolarGrid, n_modes: int, harmonics: Kernels = ring_kernels) -> tuple[Array, Array]:
    """Product-integration matrices of the ring kernels on the nodes of the grid.

    Parameters
    ----------
    grid : PolarGrid
        Whose nodes carry the pressures.
    n_modes : int
        Number of harmonics.
    harmonics : callable
        The substrate's kernel; singular at most like ln|r − r′|.

    Returns
    -------
    kernels : ndarray, shape (n_modes, N, N)
        ``kernels[m] @ p_m`` is ∫ k_m p_m r′ dr′ up to the outermost node; N counts the rim nodes.
    weights : ndarray, shape (N,)
        ``weights @ p_0`` is ∫ p₀ r′ dr′.
    """
    n = grid.shape[0]
    edges = np.concatenate([[0.0], grid.xi])  # element e lies between edges[e] and edges[e + 1]
    parity = (-1.0) ** np.arange(n_modes)[:, None]
    gauss, gauss_weight = (np.array(a) for a in leggauss(GAUSS_FAR))
    points = edges[:-1, None] + np.diff(edges)[:, None] * (gauss + 1) / 2
    r_points = grid.r_of(points)
    measure = np.diff(edges)[:, None] * gauss_weight / 2 * grid.dr_dxi(r_points) * r_points

    every = np.arange(n)
    node, weight = _interpolation(grid, every, points)
    rows = np.broadcast_to(np.arange(n * GAUSS_FAR).reshape(n, GAUSS_FAR, 1), weight.shape)
    columns = np.broadcast_to(node[:, None, :], weight.shape)

    def gathering(own: NDArray[np.bool_], column: NDArray[np.intp]) -> sparse.csr_array:
        """From values at the points to the nodes that interpolate them, transposed."""
        return sparse.csr_array((weight[own], (column[own], rows[own])), (n, n * GAUSS_FAR))

    direct, mirror = gathering(columns >= 0, columns), gathering(columns < 0, -1 - columns)

    # Far elements: plain Gauss.  The near ones are masked out here and added below.  A few targets at a time, to save memory.
    result = np.empty((n_modes, n, n))
    gather = [sparse.csr_array(direct + sign * mirror) for sign in (1.0, -1.0)]
    batch = max(1, LARGEST_BATCH // (n_modes * n * GAUSS_FAR))
    element = np.repeat(every, GAUSS_FAR)[:, None]
    for first in range(0, n, batch):
        target = every[first : first + batch]
        near = (element > target - NEAR) & (element <= target + NEAR)
        kernel = harmonics(n_modes, grid.r[target], r_points.reshape(-1, 1))
        kernel *= np.where(near, 0, measure.reshape(-1, 1))
        for m in range(n_modes):
            result[m, target] = (gather[m % 2] @ kernel[m]).T

    # Near elements: ξ = target-side end ± L t⁴ removes the logarithm and follows kernels that are narrow for large m.
    x, x_weight = leggauss(GAUSS_NEAR)
    t, t_weight = (x + 1) / 2, x_weight / 2
    for offset in range(1 - NEAR, NEAR + 1):
        target = every[(every + offset >= 0) & (every + offset < n)]
        element = target + offset
        length = np.diff(edges)[element, None]
        xi = edges[element, None] + length * (1 - t**4 if offset <= 0 else t**4)
        r_near = grid.r_of(xi)
        jacobian = length * (4 * t**3 * t_weight) * grid.dr_dxi(r_near) * r_near
        near_kernel = harmonics(n_modes, grid.r[target, None], r_near) * jacobian
        node, weight = _interpolation(grid, element, xi)
        share = np.einsum("mpk,pkc->mpc", near_kernel, weight)
        for column in range(STENCIL.size):
            own = node[:, column] >= 0
            result[:, target[own], node[own, column]] += share[:, own, column]
            result[:, target[~own], -1 - node[~own, column]] += parity * share[:, ~own, column]

    return result, np.asarray((direct + mirror) @ measure.ravel())


def angular_transform(grid: PolarGrid) -> tuple[Array, Array]:
    """Between nodal values in θ and cosine coefficients.

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
    n_modes = 1 + max(grid.n_theta, int(1.3 * np.pi / np.min(np.diff(grid.theta))))
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
    radial : ndarray, shape (n_modes, N, N)
        Ring operators of each harmonic, see `radial_operators`; N radii with the rim.
    synthesis, analysis : ndarray
        From harmonics to nodal values in θ and back, see `angular_transform`.
    load_weights : ndarray, shape (n,)
        Weights of ∫p dA over the disc inside the outermost node, whole plane (both halves); n nodes with the rim.
    far_pressure : ndarray, shape (2, n)
        Far field at the nodes per unit of 1/β: p = (far_pressure[0] + h₀ far_pressure[1])/β.
    far_displacement : ndarray, shape (2, n)
        Displacement, sign reversed, by the far field beyond the outermost node, in the same two parts.
    far_load : ndarray, shape (2,)
        Load carried beyond the outermost node, in the same two parts.
    """

    radial: Array
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
        rings = pressure.reshape(-1, self.analysis.shape[1])
        harmonics = (self.analysis @ rings.T)[:, :, None]
        displaced = np.matmul(self.radial[:, :, : rings.shape[0]], harmonics)[:, :, 0]
        return (self.synthesis @ displaced).T.ravel()

    def ring_coupling(self, target: int, sources: slice) -> Array:
        """Deflection of one ring under pressures on some others, shape (number of sources, n_angles, n_angles)."""
        return np.matmul(self.synthesis * self.radial[:, target, sources].T[:, None, :], self.analysis)


def elastic_operator(grid: PolarGrid, cavitation: str, kernels: Kernels = ring_kernels) -> ElasticOperator:
    """Assemble the elastic operator of a grid, Eq. (6b), for the substrate with the given kernel: the half-space's if none."""
    synthesis, analysis = angular_transform(grid)
    n_modes = analysis.shape[0]
    radial, weights = radial_operators(grid, n_modes, kernels)

    # Beyond the contact u = h₀ + r²/2 up to O(1/r), so p = f(θ)/(βr³)·(1 − 4h₀/r²), Eq. (9) with its first correction
    # (from Kapitza's solution).  With r′ = a/t the integral over (a, ∞) becomes one over t in (0, 1).
    profile = far_field_profile(grid.theta, cavitation)
    far_pressure = np.stack([np.outer(grid.r**-3.0, profile), np.outer(-4 * grid.r**-5.0, profile)]).reshape(2, -1)
    a = grid.r[-1]
    x, x_weight = leggauss(24)
    t = 1 - ((x + 1) / 2) ** 3
    dt = 3 * ((x + 1) / 2) ** 2 * x_weight / 2
    kernel = kernels(n_modes, grid.r[:, None], a / t) / a * dt
    # The profile has a kink in its second derivative at the front, so its coefficients are taken on a fine mesh.
    angle = (np.arange(4000) + 0.5) * np.pi / 4000
    harmonics = np.cos(np.outer(np.arange(n_modes), angle)) @ far_field_profile(angle, cavitation) * 2 / 4000
    harmonics[0] /= 2
    parts = np.stack([kernel.sum(-1), kernel @ (-4 * (t / a) ** 2)])
    far_displacement = np.einsum("m,pmr,km->prk", harmonics, parts, synthesis).reshape(2, -1)

    return ElasticOperator(
        radial=radial,
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
