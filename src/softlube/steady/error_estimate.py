"""Errors of the quantities, from three nested grids, and whether they are small enough."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from softlube.discretization.fields import Fields
from softlube.discretization.measure import FRICTIONS, least_film_on
from softlube.model.quantities import QUANTITIES, REPORTED_ONLY
from softlube.steady.regime import Regime

LOOSER = {"film_min": 3.0, "shear_rate_max": 3.0}
LOOSER_DEEP = {"film_min": 10.0, "shear_rate_max": 10.0}
"""Quantities whose error may exceed the accuracy by this factor: the extrema in the thinnest boundary layer, which need more
angles the larger β is; the second beyond `COARSE_BETA`."""
LOOSER_TRAIL = LOOSER_DEEP | {"film_outlet_min": 10.0}
"""The same on a substrate that remembers, where the edge of the contact runs askew to the mesh."""
OFF_THE_EDGE = {"boundary_layer": math.inf}
"""What does not decide where the contact does not end at the edge of the dry elastic contact, on layers and on substrates that
remember: this layer is measured from that edge, a difference that may vanish."""
COARSE_BETA = 3e6
"""β′ beyond which the thinnest boundary layer is known less well, and grids of 9 angles cannot hold it together."""
LARGEST_ERROR = 0.1
"""Relative error up to which a quantity that a refinement determines is given."""
GRIDS = 3
"""Number of nested grids that tell an error."""
SCHEME_ORDER, MEMORY_ORDER = 4.0, 3.5
"""Power of the spacing with which smooth solutions converge, and with which they do on a substrate that remembers: what it
remembers is taken along lines that cross the mesh at any angle.  On 17, 29 and 39 angles the displacement that a substrate
remembers converges like the spacing to the power 3.2 to 3.6 where lengths are 0.03 to 0.3 of the radius, else faster."""
SLOWER = 0.5
"""Taken off that power for what the middle grid's change tells by itself: the free boundary has a larger share in it than in
the coarsest grid's."""
VALLEY, VALLEY_REACH, VALLEY_SLOWER = ("film_min", "shear_rate_max"), 2, 0.75
"""Quantities whose error is at least that of the film along its valley; length of the valley on each side of its lowest place
that is compared, in intervals of the middle grid; and what is taken off the power of smooth solutions to read its change."""
SAFETY = 1.35
"""Factor of the estimates, for at least 95 % of the errors of every quantity to lie below them (docs/notes/errors.md)."""


@dataclass(frozen=True)
class Convergence:
    """How a quantity converges from grid to grid.

    Attributes
    ----------
    order : int
        Power of the spacing with which it converges at worst.
    smooth : bool
        Whether a part of fourth order can be told from the worst one.
    jumps : float
        Share of the coarsest grid's change that is not smooth, where it cannot be told.
    least : float
        Least error over `yardstick`; infinite where the grid tells nothing.
    """

    order: int
    smooth: bool = False
    jumps: float = 0.5
    least: float = 0.0


SMOOTH = Convergence(order=2, smooth=True)
"""The scheme is of fourth order along r where the pressure is smooth, and of second at the free boundary."""
PLACES = dict.fromkeys((name for name, row in QUANTITIES.items() if row.place), Convergence(order=1))
"""Where an extremum lies, which is flat there: a place is found an order worse than the value."""
BY_CHANCE = Convergence(order=2)
"""Where two changes may agree by chance."""
BETWEEN_NODES = {"pressure_gradient_inlet": Convergence(order=2, smooth=True, least=4e-5)}
"""The steepest place of the inlet lies between nodes: where in its cell leaves errors of 4·10⁻⁵, and grids agree by chance."""
AT_THE_BOUNDARY = {"film_outlet_min": Convergence(order=2, jumps=0.8), "shear_rate_max": BY_CHANCE}
"""The extrema where the liquid leaves the contact, at the free boundary under the Reynolds condition: its place within a cell
decides their errors, and on the outlet axis nothing else does."""
CANCELLING = dict.fromkeys(FRICTIONS, Convergence(order=2, smooth=True, least=1e-6))
"""Errors of the frictions along r and along θ have opposite signs in narrow boundary layers, 5·10⁻⁶ each at β = 3·10⁷ on 39
angles.  What is left of both is not told below a fifth of that, for grids are nested to whole rings only."""
REMEMBERED = dict.fromkeys(("friction_total", "friction_hysteresis"), Convergence(order=2, smooth=True, least=2e-5))
"""Frictions that a substrate makes which remembers: where the lines along which it does cross the mesh leaves 2·10⁻⁵, and grids
agree by chance."""


def yardstick(name: str, values: Mapping[str, float]) -> float:
    """What the error of a quantity is compared with; see `softlube.model.quantities.Definition.compared_with`."""
    return QUANTITIES[name].size(values)


def scheme_order(regime: Regime) -> float:
    """Power of the spacing with which a contact's smooth solution converges."""
    return SCHEME_ORDER if regime.problem.substrate.memory is None else MEMORY_ORDER


def convergence_of(regime: Regime) -> dict[str, Convergence]:
    """How the quantities of a contact converge; those that are not named as `SMOOTH`."""
    named = PLACES | CANCELLING | BETWEEN_NODES | ({} if regime.suction else AT_THE_BOUNDARY)
    return named if regime.problem.substrate.memory is None else named | REMEMBERED


