"""Film and friction of one contact at a given load as smooth functions of β.

A Stribeck curve or a fit asks for thousands of contacts that differ in one number, β of Eq. (30): with the load the speed is
all that changes, and layers and liquids are, in units of the load's Hertz contact, what they are.  So every result is a
function of β alone: lengths along the surface √(Rδ), films δ, and forces (2π/3) G δ², δ of Eq. (29).

For the half-space with constant viscosity the functions come from the master curve (`softlube.theory.master_curve`) where it
has them.  For any other problem that can be solved they are computed: solutions placed where they are needed
in parallel, and kept (`softlube.experiments.curves`).

Friction is the sum of a Couette part C = ∫ η(v₂ − v₁)/u dA and a Poiseuille part P = ∫ (u/2) ∂p/∂x dA, Eq. (27a).  P does not
depend on which surface slides and changes sign from one surface to the other, Eq. (25).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.discretization.measure import CONTACT, DOMAIN
from softlube.errors import InputError
from softlube.experiments.adaptive import Numbers
from softlube.experiments.curves import Computing, clipped
from softlube.experiments.nodes import Node, at, solving
from softlube.model.indenters import Paraboloid
from softlube.model.liquids import NewtonianLaw
from softlube.model.motions import FIXED_BALL
from softlube.model.problem import Problem
from softlube.model.substrates import HalfSpaceKernel
from softlube.model.summary import FunctionOfBeta
from softlube.solvers.notebook import watched
from softlube.solvers.progress import Listener
from softlube.steady.solve import check_accuracy

Array = NDArray[np.floating]

ACCURACY = 3e-3
"""Relative accuracy of the solutions: the friction then has errors below 0.1 %, the minimum film below 1 %."""
FORCES = ("total", "sphere", "couette")
"""Which force is called the friction; see `LoadCurve.friction`."""
WORDS = {
    "total": "the whole horizontal force on the ball (total)",
    "sphere": "the shear on the ball, Eq. (27a) (sphere)",
    "couette": "the mean shear on both surfaces (couette)",
}
"""The forces in words."""
REGIONS = {"contact": CONTACT, "domain": DOMAIN}
"""Radii of the regions with a name over the dry contact's, as in `softlube.discretization.measure`."""
FILMS = ("film_center", "film_min")
ROOM = 3.0
"""Factor of the accuracy up to which errors of the master curve are taken: they are told with its values, and the largest, near
β_load = 5, where the height h₀ changes its sign, are large only because they are safe."""
MASTER = {"film_center": "film_center", "film_min": "film_min", "total": "friction_total", "sphere": "friction_domain"}
"""Quantities of the master curve by the names that a load curve gives them; the frictions over `DOMAIN`."""
FRICTIONS = ("total", "sphere")


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


def described(force: str, region: str | float) -> str:
    """A friction in words, such as "the whole horizontal force on the ball (total), within 2 radii of the dry contact"."""
    return f"{WORDS[force]}, within {radius_of(region):g} radii of the dry contact"


def radius_of(region: str | float) -> float:
    """The radius of a region over the dry contact's."""
    return REGIONS[region] if isinstance(region, str) else region


@dataclass(frozen=True, repr=False)
class LoadCurve(FunctionOfBeta):
    """Film and friction under a given load against β.

    Attributes
    ----------
    low, high : float
        Range of β_load in which the curve holds; beyond it values are nan.
    region : str or float
        Where the friction is counted: a radius in units of that of the dry contact under the load, which stays where it is when
        the speed changes; or the name of one, "contact" (1) or "domain" (2, the paper's).
    functions : mapping of str to callable
        Value and absolute error as functions of β_load: the films over δ, and the whole friction ("total") and the shear on the
        sphere ("sphere") over (2π/3) G δ², for sliding without rolling if the curve is `linear`.
    linear : bool
        Whether the shear stress is in proportion to the shear rate.  If not, the film depends on the slide-to-roll ratio, and
        the curve is that of the problem's own.
    """

    low: float
    high: float
    region: str | float
    functions: Mapping[str, Callable[[Array], tuple[Array, Array]]]
    linear: bool = True

    def _range(self) -> tuple[float, float]:
        return self.low, self.high

    def _values(self, beta: Array) -> dict[str, tuple[Array, Array]]:
        return {name: self._at(name, beta) for name in self.functions}

    def _at(self, name: str, beta_load: ArrayLike) -> tuple[Array, Array]:
        beta = np.asarray(beta_load, dtype=float)
        inside = (beta >= self.low) & (beta <= self.high)
        value, error = self.functions[name](np.where(inside, beta, self.low))
        return np.where(inside, value, np.nan), np.where(inside, error, np.nan)

    def film(self, name: str, beta_load: ArrayLike) -> tuple[Array, Array]:
        """film_center or film_min over δ, with its error."""
        return self._at(name, beta_load)

    def friction(self, beta_load: ArrayLike, *, force: str = "total", slide_to_roll: ArrayLike = 2.0) -> tuple[Array, Array]:
        """Friction over (2π/3) G δ², with its error.

        Parameters
        ----------
        beta_load : array_like
            β of Eq. (30), formed with the sum of the surface speeds.
        force : {"total", "sphere", "couette"}
            C − P, the whole horizontal force, which is also the shear on the flat substrate: the pressure pushes the sphere
            back, too, by ∫ p ∂h/∂x dA = −2P, while ∫ p ∂w/∂x dA = 0 for an elastic substrate.  Or C + P, the shear of the
            liquid on the sphere, Eq. (27a).  Or C alone, the mean of the shear on both surfaces.
        slide_to_roll : array_like
            Difference of the surface speeds over their mean; 2 without rolling, as in the paper.  Counts for nothing if the
            curve is not `linear`.
        """
        by_liquid = "viscous" if "viscous" in self.functions else "total"
        (total, total_error), (sphere, sphere_error) = (self._at(name, beta_load) for name in (by_liquid, "sphere"))
        sliding = np.asarray(slide_to_roll if self.linear else FIXED_BALL, dtype=float) / 4
        # C S/2 ∓ P from C − P and C + P.
        rolling = {"total": 0.5, "sphere": -0.5, "couette": 0.0}[force]
        of_total, of_sphere = sliding + rolling, sliding - rolling
        error = np.abs(of_total) * total_error + np.abs(of_sphere) * sphere_error
        value = of_total * total + of_sphere * sphere
        if by_liquid == "viscous" and force == "total":
            whole, whole_error = self._at("total", beta_load)
            value, error = value + (whole - total), error + whole_error + total_error
        return value, error


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


