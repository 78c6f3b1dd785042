"""Where the work of the friction goes: the liquid's dissipation and the substrate's loss.

All is per sliding speed, so a force, over a disc r ≤ cutoff and in units of (2π/3) G h₀², Eq. (26).  With the viscous part of
the friction, C − P, the liquid's energy balance is

    C − P + 6∮ p u cos θ/2 ds + 3β∮ p u³ ∂p/∂r ds = C + 3β∫u³|∇p|² dA,

work of the walls and of the pressure on the film's edge = dissipation.  A Kelvin-Voigt element of the substrate, of compliance
Jᵢ and length Lᵢ, loses −Jᵢ Lᵢ ∫(∂pᵢ/∂x)(∂wᵢ/∂x) dA over the whole plane, where pᵢ and wᵢ are the pressure and the elastic
displacement as it remembers them; together they lose the hysteresis part of the friction.

Maps of both are per area, in units of (2π/3) G h₀/R times the sliding speed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from softlube.discretization.fields import Places
from softlube.discretization.grid import PolarGrid
from softlube.discretization.measure import friction_parts, hysteresis_friction, integrate
from softlube.discretization.memory import memory_operator
from softlube.discretization.system import ContactSystem
from softlube.errors import InputError
from softlube.readout.film import pressure_gradient
from softlube.readout.flow import mean_velocity, shear_stress
from softlube.steady.solution import Solution

Array = NDArray[np.floating]

LONGEST = 0.1
"""Length of a memory over the mesh's reach up to which the substrate's loss is inside the mesh to e^(−10)."""


@dataclass(frozen=True)
class EnergyBalance:
    """Work and dissipation over r ≤ cutoff, per sliding speed, in units of (2π/3) G h₀².

    Attributes
    ----------
    viscous : float
        Viscous part C − P of the friction.
    hysteresis : float
        The substrate's friction, 6∫p ∂w/∂x dA over the whole plane.
    edge_work : float
        Work of the pressure on the edge of the film at the cut-off.
    film : float
        Dissipation in the liquid, (1/β)∫dA/u + 3β∫u³|∇p|² dA.
    substrate : float
        Loss in the substrate, −6 ΣJᵢ Lᵢ ∫(∂pᵢ/∂x)(∂wᵢ/∂x) dA.
    """

    viscous: float
    hysteresis: float
    edge_work: float
    film: float
    substrate: float

    @property
    def work(self) -> float:
        """All work that is done: by the friction, and on the film's edge."""
        return self.viscous + self.hysteresis + self.edge_work

    @property
    def imbalance(self) -> float:
        """What is left of the balance, over the dissipation: 0 but for quadrature and the mesh."""
        return (self.work - self.film - self.substrate) / (self.film + self.substrate)


def energy_balance(solution: Solution, cutoff: float = 2.0) -> EnergyBalance:
    """The balance of energy of a contact with a liquid of constant viscosity.

    Parameters
    ----------
    solution : Solution
        On an elastic substrate, or on one that remembers.
    cutoff : float
        Radius in units of the solution's unit of length.

    Raises
    ------
    InputError
        If the viscosity is not constant, the substrate's memory reaches too far beyond the mesh for its loss to be taken on it,
        or the solution is one of the paper's methods.

    Examples
    --------
    >>> import softlube
    >>> balance = energy_balance(softlube.solve(beta=100.0))
    >>> abs(balance.imbalance) < 1e-4, balance.substrate
    (True, 0.0)
    """
    fields, problem = solution.fields, solution.problem
    if np.any(fields.liquid.viscosity(fields.pressure) != 1) or not fields.liquid.linear:
        raise InputError("solution: the balance of energy is that of a liquid of constant viscosity")
    if not isinstance(fields.chart, PolarGrid):
        raise InputError(f"solution: method {solution.method!r} has no energy balance; solve with method 'newton'")
    couette, poiseuille = friction_parts(fields, cutoff)

    def by_pressure(at: Places) -> Array:
        slope_x, slope_y = fields.gradient_on(at)
        return 3 * fields.beta * fields.film_on(at) ** 3 * (slope_x**2 + slope_y**2)

    x, weight = leggauss(64)
    rim = fields.mesh.places(fields.chart.xi_of(np.array([cutoff])), np.pi * (x + 1) / 2)
    pressure, film = fields.pressure_on(rim)[0], fields.film_on(rim)[0]
    outwards = (rim.on(fields.pressure_spline, dx=1) / rim.dr_dxi[:, None])[0]
    flux = 6 * pressure * film * rim.cosine + 6 * fields.beta * pressure * film**3 * outwards
    return EnergyBalance(
        viscous=couette - poiseuille,
        hysteresis=hysteresis_friction(fields),
        edge_work=cutoff * float(np.sum(flux * rim.dtheta_ds * weight)) * np.pi / 2,
        film=couette + float(integrate(fields, by_pressure, cutoff)),
        substrate=_loss(fields.pressure, fields.height, ContactSystem(problem, fields.chart)),
    )


