"""Power laws fitted over a range of β, beside the paper's (20), (21), (22), (28), local exponents and the Hertz limit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from inspect import signature

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.errors import InputError
from softlube.model.exact import HERTZ_PRESSURE
from softlube.model.quantities import STEADY
from softlube.steady.solution import Solution

Array = NDArray[np.floating]

PAPER_RANGE = (100.0, 1e4)
"""β over which the paper's fits are made."""


@dataclass(frozen=True)
class PowerLaw:
    """prefactor · β^exponent, fitted to data in logarithms.

    Attributes
    ----------
    prefactor, exponent : float
    prefactor_interval, exponent_interval : tuple of float
        Confidence intervals.  The data are smooth and nearly exact, so that they measure how far the curve is from a straight
        line, not noise.
    level : float
        Their confidence, such as 0.95.
    between : tuple of float
        Smallest and largest β of the data.
    deviation : float
        Largest |data/law − 1|.
    """

    prefactor: float
    exponent: float
    prefactor_interval: tuple[float, float]
    exponent_interval: tuple[float, float]
    level: float
    between: tuple[float, float]
    deviation: float

    def __call__(self, beta: ArrayLike) -> Array:
        """The law's value."""
        return self.prefactor * np.asarray(beta, dtype=float) ** self.exponent


@dataclass(frozen=True)
class PaperLaw:
    """A scaling law of the paper, and what in a solution it is a law of.

    Attributes
    ----------
    equation : str
        Its number in the paper.
    quantity : str
        Name of the quantity, a key of `Solution.quantities`.
    text : str
        What it is, in words.
    prefactor, exponent : float
        As printed.
    unit : float
        What the quantity is divided by before it is compared with the law.
    """

    equation: str
    quantity: str
    text: str
    prefactor: float
    exponent: float
    unit: float = 1.0

    def __call__(self, beta: ArrayLike) -> Array:
        """The law's value."""
        return self.prefactor * np.asarray(beta, dtype=float) ** self.exponent

    @property
    def limit(self) -> float | None:
        """Exponent of the quantity for β → ∞; None where it is no power of β."""
        row = STEADY[self.quantity]
        return None if row.offset else row.exponent

    def measured(self, solution: Solution) -> float:
        """The solution's value of what the law is of."""
        return float(solution.quantities[self.quantity]) / self.unit


# The pressure in the inlet layer falls as β^(−1/5) while p_max stays: the place where it is 5 % of p_max, Eq. (21), moves
# through the layer, crosses r = 1 and ends where Hertz's pressure has that value, at r = 0.99875.  So (21) has no exponent for
# β → ∞.
GRADIENT = PaperLaw(
    "20", "pressure_gradient_inlet", "largest |dp/dr| at the inlet, over p_H(0)", 0.5352, 0.2112, HERTZ_PRESSURE
)
BOUNDARY_LAYER = PaperLaw("21", "boundary_layer", STEADY["boundary_layer"].words, 4.216, -0.5077)
FILM_CENTER = PaperLaw("22a", "film_center", STEADY["film_center"].words, 0.9051, -0.5826)
FILM_MIN = PaperLaw("22b", "film_min", STEADY["film_min"].words, 0.9283, -0.6626)
FRICTION = PaperLaw("28", "friction_domain", "friction over r ≤ 2", 4.806, -0.4398)
LAWS = (GRADIENT, BOUNDARY_LAYER, FILM_CENTER, FILM_MIN, FRICTION)
"""The paper's laws, with (20) over the Hertz maximum and (28) over r ≤ 2, as the data show: docs/theory/paper-comparison.md."""


def asymptote(quantity: str, cavitation: str = "reynolds") -> Callable[[ArrayLike], Array] | None:
    """The law of a quantity in the Hertz limit β → ∞, with its prefactor, in either normalisation.

    β and β_load differ by a factor 1 + O(β^(−3/5)) there.

    Parameters
    ----------
    quantity : str
        A key of `softlube.model.quantities.STEADY`.
    cavitation : {"reynolds", "none"}
        Behind the contact.

    Returns
    -------
    callable or None
        None where `softlube.limits` has no law, or the quantity tends to a constant.
    """
    from softlube.theory import limits

    law = getattr(limits, f"{quantity}_asymptote", None)
    if law is None or STEADY[quantity].exponent == 0:
        return None
    return partial(law, cavitation=cavitation) if "cavitation" in signature(law).parameters else law


