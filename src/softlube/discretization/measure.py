"""Quantities of a solution: loads, films, gradients, friction; Eqs. (20)-(22), (25)-(27).

Everything is normalised like the fields: with |h₀| as in the paper, or with the Hertz indentation of the load.  Extrema are
found between the nodes, and integrals are exact for the interpolated fields up to quadrature of high order.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from softlube.discretization.fields import Fields, Mesh, Places
from softlube.discretization.splines import Spline, lowest, polynomial_weights
from softlube.model.quantities import BOUNDARY_LAYER_LEVEL
from softlube.solvers.threads import one_thread

Array = NDArray[np.floating]

CONTACT = 1.0
"""Cut-off radius of `load_contact` and `friction_contact` over the dry contact's: the contact, as Eq. (27) is printed."""
DOMAIN = 2.0
"""Cut-off radius of `friction_total` and `friction_domain` over the dry contact's: the paper's whole computational domain, from
which Eq. (28) comes."""
FRICTIONS = {"friction_total": (DOMAIN, -1.0), "friction_contact": (CONTACT, 1.0), "friction_domain": (DOMAIN, 1.0)}
"""Frictions by name: the cut-off radius over the dry contact's, and the sign of the Poiseuille part.  Couette plus Poiseuille
part is the shear on the ball, Eq. (27a).  Couette minus Poiseuille part is the shear on the substrate, which is the whole
horizontal force on the ball: the pressure pushes the ball, too, and its resultant on an elastic substrate is vertical.  On a
substrate that remembers it is not, see `hysteresis_friction`: the total is the sum of both."""

POINTS = 4
"""Points of the quadrature between two nodes of a radius."""

NEWTON_STEPS = 20
"""Steps of Newton's method at most to a minimum between the nodes; five are usual."""
ROUNDS = 2
"""Times that the samples around a maximum are made finer, eight times each, before a parabola ends the search."""

INLET_AXIS, OUTLET_AXIS = np.array([0.0]), np.array([np.pi])
"""Coordinate s of the two halves of the x axis: s = θ = 0 upstream, where the liquid enters, and π downstream."""


def _least(spline: Spline, at: Places) -> tuple[float, float, float]:
    """Place (ξ, s) and value of the minimum of a spline next to the least of its values at some places.

    On the x axis, which is a line of symmetry, it is the minimum along the line, unless the spline falls to both sides of it;
    elsewhere Newton's method finds it.
    """
    values = at.on(spline)
    i, k = np.unravel_index(int(np.argmin(values)), values.shape)
    xi, s, best = float(at.xi[i]), float(at.s[k]), float(values[i, k])
    reach = np.array([np.max(np.diff(at.xi)), np.max(np.diff(at.s))])
    central = xi < np.min(spline.x[spline.x > 0])
    if central or (k in (0, at.s.size - 1) and s in (0.0, np.pi)):
        s = 0.0 if central else s
        # The line goes on through the centre, where every angle is the same place.
        near = int(np.searchsorted(spline.x, xi))
        line = spline.x[max(near - 3, 0) : near + 3]
        xi, best = map(float, lowest(line, np.stack([spline(line, s, dx=d)[:, 0] for d in (0, 1)])))
        if central or spline.jet(xi, s)[0, 2] >= 0:
            return (xi, s, best) if xi >= 0 else (-xi, np.pi - s, best)
        s += reach[1] if s == 0 else -reach[1]
    place = np.array([xi, s])
    for _ in range(NEWTON_STEPS):
        jet = spline.jet(*place)
        gradient, hessian = jet[[1, 0], [0, 1]], np.array([[jet[2, 0], jet[1, 1]], [jet[1, 1], jet[0, 2]]])
        if not (jet[2, 0] > 0 and np.linalg.det(hessian) > 0):
            break
        step = np.clip(-np.linalg.solve(hessian, gradient), -reach, reach)
        place = place + step
        if np.all(np.abs(step) < 1e-9 * reach):
            break
    value = float(spline.jet(*place)[0, 0])
    return (float(place[0]), float(place[1]), value) if value <= best else (xi, s, best)


def _largest(f: Callable[[Places], Array], at: Places, mesh: Mesh) -> float:
    """The maximum of a function next to the largest of its values at places, by sampling that is made finer around it."""
    values = f(at)
    i, k = np.unravel_index(int(np.argmax(values)), values.shape)
    for _ in range(ROUNDS):
        xi, s = (
            np.linspace(nodes[max(best - 1, 0)], nodes[min(best + 1, nodes.size - 1)], 17)
            for nodes, best in ((at.xi, i), (at.s, k))
        )
        at = mesh.places(xi, s)
        values = f(at)
        i, k = np.unravel_index(int(np.argmax(values)), values.shape)
    return float(values[i, k] + _above(values[:, k], i) + _above(values[i], k))


