"""The mesh that suits a contact's regime."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import lru_cache

import numpy as np

from softlube.discretization.fields import Fields
from softlube.discretization.grid import WIDE, PolarGrid
from softlube.discretization.system import FAR_STRESS
from softlube.model.dry import PARABOLOID, dry_contact
from softlube.model.exact import HERTZ_LOAD
from softlube.model.film_section import viscosity_at
from softlube.model.indenters import Shape
from softlube.model.substrates import HalfSpaceKernel
from softlube.steady.regime import Regime

RADIAL_STEP = 5.2
"""Spacing of ξ times the number of angular intervals."""
RADIAL_STEP_LIGHT = 3.6
"""Radial step under a sphere that hardly touches the substrate or does not."""
LIGHT = 50.0
"""β below which a sphere hardly touches."""
RADIAL_STEP_STEEP, STEEP_LIGHT = 4.3, (3.0, 30.0)
"""Radial step on layers up to larger β, where the film is thinnest on the outlet axis, at the free boundary; and by how much
larger the β are for the light step and for this one, times the share of the dry pressure's rise at the edge that is theirs."""
RADIAL_STEP_SUCTION, RADIAL_STEP_SUCTION_DEEP = 2.8, 3.8
"""Radial step of contacts without the Reynolds condition, the second of those that are `Regime.deep`: the suction behind the
contact is narrower than the boundary layer at its edge."""
SIDE_WIDTH, WIDEST_SIDES, SIDE_CROWDING = 2.0, 1.2, 1.6
"""Width of the mesh's zone at the sides over β^(−1/4), and at most; and the crowding there.  The widest zone, of light loads,
puts the angle of 108°, at which their film breaks, where 17 to 39 intervals tell the error that it leaves."""
STEEP_SHIFT, STEEP_CROWDING, STEEP_ANGLES, STEEP_STEP = 0.95, 3.0, 0.45, 1.9
"""What `Regime.steepness` adds to the mesh: by how much its zone at the edge moves outwards, over β^(−2/5); crowding at the
sides; angular intervals and, with its square, radial spacing, both as a fraction."""
NARROWER_SIDES = 0.75
"""Factor of the width of the mesh's zone at the sides where the film there needs a finer mesh: of a liquid that thins, and on a
substrate that remembers, where the edge of the contact turns from the side towards the outlet's within about 20°."""
THINS, THINNING_CROWDING = 0.1, 0.6
"""`Regime.thinning` from which on the film at the sides, where the shear rate is largest, needs a finer mesh; and what is added
to the crowding.  Contacts at β = 1000 with n = 0.5 and λ from 100 to 1000 reach the usual accuracy with three grids, for which
four were needed without."""
STIFFEST_EDGE = 4.6
"""Rise of the dry pressure at the edge over Hertz's beyond which rings are added in proportion, so that the rings within the
contact stay as narrow as the layer is thick."""
TRAIL_WIDTH, TRAIL_NEAREST, TRAIL_FARTHEST = 0.1, 0.05, 0.9
"""Zone of the mesh about the contact's edge at the outlet, where a substrate remembers, over the mesh's edge: its width, as the
contact's edge runs from there to the sides; its least place; and from where on the zone at the edge does for it, too."""
TRAIL_THINNING = 2.8
"""Coefficient of the mesh's thinning beyond the contact where it has that zone, whose rings are wanted within the contact."""
SHIFTED_EDGE = 0.1
"""Distance of the contact's edge at the inlet and the sides from the mesh's that is not worth a change."""
BLUNT_STEP = 0.24
"""Power of 2 over a blunt indenter's `DryContact.exponent` that the radial step takes: at the edge of its contact the pressure
bends more than a paraboloid's."""
BLUNT_RINGS = 2.25
"""Over `DryContact.exponent`: angular intervals whose rings a grid has at least, for fewer hold no contact of a very blunt
indenter together.  With n = 5 to 8 and β′ to 10⁶ a grid of 9 angles finds its solution so, and has none without."""
FACE_CROWDING, FACE_STEP = 0.9, 33 / 29
"""Under a flat face, whose outlet film 17 angles know three times less well than a paraboloid's: crowding at the sides, which
leaves more angles for the outlet; and factor of a deep contact's radial step, by which 33 angles have the rings of 29."""
REACH, FARTHEST = 20.0, 60.0
"""Radius of the rim over the edge's under a paraboloid; and at least over a gap, where u = h₀ + r²/2 becomes r²/2 later."""
RIMS, FAR_EXPONENT = REACH * 2.0 ** np.arange(-4, 7, 0.25), 1.98
"""Radii of the rim under other indenters, in steps, so that neighbouring contacts share a grid; and the least exponent r f′/f
there: the far field's load, ∝ ∫ r⁻³ dr of a paraboloid, diverges under a cone."""
BORNE_BEYOND, FAR_POWER = 1.7, 0.1
"""Load beyond a radius r over η/(βr), by the far field's profile under the Reynolds condition; and ln r over which the power is
taken with which the viscosity of a liquid that thins goes there."""
FAR_DOUBT, FARTHER = 1e-4, 2.0 ** np.arange(6)
"""Share of a load up to which the mesh may leave it to the far field, times that power; and factors of the rim's radius, of
which the first is taken where none does, as under a power law, whose load depends on where the liquid ends."""
CORE, BENDS = 0.7, np.linspace(0, 0.8, 61)
"""Width of the mesh's zone about the centre over the length on which an indenter's dry pressure bends, and the radii over the
contact's at which that is looked for."""
COARSEST = 0.43
"""Spacing of ξ that `STEEP_STEP` does not go beyond, lest the first grid be no start for the second."""


