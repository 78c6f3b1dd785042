"""The similarity problems at the edge of a heavily loaded contact: inlet, and outlet with and without the Reynolds condition.

As β → ∞ the pressure is Hertz's but for a layer at the edge.  Let s be the distance from the edge into the contact, A√s the
Hertz pressure there (A = 2√2/π²) and V = |cos θ|/β the entrainment normal to the edge.  In the units

    s: ℓ = (V/A³)^(2/5),    p: A ℓ^(1/2),    u: A ℓ^(3/2) = A^(−4/5) V^(3/5)

the layer has no parameter left (Bissett & Spence 1989; Snoeijer, Eggers & Venner 2013):

    u³ p′ = ±(u − u∞)                 Reynolds equation, integrated once; + at the inlet, − at the outlet
    u″ = −2 p.v.∫ p′/(s − s′) ds′     elastic half-plane
    p = √s + O(s^(−3/2) ln s), u → u∞  deep inside;  p → 0 outside, or p = p′ = 0 at a free boundary

The inlet has a solution for one u∞ only.  The outlet has one for every u∞, and u∞ is what the inlet sent.

For a power-law liquid of index n the first equation of the inlet is u^(n+1) p′ = x(1 − u∞/u), where x(c) is the gradient that
drives back a share c of what the walls entrain (`softlube.theory.power_law`); x = c for n = 1.  Then

    V = [(2n + 1)/n]ⁿ |cos θ|ⁿ/(3β),  ℓ = (V/Aⁿ⁺²)^(2/(3n+2))

with β formed with the viscosity K (v/|h₀|)^(n−1) that the liquid has at the rate v/|h₀|, v being the sum of the surface speeds.

Numerically, s = s₀ + L sinh t on the whole line, or s = L eᵗ behind a free boundary.  On a uniform mesh in t all fields decay
or grow like powers of eᵗ, and the sinc formulas for derivative and logarithmic potential converge geometrically.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular
from scipy.special import sici

from softlube.theory.power_law import PowerLawFlow

Array = NDArray[np.floating]


@dataclass(frozen=True)
class Mesh:
    """Mesh of a similarity problem, uniform in t from −outer to inner.

    Attributes
    ----------
    step : float
        Spacing of t.
    outer, inner : float
        How far t goes, outside and into the contact.
    length, centre : float
        s = centre + length sinh t on the whole line, length·eᵗ behind a free boundary.
    """

    step: float
    outer: float
    inner: float
    length: float
    centre: float = 0.0

    @property
    def t(self) -> Array:
        """The nodes."""
        return np.arange(-round(self.outer / self.step), round(self.inner / self.step) + 1) * self.step


INLET_MESH = Mesh(step=0.12, outer=14.0, inner=40.0, length=0.3)
OUTLET_MESH = Mesh(step=0.1, outer=14.0, inner=40.0, length=0.1, centre=-0.14)
FRONT = Mesh(step=0.1, outer=34.0, inner=40.0, length=0.1)
"""Meshes of the inlet, the outlet full of liquid and the outlet with a free boundary; errors in docs/theory/asymptotics.md."""

NEWTONIAN = PowerLawFlow()
INDICES = (0.25, 1.5)
"""Power-law indices for which the iteration is known to find the inlet."""
SWITCH = 4.0
"""Where in t the weight falls off that keeps the integrated Reynolds equation to the outside."""
BETWEEN = (-2.0, 6.0)
"""Range of t where the inlet's equations are also imposed half-way between the nodes."""
LEAST_FILM = 0.3
"""Share of u∞ that the film counts as at least, so that a wild iterate of Newton's method has one; no solution goes below."""
HALF = 7
"""Reach of the local integration formula, of order 14."""


@dataclass(frozen=True)
class Similarity:
    """Solution of a similarity problem at the contact edge, in the units of this module.

    Attributes
    ----------
    t : ndarray, shape (n,)
        Uniform coordinate.
    s : ndarray, shape (n,)
        Distance from the edge of the dry Hertz contact, positive inside.
    film, pressure, gradient : ndarray, shape (n,)
        u, p, dp/ds.
    film_inside : float
        u∞, the film deep inside.
    front : float
        The free boundary's s; −∞ without one.
    """

    t: Array
    s: Array
    film: Array
    pressure: Array
    gradient: Array
    film_inside: float
    front: float

    @property
    def film_min(self) -> float:
        """Minimum film, found between the nodes."""
        return _minimum(self.t, self.film)[1]

    @property
    def film_min_place(self) -> float:
        """Distance s of the minimum film."""
        return _interpolate(self.t, self.s, _minimum(self.t, self.film)[0])

    @property
    def gradient_max(self) -> float:
        """Maximum of dp/ds."""
        return -_minimum(self.t, -self.gradient)[1]

    def film_at(self, s: float) -> float:
        """Film at a distance s from the edge of the dry contact."""
        return _interpolate(self.s, self.film, s)