@watched
def load_curve(
    problem: Problem,
    low: float,
    high: float,
    *,
    region: str | float = DOMAIN,
    accuracy: float = ACCURACY,
    progress: Listener | None = None,
) -> LoadCurve:
    """Film and friction at a given load over a range of β_load.

    Parameters
    ----------
    problem : Problem
        Substrate, liquid and cavitation under a prescribed load; its β_load counts for nothing.
    low, high : float
        Range wanted; the curve covers as much of it as can be solved (`LoadCurve.low`, `LoadCurve.high`).
    region : str or float
        See `LoadCurve`.
    accuracy : float
        Of the solutions, see `softlube.solve`, and of what is interpolated between them.  Where it cannot be reached, five
        times that is tried.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each solution.

    Raises
    ------
    InputError
        If the region does not exist or the range is none.
    NotConvergedError
        If no part of the range can be solved.
    """
    (curve,) = load_curves([(problem, low, high)], region=region, accuracy=accuracy, progress=progress)
    return curve


def load_curves(
    wanted: Sequence[tuple[Problem, float, float]],
    *,
    rows: Sequence[Sequence[float]] = (),
    films: bool = True,
    region: str | float = DOMAIN,
    accuracy: float = ACCURACY,
    progress: Listener | None = None,
) -> list[LoadCurve]:
    """Several curves, those of several loads, say.

    Parameters
    ----------
    wanted : sequence of (Problem, float, float)
        Problem and range of each, see `load_curve`.  A problem that is there twice has one curve over both ranges.
    rows : sequence of sequence of float
        β_load at which each will be read, if that is known: solutions are then placed there, see
        `softlube.experiments.adaptive.place`.
    films : bool
        Whether the films are asked for, too; without, fewer solutions are enough.
    region, accuracy, progress
        See `load_curve`.
    """
    check_friction(FORCES[0], region)
    check_accuracy(accuracy)
    ranges: dict[Problem, tuple[float, float]] = {}
    read: dict[Problem, set[float]] = {}
    for problem, low, high in wanted:
        low, high = clipped(low, high)
        before = ranges.get(at(problem, 1.0), (low, high))
        ranges[at(problem, 1.0)] = min(low, before[0]), max(high, before[1])
    for (problem, _, _), each in zip(wanted, rows or [()] * len(wanted), strict=True):
        read.setdefault(at(problem, 1.0), set()).update(each)
    with solving() as nodes:
        computing = Computing(nodes, accuracy, progress)
        curves = {
            problem: _from_table(problem, *ends, region, accuracy)
            or _computed(computing, problem, *ends, region, sorted(read[problem]), list(MASTER if films else FRICTIONS))
            for problem, ends in ranges.items()
        }
    return [curves[at(problem, 1.0)] for problem, _, _ in wanted]


def _computed(
    computing: Computing,
    problem: Problem,
    low: float,
    high: float,
    region: str | float,
    rows: Sequence[float],
    names: Sequence[str],
) -> LoadCurve:
    radius = radius_of(region)

    def read(node: Node) -> Numbers:
        return {name: node.quantities[name] for name in FILMS} | node.friction(radius)

    if problem.substrate.memory is not None:
        names = [*names, "viscous"]
    functions = computing.curves(problem, low, high, names, read, rows)
    ends = [(float(each.beta[0]), float(each.beta[-1])) for each in functions.values()]
    low, high = max(first for first, _ in ends), min(last for _, last in ends)
    return LoadCurve(low, high, region, functions, linear=problem.liquid.linear)


def _from_table(problem: Problem, low: float, high: float, region: str | float, accuracy: float) -> LoadCurve | None:
    """The curve from the master curve, None where that has not all of it, or not as accurately."""
    models = problem.substrate, problem.liquid, problem.indenter
    if models != (HalfSpaceKernel(), NewtonianLaw(), Paraboloid()) or radius_of(region) != DOMAIN:
        return None
    from softlube.theory import master_curve as master

    if not set(MASTER.values()) <= set(master.available("load")):
        return None
    curves = {ours: master.curve(name, "load", problem.cavitation) for ours, name in MASTER.items()}
    place = np.geomspace(low, high, 200)
    for curve in curves.values():
        value, error = curve(place)
        if np.any(error > ROOM * accuracy * np.abs(value)):
            return None
    return LoadCurve(low, high, region, curves)