def _above(values: Array, largest: np.intp) -> float:
    """How much higher the parabola through the largest of some equidistant values and its neighbours is."""
    if not 0 < largest < values.size - 1:
        return 0.0
    before, here, after = values[largest - 1 : largest + 2]
    return float((after - before) ** 2 / (8 * max(2 * here - before - after, 1e-300)))


def _fine(nodes: Array, low: float, high: float, parts: int) -> Array:
    """Every interval between the nodes cut in equal parts, then clipped to [low, high]."""
    cut = np.interp(np.arange((nodes.size - 1) * parts + 1) / parts, np.arange(nodes.size), nodes)
    return np.concatenate([[low], cut[(cut > low) & (cut < high)], [high]])


def integrate(fields: Fields, integrand: Callable[[Places], Array], cutoff: float) -> Any:
    """∫ f dA over the disc r ≤ cutoff, both halves.

    Parameters
    ----------
    fields : Fields
        Where to integrate.
    integrand : callable
        f on a product of chart coordinates ξ > 0 and s; several functions are stacked along a first axis.
    cutoff : float
        Radius, at most that of the fields' outermost node.
    """
    return integrals(fields, integrand, (cutoff,))[..., 0][()]  # a number, not an array without axes


def integrals(fields: Fields, integrand: Callable[[Places], Array], cutoffs: tuple[float, ...]) -> Array:
    """∫ f dA as `integrate` gives it, over each of some discs, along the last axis; their radii ascend."""
    at, across, along, ends = _quadrature(fields.mesh, cutoffs)
    return np.cumsum(2 * across * (integrand(at) @ along), axis=-1)[..., ends]


@lru_cache(maxsize=32)
def _quadrature(mesh: Mesh, cutoffs: tuple[float, ...]) -> tuple[Places, Array, Array, NDArray[np.integer]]:
    """Places of a quadrature over half the discs r ≤ cutoff, `POINTS` of ξ between two nodes; kept, since meshes come again.

    Returns
    -------
    at : Places
        The places.
    across, along : ndarray
        Their weights along r and along θ.
    ends : ndarray of int, shape (cutoffs,)
        The last ξ within each disc.
    """
    for cutoff in cutoffs:
        if not 0 < cutoff <= mesh.r[-1]:
            raise ValueError(f"cutoff: expected a radius between 0 and {mesh.r[-1]:.4g}, got {cutoff!r}")
    rims = mesh.chart.xi_of(np.array(cutoffs))
    edges = np.union1d(_fine(mesh.xi, 0.0, float(rims[-1]), 1), rims)
    x, weight = leggauss(POINTS)
    xi = (edges[:-1, None] + np.diff(edges)[:, None] * (x + 1) / 2).ravel()
    at = mesh.places(xi, np.linspace(0, np.pi, 4 * (mesh.theta.size - 1) + 1))
    across = (np.diff(edges)[:, None] * weight / 2).ravel() * at.dr_dxi * at.r
    along = np.full(at.s.size, at.s[1]) * at.dtheta_ds
    along[[0, -1]] /= 2
    return at, across, along, np.searchsorted(xi, rims) - 1


def least_film_on(fields: Fields, s: Array) -> Array:
    """Least film on each of some rays, along the valley that the constriction is; s is their chart coordinate."""
    xi = fields.mesh.xi
    return lowest(xi, np.stack([fields.film_spline(xi, s, dx=d).T for d in (0, 1)]))[1]


def load_within(fields: Fields, cutoff: float) -> float:
    """Load ∫p dA over r ≤ cutoff, Eq. (27b)."""
    return integrate(fields, lambda at: fields.pressure_on(at), cutoff)


def _densities(fields: Fields, at: Places) -> Array:
    """Pressure, and Couette and Poiseuille part of the shear stress on the sphere, `Fields.drag_on` and 3ū ∂p̄/∂x."""
    return np.stack([fields.pressure_on(at), fields.drag_on(at), 3 * fields.film_on(at) * fields.gradient_on(at)[0]])


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
    _, couette, poiseuille = integrate(fields, lambda at: _densities(fields, at), cutoff)
    return float(couette), float(poiseuille)