def _interpolate(x: Array, values: Array, at: float) -> float:
    """Polynomial of degree 13 through the nearest nodes."""
    from scipy.interpolate import BarycentricInterpolator  # slow to import, and the film inside does without

    first = int(np.clip(np.searchsorted(x, at) - 7, 0, x.size - 14))
    window = slice(first, first + 14)
    return float(BarycentricInterpolator(x[window], values[window])(at))


def _minimum(t: Array, values: Array) -> tuple[float, float]:
    """Place and value of the minimum."""
    from scipy.optimize import minimize_scalar  # likewise

    i = int(np.argmin(values))
    found = minimize_scalar(
        lambda at: _interpolate(t, values, at), bounds=(t[i - 1], t[i + 1]), method="bounded", options={"xatol": 1e-9}
    )
    return float(found.x), float(found.fun)


@dataclass(frozen=True)
class SincLine:
    """Formulas on the nodes t for functions of s; rows are points, of which the first n are the nodes themselves.

    For f analytic near the line and decaying, Σ f_j sinc((t − t_j)/h) is f up to exp(−const/h), and derivative and logarithmic
    potential of the sinc function are known.

    Attributes
    ----------
    s, ds : ndarray, shape (m,)
        s and ds/dt at the points.
    potential : ndarray, shape (m, n)
        q at the nodes → −2 ∫ q ln|s − s′| ds′.
    derivative : ndarray, shape (m, n)
        q → dq/ds.
    antiderivative : ndarray, shape (n, n)
        f at the nodes → ∫ f dt from the outer end to the nodes: local, so that a decaying f keeps its relative accuracy.
    """

    s: Array
    ds: Array
    potential: Array
    derivative: Array
    antiderivative: Array


def sinc_line(t: Array, points: Array, s: Array, ds: Array) -> SincLine:
    h, n = float(t[1] - t[0]), t.size
    x = (points[:, None] - t) / h
    at_node = np.abs(x) < 1e-6
    x = np.where(at_node, 1.0, x)
    # ln|s(t) − s(t′)| is ln|t − t′| and a smooth function; the sinc function's ln-potential brings the cosine integral.
    gap = np.where(at_node, ds[:n] * h / np.pi * np.exp(-np.euler_gamma), np.abs(s[:, None] - s[:n]))
    logarithm = np.log(gap) - np.where(at_node, 0.0, sici(np.pi * np.abs(x))[1])
    slope = np.where(at_node, 0.0, (np.cos(np.pi * x) - np.sinc(x)) / x)
    bands = [np.diag(np.full(n - abs(k), weight), k) for k, weight in enumerate(_interval_weights(), -HALF)]
    return SincLine(
        s=s,
        ds=ds,
        potential=-2 * h * ds[:n] * logarithm,
        derivative=slope / (h * ds[:, None]),
        antiderivative=h * np.cumsum(np.sum(bands, axis=0), axis=0),
    )


def _interval_weights() -> Array:
    """Weights on −HALF … HALF of ∫ f from −1 to 0, exact for polynomials."""
    power = np.arange(2 * HALF + 1)
    nodes = np.arange(-HALF, HALF + 1) / HALF
    return np.linalg.solve(nodes ** power[:, None], -HALF * (-1.0 / HALF) ** (power + 1) / (power + 1))


@dataclass(frozen=True)
class Part:
    """A pressure, the film under it, and its derivative, at the points; and the pressure to count with at the outer end."""

    pressure: Array
    film: Array
    gradient: Array
    end: float = 0.0


def smooth_edge(s: Array, length: float) -> Part:
    """Pressure √s + O(s^(−3/2)) inside, O(|s|^(−5/2)) outside, smooth between.

    It is √length Re f(s/length) with f = (z + i/2)/√(z + i), analytic above the real line; the film is then −2π Im ∫ f.
    """
    z = s / length
    angle = np.arctan2(1, 4 * z**3 + 3 * z) / 2  # −arg f
    complement = np.arctan2(1, -4 * z**3 - 3 * z) / 2  # π/2 + arg f, without cancellation
    size, root = np.hypot(z, 0.5), (z**2 + 1) ** 0.25
    return Part(
        pressure=size / root * np.sin(complement) * length**0.5,
        film=4 * np.pi / 3 * size * root * np.sin(angle) * length**1.5,
        gradient=np.real((z + 1.5j) / 2 * (z + 1j) ** -1.5) * length**-0.5,
    )