def angles_for(regime: Regime, n_theta: int) -> int:
    """Angular intervals that do for a contact what `n_theta` do on a half-space; always odd."""
    return 2 * int(n_theta * (1 + STEEP_ANGLES * regime.steepness) / 2) + 1


def has_face(regime: Regime) -> bool:
    """Whether an indenter is blunt and its dry pressure bends within the contact, as at the border of a flat face."""
    return regime.dry.exponent > 2 and _extent(regime.problem.indenter, float(np.sqrt(regime.unit)))[1] < WIDE


def grid_for(regime: Regime, n_theta: int, adjustments: Iterable[Callable[[PolarGrid], PolarGrid]] = ()) -> PolarGrid:
    """Grid with the refinement that the regime calls for.

    The boundary layers at the contact edge are β^(−2/5) wide at the inlet and outlet and β^(−1/2) at the sides, where they
    take an angle of β^(−1/4).  The grading changes in steps of 2 (of √2 in angle), so that neighbouring β share a grid and its
    elastic operator.  On a layer the grading follows the steepness, too: with the refined zone at the film and its free
    boundary fewer rings are enough, and the mesh can have more angles.

    Parameters
    ----------
    regime : Regime
        The kind of contact.
    n_theta : int
        Angular intervals over 0 ≤ θ ≤ π.
    adjustments : iterable of callable
        Each changes the grid, for instance by a second refined zone, before the rings are counted; see
        `softlube.steady.refinements.Refinement.adjust`.
    """
    beta = 1.0 if regime.over_gap else max(regime.beta, 1.0)
    octave = np.round(np.log2(beta**-0.4) - 0.2)  # a little early: too fine costs less than too coarse
    steep, rise = regime.steepness, regime.dry.substrate_rise
    edge = 1 + float(min(STEEP_SHIFT * steep * 2.0**octave, 0.25))
    width = float(min(SIDE_WIDTH * 2.0 ** (octave * 0.625), WIDEST_SIDES))
    blunt, face = min(1.0, 2 / regime.dry.exponent), has_face(regime)
    crowding = (FACE_CROWDING if face else SIDE_CROWDING) + STEEP_CROWDING * steep
    if regime.thinning > THINS and not regime.over_gap:
        width, crowding = NARROWER_SIDES * width, crowding + THINNING_CROWDING
    reach, core = _extent(regime.problem.indenter, float(np.sqrt(regime.unit)))
    reach = _farther(regime, max(reach, FARTHEST) if regime.over_gap else reach)
    grid = PolarGrid(
        n_r=8,
        n_theta=n_theta,
        edge_width=0.5 if regime.over_gap else float(min(0.4 * 2.0**octave, 0.25 * blunt)),
        side_width=width,
        side_clustering=crowding,
        reach=reach,
        edge=edge,
        core=core,
    )
    for adjust in adjustments:
        grid = adjust(grid)
    light, less_light = (LIGHT * (1 + factor * (1 - 1 / rise)) for factor in STEEP_LIGHT)
    step = RADIAL_STEP_LIGHT if beta < light else RADIAL_STEP_STEEP if beta < less_light else RADIAL_STEP
    if not regime.suction:
        step = max(step, min(step * (1 + STEEP_STEP * steep**2), COARSEST * n_theta))
    elif not regime.over_gap:
        step = RADIAL_STEP_SUCTION_DEEP if regime.deep else RADIAL_STEP_SUCTION
    if not regime.over_gap:
        step *= min(1.0, STIFFEST_EDGE / rise)
        if face:
            step *= FACE_STEP if regime.deep else 1.0
        elif not regime.deep and beta >= light:
            step *= blunt**BLUNT_STEP
    rings = max(n_theta, BLUNT_RINGS * regime.dry.exponent)
    return grid.resized(int(np.ceil(grid.xi_of(grid.reach * edge) * rings / step)), n_theta)


