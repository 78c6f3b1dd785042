"""The coupled equations of one problem on one grid, as Newton's method takes them.

Unknowns are the pressures at the cell centres and, under load control, the height h₀ of the sphere.  The film follows from them
by (6b) and (6c), so the Jacobian of the Reynolds residual R(p, u) is ∂R/∂p + ∂R/∂u · ∂u/∂p, exact; it is applied, never formed.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from softlube.discretization.elasticity import ElasticOperator, elastic_operator, rim_slice
from softlube.discretization.fields import Fields
from softlube.discretization.grid import RIM, PolarGrid
from softlube.discretization.memory import MemoryOperator, memory_operator
from softlube.discretization.preconditioner import Border, FilmBalance, FilmEquation, local_stiffness
from softlube.discretization.reynolds import Flow, ReynoldsOperator
from softlube.model.dry import dry_contact, smeared_contact
from softlube.model.exact import HERTZ_LOAD, far_field_profile, kapitza_pressure
from softlube.model.film_section import viscosity_at
from softlube.model.problem import Problem
from softlube.model.substrates import Memory, Substrate

Array = NDArray[np.floating]
Mask = NDArray[np.bool_]

FILM_KEPT = 0.5
"""Safety factor of a Newton step: nowhere does the film fall below this fraction of its value before the step."""
LARGEST_THINNING = 3.0
"""A step may lower ln η by this much at most, anywhere.  Newton's method takes q for linear in the pressure, and where the
fluidity is 10⁻¹⁰ that says that nothing flows however far the pressure falls."""
FAR_STRESS = 1.4
"""Stress that the far field's pressure gradient causes, over that of the walls' mean speed: its wall stress is
3u ∂p/∂r = 1.8/(βu) by Eq. (9), and counts in the flux by √(3/5)."""
FAR_END, FAR_POINTS = 0.01, 16
"""Radius of the rim over that beyond which the viscosity counts as constant, and points of the quadrature between them."""
LEAST_LIFT, LIFTS = 0.25, 20
"""Least film of the first guess over the film at its centre, and largest number of attempts to reach it."""


class _Operators(NamedTuple):
    """What a system needs of its grid.

    Attributes
    ----------
    elastic, reynolds, balance
        The operators.
    far_displacement : ndarray, shape (2, n)
        Displacement of the relaxed surface by the far field on the rim and beyond, see `ElasticOperator.far_displacement`.
    memory : MemoryOperator or None
        What the substrate makes of an elastic displacement, if it remembers.
    far_remembered : ndarray, shape (2, n)
        `far_displacement` with the memory.
    """

    elastic: ElasticOperator
    reynolds: ReynoldsOperator
    balance: FilmBalance
    far_displacement: Array
    memory: MemoryOperator | None
    far_remembered: Array


def _operators(grid: PolarGrid, cavitation: str, substrate: Substrate) -> _Operators:
    if substrate.memory is None:
        return _relaxed(grid, cavitation, substrate)
    return _remembering(grid, cavitation, substrate.elastic, substrate.memory)


@lru_cache(maxsize=8)
def _relaxed(grid: PolarGrid, cavitation: str, substrate: Substrate) -> _Operators:
    elastic, reynolds = elastic_operator(grid, cavitation, substrate.remainder), ReynoldsOperator.on(grid)
    rim = rim_slice(grid)
    displaced = [elastic.deflection(np.concatenate([np.zeros(grid.n_unknown), far[rim]])) for far in elastic.far_pressure]
    balance = FilmBalance(reynolds.nearest, local_stiffness(grid, elastic))
    far = elastic.far_displacement + np.stack(displaced)
    return _Operators(elastic, reynolds, balance, far, None, far)


@lru_cache(maxsize=8)
def _remembering(grid: PolarGrid, cavitation: str, elastic: Substrate, memory: Memory) -> _Operators:
    relaxed, operator = _relaxed(grid, cavitation, elastic), memory_operator(grid, memory.shares, memory.lengths)
    return relaxed._replace(
        balance=relaxed.balance.stiffened(1 / operator.compliance[: grid.n_unknown]),
        memory=operator,
        far_remembered=relaxed.far_displacement @ operator.matrix.T,
    )


def forget_operators() -> None:
    """Free the memory of the operators kept for grids that may come again."""
    for kept in (_relaxed, _remembering, memory_operator):
        kept.cache_clear()


class ContactSystem:
    """Discrete equations (6a)-(6c) with the cavitation condition and the far field.

    They keep their form whatever height the lengths are normalised with.  So the unit is chosen to suit the grid: the
    problem's own (|h₀|, or the Hertz indentation of the load) times `scale`, which makes β scale² times the problem's, and
    the load 4/(3π) scale^(−3/2) where it is prescribed; substrate, liquid and indenter come along.

    Parameters
    ----------
    problem : Problem
    grid : PolarGrid
    scale : float
        Unit of height over the problem's own.
    """

    def __init__(self, problem: Problem, grid: PolarGrid, scale: float = 1.0) -> None:
        self.problem = problem
        self.grid = grid
        self.scale = scale
        self.beta = problem.parameter * scale**2
        self.speed = 1 / self.beta
        self.prescribed = HERTZ_LOAD * scale**-1.5 if problem.load_controlled else problem.height / scale
        # Lengths scale with the root of the unit, and so do pressures.
        self.substrate, self.liquid = problem.substrate.in_units(scale), problem.liquid.in_units(scale)
        self.indenter = problem.indenter.in_units(scale)
        operators = _operators(grid, problem.cavitation, self.substrate)
        self.elastic, self.reynolds, self.balance = operators.elastic, operators.reynolds, operators.balance
        self.memory = operators.memory
        self.far_deflection = self.speed * operators.far_displacement
        n, load_controlled = grid.n_unknown, problem.load_controlled
        self.self_deflection = np.zeros(grid.shape[0] * grid.shape[1])
        self.self_deflection[:n] = 1 / np.abs(self.balance.stiffness.diagonal())
        self.constrained = np.zeros(n + load_controlled, dtype=bool)
        self.constrained[:n] = problem.cavitation == "reynolds"
        self.mean_stress: Array | None = None  # on the faces, of the last state, a quick start for the next
        # The far field, and with it the film, is linear in h₀: value = [0] + h₀ [1].
        rim = rim_slice(grid)
        viscosity, borne = self._beyond(float(grid.r[-1]))
        strength = self.speed * viscosity * np.array(self.indenter.far_field(float(grid.r[-RIM])))
        far = strength[:, None] * self.elastic.far_pressure[:, rim]
        self.rim_pressure = far
        self.film_offset = strength[:, None] * operators.far_remembered
        self.film_offset[0] += np.repeat(self.indenter.height(grid.r), grid.shape[1])
        self.film_offset[1] += 1
        self._thickened = strength * (borne - 1) * self.elastic.far_load
        self.load_offset = strength * borne * self.elastic.far_load + far @ self.elastic.load_weights[rim]

    def _beyond(self, rim: float) -> tuple[float, float]:
        """Viscosity over that at rest at the rim, for the far field there, and the load beyond over that of this viscosity.

        The far field of the pressure is η f(θ)/(βr³) with the viscosity η of the place, which rises as the shear rate falls
        like r⁻²: the load goes like ∫ η r⁻² dr.  Far out, where a power law would never end, η rises no more.
        """
        if not self.liquid.thins:
            return 1.0, 1.0
        x, weight = leggauss(FAR_POINTS)
        place = np.append(FAR_END ** ((x + 1) / 2), [FAR_END, 1.0])  # rim/r
        rate = self.speed * place**2 / (rim**2 / 2) * np.hypot(self.problem.slide_to_roll / 2, FAR_STRESS)
        *along, last, viscosity = viscosity_at(self.liquid, rate)
        total = -np.log(FAR_END) / 2 * np.sum(weight * along * place[:-2]) + last * FAR_END
        return float(viscosity), float(total / viscosity)

    def height(self, x: Array) -> float:
        """Height h₀ of the sphere's lowest point."""
        return float(x[-1]) if self.problem.load_controlled else self.prescribed

    def pressure(self, x: Array) -> Array:
        """Pressure on all nodes, shape (n,)."""
        return np.concatenate([x[: self.grid.n_unknown], self.rim_pressure[0] + self.height(x) * self.rim_pressure[1]])

    def deflection(self, pressure: Array) -> Array:
        """Displacement of the surface, sign reversed, at all nodes under nodal pressures, and what it remembers."""
        elastic = self.elastic.deflection(pressure)
        return elastic if self.memory is None else self.memory.matrix @ elastic

    def recovery(self, x: Array) -> Array | None:
        """Slope of the surface by what it remembers, shape of the grid; see `softlube.discretization.fields.Fields`."""
        if self.memory is None:
            return None
        elastic = self.elastic_deflection(x[: self.grid.n_unknown], self.height(x))
        return -(self.memory.slope @ elastic).reshape(self.grid.shape)

    def elastic_deflection(self, pressure: Array, height: float) -> Array:
        """Displacement of the relaxed surface, sign reversed, at all nodes under nodal pressures and the far field."""
        return self.elastic.deflection(pressure) + self.far_deflection[0] + height * self.far_deflection[1]

    def film(self, x: Array) -> Array:
        """Film thickness on all nodes, Eq. (6c), shape (n,)."""
        return self.deflection(x[: self.grid.n_unknown]) + self.film_offset[0] + self.height(x) * self.film_offset[1]

    def film_change(self, step: Array) -> Array:
        """Change of the film on all nodes by a change of the unknowns."""
        change = self.deflection(step[: self.grid.n_unknown])
        return change + step[-1] * self.film_offset[1] if self.problem.load_controlled else change

    def load(self, x: Array) -> float:
        """Load ∫p dA over the whole plane."""
        n = self.grid.n_unknown
        return float(self.elastic.load_weights[:n] @ x[:n] + self.load_offset[0] + self.height(x) * self.load_offset[1])

    def load_in_doubt(self, x: Array) -> float:
        """Share of the load that is borne beyond the mesh because the viscosity of a liquid that thins rises there."""
        return abs(float(self._thickened[0] + self.height(x) * self._thickened[1]) / self.load(x))

    def fields(self, x: Array) -> Fields:
        """Pressure and film in the problem's own unit of height."""
        grid = self.grid
        fields = Fields(
            chart=grid,
            r=grid.r,
            theta=grid.theta,
            pressure=self.pressure(x).reshape(grid.shape),
            film=self.film(x).reshape(grid.shape),
            beta=self.beta,
            cavitation=self.problem.cavitation,
            load=self.load(x),
            height=self.height(x),
            liquid=self.liquid,
            indenter=self.indenter,
            slide_to_roll=self.problem.slide_to_roll,
            recovery=self.recovery(x),
        )
        return fields.in_units(1 / self.scale)

    def linearise(self, x: Array) -> LinearisedContact:
        """Residual and Jacobian at x."""
        return LinearisedContact(self, x)

    def start(self, height: float | None = None, viscosity: float = 1.0) -> Array:
        """First guess.

        Parameters
        ----------
        height : float, optional
            h₀ in the system's units where it is unknown.
        viscosity : float
            That of the liquid where the film is made, over that at rest.

        Notes
        -----
        Dry contacts of radii spread over the boundary layer, under which the film is positive everywhere.  The superposition
        is smooth at the scale β^(−2/5) of the boundary layer, and so much deeper that the film at the centre is β^(−3/5), as in
        the Hertz limit; or deeper, until the film is positive on this grid (the displacement of a thin substrate is a small
        difference of large ones).  Far outside the far field is added, so that the free boundary starts where it ends.  High
        over the surface, h₀ > 1: the pressure under a rigid sphere (Kapitza) with the far field's profile in angle.
        """
        height = -dry_contact(self.substrate, 1.0, self.indenter).indentation if height is None else height
        if not self.problem.load_controlled:
            height = self.prescribed
        r = self.grid.r[: self.grid.n_r, None]
        profile = far_field_profile(self.grid.theta, self.problem.cavitation)
        own = self.beta / viscosity
        if height > 1:
            pressure = kapitza_pressure(r, 0.0, own, height) * profile / 0.8
        else:
            dry = dry_contact(self.substrate, 1.0, self.indenter)
            beta = max(dry.like_hertz(own), 1.0)
            width = min(0.5, 1.5 * beta**-0.4)  # of the boundary layer
            lift = wanted = dry.edge_rise * beta**-0.6
            outside = profile / own * r**-3 * (1 - np.maximum(r, 1) ** -2) ** 4
            pressure = outside
            for _ in range(LIFTS):
                deeper = smeared_contact(self.substrate, dry.indentation + lift, width, self.indenter, dry.exponent)
                pressure = deeper(r) + outside
                lowest = float(np.min(self.film(self._unknowns(pressure, height))))
                if lowest > LEAST_LIFT * wanted:
                    break
                lift += max(LEAST_LIFT * wanted - lowest, LEAST_LIFT * wanted)
        return self._unknowns(pressure, height)

    def _unknowns(self, pressure: Array, height: float) -> Array:
        return np.append(pressure.ravel(), height) if self.problem.load_controlled else pressure.ravel()