def _outer_tail(s: Array, length: float, flow: PowerLawFlow) -> Part:
    """Pressure that the dry gap leaves far outside the inlet, C|s|^(−a) with a = (3n + 1)/2; as small as s^(−3/2) inside.

    There u^(n+1) p′ is the gradient that drives everything back.  With Re (z + i)^(−a)/cos πa outside, no film grows inside;
    (z + i)^(−3/2), which has no pressure far outside, keeps it finite where a is near 3/2 (n = 2/3).
    """
    n = flow.index
    a = (3 * n + 1) / 2
    strength = float(flow.gradient(np.array(1.0))[0]) * (4 * np.pi / 3) ** -(n + 1) / a * length**-a
    logarithm = np.log(s / length + 1j)
    excess = a - 1.5 if abs(a - 1.5) > 1e-9 else 1e-9  # the limit, to nine digits
    factor = strength / np.sin(np.pi * excess)

    def part(power: float, share: float = 1.0, base: float = 1.0) -> Array:
        """share·z^(power − excess) − base·z^power."""
        return np.exp(power * logarithm) * (share * np.expm1(-excess * logarithm) + share - base)

    film = part(-0.5, 1 / (-0.5 - excess), -2.0)
    return Part(
        pressure=factor * part(-1.5).real,
        film=-2 * np.pi * length * factor * film.imag,
        gradient=factor / length * part(-2.5, -1.5 - excess, -1.5).real,
    )


def _sharp_edge(s: Array) -> Part:
    """Pressure √s on s > 0 alone, under which there is no gap."""
    return Part(np.sqrt(s), np.zeros_like(s), 0.5 / np.sqrt(s))


def _edge_shift(s: Array, length: float) -> Part:
    """Pressure √s/(s + length) on s > 0, by which √s becomes √(s + 2) deep inside, to first order.

    The film is 2π√length ln(s + length).
    """
    root = np.sqrt(s)
    film = 2 * np.pi * np.sqrt(length) * np.log(s + length)
    return Part(root / (s + length), film, (length - s) / (2 * root * (s + length) ** 2))


def _solve(
    t: Array, line: SincLine, flow: PowerLawFlow, sign: int, known: Part, unknown: Part | None, film_inside: float | None
) -> Similarity:
    """Gauss-Newton method for q = p − p₀ − e p₁ at the nodes, and for the number e.

    The film is u∞ + u₀ + e u₁ − 2∫ q ln|s − s′| ds′.  The number is u∞ itself where that is not given (inlet), else the
    strength of `unknown` (free boundary), else nothing (full outlet).  At the nodes with t < 0 the Reynolds equation is taken
    integrated from the outer end, p = ±∫ x(1 − u∞/u)/u^(n+1) ds, which is well conditioned where the film is thick; elsewhere
    as the flux that it is, u c(u^(n+1) p′) = ±(u − u∞).
    """
    n, m, power = t.size, line.s.size, flow.index + 1
    zero, one, node = np.zeros(m), np.ones(m), slice(0, n)
    at_inlet = film_inside is None
    part = unknown or Part(zero, one if at_inlet else zero, zero)
    outside = np.flatnonzero(t < 0)
    integral = line.antiderivative[outside]
    # ∫ψp′ = ψp − ∫ψ′p: a weight that falls off inside leaves only what is near.
    weight, weight_slope = (1 - np.tanh(t - SWITCH)) / 2, -0.5 / np.cosh(t - SWITCH) ** 2
    columns = np.append(line.ds[node] ** 0.75, [1.0] * (at_inlet or unknown is not None))  # q falls like s^(−3/2) and faster
    rows = line.ds**-0.25
    rows[outside] = columns[outside]

    q, e = np.zeros(n), 0.4 - min(0.0, float(known.film.min())) if at_inlet else 0.0
    for _ in range(40):
        inside = e if film_inside is None else film_inside
        film = (0.0 if at_inlet else inside) + known.film + e * part.film + line.potential @ q
        film = np.maximum(film, LEAST_FILM * inside)
        gradient = known.gradient + e * part.gradient + line.derivative @ q
        pressure = (known.pressure + e * part.pressure)[node] + q

        driven = sign * film**power * gradient
        back, back_slope = flow.backflow(driven)
        by_film, by_gradient = back + power * driven * back_slope - 1, sign * film ** (power + 1) * back_slope
        defect = film * back - (film - inside)
        by_q = by_film[:, None] * line.potential + by_gradient[:, None] * line.derivative
        by_e = by_film * part.film + by_gradient * part.gradient + at_inlet

        u, measure = film[node], sign * weight * line.ds[node]
        x, x_slope = flow.gradient(1 - inside / u)
        slope, slope_by_film = measure * x / u**power, measure * (x_slope * inside / u - power * x) / u ** (power + 1)
        slope_by_e = slope_by_film * part.film[node] - at_inlet * measure * x_slope / u ** (power + 1)
        defect[outside] = (weight * pressure)[outside] - known.end - integral @ (weight_slope * pressure + slope)
        by_q[outside] = -(integral * slope_by_film) @ line.potential[node] - integral * weight_slope
        by_q[outside, outside] += weight[outside]
        by_e[outside] = (weight * part.pressure[node])[outside] - integral @ (weight_slope * part.pressure[node] + slope_by_e)

        matrix, right, scale = by_q, -defect, rows
        if columns.size > n:
            matrix = np.column_stack([matrix, by_e])
        if unknown is not None:  # p′ = 0 at the free boundary: the film there is u∞
            matrix = np.vstack([matrix, np.append(line.potential[0], part.film[0])])
            right, scale = np.append(right, inside - film[0]), np.append(scale, 1.0)
        orthogonal, triangular = np.linalg.qr(matrix * scale[:, None] / columns)
        step = solve_triangular(triangular, orthogonal.T @ (right * scale)) / columns
        q_step, e_step = step[:n], float(step[n:].sum())
        q, e = q + q_step, e + e_step
        if np.max(np.abs(e_step * part.film + line.potential @ q_step) / film) < 1e-9:  # the convergence is quadratic
            break
    else:
        raise RuntimeError("the similarity problem's Newton iteration did not converge on this mesh")

    inside = e if film_inside is None else film_inside
    edge = 0.0 if unknown is None else -2 * e  # √s + e/√s is √(s + 2e)
    return Similarity(
        t=t,
        s=line.s[node] - edge,
        film=((0.0 if at_inlet else inside) + known.film + e * part.film + line.potential @ q)[node],
        pressure=(known.pressure + e * part.pressure)[node] + q,
        gradient=(known.gradient + e * part.gradient + line.derivative @ q)[node],
        film_inside=inside,
        front=-np.inf if unknown is None else -edge,
    )


