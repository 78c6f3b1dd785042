"""Film and friction at a given load as smooth functions of β: solutions on a few β, and a spline in ln β between them.

A Stribeck curve or a fit asks for thousands of contacts that differ in one number, β of Eq. (30).  Under load control every
result is a function of it alone, in units of the load's Hertz contact: lengths along the surface √(Rδ), films δ, and forces
(2π/3) G δ², δ of Eq. (29).  The curves are nearly straight in logarithms, so five solutions a decade give four digits.

Friction is the sum of a Couette part C = ∫ η(v₁ − v₂)/u dA and a Poiseuille part P = ∫ (u/2) ∂p/∂x dA, Eq. (27a).  They are
kept apart, because P does not depend on which surface slides and changes sign from one surface to the other, Eq. (25).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from softlube.discretization.measure import CONTACT, DOMAIN, integrate
from softlube.errors import InputError, NotConvergedError
from softlube.model.problem import Cavitation
from softlube.solvers.progress import Listener, Progress
from softlube.steady.solution import Solution
from softlube.steady.solve import solve

Array = NDArray[np.floating]

ACCURACY = 3e-3
"""Relative accuracy of the solutions: the friction then has errors below 0.1 %, the minimum film below 1 %."""
PER_DECADE = 5
"""Solutions a decade of β."""
MARGIN = 1
"""Nodes beyond either end of the range asked for: splines are least accurate at their ends."""
FEWEST = 5
"""Least number of nodes of a curve."""
WIDEST = (1e-4, 1e8)
"""Range of β_load outside which nothing is solved."""
FORCES = ("sphere", "total", "couette")
"""Which force is called the friction; see `LoadCurve.friction`."""
REGIONS = {"contact": CONTACT, "domain": DOMAIN}
"""Radii of the regions with a name, as in `softlube.discretization.measure`."""


def parse_region(text: str) -> str | float:
    """A region as it is written on the command line: a name, or a number of contact radii.

    Raises
    ------
    InputError
        If it is neither.
    """
    try:
        region: str | float = float(text)
    except ValueError:
        region = text
    check_friction(FORCES[0], region)
    return region


@dataclass(frozen=True)
class Node:
    """One solution under load control, in units of the load's Hertz contact.

    Attributes
    ----------
    film_center, film_min : float
        Over δ.
    couette : float
        Couette part of the friction for sliding without rolling, over (2π/3) G δ².
    poiseuille : float
        Poiseuille part over the Couette part.
    errors : tuple of float
        Relative errors of the first three.
    """

    film_center: float
    film_min: float
    couette: float
    poiseuille: float
    errors: tuple[float, float, float]


@lru_cache(maxsize=400)
def _solution(index: int, cavitation: Cavitation, accuracy: float) -> Solution | str:
    """Solution at β_load = 10^(index/PER_DECADE), or why there is none."""
    reason = ""
    for attempt in (accuracy, 5 * accuracy):
        try:
            return solve(beta_load=10 ** (index / PER_DECADE), cavitation=cavitation, accuracy=attempt)
        except NotConvergedError as error:
            reason = reason or str(error)
    return reason


@lru_cache(maxsize=4000)
def _node(index: int, region: str | float, cavitation: Cavitation, accuracy: float) -> Node | None:
    solution = _solution(index, cavitation, accuracy)
    if isinstance(solution, str):
        return None
    fields, values = solution.fields, solution.quantities
    cutoff = REGIONS[region] if isinstance(region, str) else region
    if cutoff > fields.r[-1]:
        return None

    def part(integrand: Callable[[Array, Array], Array]) -> float:
        return integrate(fields, integrand, cutoff)

    poiseuille = part(lambda xi, s: 3 * fields.film_spline(xi, s) * fields.gradient_on(xi, s)[0])
    couette = part(lambda xi, s: 1 / (fields.beta * fields.film_spline(xi, s)))
    center, least, friction = (values[name] for name in ("film_center", "film_min", "friction_domain"))
    return Node(
        float(center),
        float(least),
        couette,
        poiseuille / couette,
        (center.error / center, least.error / least, friction.error / abs(friction)),
    )


@dataclass(frozen=True)
class LoadCurve:
    """Film and friction under a given load against β.

    Attributes
    ----------
    low, high : float
        Range of β_load in which the curve holds; beyond it values are nan.
    region : str or float
        Where the friction is counted: a radius in units of the load's Hertz contact radius √(Rδ), which stays where it is when
        the speed changes; or the name of one, "contact" (1) or "domain" (2, the paper's).
    nodes : tuple of Node
        The solutions, by rising β.
    log_beta : ndarray
        ln β_load of the nodes.
    """

    low: float
    high: float
    region: str | float
    nodes: tuple[Node, ...]
    log_beta: Array

    @cached_property
    def _splines(self) -> dict[str, CubicSpline]:
        return {name: self._spline(name) for name in ("film_center", "film_min", "couette", "poiseuille")}

    def _spline(self, name: str, every: int = 1) -> CubicSpline:
        values = np.array([getattr(node, name) for node in self.nodes])[::every]
        return CubicSpline(self.log_beta[::every], values if name == "poiseuille" else np.log(values))

    def _at(self, name: str, beta_load: ArrayLike) -> Array:
        beta = np.asarray(beta_load, dtype=float)
        inside = (beta >= self.low) & (beta <= self.high)
        values = self._splines[name](np.log(np.where(inside, beta, self.low)))
        return np.where(inside, values if name == "poiseuille" else np.exp(values), np.nan)

    def film_center(self, beta_load: ArrayLike) -> Array:
        """Film at the centre over δ."""
        return self._at("film_center", beta_load)

    def film_min(self, beta_load: ArrayLike) -> Array:
        """Minimum film over δ."""
        return self._at("film_min", beta_load)

    def friction(self, beta_load: ArrayLike, *, force: str = "sphere", slide_to_roll: ArrayLike = 2.0) -> Array:
        """Friction over (2π/3) G δ².

        Parameters
        ----------
        beta_load : array_like
            β of Eq. (30), formed with the sum of the surface speeds.
        force : {"sphere", "total", "couette"}
            C + P, the shear of the liquid on the sphere, Eq. (27a).  Or C − P, the shear on the flat substrate, which is the
            whole horizontal force: the pressure pushes the sphere back, too, by ∫ p ∂h/∂x dA = −2P, while ∫ p ∂w/∂x dA = 0 for
            an elastic substrate.  Or C alone, the mean of the shear on both surfaces.
        slide_to_roll : array_like
            (v₁ − v₂) over the mean of both; 2 where the substrate rests, as in the paper.
        """
        couette = self._at("couette", beta_load)
        sign = {"sphere": 1.0, "total": -1.0, "couette": 0.0}[force]
        return couette * (np.asarray(slide_to_roll) / 2 + sign * self._at("poiseuille", beta_load))

    def relative_error(self, name: str, beta_load: ArrayLike) -> Array:
        """Estimated relative error of film_center, film_min or couette: of the solutions, and of the spline between them.

        The spline's is what the spline through every other node misses on those left out, divided by eight (fourth order would
        be sixteen).
        """
        column = ("film_center", "film_min", "couette").index(name)
        log_beta = np.log(np.clip(np.asarray(beta_load, dtype=float), self.low, self.high))
        solver = np.interp(log_beta, self.log_beta, [node.errors[column] for node in self.nodes])
        between = self.log_beta[1:-1:2]
        missed = np.abs(self._spline(name, every=2)(between) - self._splines[name](between)) / 8
        return np.where(np.isnan(self._at(name, beta_load)), np.nan, solver + np.interp(log_beta, between, missed))


def check_friction(force: str, region: str | float) -> None:
    """Refuse a force or a region that does not exist.

    Raises
    ------
    InputError
        If it is none of `FORCES`, or neither one of `REGIONS` nor a positive number up to 15.
    """
    if force not in FORCES:
        raise InputError(f"force: expected one of {', '.join(FORCES)}, got {force!r}")
    if isinstance(region, str) and region not in REGIONS:
        raise InputError(f"region: expected {', '.join(REGIONS)} or a number of contact radii, got {region!r}")
    if not isinstance(region, str) and not 0 < region <= 15:
        raise InputError(f"region: expected a number of contact radii up to 15, got {region!r}")


def load_curve(
    low: float,
    high: float,
    *,
    region: str | float = 2.0,
    cavitation: Cavitation = "reynolds",
    accuracy: float = ACCURACY,
    progress: Listener | None = None,
) -> LoadCurve:
    """Film and friction at a given load over a range of β_load.

    Solutions are kept in memory, so that a second curve costs little.

    Parameters
    ----------
    low, high : float
        Range wanted; the curve covers as much of it as can be solved (`LoadCurve.low`, `LoadCurve.high`).
    region : str or float
        See `LoadCurve`.
    cavitation : {"reynolds", "none"}
        See `softlube.solve`.
    accuracy : float
        Of the solutions; see `softlube.solve`.  Where it cannot be reached, five times that is tried.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each solution.

    Raises
    ------
    InputError
        If the region does not exist or the range is none.
    NotConvergedError
        If no part of the range can be solved.
    """
    check_friction("sphere", region)
    if not 0 < low <= high < math.inf or cavitation not in get_args(Cavitation):
        raise InputError(f"beta_load: expected a range of positive numbers, got {low!r} to {high!r}")
    low, high = (min(max(end, WIDEST[0]), WIDEST[1]) for end in (low, high))
    first = math.floor(PER_DECADE * math.log10(low)) - MARGIN
    last = math.ceil(PER_DECADE * math.log10(high)) + MARGIN
    # Downwards from heavy loads, where all is well, until light ones cannot be solved.
    found: dict[int, Node] = {}
    failures = 0
    for done, index in enumerate(range(last, first - 1, -1), 1):
        node = _node(index, region, cavitation, accuracy)
        if node is not None:
            found[index] = node
        failures = 0 if node is not None else failures + 1
        if progress is not None:
            progress(Progress("solving the curve", done, last - first + 1))
        if len(found) >= FEWEST and failures == 2:
            break
    if len(found) < FEWEST:
        reason = _solution(last, cavitation, accuracy)
        raise NotConvergedError(
            f"the curve from beta_load = {low:.3g} to {high:.3g} cannot be had"
            + (f": {reason}" if isinstance(reason, str) else "")
        )
    order = sorted(found)
    log_beta = math.log(10) / PER_DECADE * np.array(order)
    ends = float(np.exp(log_beta[0])), float(np.exp(log_beta[-1]))
    return LoadCurve(max(low, ends[0]), min(high, ends[1]), region, tuple(found[i] for i in order), log_beta)
