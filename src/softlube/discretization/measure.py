"""Quantities of a solution: loads, films, gradients, friction; Eqs. (20)-(22), (25)-(27).

Everything is normalised like the fields: with |h₀| as in the paper, or with the Hertz indentation of the load.  Extrema are
found between the nodes, and integrals are exact for the interpolated fields up to quadrature of high order.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from softlube.discretization.fields import Fields
from softlube.model.quantities import BOUNDARY_LAYER_LEVEL

Array = NDArray[np.floating]

CONTACT = 1.0
"""Cut-off radius of `load_contact` and `friction_contact` over the dry contact's: the contact, as Eq. (27) is printed."""
DOMAIN = 2.0
"""Cut-off radius of `friction_total` and `friction_domain` over the dry contact's: the paper's whole computational domain, from
which Eq. (28) comes."""
FRICTIONS = {"friction_total": (DOMAIN, -1.0), "friction_contact": (CONTACT, 1.0), "friction_domain": (DOMAIN, 1.0)}
"""Frictions by name: the cut-off radius over the dry contact's, and the sign of the Poiseuille part.  Couette plus Poiseuille
part is the shear on the ball, Eq. (27a).  Couette minus Poiseuille part is the shear on the substrate, which is the whole
horizontal force on the ball: the pressure pushes the ball, too, and its resultant on an elastic substrate is vertical."""

POINTS = 4
"""Points of the quadrature between two nodes of a radius."""

INLET_AXIS, OUTLET_AXIS = np.array([0.0]), np.array([np.pi])
"""Coordinate s of the two halves of the x axis: s = θ = 0 upstream, where the liquid enters, and π downstream."""


def _zoom(f: Callable[[Array], Array], low: float, high: float, rounds: int = 5) -> tuple[float, float]:
    """Place and value of the minimum of f on [low, high], by sampling that is made finer around the least value found.

    f takes an increasing array and returns one of its shape.
    """
    best = low, np.inf
    for _ in range(rounds):
        x = np.linspace(low, high, 65)
        values = f(x)
        i = int(np.argmin(values))
        best = float(x[i]), float(values[i])
        low, high = float(x[max(i - 1, 0)]), float(x[min(i + 1, 64)])
    return best


def _zoom_plane(f: Callable[[Array, Array], Array], xi: Array, s: Array, rounds: int = 4) -> tuple[float, float, float]:
    """Place (ξ, s) and value of the minimum of f over a rectangle, by sampling that is made finer around the least value found.

    The first samples are the product of the given `xi` and `s`; f takes two such arrays and returns their product's shape.
    """
    best = float(xi[0]), float(s[0]), np.inf
    for _ in range(rounds):
        values = f(xi, s)
        i, k = np.unravel_index(int(np.argmin(values)), values.shape)
        best = float(xi[i]), float(s[k]), float(values[i, k])
        xi = np.linspace(xi[max(i - 1, 0)], xi[min(i + 1, xi.size - 1)], 17)
        if i > 0:  # at the centre every angle is the same place, and none may be ruled out
            s = np.linspace(s[max(k - 1, 0)], s[min(k + 1, s.size - 1)], 17)
    return best


def _fine(nodes: Array, low: float, high: float, parts: int) -> Array:
    """Every interval between the nodes cut in equal parts, then clipped to [low, high]."""
    cut = np.interp(np.arange((nodes.size - 1) * parts + 1) / parts, np.arange(nodes.size), nodes)
    return np.concatenate([[low], cut[(cut > low) & (cut < high)], [high]])


def integrate(fields: Fields, integrand: Callable[[Array, Array], Array], cutoff: float) -> Any:
    """∫ f dA over the disc r ≤ cutoff, both halves.

    Parameters
    ----------
    fields : Fields
        Where to integrate.
    integrand : callable
        f(ξ, s) on the product of two increasing arrays of chart coordinates, ξ > 0; several functions are stacked along a
        first axis.
    cutoff : float
        Radius, at most that of the fields' outermost node.
    """
    xi, s, across, along = _quadrature(fields, cutoff)
    return 2 * across @ integrand(xi, s) @ along