def _whole_line(mesh: Mesh, points: Array) -> SincLine:
    return sinc_line(mesh.t, points, mesh.centre + mesh.length * np.sinh(points), mesh.length * np.cosh(points))


@cache
def inlet(mesh: Mesh = INLET_MESH, flow: PowerLawFlow = NEWTONIAN) -> Similarity:
    """The inlet: the one film u∞ that is drawn in, and how it gets there.

    A square collocation system has here, and only here, a spurious solution that alternates from node to node (its symbol winds
    about zero the other way than at the outlet), so the equations are also imposed between the nodes, by least squares.

    Parameters
    ----------
    mesh : Mesh
        Resolution.
    flow : PowerLawFlow
        Index of the liquid, from 0.25 to 1.5, and slide-to-roll ratio of the surfaces.

    Raises
    ------
    ValueError
        If the index is beyond.
    RuntimeError
        If the mesh is too coarse for the iteration to converge.
    """
    if not INDICES[0] <= flow.index <= INDICES[1]:
        raise ValueError(f"index: expected a number from {INDICES[0]:g} to {INDICES[1]:g}, got {flow.index!r}")
    t = mesh.t
    between = t[(t > BETWEEN[0]) & (t < BETWEEN[1])] + mesh.step / 2
    line = _whole_line(mesh, np.append(t, between))
    edge, tail = smooth_edge(line.s, 1.2), _outer_tail(line.s, 2.0, flow)  # as smooth as needed to begin at any index
    known = Part(edge.pressure + tail.pressure, edge.film + tail.film, edge.gradient + tail.gradient, tail.pressure[0])
    return _solve(t, line, flow, +1, known, None, None)


@cache
def outlet(cavitation: str = "reynolds", film_inside: float | None = None, mesh: Mesh | None = None) -> Similarity:
    """The outlet: the film u∞ from within passes a constriction and opens.

    Parameters
    ----------
    cavitation : {"reynolds", "none"}
        With the Reynolds condition the pressure ends at a free boundary with p = p′ = 0.  Without, it is negative outside.
    film_inside : float, optional
        u∞; that of `inlet` if not given.
    mesh : Mesh, optional
        Resolution.

    Raises
    ------
    RuntimeError
        If the mesh is too coarse for the iteration to converge.
    """
    if cavitation not in ("reynolds", "none"):
        raise ValueError(f'cavitation: expected "reynolds" or "none", got {cavitation!r}')
    if film_inside is None:
        film_inside = inlet().film_inside
    if cavitation == "none":
        mesh = mesh or OUTLET_MESH
        line = _whole_line(mesh, mesh.t)
        return _solve(mesh.t, line, NEWTONIAN, -1, smooth_edge(line.s, 0.3), None, film_inside)
    mesh = mesh or FRONT
    s = mesh.length * np.exp(mesh.t)
    return _solve(mesh.t, sinc_line(mesh.t, mesh.t, s, s), NEWTONIAN, -1, _sharp_edge(s), _edge_shift(s, 0.2), film_inside)
