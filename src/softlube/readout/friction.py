"""Friction in its parts, and the balance of forces on sphere, film and substrate.

All forces are over a disc r ≤ cutoff and in units of (2π/3) G h₀², Eq. (26).  With the film's thickness u, the heights h and w
of its walls and the shear stresses (25) on them, the liquid's momentum balance u ∂p/∂x = τ(h) − τ(w) gives

    ∫τ(h) dA + 6β∫p ∂h/∂x dA = ∫τ(w) dA + 6β∫p ∂w/∂x dA + 6β∮ p u cos θ ds     (each over β)

drag on the sphere = drag on the substrate + pressure on the film's edge.  The half-space adds a condition of its own: a
frictionless load cannot drag itself, ∫p ∂w/∂x dA = 0 over the whole plane, because (2) is symmetric.  So the whole horizontal
force on the sphere, pressure included, is the substrate's shear and the edge's pressure; the paper's friction (27a) is the
shear on the sphere alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from softlube.discretization.fields import Fields, Places
from softlube.discretization.measure import friction_parts, hysteresis_friction, integrate
from softlube.errors import InputError
from softlube.model.exact import far_field_profile
from softlube.model.motions import FIXED_BALL
from softlube.model.substrates import HalfSpaceKernel
from softlube.steady.solution import Solution

Array = NDArray[np.floating]


@dataclass(frozen=True)
class FrictionSplit:
    """Horizontal forces over r ≤ cutoff, in units of (2π/3) G h₀²; positive where they resist the sliding.

    Attributes
    ----------
    cutoff : float
    couette : float
        ∫τm dA, τm the mean shear stress across the film, (η/η₀)/(βū) where it is in proportion to the shear rate; the same on
        both walls.
    poiseuille : float
        3∫ū ∂p̄/∂x dA, what the pressure gradient adds on the sphere and takes from the substrate.
    sphere_pressure : float
        6∫p̄ ∂h̄/∂x dA, the pressure's horizontal component on the sphere, which (27a) leaves out.
    substrate_pressure : float
        6∫p̄ ∂w̄/∂x dA, the same on the substrate.
    edge_force : float
        6∮p̄ ū cos θ ds, the pressure on the edge of the film at the cut-off.
    """

    cutoff: float
    couette: float
    poiseuille: float
    sphere_pressure: float
    substrate_pressure: float
    edge_force: float

    @property
    def sphere(self) -> float:
        """Shear on the sphere, Eq. (27a)."""
        return self.couette + self.poiseuille

    @property
    def substrate(self) -> float:
        """Shear on the substrate."""
        return self.couette - self.poiseuille

    @property
    def drag(self) -> float:
        """The whole horizontal force on the sphere, shear and pressure."""
        return self.sphere + self.sphere_pressure

    @property
    def imbalance(self) -> float:
        """What is left of the horizontal balance of the film, over the drag: 0 but for quadrature."""
        return (self.drag - self.substrate - self.substrate_pressure - self.edge_force) / self.drag


def split(solution: Solution, cutoff: float = 2.0) -> FrictionSplit:
    """Friction over r ≤ cutoff in its Couette and Poiseuille parts, with the pressure's horizontal components.

    Parameters
    ----------
    solution : Solution
        Where to integrate.
    cutoff : float
        Radius in units of √(R|h₀|), at most the solution's reach.  Behind the free boundary the gap counts as full, as in
        (27a).

    Raises
    ------
    ValueError
        If the cutoff is not positive or beyond the solution.
    """
    fields = solution.fields

    def poiseuille(at: Places) -> Array:
        return 3 * fields.film_on(at) * fields.gradient_on(at)[0]

    def on_sphere(at: Places) -> Array:
        return 6 * fields.pressure_on(at) * at.r[:, None] * at.cosine

    def on_substrate(at: Places) -> Array:
        return on_sphere(at) - 6 * fields.pressure_on(at) * fields.gradient_on(at, fields.film_spline)[0]

    x, weight = leggauss(64)
    rim = fields.mesh.places(fields.chart.xi_of(np.array([cutoff])), np.pi * (x + 1) / 2)
    pu = (fields.pressure_on(rim) * fields.film_on(rim))[0]
    edge = 12 * cutoff * float(np.sum(pu * rim.cosine * rim.dtheta_ds * weight)) * np.pi / 2
    return FrictionSplit(
        cutoff=float(cutoff),
        couette=integrate(fields, fields.drag_on, cutoff) + solution.friction_missed(cutoff),
        poiseuille=integrate(fields, poiseuille, cutoff),
        sphere_pressure=integrate(fields, on_sphere, cutoff),
        substrate_pressure=integrate(fields, on_substrate, cutoff),
        edge_force=edge,
    )


def against_cutoff(solution: Solution, cutoffs: ArrayLike) -> list[FrictionSplit]:
    """`split` for each of several cut-off radii."""
    return [split(solution, float(cutoff)) for cutoff in np.ravel(cutoffs)]


def total_within(solution: Solution, cutoff: float, slide_to_roll: float = FIXED_BALL) -> float:
    """Total friction over r ≤ cutoff, in units of (2π/3) G h₀²: what a force sensor reads if the liquid reaches that far.

    Beyond the mesh, where the sphere has left the substrate's deformation behind, the gap is r²/2 and a constant, so that the
    Couette part is 2πη v/(…) times the logarithm of the gap, in closed form.

    Parameters
    ----------
    solution : Solution
        Where to integrate.
    cutoff : float
        Radius in units of the solution's unit of length.
    slide_to_roll : float
        S, see `softlube.Rolling`: the Couette part is S/2 times that of a ball that does not turn.  A solution whose liquid's
        shear stress is not in proportion to the shear rate has its own, and this counts for nothing.
    """
    fields = solution.fields
    share = slide_to_roll / 2 if fields.liquid.linear else 1.0
    reach = min(cutoff, float(fields.r[-1]))
    couette, poiseuille = friction_parts(fields, reach)
    couette += solution.friction_missed(reach)
    if cutoff > reach:
        gap = (
            float(
                np.trapezoid(
                    fields.film[-1] * fields.chart.dtheta_ds(fields.chart.s_of(fields.theta)), fields.chart.s_of(fields.theta)
                )
            )
            / np.pi
        )
        if fields.liquid.linear:
            couette += 2 * np.pi / fields.beta * np.log1p((cutoff**2 - reach**2) / (2 * gap))
        else:
            couette += _sheared_beyond(fields, gap, reach, cutoff)
    return float(couette * share - poiseuille) + hysteresis_friction(fields)


def _sheared_beyond(fields: Fields, gap: float, reach: float, cutoff: float) -> float:
    """∫τm dA over reach < r < cutoff, where the film is sheared only and opens like a parabola, by the law of the liquid."""
    x, weight = leggauss(40)
    half = np.log(cutoff / reach) / 2
    r = reach * np.exp(half * (x + 1))
    rest = fields.slip / (gap + (r**2 - reach**2) / 2)
    stress = np.copysign(fields.liquid.flow_curve(np.maximum(np.abs(rest), 1e-150)), rest)
    return float(2 * np.pi * half * np.sum(weight * r**2 * fields.liquid.limited(stress, np.zeros_like(r))))


@dataclass(frozen=True)
class VerticalBalance:
    """Vertical forces, in units of 4πG|h₀|√(R|h₀|).

    Attributes
    ----------
    load : float
        The solution's load, by the quadrature of the discretisation.
    sphere : float
        ∫p̄ dA from the interpolated pressure, the far field (9) beyond it in closed form.
    substrate : float
        The load that the substrate feels: what must act at the centre to explain its mean displacement on a circle far out.
    """

    load: float
    sphere: float
    substrate: float

    @property
    def imbalance(self) -> float:
        """Largest relative difference from `load`."""
        return max(abs(self.sphere / self.load - 1), abs(self.substrate / self.load - 1))


def vertical_balance(solution: Solution, radius: float = 8.0) -> VerticalBalance:
    """Load on the sphere against that on the substrate, by two ways that share neither quadrature nor kernel with the solver.

    The mean of (6b) over the circle of nodes nearest to `radius`, a, is −∫p (2/π) K(k)/max(r, a) dA, k = min(r, a)/max(r, a),
    with the complete elliptic integral K.

    Raises
    ------
    InputError
        If the substrate is no half-space, for which alone (6b) holds.
    """
    from scipy.special import ellipkm1

    if solution.problem.substrate != HalfSpaceKernel():
        raise InputError("solution: the vertical balance is that of a half-space; horizontal_balance takes every substrate")
    fields = solution.fields
    chart = fields.chart
    ring = int(np.argmin(np.abs(fields.r - radius)))
    radius, reach = float(fields.r[ring]), float(fields.r[-1])
    angle = np.linspace(0, np.pi, 2001)
    profile = far_field_profile(angle, fields.cavitation) / fields.beta
    far_mean = float(np.trapezoid(profile, angle)) / np.pi
    inside = integrate(fields, fields.pressure_on, reach)
    sphere = inside + 2 * np.pi * far_mean / reach

    def influence(r: Array) -> Array:
        small, large = np.minimum(r, radius), np.maximum(r, radius)
        gap = np.maximum((large - small) * (large + small) / large**2, 1e-300)
        return 2 / np.pi * ellipkm1(gap) / large

    # The quadrature's points miss the circle itself, where the kernel has a logarithm and the pressure hardly anything.
    near = integrate(fields, lambda at: fields.pressure_on(at) * influence(at.r)[:, None], reach)
    beyond = np.geomspace(reach, 1e4 * reach, 4001)
    far = 2 * np.pi * far_mean * float(np.trapezoid(influence(beyond) / beyond, np.log(beyond)))
    # On the nodes themselves: between them the film's parabola would drown the displacement in interpolation errors.
    s = chart.s_of(fields.theta)
    displacement = (fields.height + float(solution.problem.indenter.height(radius)) - fields.film[ring]) * chart.dtheta_ds(s)
    mean = float(np.trapezoid(displacement, s)) / np.pi
    return VerticalBalance(float(fields.load), sphere, sphere + radius * (-mean - near - far))