def _quadrature(fields: Fields, cutoff: float) -> tuple[Array, Array, Array, Array]:
    """Points ξ and s of a quadrature over half the disc r ≤ cutoff, and their weights; `POINTS` of ξ between two nodes."""
    if not 0 < cutoff <= fields.r[-1]:
        raise ValueError(f"cutoff: expected a radius between 0 and {fields.r[-1]:.4g}, got {cutoff!r}")
    chart = fields.chart
    edges = _fine(chart.xi_of(fields.r), 0.0, float(chart.xi_of(cutoff)), 1)
    x, weight = leggauss(POINTS)
    xi = (edges[:-1, None] + np.diff(edges)[:, None] * (x + 1) / 2).ravel()
    r = chart.r_of(xi)
    across = (np.diff(edges)[:, None] * weight / 2).ravel() * chart.dr_dxi(r) * r
    s = np.linspace(0, np.pi, 4 * (fields.theta.size - 1) + 1)
    along = np.full(s.size, s[1]) * chart.dtheta_ds(s)
    along[[0, -1]] /= 2
    return xi, s, across, along


def load_within(fields: Fields, cutoff: float) -> float:
    """Load ∫p dA over r ≤ cutoff, Eq. (27b)."""
    return integrate(fields, lambda xi, s: fields.pressure_spline(xi, s), cutoff)


def _friction_densities(fields: Fields, xi: Array, s: Array) -> Array:
    """Couette and Poiseuille part of the shear stress on the sphere, (η/η₀)/(βū) and 3ū ∂p̄/∂x, on the product of ξ and s."""
    film = fields.film_spline(xi, s)
    return np.stack([fields.viscosity_on(xi, s) / (fields.beta * film), 3 * film * fields.gradient_on(xi, s)[0]])


def friction_within(fields: Fields, cutoff: float) -> float:
    """Friction force on the sphere over r ≤ cutoff, Eq. (27a), in units of (2π/3) G h₀² (or of the unit of height squared).

    ∫ (3 ū ∂p̄/∂x + (η/η₀)/(βū)) dA.  The Couette part grows like ln(cutoff) as the film opens, so a friction is a number only
    together with its region.  Behind the free boundary the gap counts as full of liquid, as in the paper.
    """
    return float(sum(friction_parts(fields, cutoff)))


def friction_parts(fields: Fields, cutoff: float) -> tuple[float, float]:
    """Couette and Poiseuille part of the friction over r ≤ cutoff, in units of (2π/3) G h₀² (or of the unit of height squared).

    Returns
    -------
    couette : float
        ∫ (η/η₀)/(βū) dA, the drag of the sliding surface on either wall.
    poiseuille : float
        ∫ 3ū ∂p̄/∂x dA, which the pressure gradient adds to the shear on the sphere and takes from that on the substrate.
    """
    couette, poiseuille = integrate(fields, lambda xi, s: _friction_densities(fields, xi, s), cutoff)
    return float(couette), float(poiseuille)


def frictions(parts: Callable[[float], tuple[float, float]]) -> dict[str, float]:
    """All of `FRICTIONS`, from the Couette and Poiseuille part as functions of the cut-off radius over the dry contact's."""
    known = {cutoff: parts(cutoff) for cutoff in (CONTACT, DOMAIN)}
    return {name: known[cutoff][0] + sign * known[cutoff][1] for name, (cutoff, sign) in FRICTIONS.items()}


def friction_profile(fields: Fields) -> tuple[Array, Array]:
    """Couette and Poiseuille part of the friction within each node's radius, in units of (2π/3) G h₀².

    Returns
    -------
    couette, poiseuille : ndarray, shape (radii,)
        What `friction_parts` gives for the radii `fields.r`; 0 at the centre.
    """
    xi, s, across, along = _quadrature(fields, float(fields.r[-1]))
    rings = 2 * across * (_friction_densities(fields, xi, s) @ along)
    within = np.cumsum(rings.reshape(2, -1, POINTS).sum(axis=2), axis=1)
    couette, poiseuille = np.hstack([np.zeros((2, 1)), within])
    return couette, poiseuille


def wall_shear_rate(fields: Fields, xi: Array, s: Array) -> Array:
    """Larger of the shear rates on the two walls, Eq. (25) with its transverse component, in units of v/|h₀|.

    The gradient is that of the reduced pressure q, since φ∇p = ∇q; shape (xi.size, s.size).
    """
    film = fields.film_spline(xi, s)
    q_x, q_y = fields.gradient_on(xi, s, fields.reduced_spline)
    poiseuille = 3 * fields.beta * film
    return np.hypot(1 / film + np.abs(poiseuille * q_x), poiseuille * q_y)


