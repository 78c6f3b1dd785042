"""Friction at any load and β: load curves of several loads, and polynomials in ln(load) between them.

On a half-space with constant viscosity every load has one and the same curve.  A layer is the thicker over the contact's radius
the lighter the load, and an oil thickens the less: there each load has a curve of its own.  Where a few loads are measured,
their curves are taken; else those of Chebyshev's points in ln(load), so many that the polynomial through them is as accurate as
they are.  The polynomial is one of the logarithm of the friction's Couette part, of its Poiseuille part, and of what a
viscoelastic substrate makes, none of which changes sign: under an oil they rise by orders of magnitude with the load.

Other numbers of the normalised problem may vary, too, such as the index of a liquid that thins with shear: then there are
curves for nodes of each, and polynomials in their logarithms.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.experiments.load_curve import ACCURACY, LoadCurve, load_curves
from softlube.experiments.nodes import at
from softlube.model.motions import FIXED_BALL
from softlube.model.problem import Problem
from softlube.solvers.progress import Listener

Array = NDArray[np.floating]

MOST_CURVES = 8
"""Different loads up to which each has its own curve."""
LEVELS = (3, 5, 9)
"""Numbers of nested Chebyshev points; a level is enough where the one before it predicts it."""
LEVEL = 5
"""The level where other numbers vary, too, and curves are dear."""
INWARDS = 1.1
"""Factor of β over which the slope at the end of a curve is taken."""


@dataclass(frozen=True)
class LoadFamily:
    """Load curves of several loads.

    Attributes
    ----------
    loads : ndarray, shape (curves,)
        Rising [N].
    curves : tuple of LoadCurve
        Their curves; one for all loads where it does not depend on the load.  Those of all loads stand together, for each
        combination of the `numbers`.
    numbers : tuple of ndarray
        Nodes of other numbers that vary, each rising.
    """

    loads: Array
    curves: tuple[LoadCurve, ...]
    numbers: tuple[Array, ...] = ()

    @property
    def low(self) -> float:
        """Least β_load that all curves hold at."""
        return max(curve.low for curve in self.curves)

    @property
    def high(self) -> float:
        """Greatest β_load that all curves hold at."""
        return min(curve.high for curve in self.curves)

    def friction(
        self,
        load: ArrayLike,
        beta_load: ArrayLike,
        *,
        numbers: Sequence[float] = (),
        force: str = "total",
        slide_to_roll: ArrayLike = 2.0,
    ) -> Array:
        """Friction over (2π/3) G δ², see `softlube.experiments.load_curve.LoadCurve.friction`.

        Parameters
        ----------
        load : array_like
            Load [N].
        beta_load : array_like
            β of Eq. (30).
        numbers : sequence of float
            The other numbers that vary.
        force, slide_to_roll
            See there.

        Notes
        -----
        Beyond the ends of the curves it goes on with its last slope in β, and with the value at the end in the load, so that a
        search does not fall off.
        """
        load, beta, rolls = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (load, beta_load, slide_to_roll)))
        inside = np.clip(beta, self.low, self.high)
        weights = self._weights(load, numbers)
        found = self._inside(weights, inside, force, rolls)
        for end, inner in ((self.low, INWARDS * self.low), (self.high, self.high / INWARDS)):
            beyond = beta < end if end == self.low else beta > end
            if np.any(beyond):
                there = weights[:, beyond], force, rolls[beyond]
                at_end, further_in = (self._inside(there[0], np.full(beyond.sum(), b), *there[1:]) for b in (end, inner))
                slope = np.log(np.abs(at_end / further_in)) / math.log(end / inner)
                found[beyond] *= (beta[beyond] / end) ** slope
        return found

    def _inside(self, weights: Array, beta: Array, force: str, rolls: Array) -> Array:
        couette, sphere = (
            np.array([curve.friction(beta, force=each)[0] for curve in self.curves]) for each in ("couette", "sphere")
        )
        poiseuille = sphere - couette
        sign = {"total": -1.0, "sphere": 1.0, "couette": 0.0}[force]
        sliding = rolls / FIXED_BALL if self.curves[0].linear else 1.0
        found = _between(couette, weights) * sliding + sign * _between(poiseuille, weights)
        if force == "total" and "viscous" in self.curves[0].functions:
            total = np.array([curve.friction(beta)[0] for curve in self.curves])
            found += _between(total - couette + poiseuille, weights)
        return found

    def _weights(self, load: Array, numbers: Sequence[float] = ()) -> Array:
        """What each curve counts at some loads, shape (curves, …): Lagrange's polynomials in ln(load) and the logarithms."""
        weights = _lagrange(self.loads, load)
        for nodes, number in zip(reversed(self.numbers), reversed(numbers), strict=True):
            own = _lagrange(nodes, np.full(load.shape, number))
            weights = (own[:, None] * weights[None]).reshape(-1, *load.shape)
        return weights