def fit(beta: ArrayLike, values: ArrayLike, *, between: tuple[float, float] | None = None, level: float = 0.95) -> PowerLaw:
    """Fit a power law by least squares in logarithms.

    Parameters
    ----------
    beta, values : array_like, shape (n,)
        Positive data, at least three within the range.
    between : tuple of float, optional
        Smallest and largest β to use.
    level : float
        Confidence of the intervals.

    Raises
    ------
    InputError
        If fewer than three data are left or one is not positive.

    Examples
    --------
    >>> law = fit([100, 1000, 10000], [2.0, 0.2, 0.02])
    >>> round(law.exponent, 6), round(law.prefactor, 6)
    (-1.0, 200.0)
    """
    from scipy.special import stdtrit

    beta, values = np.broadcast_arrays(np.asarray(beta, dtype=float), np.asarray(values, dtype=float))
    if not 0 < level < 1:
        raise InputError(f"level: expected a confidence between 0 and 1, got {level!r}")
    if between is not None:
        inside = (beta >= between[0] * (1 - 1e-9)) & (beta <= between[1] * (1 + 1e-9))
        beta, values = beta[inside], values[inside]
    if beta.size < 3 or not (np.all(beta > 0) and np.all(values > 0)):
        raise InputError(f"values: expected at least three positive data in the range, got {beta.size}")
    x, y = np.log(beta), np.log(values)
    mean, spread = x.mean(), float(np.sum((x - x.mean()) ** 2))
    if spread == 0:
        raise InputError("beta: expected different values")
    exponent = float(np.sum((x - mean) * y)) / spread
    offset = float(y.mean()) - exponent * mean
    residual = y - offset - exponent * x
    variance = float(residual @ residual) / (x.size - 2)
    quantile = float(stdtrit(x.size - 2, (1 + level) / 2))
    slack = quantile * np.sqrt(variance / spread)
    offset_slack = quantile * np.sqrt(variance * (1 / x.size + mean**2 / spread))
    return PowerLaw(
        prefactor=float(np.exp(offset)),
        exponent=exponent,
        prefactor_interval=(float(np.exp(offset - offset_slack)), float(np.exp(offset + offset_slack))),
        exponent_interval=(exponent - slack, exponent + slack),
        level=level,
        between=(float(beta.min()), float(beta.max())),
        deviation=float(np.max(np.abs(np.expm1(residual)))),
    )


def local_exponents(beta: ArrayLike, values: ArrayLike) -> Array:
    """D ln(value)/d ln β at each β, from a cubic spline through the logarithms.

    Parameters
    ----------
    beta, values : array_like, shape (n,)
        Positive, β increasing, at least four.

    Raises
    ------
    InputError
        If the data are not as described.
    """
    from scipy.interpolate import CubicSpline

    beta, values = np.asarray(beta, dtype=float), np.asarray(values, dtype=float)
    if beta.size < 4 or np.any(np.diff(beta) <= 0) or np.any(beta <= 0) or np.any(values <= 0):
        raise InputError("beta: expected at least four positive data with increasing beta")
    return CubicSpline(np.log(beta), np.log(values))(np.log(beta), 1)


@dataclass(frozen=True)
class Comparison:
    """One law of the paper beside our solutions.

    Attributes
    ----------
    law : PaperLaw
    fit : PowerLaw
        Power law fitted to our solutions over the range of the paper's fit.
    beta, values, ratios, exponents : ndarray
        Of every solution: β, the quantity in the law's units, its ratio to the paper's law, and the local exponent.
    """

    law: PaperLaw
    fit: PowerLaw
    beta: Array
    values: Array
    ratios: Array
    exponents: Array

    @property
    def exponent_difference(self) -> float:
        """Exponent fitted to our solutions less the paper's."""
        return self.fit.exponent - self.law.exponent

    def largest_ratio(self, between: tuple[float, float] = PAPER_RANGE) -> tuple[float, float]:
        """(Where, how much) our value is farthest from the paper's law within a range, as β and ratio."""
        inside = np.flatnonzero((self.beta >= between[0] * (1 - 1e-9)) & (self.beta <= between[1] * (1 + 1e-9)))
        k = inside[np.argmax(np.abs(np.log(self.ratios[inside])))]
        return float(self.beta[k]), float(self.ratios[k])


def compare(solutions: Sequence[Solution], law: PaperLaw, between: tuple[float, float] = PAPER_RANGE) -> Comparison:
    """One law of the paper beside a fit to our solutions over the same range, and beside local exponents over all of them.

    Raises
    ------
    InputError
        If fewer than three solutions are in the range, or fewer than four in all.
    """
    ordered = sorted(solutions, key=lambda solution: solution.beta)
    beta = np.array([solution.beta for solution in ordered])
    values = np.array([law.measured(solution) for solution in ordered])
    return Comparison(law, fit(beta, values, between=between), beta, values, values / law(beta), local_exponents(beta, values))


@dataclass(frozen=True)
class FrictionReading:
    """One way to read (28): the region of the friction, and what β and the unit of force are made of.

    Attributes
    ----------
    cutoff : float
        Region r ≤ cutoff, in units of √(R|h₀|).
    by_load : bool
        β by the load (30) and the Hertz indentation (29) in the unit of force; otherwise β (6d) and |h₀|.
    fit : PowerLaw
        Ours.
    deviation : float
        Largest |ours/(28) − 1| over the range.
    """

    cutoff: float
    by_load: bool
    fit: PowerLaw
    deviation: float


def friction_reading(
    solutions: Sequence[Solution], cutoff: float, *, by_load: bool = False, between: tuple[float, float] = PAPER_RANGE
) -> FrictionReading:
    """Fit the friction (27a) over r ≤ cutoff and compare it with (28): to find out of what region (28) is.

    Raises
    ------
    InputError
        If fewer than three solutions are in the range of β (6d).
    """
    low, high = between[0] * (1 - 1e-9), between[1] * (1 + 1e-9)
    inside = [solution for solution in solutions if low <= solution.beta <= high]
    beta = np.array([solution.beta for solution in inside])
    friction = np.array([solution.friction_within(cutoff) for solution in inside])
    if by_load:
        # The unit of force goes with the square of the indentation, and so does β: (|h₀|/δ)² = β/β_load.
        beta_load = np.array([solution.beta_load for solution in inside])
        beta, friction = beta_load, friction * beta / beta_load
    law = fit(beta, friction)
    return FrictionReading(cutoff, by_load, law, float(np.max(np.abs(friction / FRICTION(beta) - 1))))