def _loss(pressure: Array, height: float, system: ContactSystem) -> float:
    """−6 ΣJᵢ Lᵢ ∫(∂pᵢ/∂x)(∂wᵢ/∂x) dA, with Lᵢ ∂pᵢ/∂x = pᵢ − p and Lᵢ ∂wᵢ/∂x = wᵢ − wₑ."""
    memory, grid = system.substrate.memory, system.grid
    if memory is None:
        return 0.0
    if max(memory.lengths) > LONGEST * grid.r[-1]:
        raise InputError(
            f"solution: the substrate remembers over {max(memory.lengths):.3g} units of length; its loss is taken on the mesh "
            f"where that is at most {LONGEST * grid.r[-1]:.3g}. friction_hysteresis is the loss, however long the memory"
        )
    pressed = pressure.ravel()
    deflected = system.elastic_deflection(pressed[: grid.n_unknown], height)
    total = 0.0
    for share, length in zip(memory.shares, memory.lengths, strict=True):
        average = memory_operator(grid, (1.0,), (length,)).matrix
        strained, recovered = (average @ each - each for each in (pressed, deflected))
        total += share / length * float(system.elastic.load_weights @ (strained * recovered))
    return 6 * total


def film_dissipation(solution: Solution, r: ArrayLike, theta: ArrayLike) -> Array:
    """Dissipation in the liquid per area, for every liquid; over a disc it sums up to `EnergyBalance.film`.

    In the frame of the substrate the stress on the sphere works on the film, and the pressure on the flux q through it:
    τ_zx V − ∇p·q, which is η V²/u + u³|∇p|²/(12η) for a constant viscosity.  Behind the free boundary the gap counts as full.

    Parameters
    ----------
    solution : Solution
        Where the liquid flows.
    r, theta : array_like
        Polar coordinates, θ = 0 at the inlet; broadcast.
    """
    fields = solution.fields
    shear, _ = shear_stress(solution, r, theta, level=1.0)
    film = fields.film_at(r, theta)
    pushed = sum(
        slope * along * film
        for slope, along in zip(
            pressure_gradient(solution, r, theta), mean_velocity(solution, r, theta, frame="substrate"), strict=True
        )
    )
    return shear * fields.slide_to_roll / 2 / fields.beta - 6 * pushed


def surface_work(solution: Solution, r: ArrayLike, theta: ArrayLike) -> Array:
    """Work of the pressure on a substrate that remembers per area, 6p ∂w/∂x; over the whole plane it sums up to its loss.

    Positive where the substrate takes work, negative where it gives some back.  Only the part of the slope counts that it owes
    to its memory: what an elastic half-space takes in front it gives back behind, and nothing is lost.

    Parameters
    ----------
    solution : Solution
        On a substrate that remembers.
    r, theta : array_like
        Polar coordinates, θ = 0 at the inlet; broadcast.

    Raises
    ------
    InputError
        If the substrate is elastic.
    """
    fields = solution.fields
    return 6 * fields.pressure_at(r, theta) * fields.recovery_at(r, theta)