def _lagrange(places: Array, at: Array) -> Array:
    """Lagrange's polynomials in the logarithm, shape (places, …); beyond the ends their values there."""
    nodes, x = np.log(places), np.log(np.clip(at, places[0], places[-1]))
    weights = np.ones((nodes.size, *x.shape))
    for k, node in enumerate(nodes):
        for other in np.delete(nodes, k):
            weights[k] *= (x - other) / (node - other)
    return weights


def _between(values: Array, weights: Array) -> Array:
    """Polynomial in ln(load) through the logarithms of some values; through the values themselves where signs differ."""
    one_sign = np.all(values > 0, axis=0) | np.all(values < 0, axis=0)
    logarithm = np.log(np.where(one_sign, np.abs(values), 1.0))
    return np.where(
        one_sign, np.sign(values[0]) * np.exp(np.sum(weights * logarithm, axis=0)), np.sum(weights * values, axis=0)
    )


def load_family(
    problem_at: Callable[..., Problem],
    loads: ArrayLike,
    low: float,
    high: float,
    *,
    spread: float = 1.0,
    numbers: Sequence[Array] = (),
    region: str | float = 2.0,
    accuracy: float = ACCURACY,
    progress: Listener | None = None,
) -> LoadFamily:
    """Load curves for some loads over a range of β_load.

    Parameters
    ----------
    problem_at : callable
        The contact's problem under a load [N], and with other numbers if there are any; its β_load counts for nothing.
    loads : array_like
        Loads that are asked for [N].
    low, high : float
        Range of β_load.
    spread : float
        Factor by which other loads may be asked for later, heavier and lighter.
    numbers : sequence of ndarray
        Nodes of other numbers that vary, each rising.
    region, accuracy, progress
        See `softlube.experiments.load_curve.load_curve`.

    Raises
    ------
    NotConvergedError
        If no part of the range can be solved at one of the loads.
    """
    different = np.unique(np.asarray(loads, dtype=float))
    everywhere = [tuple(map(float, each)) for each in product(*numbers)]
    middle = everywhere[len(everywhere) // 2]

    def family_at(chosen: Array, places: Sequence[tuple[float, ...]]) -> LoadFamily:
        wanted = [(problem_at(float(load), *place), low, high) for place in places for load in chosen]
        curves = tuple(load_curves(wanted, films=not numbers, region=region, accuracy=accuracy, progress=progress))
        return LoadFamily(chosen, curves, tuple(numbers) if len(places) == len(everywhere) else ())

    ends = np.array([different[0] / spread, different[-1] * spread])
    if len({at(problem_at(float(each), *middle), 1.0) for each in ends}) == 1:
        return family_at(ends[:1], everywhere)
    if different.size <= MOST_CURVES and spread == 1:
        return family_at(different, everywhere)
    # Whole octaves, so that curves are found again when the range has changed a little.
    first, last = math.floor(math.log2(ends[0])), math.ceil(math.log2(ends[1]))

    def family_of(count: int) -> LoadFamily:
        chosen = 2 ** ((first + last) / 2 - (last - first) / 2 * np.cos(np.pi * np.arange(count) / (count - 1)))
        return family_at(chosen, everywhere)

    if numbers:
        return family_of(LEVEL)
    family = family_of(LEVELS[0])
    for count in LEVELS[1:]:
        before, family = family, family_of(count)
        if _predicts(before, family, accuracy):
            break
    return family


def _predicts(before: LoadFamily, family: LoadFamily, accuracy: float) -> bool:
    """Whether a family has known the curves that another one has between its own."""
    beta = np.geomspace(max(before.low, family.low), min(before.high, family.high), 30)
    for load, curve in zip(family.loads[1::2], family.curves[1::2], strict=True):
        value, _ = curve.friction(beta)
        if np.any(np.abs(before.friction(load, beta) - value) > accuracy * np.abs(value)):
            return False
    return True