def error_of(values: Sequence[float], angles: Sequence[int], rate: Convergence = SMOOTH, smooth: float = SCHEME_ORDER) -> float:
    """Error of the last of three values on nested grids.

    Parameters
    ----------
    values : sequence of float
        Coarse to fine.
    angles : sequence of int
        Angular intervals of the grids.
    rate : Convergence
        How the values converge.
    smooth : float
        Power q of the spacing with which a smooth solution converges.

    Notes
    -----
    A change x(h) − x(1) from a grid with the spacing h, relative to the finest's, is read as if it were smooth:
    change/(h^q − 1), a from the middle grid and b from the coarsest.  Where the solution is smooth both agree and are the
    error.  What they differ by belongs to the free boundary, which leaves an error of second order.  Its place within its cell
    is another one on every grid: the signs tell nothing, and nothing beyond the larger reading does.  So the error is
    M + k min(|a − b|, M), where M is the larger of |b| and of what the middle grid tells by itself, its change read as of the
    power q − 1/2.  This k turns readings of the powers q − 1/2 and q into an error of second order.

    Where that place is all that counts a and b may agree by chance.  Then all is read as of second order, a as of the
    quantity's own, and the largest is taken: a, what it differs from b by, and half of b, which has a smooth part, too, or four
    fifths on the outlet axis, where that part is small.
    """
    coarsest, middle = (value - values[-1] for value in values[-GRIDS:-1])
    far, near = (angles[-1] / n for n in angles[-GRIDS:-1])
    a, b = middle / (near**smooth - 1), coarsest / (far**smooth - 1)
    apart, a, b = abs(a - b), abs(a), abs(b)
    # Over what second order would make of them.
    near_ratio, far_ratio = ((h**smooth - 1) / (h**2 - 1) for h in (near, far))
    if rate.smooth:
        slow = near ** (smooth - SLOWER) - 1
        own, own_ratio = abs(middle) / slow, slow / (near**2 - 1)
        k, largest = far_ratio * (own_ratio - 1) / (far_ratio - own_ratio), max(own, b)
        return SAFETY * (largest + k * min(apart, largest))
    own = (near**smooth - 1) / (near**rate.order - 1)
    return SAFETY * max(own * a, near_ratio * apart, rate.jumps * far_ratio * b)


def valley_error(
    fields: Sequence[Fields], values: Mapping[str, float], angles: Sequence[int], smooth: float = SCHEME_ORDER
) -> float:
    """Relative error of the film along its valley, near the finest grid's minimum.

    Coarse grids do not see how narrow the minimum at the sides is in angle.  Their errors change sign there, and three values
    may agree by chance, but a stretch of the valley does not.  Its largest change from the middle grid to the finest is read as
    of three quarters of an order less than that of smooth solutions.

    Parameters
    ----------
    fields : sequence of Fields
        On nested grids, coarse to fine.
    values : mapping of str to float
        Quantities on the finest grid.
    angles : sequence of int
        Angular intervals of the grids.
    smooth : float
        Power of the spacing with which a smooth solution converges, see `scheme_order`.
    """
    coarse, fine = fields[-2:]
    near, interval = angles[-1] / angles[-2], np.pi / angles[-2]
    lowest = float(fine.chart.s_of(np.radians(values["film_min_angle_deg"])))
    s = np.clip(lowest + interval * np.linspace(-VALLEY_REACH, VALLEY_REACH, 4 * VALLEY_REACH + 1), 0.0, np.pi)
    here = least_film_on(fine, s)
    change = np.max(np.abs(least_film_on(coarse, s) - here)) / np.min(here)
    return SAFETY * float(change) / (near ** (smooth - VALLEY_SLOWER) - 1)


def estimate_errors(
    levels: Sequence[Mapping[str, float]],
    angles: Sequence[int],
    exact: str = "",
    convergence: Mapping[str, Convergence] | None = None,
    smooth: float = SCHEME_ORDER,
    least: Mapping[str, float] | None = None,
) -> dict[str, float]:
    """Errors of the finest grid's quantities, from how they changed over the last three grids.

    Parameters
    ----------
    levels : sequence of mapping
        Quantities on nested grids, coarse to fine; at least `GRIDS`.
    angles : sequence of int
        Angular intervals of the grids.
    exact : str
        A quantity that is prescribed.
    convergence : mapping of str to Convergence, optional
        How some quantities converge; else as `SMOOTH`; see `convergence_of`.
    smooth : float
        Power of the spacing with which a smooth solution converges, see `scheme_order`.
    least : mapping of str to float, optional
        Relative errors that some quantities have at least, see `valley_error`.

    Returns
    -------
    dict of str to float
        Absolute estimates; at least 95 % of true errors lie below them (docs/verification.md).
    """
    estimates = {}
    for name in levels[-1]:
        rate = (convergence or {}).get(name, SMOOTH)
        error = error_of([level[name] for level in levels], angles, rate, smooth)
        known = max(rate.least, (least or {}).get(name, 0.0)) * yardstick(name, levels[-1])
        estimates[name] = 0.0 if name == exact else max(error, known)
    return estimates


def looser(regime: Regime) -> Mapping[str, float]:
    """Factors by which the errors of some quantities may exceed the accuracy.

    On a layer the film at the edge of the dry contact rises within a boundary layer, which is narrow there, to several times
    the film at the centre; its error may be three times the accuracy.  A liquid that thickens far outside, where it is hardly
    sheared, bears a load there that no mesh has, and of which the solution warns.
    """
    remembers, layer = regime.problem.substrate.memory is not None, regime.dry.substrate_rise != 1
    factors = dict(LOOSER_TRAIL if remembers else LOOSER_DEEP if regime.beta > COARSE_BETA else LOOSER)
    if remembers or layer:
        factors |= OFF_THE_EDGE
    if layer:
        factors["film_inlet"] = 3.0
    if regime.thickens_outwards:
        factors["load"] = math.inf
    return factors


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
