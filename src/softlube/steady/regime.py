"""What kind of contact a problem is, computed once: mesh, first guess, ladder of grids and error estimate ask it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from softlube.model.dry import PARABOLOID, DryContact, dry_contact_at
from softlube.model.exact import HERTZ_LOAD, HERTZ_PRESSURE
from softlube.model.film_section import viscosity_at
from softlube.model.indenters import Shape
from softlube.model.indenters.base import Array
from softlube.model.problem import Problem
from softlube.model.substrates import Substrate

TOUCHING = 4.5
"""β_load at which h₀ = 0 under the Reynolds condition, about."""
THIN_GAP = 15.0
"""β′ of a layer beyond which there is a contact even where the sphere stays above the undeformed surface."""
DEEP_BETA = 2e4
"""β′ beyond which the boundary layer at the sides is what is hardest to resolve."""
BLUNT, STEEPER = 4.0, 300.0
"""Power of a blunt indenter's `DryContact.exponent` over 2, and factor of a contact of steepness 1, by which the boundary
layers at the sides are as hard to resolve as a paraboloid's on a half-space at a larger β."""
STEEP_BETA = 3e2, 3e4
"""β′ from which on the steepness counts, and beyond which it counts in full."""
THICK = 2.5
"""ln η/η₀ under a dry contact's largest pressure beyond which a spike may stand at the outlet."""
INLET_RATE = 0.5, 0.58
"""Shear rates that decide the film over the walls' mean speed over the film at the centre: of the sliding, S = 2, and of the
pressure gradient, whose wall stress is largest where the film is twice that at the centre, 3/4, and counts by √(3/5)."""
FASTER = 1.1
"""Ratio of two shear rates that tell the power with which the viscosity falls."""
FAR = 400.0
"""Square of the rim's radius over the mesh's unit of length, about, for the shear rate 2/(βr²) there; and 10⁴ times that."""
VISCOSITY_STEPS = 60
"""Steps of the fixed point for the inlet's viscosity, each of which brings it nearer by the factor 0.6 (1 − n) at least."""
RADII, FLAT = np.geomspace(1e-4, 1e8, 600), 1e-30
"""Radii at which an indenter's surface is looked at, and the height that a flat face has there."""
LEAST_SHARE = 0.01
"""Least 1 − 2(1 − n) that is looked at: at n = 1/2 a power law's far field bears any load."""
FRONT_EDGE = 6.0
"""Rise of a layer's dry pressure at the edge over a half-space's beyond which the sides' constriction may end in a front."""