@lru_cache(maxsize=512)
def _extent(indenter: Shape, edge: float) -> tuple[float, float]:
    """Reach and core of the mesh that suit an indenter's contact of a radius; see `PolarGrid`.

    The rim is where the displacement, which falls like 1/r, is as small beside the height as under a paraboloid at `REACH`.
    Where the dry pressure over Hertz's is no parabola, as at a tip or the border of a flat face, the mesh is refined about the
    centre.
    """
    if indenter == PARABOLOID:
        return REACH, WIDE
    edge = max(edge, 1.1 * indenter.flat)
    height = indenter.height(edge * RIMS)
    exponent = edge * RIMS * indenter.slope(edge * RIMS) / height
    far = (RIMS * height > 0.499 * REACH**3 * indenter.depth(edge)) & (exponent > FAR_EXPONENT)
    smooth = dry_contact(HalfSpaceKernel(), edge, indenter).smooth_part(BENDS)
    rest = smooth - np.polynomial.Polynomial.fit(BENDS**2, smooth, 1)(BENDS**2)
    bend = np.diff(rest, 2) / BENDS[1] ** 2 / smooth[1:-1]
    core = CORE / max(np.sqrt(np.max(np.abs(bend))), CORE / WIDE)
    return float(RIMS[np.argmax(far)] if far.any() else RIMS[-1]), float(2.0 ** (np.round(2 * np.log2(core)) / 2))


def _farther(regime: Regime, reach: float) -> float:
    """The rim's radius where a liquid thins: farther out, where it is hardly sheared, it is thicker and bears more of the load.

    The far field beyond the rim has the profile of a constant viscosity.
    """
    problem = regime.problem
    if not (problem.liquid.thins and problem.load_controlled and not regime.suction):
        return reach
    r = reach * FARTHER * np.sqrt(regime.unit)
    rate = 2 * np.hypot(problem.slide_to_roll / 2, FAR_STRESS) / (problem.parameter * r**2)
    here, beyond = (viscosity_at(problem.liquid, rate / step) for step in (1.0, np.exp(2 * FAR_POWER)))
    doubt = np.log(beyond / here) / FAR_POWER * BORNE_BEYOND * here / (problem.parameter * r) / HERTZ_LOAD
    return reach * float(FARTHER[np.argmax(doubt < FAR_DOUBT)])


def with_trail(grid: PolarGrid, fields: Fields, unit: float) -> PolarGrid:
    """The grid of a contact whose edge is nearer to the axis at the outlet than at the inlet and the sides.

    Parameters
    ----------
    grid : PolarGrid
        The grid of a round contact.
    fields : Fields
        Pressure of about this contact, in the problem's unit.
    unit : float
        The grid's unit of height over the problem's.
    """
    inlet, side, outlet = (_edge_of(fields, angle) / float(np.sqrt(unit)) for angle in (0.0, np.pi / 2, np.pi))
    edge = (inlet + side) / 2
    if abs(edge - grid.edge) < SHIFTED_EDGE:
        edge = grid.edge
    grid, crest = replace(grid, edge=edge), max(outlet / edge, TRAIL_NEAREST)
    if crest > TRAIL_FARTHEST:
        return grid
    sides = NARROWER_SIDES * grid.side_width
    return replace(grid, crest=crest, crest_width=TRAIL_WIDTH, thinning=TRAIL_THINNING, side_width=sides)


def _edge_of(fields: Fields, angle: float) -> float:
    """Where the pressure falls most steeply outwards, between the nodes nearest to an angle; the rim where it only rises."""
    ray = fields.pressure[:, int(np.argmin(np.abs(fields.theta - angle)))]
    highest = int(np.argmax(ray[:-1]))
    fall = -np.diff(ray[highest:]) / np.diff(fields.r[highest:])
    steepest = highest + int(np.argmax(fall))
    return float(fields.r[steepest] + fields.r[steepest + 1]) / 2
