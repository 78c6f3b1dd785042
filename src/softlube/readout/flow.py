"""The flow in the gap, read off a solution: velocity (23), averages (24), shear stress (25), flux, streamlines.

Everything is normalised as in the paper: lengths in the plane with √(R|h₀|), heights with |h₀|, velocities with the sliding
speed v (the sum of the surface speeds), shear stresses with ηv/|h₀|, η the viscosity at rest.  A place in the film is (r, θ)
and either a height z̄ or a `level` ζ = (z − w)/u: 0 on the substrate, 1 on the sphere.

Two frames: in that of the substrate, the paper's, the substrate is at rest and the sphere moves with velocity 1 along +x; in
that of the sphere the flow is steady, the liquid comes from +x, and fluxes have no divergence.

A liquid that thins with shear may roll, too: then both walls move in the frame of the sphere, where the flow is steady.

Behind the free boundary of the Reynolds condition the gap is only partly filled; see `softlube.free_boundary`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, get_args

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from softlube.errors import InputError
from softlube.readout.across import across_at, cartesian
from softlube.readout.film import driving_gradient as driving_gradient
from softlube.readout.film import levels, viscosity_at_rest
from softlube.readout.film import pressure_gradient as pressure_gradient
from softlube.readout.film import sphere_height as sphere_height
from softlube.readout.film import substrate_height as substrate_height
from softlube.readout.free_boundary import CENTRE, filling, free_boundary, polar
from softlube.steady.solution import Solution

Array = NDArray[np.floating]
Frame = Literal["substrate", "sphere"]

RIM_OF_PICTURE = 0.02
"""Distance over which streamlines come to their end at the rim of what is drawn."""
SLOWEST = 1e-4
"""Speed below which the liquid counts as at rest when a streamline is followed."""


# --- velocity and stress --------------------------------------------------------------------------------------------


def _polar(along_x: Array, along_y: Array, theta: ArrayLike) -> tuple[Array, Array]:
    return cartesian(along_x, along_y, -np.asarray(theta))


def shear_rate(solution: Solution, r: ArrayLike, theta: ArrayLike, *, level: ArrayLike) -> tuple[Array, Array]:
    """Shear rate (∂v̄_x/∂z̄, ∂v̄_y/∂z̄) at a level of the film, in units of v over the unit of height.

    Parameters
    ----------
    solution : Solution
        Whose flow.
    r, theta : array_like
        Polar coordinates.
    level : array_like
        Share of the film's thickness from the substrate (0) to the sphere (1); broadcast with r and θ.
    """
    if solution.fields.liquid.thins:
        along_x, along_y = across_at(solution, r, theta).rate(level)
        return along_x, along_y
    stress = shear_stress(solution, r, theta, level=level)
    viscosity = viscosity_at_rest(solution, r, theta)
    return stress[0] / viscosity, stress[1] / viscosity


def viscosity(solution: Solution, r: ArrayLike, theta: ArrayLike, *, level: ArrayLike) -> Array:
    """Viscosity at a level of the film over η₀, that at rest at zero pressure."""
    at_rest = viscosity_at_rest(solution, r, theta)
    if not solution.fields.liquid.thins:
        return at_rest + 0 * np.asarray(level)
    across = across_at(solution, r, theta)
    stress = np.maximum(np.hypot(*across.stress(level)) / solution.fields.beta, 1e-150)
    return at_rest * np.exp(-solution.fields.liquid.fluidity_at(stress)[0])


def _walls(solution: Solution, frame: str) -> tuple[float, float]:
    """Velocities of substrate and sphere along x, in units of v."""
    slip = solution.fields.slide_to_roll / 4
    middle = slip if frame == "substrate" else -0.5
    return middle - slip, middle + slip


def _check_frame(frame: str) -> None:
    if frame not in get_args(Frame):
        raise InputError(f"frame: expected 'substrate' or 'sphere', got {frame!r}")


def velocity(
    solution: Solution,
    r: ArrayLike,
    theta: ArrayLike,
    z: ArrayLike | None = None,
    *,
    level: ArrayLike | None = None,
    frame: Frame = "substrate",
) -> tuple[Array, Array]:
    """Velocity (v̄_r, v̄_θ) in the film, Eq. (23), in units of the sliding speed.

    Parameters
    ----------
    solution : Solution
        Whose flow.
    r, theta : array_like
        Polar coordinates, θ = 0 at the inlet; broadcast with the height.
    z : array_like, optional
        Height z̄ over the undeformed substrate; nan is returned where it lies outside the film.
    level : array_like, optional
        Instead of `z`: share of the film's thickness from the substrate (0) to the sphere (1).
    frame : {"substrate", "sphere"}
        Whose velocity is zero.  Liquid sticks to both walls exactly, in either frame.

    Raises
    ------
    InputError
        If not exactly one of z and level is given, or the frame is unknown.

    Examples
    --------
    >>> import softlube
    >>> from softlube.readout.flow import velocity
    >>> solution = softlube.solve(beta=100)
    >>> v_r, v_theta = velocity(solution, 1.0, 0.0, level=[0.0, 1.0])
    >>> v_r.tolist()
    [0.0, 1.0]
    """
    _check_frame(frame)
    zeta, rest = levels(solution, r, theta, z, level)
    if solution.fields.liquid.thins:
        across = across_at(solution, r, theta)
        below, above = (across.velocity(zeta, wall) for wall in (0.0, 1.0))
        substrate, sphere = _walls(solution, frame)
        low = zeta < rest  # each wall's velocity exactly
        return _polar(np.where(low, below[0] + substrate, above[0] + sphere), np.where(low, below[1], above[1]), theta)
    q_r, q_t = driving_gradient(solution, r, theta)
    parabola = -3 * solution.fields.beta * solution.fields.film_at(r, theta) ** 2 * zeta * rest
    substrate, sphere = _walls(solution, frame)
    couette = substrate * rest + sphere * zeta
    return parabola * q_r + couette * np.cos(theta), parabola * q_t - couette * np.sin(theta)


def mean_velocity(solution: Solution, r: ArrayLike, theta: ArrayLike, *, frame: Frame = "substrate") -> tuple[Array, Array]:
    """Velocity averaged through the film, Eq. (24)."""
    _check_frame(frame)
    if solution.fields.liquid.thins:
        pushed_x, pushed_y = across_at(solution, r, theta).mean_velocity
        return _polar(pushed_x + sum(_walls(solution, frame)) / 2, pushed_y, theta)
    q_r, q_t = driving_gradient(solution, r, theta)
    mobility = -solution.fields.beta / 2 * solution.fields.film_at(r, theta) ** 2
    couette = sum(_walls(solution, frame)) / 2
    return mobility * q_r + couette * np.cos(theta), mobility * q_t - couette * np.sin(theta)


def shear_stress(
    solution: Solution, r: ArrayLike, theta: ArrayLike, z: ArrayLike | None = None, *, level: ArrayLike | None = None
) -> tuple[Array, Array]:
    """Shear stress (τ̄_zx, τ̄_zy) in the film, Eq. (25) and its like along y, in units of ηv over the unit of height.

    On the sphere (level 1): 3βū∂p̄/∂x + (η/η₀)/ū; on the substrate (level 0): −3βū∂p̄/∂x + (η/η₀)/ū.
    """
    zeta, rest = levels(solution, r, theta, z, level)
    if solution.fields.liquid.thins:
        along_x, along_y = across_at(solution, r, theta).stress(zeta)
        return along_x, along_y
    p_r, p_t = pressure_gradient(solution, r, theta)
    film = solution.fields.film_at(r, theta)
    slope = 3 * solution.fields.beta * film * (zeta - rest)
    cosine, sine = np.cos(theta), np.sin(theta)
    fields = solution.fields
    couette = fields.beta * fields.drag_under(fields.pressure_at(r, theta), film)
    return slope * (cosine * p_r - sine * p_t) + couette, slope * (sine * p_r + cosine * p_t)


# --- flux -----------------------------------------------------------------------------------------------------------


def flux(solution: Solution, r: ArrayLike, theta: ArrayLike, *, frame: Frame = "sphere") -> tuple[Array, Array]:
    """Flux (q̄_r, q̄_θ) of liquid per unit width, in units of v|h₀|; without divergence in the frame of the sphere.

    The flux of mass over the density at zero pressure: of volume, where the density is constant.
    """
    v_r, v_t = mean_velocity(solution, r, theta, frame=frame)
    density, _ = solution.fields.liquid.density(solution.fields.pressure_at(r, theta))
    depth = density * solution.fields.film_at(r, theta) * filling(solution, r, theta)
    return v_r * depth, v_t * depth


def stream_function(solution: Solution, r: ArrayLike, theta: ArrayLike) -> Array:
    """Flux that passes between the inlet axis and the place, through the circle about the centre; frame of the sphere.

    Its contours are streamlines of the mean flow: ψ = −∫ q̄_r r dθ from 0 to θ, so that ψ → ū y/2 far upstream.
    """
    r, theta = np.broadcast_arrays(np.asarray(r, dtype=float), np.asarray(theta, dtype=float))
    _, end, side = polar(r, theta)
    x, weight = leggauss(24)
    start = np.zeros_like(end)
    boundary = free_boundary(solution)
    total = np.zeros_like(end)
    # The flux has a kink at the free boundary: the arc is cut there.
    front = end if boundary is None else np.minimum(end, boundary.angle(r))
    for a, b in ((start, front / 2), (front / 2, front), (front, (front + end) / 2), ((front + end) / 2, end)):
        for point, share in zip((x + 1) / 2, weight / 2, strict=True):
            angle = a + point * (b - a)
            total += share * (b - a) * flux(solution, r, angle)[0] * r
    return -side * total


def net_flux(solution: Solution, radius: float) -> float:
    """Net flux out of the disc r ≤ radius over the flux into it: 0 where liquid is conserved."""
    x, weight = leggauss(40)
    boundary = free_boundary(solution)
    front = np.pi if boundary is None else float(boundary.angle(radius))
    net = gross = 0.0
    for a, b in ((0, np.pi / 2), (np.pi / 2, front), (front, np.pi)):
        if b > a:
            q = flux(solution, radius, a + (b - a) * (x + 1) / 2)[0] * weight * (b - a) / 2
            net += float(q.sum())
            gross += float(np.abs(q).sum()) / 2
    return net / gross


# --- streamlines ----------------------------------------------------------------------------------------------------


def streamlines(
    solution: Solution,
    starts: ArrayLike,
    *,
    level: float | None = None,
    frame: Frame = "sphere",
    reach: float = 2.0,
    upstream: bool = False,
) -> list[Array]:
    """Streamlines in the plane, of the mean flow or of the flow at one level of the film.

    Parameters
    ----------
    solution : Solution
        Whose flow.
    starts : array_like, shape (n, 2)
        Points (x, y) from which lines are followed downstream.
    level : float, optional
        Level ζ in the film, 0 … 1; without it the velocity averaged through the film.
    frame : {"substrate", "sphere"}
        Whose velocity is zero.
    reach : float
        Lines end on this radius, or where the liquid is at rest.
    upstream : bool
        Follow them upstream as well; the points are then in the middle of their lines.

    Returns
    -------
    list of ndarray, shape (m, 2)
        (x, y) along each line.
    """
    _check_frame(frame)

    def direction(x: Array, y: Array) -> tuple[Array, Array]:
        r, theta = np.hypot(x, y), np.arctan2(y, x)
        if level is None:
            v_r, v_t = mean_velocity(solution, r, theta, frame=frame)
        else:
            v_r, v_t = velocity(solution, r, theta, level=level, frame=frame)
        return v_r * np.cos(theta) - v_t * np.sin(theta), v_r * np.sin(theta) + v_t * np.cos(theta)

    def room(x: Array, y: Array) -> Array:
        return reach - np.hypot(x, y)

    return _trace(direction, starts, room, 2.5 * reach, upstream=upstream)


def section_streamlines(solution: Solution, starts: ArrayLike, *, reach: float = 2.0, upstream: bool = False) -> list[Array]:
    """Streamlines in the vertical mid-plane y = 0, frame of the sphere, where they stay by symmetry.

    With the level ζ as coordinate the walls are ζ = 0 and 1, and continuity with the Reynolds equation (6a) gives
    dζ/dt = ζ(1 − ζ)² ∂(ρū)/∂x/(ρū), which vanishes on both.

    Parameters
    ----------
    solution : Solution
        Whose flow.
    starts : array_like, shape (n, 2)
        Points (x, ζ) from which lines are followed downstream.
    reach : float
        Lines end at |x| = reach, at the free boundary, or where the liquid is at rest.
    upstream : bool
        Follow them upstream as well; the points are then in the middle of their lines.

    Returns
    -------
    list of ndarray, shape (m, 2)
        (x, ζ) along each line; the height is w̄ + ζū.
    """
    chart, liquid = solution.fields.chart, solution.fields.liquid
    if liquid.thins:
        raise InputError("solution: its liquid thins with shear; streamlines in the section are known for others only")
    film_spline, pressure_spline = solution.fields.film_spline, solution.fields.pressure_spline

    def direction(x: Array, zeta: Array) -> tuple[Array, Array]:
        zeta = np.clip(zeta, 0, 1)
        r, theta = np.maximum(np.abs(x), CENTRE), np.where(x >= 0, 0.0, np.pi)
        v_r, _ = velocity(solution, r, theta, level=zeta, frame="sphere")
        xi, s = chart.xi_of(r), chart.s_of(theta)
        density, stiffness = liquid.density(pressure_spline(xi, s, grid=False))
        growth = film_spline(xi, s, dx=1, grid=False) / film_spline(xi, s, grid=False)
        growth = growth + stiffness / density * pressure_spline(xi, s, dx=1, grid=False)  # of ρū, relative
        return v_r * np.cos(theta), zeta * (1 - zeta) ** 2 * np.cos(theta) * growth / chart.dr_dxi(r)

    boundary = free_boundary(solution)
    last = -reach if boundary is None else max(-reach, float(boundary.place(0.0)))
    return _trace(direction, starts, lambda x, _: np.minimum(reach - x, x - last), 2.5 * reach, upstream=upstream)


def _trace(
    direction: Callable[[Array, Array], tuple[Array, Array]],
    starts: ArrayLike,
    room: Callable[[Array, Array], Array],
    length: float,
    *,
    upstream: bool = False,
) -> list[Array]:
    """Follow a direction field from points by the arc, all lines at once, until `room` runs out or the field vanishes."""
    from scipy.integrate import solve_ivp

    starts = np.atleast_2d(np.asarray(starts, dtype=float))
    if upstream:

        def against(x: Array, y: Array) -> tuple[Array, Array]:
            v_x, v_y = direction(x, y)
            return -v_x, -v_y

        up = _trace(against, starts, room, length)
        down = _trace(direction, starts, room, length)
        return [np.concatenate([before[:0:-1], after]) for before, after in zip(up, down, strict=True)]

    def unit(_: float, flat: Array) -> Array:
        x, y = flat.reshape(2, -1)
        v = np.array([*direction(x, y)])
        # Lines come to rest at the rim of the picture, softly for the sake of the step control, and where the liquid does.
        brake = np.clip(room(x, y) / RIM_OF_PICTURE, 0, 1)
        return (v * brake / np.maximum(np.hypot(v[0], v[1]), SLOWEST)).ravel()

    run = solve_ivp(unit, (0.0, length), starts.T.ravel(), max_step=0.04, rtol=1e-5, atol=1e-7)
    lines = np.moveaxis(run.y.reshape(2, starts.shape[0], -1), 1, 0)
    result: list[Array] = []
    for line in lines:
        moving = np.flatnonzero(np.hypot(*np.diff(line, axis=1)) > 1e-5)
        result.append(line[:, : moving[-1] + 2 if moving.size else 1].T)
    return result