def measure(fields: Fields, edge: float = 1.0) -> dict[str, float]:
    """Every quantity of `softlube.model.quantities.STEADY` by its name, normalised like the fields.

    Parameters
    ----------
    fields : Fields
        Pressure and film of a solution.
    edge : float
        Radius a of the dry contact.
    """
    chart = fields.chart
    xi_nodes, s_nodes = chart.xi_of(fields.r), chart.s_of(fields.theta)
    inside = float(chart.xi_of(min(DOMAIN * edge, fields.r[-1])))
    everywhere = float(xi_nodes[-1])

    def around(nodal: Array) -> tuple[Array, Array]:
        """A fine mesh of two intervals on each side of the least nodal value."""
        i, k = np.unravel_index(int(np.argmin(nodal)), nodal.shape)
        xi = _fine(xi_nodes, xi_nodes[i - 2] if i >= 2 else 0.0, xi_nodes[min(i + 2, xi_nodes.size - 1)], 4)
        s = _fine(s_nodes, s_nodes[max(k - 2, 0)], s_nodes[min(k + 2, s_nodes.size - 1)], 4)
        return xi, s if i >= 2 else s_nodes  # at the centre every angle is the same place

    xi_film, s_film, film_min = _zoom_plane(lambda a, b: fields.film_spline(a, b), *around(fields.film))
    pressure_center = float(fields.pressure_at(0.0, 0.0))
    if fields.is_sharp:
        # Between the nodes of a ridge that runs askew to the mesh, a cubic overshoots.
        highest = float(np.max(fields.pressure))
    else:
        highest = -_zoom_plane(lambda a, b: -fields.pressure_spline(a, b), *around(-fields.pressure))[2]
    pressure_max = max(highest, pressure_center)  # the centre lies between the nodes
    sheared = -wall_shear_rate(fields, xi_nodes[1:], s_nodes)
    xi_shear, s_shear = around(np.vstack([np.zeros((1, s_nodes.size)), sheared]))
    shear_rate_max = -_zoom_plane(lambda a, b: -wall_shear_rate(fields, a, b), np.maximum(xi_shear, xi_nodes[1] / 8), s_shear)[
        2
    ]

    def on_axis(angle: float, f: Callable[[Array], Array], high: float) -> tuple[float, float]:
        """Minimum along the inlet (angle 0) or outlet (π) axis."""
        x = _fine(xi_nodes, 0.0, high, 3)
        i = int(np.argmin(f(x)))
        return _zoom(f, x[max(i - 1, 0)], x[min(i + 1, x.size - 1)])

    def inlet_slope(x: Array) -> Array:
        return -np.abs(fields.pressure_spline(x, INLET_AXIS, dx=1)[:, 0]) / chart.dr_dxi(chart.r_of(x))

    outlet_min = on_axis(np.pi, lambda x: fields.film_spline(x, OUTLET_AXIS)[:, 0], inside)[1]
    slope = on_axis(0.0, inlet_slope, everywhere)[1]
    return {
        "load": fields.load,
        "load_contact": load_within(fields, CONTACT * edge),
        "height": fields.height,
        "film_center": float(fields.film_at(0.0, 0.0)),
        "film_min": film_min,
        "film_min_radius": float(chart.r_of(xi_film)),
        "film_min_angle_deg": float(np.degrees(chart.theta_of(s_film))),
        "film_inlet": float(fields.film_at(CONTACT * edge, 0.0)),
        "film_outlet_min": outlet_min,
        "pressure_center": pressure_center,
        "pressure_max": pressure_max,
        "pressure_gradient_inlet": -slope,
        "boundary_layer": boundary_layer(fields, pressure_max, edge),
        **frictions(lambda cutoff: friction_parts(fields, min(cutoff * edge, float(fields.r[-1])))),
        "shear_rate_max": shear_rate_max,
    }


def boundary_layer(fields: Fields, pressure_max: float, edge: float = 1.0) -> float:
    """Distance from the edge of the dry contact to where the pressure on the inlet axis is 5 % of its maximum, Eq. (21)."""
    xi_nodes = fields.chart.xi_of(fields.r)
    xi = _fine(xi_nodes, 0.0, float(xi_nodes[-1]), 2)
    for _ in range(6):
        above = fields.pressure_spline(xi, INLET_AXIS)[:, 0] >= BOUNDARY_LAYER_LEVEL * pressure_max
        last = int(np.flatnonzero(above)[-1]) if above.any() else xi.size - 1
        if last == xi.size - 1:
            return float("nan")
        xi = np.linspace(xi[last], xi[last + 1], 33)
    return float(fields.chart.r_of(xi.mean())) - edge