@dataclass(frozen=True)
class LinearisedContact:
    """Residual and exact Jacobian of a `ContactSystem` at x; see `softlube.solvers.newton.Linearised`."""

    system: ContactSystem
    x: Array

    @cached_property
    def film(self) -> Array:
        """Film thickness on all nodes."""
        return self.system.film(self.x)

    @cached_property
    def flow(self) -> Flow:
        """The fluxes between the nodes."""
        system = self.system
        problem, pressure = system.problem, system.pressure(self.x)
        flow = system.reynolds.at(pressure, self.film, system.speed, system.liquid, problem.slide_to_roll, system.mean_stress)
        system.mean_stress = flow.mean_stress
        return flow

    @cached_property
    def residual(self) -> Array:
        """Reynolds residual at the unknown nodes, then the load's defect under load control."""
        system, balance = self.system, self.flow.residual
        return np.append(balance, system.load(self.x) - system.prescribed) if system.problem.load_controlled else balance

    @cached_property
    def scale(self) -> Array:
        """Size of the Jacobian's diagonal: ∂R/∂p at fixed film, and what a node's own deflection does to ∂R/∂u.

        The second is by far the larger within the contact; without it a residual there would be taken for cavitation.
        """
        scale = self.flow.diagonal(self.system.self_deflection) + 1e-300
        return np.append(scale, 1.0) if self.system.problem.load_controlled else scale

    def times(self, step: Array) -> Array:
        """Jacobian times a vector."""
        system, n = self.system, self.system.grid.n_unknown
        height = step[-1] if system.problem.load_controlled else 0.0
        result = self.change(np.concatenate([step[:n], height * system.rim_pressure[1]]), system.film_change(step))
        if not system.problem.load_controlled:
            return result
        return np.append(result, system.elastic.load_weights[:n] @ step[:n] + height * system.load_offset[1])

    def change(self, pressure: Array, film: Array) -> Array:
        """Change of the balances of the cells with changes of pressure and film on all nodes."""
        return self.flow.change(pressure, film)

    def balance_entries(self) -> Array:
        """Entries of the approximate Jacobian by the film, see `softlube.discretization.preconditioner.FilmBalance`."""
        return self.system.balance.entries(*self.flow.entries(self.system.reynolds.nearest))

    def equation(self, free: Mask) -> FilmEquation:
        """Newton's equation on the free unknowns."""
        system, n = self.system, self.system.grid.n_unknown
        border = None
        if system.problem.load_controlled:
            by_height = self.change(np.concatenate([np.zeros(n), system.rim_pressure[1]]), system.film_offset[1])
            # Under a light load the pressure hardly moves the film, and would drown in the changes by the height.
            center = float(self.film[0])
            deflection = abs(center - system.height(self.x) - float(system.indenter.height(system.grid.r[0])))
            unit = center * max(1.0, center / max(deflection, 1e-300))
            border = Border(by_height, system.elastic.load_weights[:n], float(system.load_offset[1]), unit)
        return FilmEquation(self.times, system.balance, self.balance_entries(), free[:n], self.film[:n], border)

    def reach(self, step: Array) -> tuple[float, float]:
        """How large a step is, and the largest fraction of it that may be taken.

        Returns
        -------
        size : float
            Largest relative change of the film, or of the pressure over its maximum if that is larger: under a light load the
            film hardly knows the pressure, in the Hertz limit the pressure hardly knows the film.
        fraction : float
            Down to which the film keeps `FILM_KEPT` of its thickness and the liquid its viscosity.
        """
        n = self.system.grid.n_unknown
        change = self.system.film_change(step) / self.film
        size = max(float(np.max(np.abs(change))), float(np.max(np.abs(step[:n])) / np.max(np.abs(self.x[:n]), initial=1e-300)))
        fraction = min(1.0, (1 - FILM_KEPT) / max(-float(np.min(change)), 1e-300))
        fluidity, slope = self.system.liquid.fluidity(self.x[:n])
        thinning = float(np.max(slope / fluidity * step[:n], initial=0.0))
        return size, min(fraction, LARGEST_THINNING / thinning) if thinning > LARGEST_THINNING else fraction