def frictions(parts: Callable[[float], tuple[float, float]]) -> dict[str, float]:
    """All of `FRICTIONS`, from the Couette and Poiseuille part as functions of the cut-off radius over the dry contact's."""
    known = {cutoff: parts(cutoff) for cutoff in (CONTACT, DOMAIN)}
    return {name: known[cutoff][0] + sign * known[cutoff][1] for name, (cutoff, sign) in FRICTIONS.items()}


def hysteresis_friction(fields: Fields) -> float:
    """Friction that the substrate makes itself, 6∫p̄ ∂w̄/∂x dA, in units of (2π/3) G h₀²; 0 on an elastic one.

    Only the part of the slope counts that the substrate remembers: the displacement of an elastic half-space under the pressure
    has none (it is symmetric, so ∫p ∂wₑ/∂x dA = 0 over the whole plane).
    """
    if fields.recovery is None:
        return 0.0
    slope = fields.recovery_spline
    return 6 * float(integrate(fields, lambda at: fields.pressure_on(at) * at.on(slope), float(fields.r[-1])))


def friction_profile(fields: Fields) -> tuple[Array, Array]:
    """Couette and Poiseuille part of the friction within each node's radius, in units of (2π/3) G h₀².

    Returns
    -------
    couette, poiseuille : ndarray, shape (radii,)
        What `friction_parts` gives for the radii `fields.r`; 0 at the centre.
    """
    cutoffs = tuple(fields.r[fields.r > 0].tolist())
    within = integrals(fields, lambda at: _densities(fields, at)[1:], cutoffs)
    couette, poiseuille = np.hstack([np.zeros((2, 1)), within])
    return couette, poiseuille


def wall_shear_rate(fields: Fields, at: Places) -> Array:
    """Larger of the shear rates on the two walls, Eq. (25) with its transverse component, in units of v/|h₀|.

    The gradient is that of the reduced pressure q, since φ∇p = ∇q.
    """
    film = fields.film_on(at)
    if fields.liquid.thins:
        return fields.sheared_on(at).rate.max(axis=0)
    q_x, q_y = fields.gradient_on(at, fields.reduced_spline)
    poiseuille = 3 * fields.beta * film
    across, along = abs(fields.slide_to_roll) / 2 / film + np.abs(poiseuille * q_x), poiseuille * q_y
    return np.sqrt(across * across + along * along)


def _thinned(fields: Fields, cutoff: float) -> dict[str, float]:
    """Quantities of `softlube.model.quantities.THINNING` over r ≤ cutoff."""
    at_walls = [fields.nodal_spline(np.log(np.mean(each, axis=0))) for each in (fields.sheared.stress, fields.sheared.rate)]
    stress, rate = integrate(fields, lambda at: np.exp([at.on(each) for each in at_walls]), cutoff)
    area = np.pi * cutoff**2
    return {"shear_rate_mean": float(rate / area), "viscosity_mean": float(fields.beta * stress / rate)}


