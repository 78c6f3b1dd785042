"""Errors of the quantities, from how they change over nested grids, and whether they are small enough."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from softlube.model.quantities import QUANTITIES, REPORTED_ONLY, STEADY
from softlube.steady.regime import Regime

LOOSER = {"film_min": 3.0, "shear_rate_max": 3.0}
LOOSER_DEEP = {"film_min": 10.0, "shear_rate_max": 10.0}
"""Quantities whose error may exceed the accuracy by this factor: the extrema in the thinnest boundary layer, which need more
angles the larger β is; the second beyond `COARSE_BETA`."""
FREE_BOUNDARY = {name: row.free_boundary_error for name, row in STEADY.items()}
"""Least error, times n_theta², that a grid leaves because the free boundary falls between its nodes: in terms of `yardstick`.
Measured against finer grids by benchmarks/coverage.py, like all the following; see docs/verification.md."""
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
    "friction_total": 0.36,
    "friction_contact": 0.36,
    "friction_domain": 0.36,
}
"""Least errors under a sphere that hardly touches the substrate or does not, where they differ: the free boundary passes close
by, and the minimum film sits on the axis."""
FREE_BOUNDARY_DEEP = {"film_min": 2.0, "shear_rate_max": 2.5}
"""Least errors of a `Regime.deep` contact, where few angles share the boundary layer with the minimum film."""
FREE_BOUNDARY_STEEP, FREE_BOUNDARY_STEEP_DEEP = {"film_center": 0.08}, {"film_min": 2.8, "shear_rate_max": 2.8}
"""Least errors on layers, whose meshes have fewer rings than a half-space's for the same number of angles: of any contact, and
of a `Regime.deep` one."""
SUCTION = {"film_min": 1.0, "shear_rate_max": 3.5}
"""Least errors without the Reynolds condition: the largest shear lies in the suction behind the contact."""
COARSE_BETA = 3e6
"""β up to which the coarsest grid is of use."""


LARGEST_ERROR = 0.1
"""Relative error up to which a quantity that a refinement determines is given."""


@dataclass(frozen=True)
class Convergence:
    """How a quantity converges from grid to grid, and so what its last changes say of its error.

    Attributes
    ----------
    last, before : float
        Error over the last change, and over the change before it, which counts where the last is small by chance.
    only : float
        Error over the last change where there are two grids only.
    least : float
        Least error over `yardstick`; infinite where the grid tells nothing.
    """

    last: float
    before: float
    only: float
    least: float = 0.0


SMOOTH = Convergence(last=0.6, before=0.05, only=1.0)
"""The scheme is of fourth order where the pressure is smooth, and of second at the free boundary, whose place between the nodes
makes the change from grid to grid erratic: now and then a quantity hardly changes by chance."""


def yardstick(name: str, values: Mapping[str, float]) -> float:
    """What the error of a quantity is compared with; see `softlube.model.quantities.Definition.compared_with`."""
    return QUANTITIES[name].size(values)


def floors_for(regime: Regime) -> Mapping[str, float]:
    """Errors, times n_theta² and in terms of `yardstick`, that the estimates of a contact never go below."""
    floors = dict(FREE_BOUNDARY)
    if regime.suction:
        floors |= SUCTION
    elif regime.over_gap:
        floors |= FREE_BOUNDARY_GAP
    steep = regime.steepness > 0
    if steep:
        floors |= FREE_BOUNDARY_STEEP
    if regime.deep:
        floors |= FREE_BOUNDARY_STEEP_DEEP if steep else FREE_BOUNDARY_DEEP
    return floors


def estimate_errors(
    levels: Sequence[Mapping[str, float]],
    n_theta: int,
    floors: Mapping[str, float] = FREE_BOUNDARY,
    exact: str = "",
    convergence: Mapping[str, Convergence] | None = None,
) -> dict[str, float]:
    """Error of the finest grid's quantities, from how they changed over the grids.

    An error is taken from the quantity's last change, the change before that, and what the free boundary is known to leave on
    a grid of that size.

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
    convergence : mapping of str to Convergence, optional
        How some quantities converge; `SMOOTH` for the others.

    Returns
    -------
    dict of str to float
        Absolute estimates; at least 95 % of true errors lie below them (docs/verification.md).
    """
    finest, before = levels[-1], levels[-2]
    estimates = {}
    for name, value in finest.items():
        rate = (convergence or {}).get(name, SMOOTH)
        last = abs(value - before[name])
        if len(levels) > 2:
            changes = max(rate.last * last, rate.before * abs(before[name] - levels[-3][name]))
        else:
            changes = rate.only * last
        size = yardstick(name, finest)
        estimates[name] = 0.0 if name == exact else max(changes, rate.least * size, size * floors[name] / n_theta**2)
    return estimates


def looser(regime: Regime) -> Mapping[str, float]:
    """Factors by which the errors of some quantities may exceed the accuracy.

    On a layer the pressure falls to 5 % of its maximum far inside the dry contact, or not: the inlet's boundary layer is a
    difference that may vanish, and does not decide.  The film at the edge of the dry contact rises within that boundary layer,
    which is narrow there, to several times the film at the centre; its error may be three times the accuracy.
    """
    factors = LOOSER_DEEP if regime.beta > COARSE_BETA else LOOSER
    return factors if regime.dry.edge_rise == 1 else {**factors, "boundary_layer": math.inf, "film_inlet": 3.0}


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


def too_uncertain(names: Iterable[str], values: Mapping[str, float], errors: Mapping[str, float]) -> tuple[str, ...]:
    """Names of the quantities whose relative error is above `LARGEST_ERROR`, so that they are not given."""
    return tuple(name for name in names if not errors[name] <= LARGEST_ERROR * yardstick(name, values))
