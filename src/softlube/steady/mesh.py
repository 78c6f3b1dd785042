"""Which unit of height, which grid, and about which height a problem starts from."""

from __future__ import annotations

import numpy as np

from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.model.dry import DryContact, dry_contact_at
from softlube.model.exact import HERTZ_LOAD, HERTZ_PRESSURE
from softlube.model.problem import Problem
from softlube.steady.spike.detection import is_compressible, outlet_crest

RADIAL_STEP = 5.2
"""Spacing of ξ times the number of angular intervals."""
RADIAL_STEP_LIGHT = 3.5
"""The same under a sphere that hardly touches or does not."""
LIGHT = 50.0
"""β below which a sphere hardly touches."""
RADIAL_STEP_STEEP, STEEP_LIGHT = 4.3, (3.0, 30.0)
"""The same on layers up to larger β, where the film is thinnest on the outlet axis, at the free boundary; and by how much
larger the β are for the step before and for this one, times the share of the dry pressure's rise at the edge that is theirs."""
RADIAL_STEP_SUCTION = 3.2
"""The same up to `DEEP_BETA` without the Reynolds condition: the suction behind the contact is narrower than the layer at its
edge."""
DEEP_BETA = 3e4
"""β beyond which the layer at the sides is what is hardest to resolve."""
STEEP_SHIFT, STEEP_CROWDING, STEEP_ANGLES, STEEP_STEP = 0.95, 3.0, 0.25, 1.4
"""What `steepness` adds to the mesh: by how much its zone at the edge moves outwards, over β^(−2/5); crowding at the sides;
angular intervals and, with its square, radial spacing, both as a fraction."""
DEEP_ANGLES = 31 / 26
"""Angular intervals on a layer over the half-space's at least, beyond `DEEP_BETA`, for what the free boundary leaves of the
film at the sides (`softlube.steady.error_estimate`)."""
STIFFEST_EDGE = 4.6
"""Rise of the dry pressure at the edge over Hertz's beyond which rings are added in proportion, so that those within the
contact stay as narrow as the layer is thick."""
STEEP_BETA = 3e2, 3e4
"""β′ from which on it counts, and beyond which it does in full."""
COARSEST = 0.43
"""Spacing of ξ that `STEEP_STEP` does not go beyond, lest the first grid be no start for the second."""
THIN_GAP = 15.0
"""β′ of a layer beyond which there is a contact even where the sphere stays above the undeformed surface."""
TOUCHING = 4.5
"""β_load at which h₀ = 0 under the Reynolds condition, about."""
THICK = 2.5
"""ln η/η₀ under a dry contact's largest pressure beyond which a spike may stand at the outlet."""
THICKEST = 55.0
"""The same, up to which the march in the viscosity is known to arrive."""
CREST_LAYER, CREST_LAYER_COMPRESSIBLE = 0.05, 0.01
"""Width of the refined zone at a crest, over the contact radius: in a compressible liquid the spike has a height to resolve."""
CREST_STEP = 0.4
"""Crests of meshes are multiples of this times that width, so that neighbouring problems share a grid and its operators."""


def unit_for(problem: Problem) -> float:
    """Unit of height that suits the mesh, over the problem's own: √unit is where the mesh is refined.

    A contact has its edge, as found dry, at r = 1 (on a half-space the units are the same).  Where the film is thicker than
    the indentation, the pressure is as wide as the gap allows
    (the rigid sphere's is largest at r = 0.26 √(2h₀)).
    """
    pressed = dry_under(problem).radius ** 2
    if problem.load_controlled:
        return pressed + 0.18 * max(first_height(problem), 0)
    lifted = np.sqrt(TOUCHING / problem.parameter)
    over_contact = pressed * max(1.0, np.sqrt(TOUCHING / like_hertz(problem)))
    return float({-1: over_contact, 0: lifted, 1: 0.2 + lifted}[problem.height])


def dry_under(problem: Problem) -> DryContact:
    """The contact without the film, under the problem's load or at its indentation."""
    if problem.load_controlled:
        return dry_contact_at(problem.substrate, load=HERTZ_LOAD)
    return dry_contact_at(problem.substrate, indentation=1.0)


def contact_edge(problem: Problem) -> float:
    """Radius of the dry contact, from which the boundary layer is counted; of the unit's over a gap that is prescribed."""
    return 1.0 if problem.height >= 0 else dry_under(problem).radius


def like_hertz(problem: Problem) -> float:
    """β of the contact on a half-space with the same layers at its edge; the problem's own if it is one."""
    return dry_under(problem).like_hertz(problem.parameter)


def steepness(problem: Problem) -> float:
    """How much of the dry pressure's rise at the contact's edge is the substrate's: 0 on a half-space, up to 1 on thin layers.

    Inwards from the edge the pressure rises ever faster on a thin layer, ever more slowly on a half-space.  So the film that
    enters widens the contact by more of its boundary layer's width, and the minimum at the sides is sharper in angle.  It
    counts as far as these layers are narrow, in full beyond the second of `STEEP_BETA`.
    """
    if over_a_gap(problem):
        return 0.0
    narrow = np.interp(np.log(max(like_hertz(problem), 1.0)), np.log(STEEP_BETA), (0.0, 1.0))
    return float(narrow) * (1 - 1 / dry_under(problem).edge)


