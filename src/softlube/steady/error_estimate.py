"""Errors of the quantities, from how they change over nested grids, and whether they are small enough."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence

from softlube.discretization.fields import Fields
from softlube.model.problem import Problem
from softlube.model.quantities import QUANTITIES, REPORTED_ONLY, STEADY
from softlube.steady.mesh import DEEP_BETA, dry_under, like_hertz, over_a_gap, steepness
from softlube.steady.spike.detection import (
    LARGEST_SPIKE_ERROR,
    LEFT_OF_FIRST_ORDER,
    fall_from_top,
    is_needle,
    ridge_error,
)

LOOSER = {"film_min": 3.0, "shear_rate_max": 3.0}
LOOSER_DEEP = {"film_min": 10.0, "shear_rate_max": 10.0}
"""Quantities whose error may exceed the accuracy by this factor: the extrema in the thinnest layer, which take
more angles the larger β is; the second beyond `COARSE_BETA`."""
SPIKE_BOUND = ("pressure_max", "boundary_layer", "friction_contact", "friction_domain")
"""Quantities that the tip of a pressure spike decides, or the viscosity in it: none where no grid resolves the spike."""
FREE_BOUNDARY = {name: row.free_boundary_error for name, row in STEADY.items()}
"""Least error, times n_theta², that a grid leaves because the free boundary falls between its nodes: in terms of `yardstick`.
Measured against finer grids by benchmarks/calibrate_errors.py; see docs/verification.md."""
FREE_BOUNDARY_GAP = {
    "load_contact": 0.56,
    "height": 0.18,
    "film_center": 0.35,
    "film_min": 0.35,
    "film_min_angle_deg": 1.2e5,
    "film_inlet": 0.35,
    "film_outlet_min": 0.35,
    "pressure_center": 0.56,
    "pressure_max": 0.55,
    "pressure_gradient_inlet": 0.71,
    "boundary_layer": 0.21,
    "friction_contact": 0.36,
    "friction_domain": 0.36,
}
"""The same under a sphere that hardly touches or does not: the boundary passes close by, the minimum film sits on the axis."""
FREE_BOUNDARY_DEEP = {"film_min": 2.0, "shear_rate_max": 2.5}
"""The same for a very large β, where few angles share the layer with the minimum film."""
FREE_BOUNDARY_STEEP, FREE_BOUNDARY_STEEP_DEEP = {"film_center": 0.08}, {"film_min": 2.8, "shear_rate_max": 2.8}
"""The same on layers, whose meshes have fewer rings for their angles, at any β and at a very large one."""
SUCTION = {"film_min": 1.0, "shear_rate_max": 3.5}
"""The same without the Reynolds condition, where it differs: the largest shear lies in the suction behind the contact."""
LEFT, LEFT_BEFORE = 0.6, 0.05
"""Error over the last change, and over the one before it, which counts where the last is small by chance."""
FRONT_EDGE, OUTLET = 6.0, 150.0
"""Rise of a layer's dry pressure at the edge over Hertz's beyond which the constriction at the sides may end in a front, and
the angle in degrees beyond which the film is not thinnest there but on the outlet axis."""
ERRATIC, ERRATIC_BEFORE = 1.5, 0.3
"""The same as `LEFT` and `LEFT_BEFORE`, of what such a front decides, which lies anywhere between the nodes."""
FRONT = (
    "the layer is so thin that its film at the sides is thinnest at a front a degree wide, which the grids hardly resolve: "
    "{}. Every other quantity is as accurate as asked"
)
COARSE_BETA = 3e6
"""β up to which the coarsest grid is of use."""


def yardstick(name: str, values: Mapping[str, float]) -> float:
    """What the error of a quantity is compared with; see `softlube.model.quantities.Definition.compared_with`."""
    return QUANTITIES[name].size(values)


def floors_for(problem: Problem) -> Mapping[str, float]:
    """Errors, times n_theta² and in terms of `yardstick`, that the estimates of a problem never go below."""
    floors = dict(FREE_BOUNDARY)
    if problem.cavitation == "none":
        floors |= SUCTION
    elif over_a_gap(problem):
        floors |= FREE_BOUNDARY_GAP
    steep, deep = steepness(problem) > 0, like_hertz(problem) > DEEP_BETA and not over_a_gap(problem)
    if steep:
        floors |= FREE_BOUNDARY_STEEP
    if deep:
        floors |= FREE_BOUNDARY_STEEP_DEEP if steep else FREE_BOUNDARY_DEEP
    return floors


def estimate_errors(
    levels: Sequence[Mapping[str, float]],
    n_theta: int,
    floors: Mapping[str, float] = FREE_BOUNDARY,
    exact: str = "",
    slow: Mapping[str, float] | None = None,
    erratic: Collection[str] = (),
) -> dict[str, float]:
    """Error of the finest grid's quantities, from how they changed over the grids.

    The scheme is of fourth order where the pressure is smooth, and of second at the free boundary, whose place between the
    nodes makes the change from grid to grid erratic: now and then a quantity hardly changes by chance.  So its error is taken
    from its last change, the change before that, and what the free boundary is known to leave on a grid of that size.

    Parameters
    ----------
    levels : sequence of mapping
        Quantities on successive grids, coarse to fine; at least two.
    n_theta : int
        Angular intervals of the finest.
    floors : mapping
        See `floors_for`.
    exact : str
        A quantity that is prescribed.
    slow : mapping of str to float, optional
        Quantities that converge like the spacing only, with the least relative error of each; see `spike_bound`.
    erratic : collection of str
        Quantities that come nearer in jumps; see `front_bound`.

    Returns
    -------
    dict of str to float
        Absolute estimates; at least 95 % of true errors lie below them (docs/verification.md).
    """
    finest, before = levels[-1], levels[-2]
    estimates = {}
    for name, value in finest.items():
        last = abs(value - before[name])
        changes = max(LEFT * last, LEFT_BEFORE * abs(before[name] - levels[-3][name])) if len(levels) > 2 else last
        if slow and name in slow:
            changes = max(changes * LEFT_OF_FIRST_ORDER / LEFT, slow[name] * yardstick(name, finest))
        if name in erratic:
            changes = max(ERRATIC * last, ERRATIC_BEFORE * abs(before[name] - levels[-3][name]) if len(levels) > 2 else 0.0)
        estimates[name] = 0.0 if name == exact else max(changes, yardstick(name, finest) * floors[name] / n_theta**2)
    return estimates


def looser(problem: Problem) -> Mapping[str, float]:
    """Factors by which the errors of some quantities may exceed the accuracy.

    On a layer the pressure falls to 5 % of its maximum far inside the dry contact, or not: the boundary layer is a difference
    that may vanish, and does not decide.
    """
    factors = LOOSER_DEEP if like_hertz(problem) > COARSE_BETA else LOOSER
    return factors if dry_under(problem).edge == 1 else {**factors, "boundary_layer": math.inf}


def unresolved(
    values: Mapping[str, float], errors: Mapping[str, float], accuracy: float, looser: Mapping[str, float]
) -> dict[str, float]:
    """Quantities whose error exceeds what was asked for, with the relative error."""
    result = {}
    for name, error in errors.items():
        if name not in REPORTED_ONLY:
            relative = error / yardstick(name, values)
            if not relative <= accuracy * looser.get(name, 1.0):
                result[name] = relative
    return result


def spike_bound(fields: Fields) -> dict[str, float]:
    """Quantities that do not decide when the grid is fine enough, because a spike that it hardly resolves decides them.

    With the least relative error of each.
    """
    if not fields.is_sharp:
        return {}
    return dict.fromkeys(SPIKE_BOUND, 0.0) | {"pressure_max": ridge_error(fall_from_top(fields))}


def has_front(problem: Problem) -> bool:
    """Whether the constriction at the sides may end in a front."""
    return dry_under(problem).edge > FRONT_EDGE


def front_bound(problem: Problem, values: Mapping[str, float]) -> tuple[str, ...]:
    """Quantities that the front decides in which the constriction at a very thin layer's sides ends (docs/layers.md)."""
    at_the_sides = values["film_min_angle_deg"] < OUTLET
    return ("film_min", "shear_rate_max") if at_the_sides and has_front(problem) else ()


