"""The dry contact of a ball that slides over a substrate that remembers: the limit β → ∞ of the lubricated one.

Without friction between the surfaces the pressure and the gap satisfy

    p ≥ 0,     u = h₀ + f(r) − w ≥ 0,     p u = 0,

with the displacement w of the memory (`softlube.discretization.memory`).  The contact is no circle: behind its centre the
surface comes back late.  It is solved on the grids of the lubricated contact by the same Newton method.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.discretization.measure import hysteresis_friction
from softlube.discretization.system import ContactSystem
from softlube.errors import InputError, NotConvergedError
from softlube.model.indenters import Paraboloid, Shape
from softlube.model.problem import Problem
from softlube.model.quantities import Quantity
from softlube.model.substrates import Substrate
from softlube.solvers.newton import newton
from softlube.solvers.threads import one_thread
from softlube.steady.error_estimate import error_of
from softlube.steady.level import prolong, sketch
from softlube.steady.mesh import grid_for, with_trail
from softlube.steady.regime import Regime

Array = NDArray[np.floating]
Mask = NDArray[np.bool_]

STILL = 1e30
"""β at which the liquid carries nothing."""
EDGE_BETA = 1e4
"""β′ of the lubricated contact whose grids are taken."""
ANGLES = (21, 31, 45)
"""Angular intervals of the nested grids."""
LEAST = 1e-9
"""Pressure over the largest above which a node is in contact."""
STEPS = 60
"""Steps of Newton's method at most: each moves the edge of the contact by some nodes."""


class _Touching:
    """Gap and pressure as a complementarity problem, a `softlube.solvers.newton.System`."""

    def __init__(self, system: ContactSystem) -> None:
        self.contact = system
        self.constrained = np.ones(system.grid.n_unknown, dtype=bool)

    def linearise(self, x: Array) -> _LinearisedTouching:
        """Residual and Jacobian at x."""
        return _LinearisedTouching(self.contact, x)


@dataclass(frozen=True)
class _LinearisedTouching:
    """The gap at x, and what pressures do to it; a `softlube.solvers.newton.Linearised`."""

    contact: ContactSystem
    x: Array

    @cached_property
    def residual(self) -> Array:
        """The gap at the unknown nodes."""
        return self.contact.film(self.x)[: self.x.size]

    @property
    def scale(self) -> Array:
        """What the pressure of a node does to the gap there."""
        return self.contact.self_deflection[: self.x.size]

    def times(self, step: Array) -> Array:
        """Change of the gap by a change of the pressure."""
        return self.contact.deflection(step)[: step.size]

    def equation(self, free: Mask) -> _TouchingEquation:
        """Newton's equation on the nodes in contact."""
        return _TouchingEquation(self.contact, free, self.times)

    def reach(self, step: Array) -> tuple[float, float]:
        """Size of a step over the largest pressure, all of which may be taken."""
        return float(np.max(np.abs(step)) / np.max(np.abs(self.x + step), initial=1e-300)), 1.0


@dataclass(frozen=True)
class _TouchingEquation:
    """A `softlube.solvers.newton.LinearEquation` for the pressures in contact, preconditioned by the local stiffness."""

    contact: ContactSystem
    free: Mask
    times: Callable[[Array], Array]

    def at(self, times: Callable[[Array], Array]) -> _TouchingEquation:
        """The same: it is linear."""
        return replace(self, times=times)

    def right(self, residual: Array) -> Array:
        """About the pressures that a change of the gap asks for, zero outside the contact."""
        return np.where(self.free, self.contact.balance.stiffness @ np.where(self.free, residual, 0.0), 0.0)

    def operator(self, unknown: Array) -> Array:
        """Nearly the identity."""
        return self.right(self.times(np.where(self.free, unknown, 0.0)))

    def step(self, unknown: Array) -> Array:
        """The step in pressures."""
        return np.where(self.free, unknown, 0.0)


@dataclass(frozen=True)
class DrySliding:
    """A dry ball sliding over a substrate that remembers, normalised with its indentation.

    Attributes
    ----------
    fields : Fields
        Pressure and gap on the finest grid.
    load : Quantity
        ∫p dA.
    friction : Quantity
        The substrate's friction, 6∫p ∂w/∂x dA, in units of (2π/3) G h₀²; see `softlube.model.quantities`.
    friction_coefficient : Quantity
        μ over √(indentation/R): the horizontal over the vertical force.
    """

    fields: Fields
    load: Quantity
    friction: Quantity
    friction_coefficient: Quantity

    def edge(self, theta: float) -> float:
        """Radius up to which the pressure reaches at the node's angle nearest to one from the inlet [rad].

        The pressure ends like the root of the distance: its square is continued beyond the last two nodes in contact.
        """
        ray = self.fields.pressure[:, int(np.argmin(np.abs(self.fields.theta - theta)))]
        last = int(np.flatnonzero(ray > LEAST * np.max(self.fields.pressure))[-1])
        r, square = self.fields.r[last - 1 : last + 1], ray[last - 1 : last + 1] ** 2
        return float(r[1] + (r[1] - r[0]) * square[1] / max(square[0] - square[1], square[1]))


@one_thread
def dry_sliding(substrate: Substrate, indenter: Shape | None = None) -> DrySliding:
    """Solve the dry contact at an indentation of one unit of height.

    Parameters
    ----------
    substrate : Substrate
        With a memory, see `softlube.model.substrates.ViscoelasticKernel`; lengths over √(R × indentation).
    indenter : Shape, optional
        The paraboloid if none.

    Raises
    ------
    InputError
        If the substrate remembers nothing: `softlube.dry.dry_contact` has that contact.
    NotConvergedError
        If Newton's method fails.

    Examples
    --------
    >>> from softlube.model.substrates import ViscoelasticKernel
    >>> contact = dry_sliding(ViscoelasticKernel((0.5,), (1.0,)))
    >>> contact.edge(0.0) > contact.edge(3.14)
    True
    """
    if substrate.memory is None:
        raise InputError("substrate: it remembers nothing; softlube.dry.dry_contact has its contact")
    shape = indenter or Paraboloid()
    beta = EDGE_BETA * substrate.compliance(1.0)
    problem = Problem(beta=beta, substrate=substrate, indenter=shape)
    regime = Regime.of(problem)
    pressed = list(_pressed(regime))
    loads = [each.load for each in pressed]
    frictions = [hysteresis_friction(each) for each in pressed]
    coefficients = [friction / (6 * load) for friction, load in zip(frictions, loads, strict=True)]
    known = (Quantity(values[-1], error_of(values, ANGLES)) for values in (loads, frictions, coefficients))
    return DrySliding(pressed[-1], *known)


def _grids(regime: Regime) -> list[PolarGrid]:
    drawn = sketch(regime.problem).fields
    return [grid_for(regime, n, [lambda grid: with_trail(grid, drawn, regime.unit)]) for n in ANGLES]


def _pressed(regime: Regime) -> Iterator[Fields]:
    """Pressure and gap on nested grids, each found from the one before."""
    problem = replace(regime.problem, beta=STILL)
    before: tuple[Array, PolarGrid] | None = None
    for grid in _grids(regime):
        system = ContactSystem(problem, grid, regime.unit)
        start = system.start(-1.0 / regime.unit) if before is None else prolong(*before, grid, regime)
        result = newton(_Touching(system), start, tolerance=1e-8, max_iterations=STEPS)
        if not result.converged:
            raise NotConvergedError(f"the dry contact was not found on {grid.n_r} x {grid.n_theta} cells")
        yield system.fields(result.x)
        before = result.x, grid