def angles_for(problem: Problem, n_theta: int) -> int:
    """Angular intervals that do for a problem what `n_theta` do on a half-space."""
    steep = steepness(problem)
    factor = 1 + STEEP_ANGLES * steep
    if steep > 0 and like_hertz(problem) > DEEP_BETA:
        factor = max(factor, DEEP_ANGLES)
    return round(n_theta * factor)


def over_a_gap(problem: Problem) -> bool:
    """Whether the sphere stays above the undeformed surface, or about.

    Not so on a thin layer, which is hardly indented but has a contact with narrow layers at its edge.
    """
    if not problem.load_controlled:
        return problem.height >= 0
    return like_hertz(problem) < THIN_GAP and unit_for(problem) > 1.01 * dry_under(problem).radius ** 2


def thickening(problem: Problem) -> float:
    """Ln η/η₀ at the largest pressure of the dry contact, (2/π²)√(indentation) on a half-space."""
    highest = HERTZ_PRESSURE * np.sqrt(dry_under(problem).indentation)
    return float(np.log(problem.liquid.viscosity(np.array([highest]))[0]))


def crest_of(problem: Problem, fields: Fields, before: float = 0.0) -> float:
    """Radius of the pressure's crest on the outlet axis, over the mesh's unit of length, where it may be a spike; else 0.

    It stays where it was found `before`, if that is within the refined zone: a needle does not like to be moved.
    """
    if thickening(problem) < THICK or over_a_gap(problem):
        return 0.0
    here, layer = outlet_crest(fields) / np.sqrt(unit_for(problem)), crest_layer(problem)
    step = CREST_STEP * layer
    return before if abs(here - before) < layer else step * round(here / step)


def crest_layer(problem: Problem) -> float:
    """Width of the refined zone at a crest."""
    return CREST_LAYER_COMPRESSIBLE if is_compressible(problem.liquid) else CREST_LAYER


def grid_for(problem: Problem, n_theta: int, crest: float = 0.0) -> PolarGrid:
    """Grid with the refinement that β calls for, and a second refined zone at a `crest`, see `crest_of`.

    The layers at the contact edge are β^(−2/5) wide at the inlet and outlet and β^(−1/2) at the sides, where they take an
    angle of β^(−1/4).  The grading changes in steps of 2 (of √2 in angle), so that neighbouring β share a grid and its elastic
    operator.  On a layer it follows the `steepness`, too: with the refined zone where the film and its free boundary are, fewer
    rings do, and more angles can be had for them.
    """
    gap = over_a_gap(problem)
    beta = 1.0 if gap else max(like_hertz(problem), 1.0)
    octave = np.round(np.log2(beta**-0.4) - 0.2)  # a little early: too fine costs less than too coarse
    deep = beta > DEEP_BETA
    steep = steepness(problem)
    edge = 1 + float(min(STEEP_SHIFT * steep * 2.0**octave, 0.25))
    grid = PolarGrid(
        n_r=8,
        n_theta=n_theta,
        layer=0.5 if gap else float(min(0.4 * 2.0**octave, 0.25)),
        side_layer=float(min((2.4 if deep else 1.4) * 2.0 ** (octave * 0.625), 1.0)),
        crowding=(1.2 if deep else 0.7) + STEEP_CROWDING * steep,
        reach=60.0 if gap else 20.0,  # u = h₀ + r²/2 becomes r²/2 later under a gap
        edge=edge,
        crest=crest / edge,
        crest_layer=crest_layer(problem) / edge,
    )
    light, less_light = (LIGHT * (1 + factor * (1 - 1 / dry_under(problem).edge)) for factor in STEEP_LIGHT)
    step = RADIAL_STEP_LIGHT if beta < light else RADIAL_STEP_STEEP if beta < less_light else RADIAL_STEP
    if problem.cavitation == "reynolds":
        step = max(step, min(step * (1 + STEEP_STEP * steep**2), COARSEST * n_theta))
    elif not gap and not deep:
        step = RADIAL_STEP_SUCTION
    if not gap:
        step *= min(1.0, STIFFEST_EDGE / dry_under(problem).edge)
    return grid.resized(int(np.ceil(grid.xi_of(grid.reach * edge) * n_theta / step)), n_theta)


def first_height(problem: Problem) -> float:
    """About the height under a load, in units of the load's Hertz indentation.

    In the Hertz limit h₀ + 1 ~ β^(−3/5), and another substrate is as deep as dry.  A light load is carried by the rigid
    sphere's pressure, which goes like 1/(β√h₀), or
    without the Reynolds condition by what the deformation adds to it, like 1/(β²h₀^(5/2)) (constants measured).
    """
    beta, dry = like_hertz(problem), dry_under(problem)
    if beta > TOUCHING / 2:
        return 2.6 * dry.radius**2 * dry.edge * beta**-0.6 - dry.indentation
    beta = problem.parameter
    return 5.5 / beta**2 if problem.cavitation == "reynolds" else 0.65 / beta**0.8