@dataclass(frozen=True)
class Regime:
    """The kind of a contact, from what is known of it before it is solved.

    Attributes
    ----------
    problem : Problem
        The contact.
    dry : DryContact
        The contact without the film, under the problem's load or at its indentation.
    beta : float
        β′: β of the contact on a half-space that has boundary layers of equal width at its edge, relative to the contact
        radius; the problem's own β if its substrate is a half-space.
    unit : float
        Unit of height that suits the mesh, over the problem's own: √unit is the unit of length, and the mesh is refined one
        unit of length from the centre.
    over_gap : bool
        Whether the sphere stays above the undeformed surface, or about.  A thin layer is hardly indented but has a contact
        with narrow boundary layers at its edge, and does not count as a gap.
    steepness : float
        How much of the dry pressure's rise at the contact's edge is the substrate's: 0 on a half-space, up to 1 on thin
        layers.  Inwards from the edge the pressure rises ever faster on a thin layer, ever more slowly on a half-space.  So
        the film that enters widens the contact by more of its boundary layer's width, and the minimum at the sides is sharper
        in angle.  The steepness counts as far as the boundary layers are narrow, in full beyond the second of `STEEP_BETA`.
    thickening : float
        ln η/η₀ at the largest pressure of the dry contact, for which (2/π²)√(indentation) is taken under a paraboloid.
    viscosity : float
        Viscosity of the liquid where the film is made, over that at rest, about; 1 for a liquid that does not thin with shear.
        β′ and all that follows from it are formed with it.
    thinning : float
        Power of the shear rate with which the viscosity falls there: 1 − n for a power law, 0 for constant viscosity.
    front : bool
        Whether the constriction at the sides of the contact may end in a front, as on very thin layers (docs/how-to/layers.md).
    """

    problem: Problem
    dry: DryContact
    beta: float
    unit: float
    over_gap: bool
    steepness: float
    thickening: float
    viscosity: float
    thinning: float
    front: bool

    @classmethod
    def of(cls, problem: Problem) -> Regime:
        """Find the regime of a problem.

        Raises
        ------
        NotConvergedError
            If the dry contact on the problem's substrate is not found.
        """
        dry = _dry(problem, problem.substrate)
        viscosity, thinning = _at_inlet(problem, dry)
        own = problem.parameter / viscosity
        beta = dry.like_hertz(own)
        pressed = dry.radius**2
        if problem.load_controlled:
            # Where the film is thicker than the indentation, the pressure is as wide as the gap allows: the rigid sphere's
            # is largest at r = 0.26 √(2h₀), where the sphere has risen by 0.07 h₀.
            unit = pressed + _risen_at(problem.indenter, 0.09 * _height_under_load(problem, dry, own, thinning)) ** 2
            over_gap = beta < THIN_GAP and unit > 1.01 * pressed
        else:
            shape, half = problem.indenter, float(problem.indenter.depth(dry.radius)) / 2
            lifted = _lifted_at(shape, 8 * own / TOUCHING) ** 2
            over_contact = max(pressed, _lifted_at(shape, pressed / half**3 * beta / TOUCHING) ** 2)
            unit = float({-1: over_contact, 0: lifted, 1: _risen_at(shape, 0.1) ** 2 + lifted}[problem.height])
            over_gap = problem.height >= 0
        narrow = 0.0 if over_gap else float(np.interp(np.log(max(beta, 1.0)), np.log(STEEP_BETA), (0.0, 1.0)))
        paraboloid = problem.indenter == PARABOLOID
        highest = np.array([HERTZ_PRESSURE * dry.stiffness * np.sqrt(dry.indentation) if paraboloid else dry.highest_pressure])
        return cls(
            problem=problem,
            dry=dry,
            beta=beta,
            unit=unit,
            over_gap=over_gap,
            steepness=narrow * (1 - 1 / dry.substrate_rise),
            thickening=float(np.log(problem.liquid.viscosity(highest)[0])),
            viscosity=viscosity,
            thinning=thinning,
            front=dry.substrate_rise > FRONT_EDGE,
        )

    @property
    def thickens_outwards(self) -> bool:
        """Whether the viscosity of a liquid that thins rises from the mesh's rim on outwards, and with it the load there."""
        if not self.problem.liquid.thins:
            return False
        rim, beyond = viscosity_at(self.problem.liquid, np.array([2.0, 2e-4]) / (FAR * self.unit * self.problem.parameter))
        return bool(beyond > 1.01 * rim)

    @property
    def suction(self) -> bool:
        """Whether pressures below zero are allowed: no Reynolds condition."""
        return self.problem.cavitation == "none"

    @property
    def deep(self) -> bool:
        """Whether the boundary layers at the edge of the contact are narrow, so that the sides are hardest to resolve."""
        return self.blunt_like * STEEPER**self.steepness > DEEP_BETA and not self.over_gap

    @property
    def blunt_like(self) -> float:
        """β of a paraboloid whose boundary layers at the sides are as hard to resolve; see `BLUNT`."""
        return self.beta * max(self.dry.exponent / 2, 1.0) ** BLUNT

    @property
    def steep_like(self) -> float:
        """β of a contact on a half-space whose boundary layers at the sides are as hard to resolve; see `STEEPER`."""
        return self.beta * STEEPER**self.steepness

    @property
    def thick(self) -> bool:
        """Whether the viscosity rises so much that a pressure spike may stand at the outlet."""
        return self.thickening > THICK

    @property
    def dry_at_rest(self) -> DryContact:
        """The dry contact where nothing slides: on the relaxed substrate if it has a memory."""
        substrate = self.problem.substrate
        return self.dry if substrate.memory is None else _dry(self.problem, substrate.elastic)

    @property
    def edge_radius(self) -> float:
        """Radius a of `dry_at_rest`, over which loads and frictions are taken; the unit of length over a prescribed gap."""
        return 1.0 if self.problem.height >= 0 else self.dry_at_rest.radius

    @cached_property
    def first_height(self) -> float:
        """About the height h₀ under the problem's load, in units of the load's Hertz indentation.

        In the Hertz limit h₀ + 1 ~ β^(−3/5), and another substrate is as deep as it is dry.  A light load is carried by the
        rigid sphere's pressure, which goes like 1/(β√h₀), or without the Reynolds condition by what the deformation adds to
        that pressure, like 1/(β²h₀^(5/2)), and other indenters by their gap.  The constants are fitted to spheres.
        """
        return _height_under_load(self.problem, self.dry, self.problem.parameter / self.viscosity, self.thinning)


