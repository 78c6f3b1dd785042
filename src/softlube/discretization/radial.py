"""Product integration along r: from the pressures on the rings to the displacement of each, harmonic by harmonic.

The integrals ∫ k_m(r, r′) p_m(r′) r′ dr′ are taken over a piecewise quintic interpolant of p_m: Gauss points on every element,
and points graded towards the target on the elements next to it.  They are smooth functions of m: beyond the first harmonics
some are taken and the others interpolated.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray
from scipy import sparse

from softlube.discretization.grid import PolarGrid
from softlube.discretization.potentials import ring_kernels
from softlube.model.substrates import Orders, Remainder

Array = NDArray[np.floating]

GAUSS_FAR = 4
GAUSS_NEAR = 14
NEAR = 2
"""Gauss points on an element far from the target, on one near it, and elements on each side of the target that count as near.

With these the displacement of a smooth pressure has an order above 4.5 in r (tests/discretization/test_elasticity.py)."""
LARGEST_BATCH = 1_000_000
"""Kernel values held in memory at a time."""
PANEL, LONG = 12, 0.75
"""Points on a panel on which a remainder is sampled, and the length of elements, over the panel's, that are too long for plain
Gauss.  With a pole at the panel's length from it, a function is interpolated to 10⁻⁷ and integrated to 10⁻⁶."""
EVERY_ORDER, ORDER_STEP = 24, 0.1
"""Number of the first orders whose kernels are all computed, and the relative distance of the computed ones beyond.

Interpolation in between is good to 10⁻⁵ (5·10⁻⁵ at the last order), of what is a small part of the displacement."""
STENCIL = np.arange(-3, 3)
"""Nodes of the quintic through which p is interpolated on an element, relative to its outer node."""


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
    return node, _lagrange(x, (node - element[:, None])[:, None, :])


def _lagrange(x: NDArray[np.number], places: NDArray[np.number]) -> Array:
    """Weights of the values at some places, the last axis, in the polynomial through them at x."""
    weight = np.ones(np.broadcast_shapes((*x.shape, 1), places.shape))
    for a in range(places.shape[-1]):
        for b in range(places.shape[-1]):
            if a != b:
                weight[..., a] *= (x - places[..., b]) / (places[..., a] - places[..., b])
    return weight