def too_vague(names: Iterable[str], values: Mapping[str, float], errors: Mapping[str, float]) -> tuple[str, ...]:
    """Those quantities whose error is too large for them to be given."""
    return tuple(name for name in names if not errors[name] <= LARGEST_SPIKE_ERROR * yardstick(name, values))


def withheld(problem: Problem, fields: Fields, values: Mapping[str, float], errors: Mapping[str, float]) -> tuple[str, ...]:
    """Those of them that these grids do not give: where the spike is a needle to them, or the error is large."""
    vague = too_vague(front_bound(problem, values), values, errors)
    if "film_min" in vague:
        vague += REPORTED_ONLY  # where it lies
    return (SPIKE_BOUND if is_needle(fields) else too_vague(spike_bound(fields), values, errors)) + vague


def front_doubts(
    problem: Problem, values: Mapping[str, float], errors: Mapping[str, float], accuracy: float
) -> tuple[str, ...]:
    """What is said of quantities that a front decides and that are not as accurate as asked."""
    of_front = {name: errors[name] for name in front_bound(problem, values)}
    left = unresolved(values, of_front, accuracy, looser(problem))
    vague = too_vague(of_front, values, errors)
    told = [f"{name} is {'not given' if name in vague else f'known to {error:.1%}'}" for name, error in left.items()]
    return (FRONT.format(", ".join(told)),) if told else ()