def _dry(problem: Problem, substrate: Substrate) -> DryContact:
    """The contact without the film on a substrate, under a problem's load or at its indentation."""
    if problem.load_controlled:
        return dry_contact_at(substrate, load=HERTZ_LOAD, indenter=problem.indenter)
    return dry_contact_at(substrate, indentation=1.0, indenter=problem.indenter)


def _at_inlet(problem: Problem, dry: DryContact) -> tuple[float, float]:
    """See `Regime.viscosity` and `Regime.thinning`: the viscosity makes the film, and the film the shear rate."""
    if not problem.liquid.thins:
        return 1.0, 0.0
    viscosity, thinning = 1.0, 0.0
    sliding, pushed = INLET_RATE
    speed = float(np.hypot(sliding * problem.slide_to_roll / 2, pushed)) / problem.parameter
    for _ in range(VISCOSITY_STEPS):
        own = problem.parameter / viscosity
        film = dry.radius**2 * dry.edge_rise * max(dry.like_hertz(own), TOUCHING / 2) ** -0.6 + max(problem.height, 0)
        if problem.load_controlled:
            film += max(_height_under_load(problem, dry, own, thinning), 0)
        viscosity, faster = map(float, viscosity_at(problem.liquid, np.array([1.0, FASTER]) * speed / film))
        thinning = float(np.log(viscosity / faster) / np.log(FASTER))
    return viscosity, thinning


def _height_under_load(problem: Problem, dry: DryContact, own: float, thinning: float) -> float:
    """See `Regime.first_height`; `own` is the problem's β with the viscosity where the film is made."""
    beta = dry.like_hertz(own)
    if beta > TOUCHING / 2:
        return 2.6 * dry.radius**2 * dry.edge_rise * beta**-0.6 - dry.indentation
    # A film of the thickness h = f(r) under a rigid indenter is r wide, and carries r³/(βh²), or without the Reynolds condition
    # what that pressure's deformation adds, r⁵/(β²h⁵).
    height = _heights(problem.indenter)
    if problem.cavitation == "reynolds":
        # Farther out a liquid that thins is less thin: the load ∫ η r⁻² dr grows by 1/(1 − 2(1 − n)), about.
        carried = RADII**3 / height**2 / max(1 - 2 * thinning, LEAST_SHARE)
        radius = _outermost(carried, np.sqrt(8 / 5.5) * own)
    else:
        radius = _outermost(RADII / height, np.sqrt(2 / 0.65) * own**0.4)
    return float(problem.indenter.height(radius))


def _risen_at(indenter: Shape, height: float) -> float:
    """Radius at which an indenter has risen to a height; 0 where that is not positive."""
    return _outermost(1 / _heights(indenter), 1 / height) if height > 0 else 0.0


def _lifted_at(indenter: Shape, stiffness: float) -> float:
    """Radius up to which a film lifts an indenter that just touches: there the film f is pressure × radius ~ r²/(βf²)."""
    return _outermost(RADII**2 / _heights(indenter) ** 3, stiffness)


def _heights(indenter: Shape) -> Array:
    """Heights of an indenter's surface at `RADII`, of a flat face not quite 0."""
    return np.maximum(indenter.height(RADII), FLAT)


def _outermost(falling: Array, value: float) -> float:
    """The outermost of `RADII`, interpolated, at which something that falls outwards, by a power or nearly so, has a value."""
    i = int(np.clip(np.flatnonzero(falling >= value).max(initial=0), 0, RADII.size - 2))
    before, after = np.log(falling[i : i + 2])
    share = np.clip((np.log(value) - before) / (after - before), 0, 1)
    return float(RADII[i] ** (1 - share) * RADII[i + 1] ** share)