def sampled_orders(n_modes: int) -> tuple[Orders, Array]:
    """Orders whose kernels are computed, and the weights that give the kernels of all orders from them.

    Beyond the first `EVERY_ORDER` kernels fall like e^{−mη}, smooth in ln m until they are negligible; every tenth or so does.
    Those taken are even, like the mirror image beyond the centre, which has no pressure of such orders.

    Returns
    -------
    orders : ndarray of int, shape (n_orders,)
    weights : ndarray, shape (n_modes, n_orders)
        Of quintic interpolation in m.
    """
    orders = list(range(min(n_modes, EVERY_ORDER)))
    while orders[-1] < n_modes - 1:
        orders.append(orders[-1] + 2 * max(1, round(ORDER_STEP * orders[-1] / 2)) - orders[-1] % 2)
    taken, every = np.array(orders), np.arange(n_modes)
    size = min(STENCIL.size, taken.size)
    first = np.clip(np.searchsorted(taken, every) - size // 2, 0, taken.size - size)
    node = first[:, None] + np.arange(size)
    weights = np.zeros((n_modes, taken.size))
    weights[every[:, None], node] = _lagrange(every, taken[node])
    return taken, weights


def radial_operators(grid: PolarGrid, orders: Orders, remainder: Remainder | None = None) -> tuple[Array, Array]:
    """Product-integration matrices of the kernels on the nodes of the grid.

    Parameters
    ----------
    grid : PolarGrid
        Whose nodes carry the pressures.
    orders : ndarray of int, shape (n_orders,)
        Orders of the harmonics, ascending from 0.
    remainder : Remainder, optional
        What the substrate's kernel has beyond the half-space's.

    Returns
    -------
    kernels : ndarray, shape (n_orders, N, N)
        ``kernels[i] @ p_m`` is ∫ k_m p_m r′ dr′ up to the outermost node for m = orders[i]; N counts the rim nodes.
    weights : ndarray, shape (N,)
        ``weights @ p_0`` is ∫ p₀ r′ dr′.
    """
    points = _Points.on(grid)
    # A remainder is smooth on short elements; on long ones it is treated like the half-space's kernel, near and far.
    long = np.zeros(grid.shape[0], dtype=bool)
    result = _far(grid, orders, points)
    if remainder is not None:
        long = np.diff(points.r_edges) > LONG * remainder.smooth_over
        result += _sampled(grid, orders, points, remainder, long)
    _add_near(result, grid, orders, remainder, long)
    return result, np.asarray(points.integrals[0].sum(axis=0), dtype=float)


@dataclass(frozen=True)
class _Points:
    """Gauss points on the elements of a grid.

    Attributes
    ----------
    r : ndarray, shape (n_elements, GAUSS_FAR)
        Their radii.
    r_edges : ndarray, shape (n_elements + 1,)
        Radii of the elements' ends.
    integrals : tuple of sparse matrix, shape (n_points, n_elements)
        What the pressures on the nodes weigh at each point in ∫ … p_m r′ dr′, for even and odd m.
    """

    r: Array
    r_edges: Array
    integrals: tuple[sparse.csr_array, sparse.csr_array]

    @classmethod
    def on(cls, grid: PolarGrid) -> _Points:
        """`GAUSS_FAR` points on every element of a grid, and the quintic through the nodal pressures at these points."""
        n, edges = grid.shape[0], _edges(grid)
        gauss, gauss_weight = (np.array(a) for a in leggauss(GAUSS_FAR))
        xi = edges[:-1, None] + np.diff(edges)[:, None] * (gauss + 1) / 2
        r = grid.r_of(xi)
        node, weight = _interpolation(grid, np.arange(n), xi)
        weight *= (np.diff(edges)[:, None] * gauss_weight / 2 * grid.dr_dxi(r) * r)[..., None]
        rows = np.broadcast_to(np.arange(n * GAUSS_FAR).reshape(n, GAUSS_FAR, 1), weight.shape).ravel()
        column = np.broadcast_to(np.where(node < 0, -1 - node, node)[:, None, :], weight.shape).ravel()
        mirrored = np.broadcast_to((node < 0)[:, None, :], weight.shape)
        even, odd = (
            sparse.csr_array((np.where(mirrored, sign * weight, weight).ravel(), (rows, column)), (n * GAUSS_FAR, n))
            for sign in (1, -1)
        )
        return cls(r, grid.r_of(edges), (even, odd))


def _edges(grid: PolarGrid) -> Array:
    """ξ at the ends of the elements: the centre, then the nodes; element e lies between numbers e and e + 1."""
    return np.concatenate([[0.0], grid.xi])


def _is_near(element: NDArray[np.intp], target: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Whether an element gets the graded rule for a target."""
    return (element > target - NEAR) & (element <= target + NEAR)


def _far(grid: PolarGrid, orders: Orders, points: _Points) -> Array:
    """Integrals of the half-space's kernels over all but the near elements, a few targets at a time to save memory."""
    n, r = grid.shape[0], points.r.reshape(-1, 1)
    result = np.empty((orders.size, n, n))
    element = np.repeat(np.arange(n), GAUSS_FAR)[:, None]
    transposed = [sparse.csr_array(each.T) for each in points.integrals]
    batch = max(1, LARGEST_BATCH // (orders.size * n * GAUSS_FAR))
    for target in np.split(np.arange(n), np.arange(batch, n, batch)):
        kernel = ring_kernels(orders, grid.r[target], r)
        kernel *= ~_is_near(element, target)
        for row, m in enumerate(orders):
            result[row, target] = (transposed[m % 2] @ kernel[row]).T
    return result


def _sampled(grid: PolarGrid, orders: Orders, points: _Points, remainder: Remainder, long: NDArray[np.bool_]) -> Array:
    """Integrals of a remainder over all but the near elements that are long.

    It does not take all points to know it: from the centre to the first long element there are panels as long as it is smooth
    over, with `PANEL` Chebyshev points each, if these are fewer.
    """
    n_inner = int(np.argmax(long)) if long.any() else long.size
    n_panels = int(np.ceil(points.r_edges[n_inner] / remainder.smooth_over))
    if n_panels * PANEL > n_inner * GAUSS_FAR:
        n_inner = n_panels = 0
    width = points.r_edges[n_inner] / max(n_panels, 1)
    inner, outer = points.r[:n_inner].ravel(), points.r[n_inner:].ravel()
    panel = np.minimum(inner / width, n_panels - 1).astype(int)[:, None]
    chebyshev = (1 - np.cos((np.arange(PANEL) + 0.5) * np.pi / PANEL)) / 2
    nodes = ((np.arange(n_panels)[:, None] + chebyshev) * width).ravel()
    weights = _lagrange(inner[:, None] / width - panel, chebyshev[None, None])[:, 0]
    rows = np.repeat(np.arange(inner.size), PANEL)
    interpolation = sparse.csr_array(
        (weights.ravel(), (rows, (panel * PANEL + np.arange(PANEL)).ravel())), (inner.size, nodes.size)
    )

    kernel = remainder.ring_remainder(orders, grid.r[:, None], np.concatenate([nodes, outer]))
    element = np.repeat(np.arange(n_inner, long.size), GAUSS_FAR)
    kernel[:, :, nodes.size :] *= ~(_is_near(element, np.arange(long.size)[:, None]) & long[element])
    integrals = [
        np.concatenate([(interpolation.T @ each[: inner.size]).toarray(), each[inner.size :].toarray()])
        for each in points.integrals
    ]
    return np.stack([kernel[row] @ integrals[m % 2] for row, m in enumerate(orders)])


def _add_near(result: Array, grid: PolarGrid, orders: Orders, remainder: Remainder | None, long: NDArray[np.bool_]) -> None:
    """Add the integrals over the elements near a target: of the half-space's kernel, on long elements of the remainder, too.

    ξ = target-side end ± L t⁴ removes the logarithm and follows kernels that are narrow for large m.
    """
    n, edges = grid.shape[0], _edges(grid)
    x, x_weight = leggauss(GAUSS_NEAR)
    t, t_weight = (x + 1) / 2, x_weight / 2
    target, offset = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(1 - NEAR, NEAR + 1)))
    target, offset = (a[(target + offset >= 0) & (target + offset < n)] for a in (target, offset))
    element = target + offset
    length = np.diff(edges)[element, None]
    xi = edges[element, None] + length * np.where(offset[:, None] <= 0, 1 - t**4, t**4)
    r = grid.r_of(xi)
    kernel = ring_kernels(orders, grid.r[target, None], r)
    if remainder is not None:
        own = long[element]
        kernel[:, own] += remainder.ring_remainder(orders, grid.r[target[own], None], r[own])
    kernel *= length * (4 * t**3 * t_weight) * grid.dr_dxi(r) * r
    node, weight = _interpolation(grid, element, xi)
    share = np.einsum("mpk,pkc->mpc", kernel, weight)
    share[:, node < 0] *= (-1.0) ** orders[:, None]
    node = np.where(node < 0, -1 - node, node)
    for each in range(1 - NEAR, NEAR + 1):
        own = offset == each
        for column in range(STENCIL.size):
            result[:, target[own], node[own, column]] += share[:, own, column]