@one_thread
def measure(fields: Fields, edge: float = 1.0) -> dict[str, float]:
    """Every quantity of `softlube.model.quantities.STEADY` by its name, normalised like the fields.

    Those of `softlube.model.quantities.THINNING`, too, if the liquid thins with shear.

    Parameters
    ----------
    fields : Fields
        Pressure and film of a solution.
    edge : float
        Radius a of the dry contact.
    """
    mesh, chart = fields.mesh, fields.chart
    xi_nodes, s_nodes = mesh.xi, mesh.s
    contact, domain = (min(cutoff * edge, float(fields.r[-1])) for cutoff in (CONTACT, DOMAIN))

    def around(nodal: Array) -> Places:
        """A fine mesh of two intervals on each side of the least nodal value."""
        i, k = np.unravel_index(int(np.argmin(nodal)), nodal.shape)
        xi = _fine(xi_nodes, xi_nodes[i - 2] if i >= 2 else 0.0, xi_nodes[min(i + 2, xi_nodes.size - 1)], 4)
        s = _fine(s_nodes, s_nodes[max(k - 2, 0)], s_nodes[min(k + 2, s_nodes.size - 1)], 4)
        return mesh.places(xi, s if i >= 2 else s_nodes)  # at the centre every angle is the same place

    xi_film, s_film, film_min = _least(fields.film_spline, around(fields.film))
    pressure_center = float(fields.pressure_at(0.0, 0.0))
    if fields.is_sharp:
        # Between the nodes of a ridge that runs askew to the mesh, a cubic overshoots.
        highest = float(np.max(fields.pressure))
    else:
        highest = -_least(-fields.pressure_spline, around(-fields.pressure))[2]
    pressure_max = max(highest, pressure_center)  # the centre lies between the nodes

    thins = fields.liquid.thins
    sheared = fields.sheared.rate.max(axis=0)[1 - mesh.centre :] if thins else wall_shear_rate(fields, mesh.nodes)
    near = around(np.vstack([np.zeros((1, s_nodes.size)), -sheared]))
    near = mesh.places(np.maximum(near.xi, xi_nodes[1] / 8), near.s)
    outlet = _fine(xi_nodes, 0.0, float(chart.xi_of(domain)), 1)
    outlet_line = np.stack([fields.film_spline(outlet, OUTLET_AXIS, dx=d)[:, 0] for d in (0, 1)])

    discs = integrals(fields, lambda at: _densities(fields, at), (contact, domain)).T.tolist()
    within = dict(zip((CONTACT, DOMAIN), discs, strict=True))
    by_region = frictions(lambda cutoff: within[cutoff][1:])
    if fields.recovery is not None:
        hysteresis = hysteresis_friction(fields)
        by_region |= {
            "friction_total": by_region["friction_total"] + hysteresis,
            "friction_viscous": by_region["friction_total"],
            "friction_hysteresis": hysteresis,
        }
    found = {
        "load": fields.load,
        "load_contact": within[CONTACT][0],
        "height": fields.height,
        "film_center": float(fields.film_at(0.0, 0.0)),
        "film_min": film_min,
        "film_min_radius": float(chart.r_of(xi_film)),
        "film_min_angle_deg": float(np.degrees(chart.theta_of(s_film))),
        "film_inlet": float(fields.film_at(CONTACT * edge, 0.0)),
        "film_outlet_min": float(lowest(outlet, outlet_line)[1]),
        "pressure_center": pressure_center,
        "pressure_max": pressure_max,
        "pressure_gradient_inlet": steepest_inlet(fields),
        "boundary_layer": boundary_layer(fields, pressure_max, edge),
        **by_region,
        "shear_rate_max": _largest(lambda at: wall_shear_rate(fields, at), near, mesh),
    }
    return found | _thinned(fields, contact) if thins else found


def steepest_inlet(fields: Fields) -> float:
    """Largest pressure gradient on the inlet axis, Eq. (20).

    Slopes on the nodes and the polynomial through six of them are of sixth order and do not jump at a node.  A cubic spline's
    slope would be of third order between its nodes.
    """
    mesh, chart = fields.mesh, fields.chart
    axis = np.concatenate([fields.pressure[mesh.centre :][::-1, -1], fields.pressure[:, 0]])
    nodes = mesh.xi_nodes
    slopes = polynomial_weights(nodes, nodes, 1, 7) @ axis / chart.dr_dxi(chart.r_of(np.abs(nodes)))

    def steepness(xi: Array) -> Array:
        return np.abs(polynomial_weights(nodes, xi, 0, 6) @ slopes)

    xi = np.union1d(0.0, mesh.xi)
    steepest = int(np.argmax(steepness(xi)))
    values = steepness(np.linspace(xi[max(steepest - 1, 0)], xi[min(steepest + 1, xi.size - 1)], 33))
    highest = np.argmax(values)
    return float(values[highest] + _above(values, highest))


def boundary_layer(fields: Fields, pressure_max: float, edge: float = 1.0) -> float:
    """Distance from the edge of the dry contact to where the pressure on the inlet axis is 5 % of its maximum, Eq. (21)."""
    level = BOUNDARY_LAYER_LEVEL * pressure_max
    xi = _fine(fields.mesh.xi, 0.0, float(fields.mesh.xi[-1]), 2)
    above = fields.pressure_spline(xi, INLET_AXIS)[:, 0] >= level
    last = int(np.flatnonzero(above)[-1]) if above.any() else xi.size - 1
    if last == xi.size - 1:
        return float("nan")
    start, width = xi[last], xi[last + 1] - xi[last]
    taylor = [float(fields.pressure_spline(start, 0.0, dx=d, grid=False)) * width**d for d in range(3)]
    # The cubic from there on, as a polynomial: its third derivative is what its value at the end leaves.
    value = float(fields.pressure_spline(xi[last + 1], 0.0, grid=False))
    roots = np.roots([value - taylor[0] - taylor[1] - taylor[2] / 2, taylor[2] / 2, taylor[1], taylor[0] - level])
    crossing = np.max(roots.real[(np.abs(roots.imag) < 1e-9) & (roots.real >= -1e-9) & (roots.real <= 1 + 1e-9)])
    return float(fields.chart.r_of(start + crossing * width)) - edge
