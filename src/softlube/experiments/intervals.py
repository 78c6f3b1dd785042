"""Intervals of fitted parameters: the profile of the likelihood, and rows drawn again."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import stats
from scipy.optimize import brentq

from softlube.errors import NotConvergedError
from softlube.experiments.friction_model import Model
from softlube.experiments.optimum import Optimum, Parametric, optimise
from softlube.experiments.parameters import unit_of
from softlube.solvers.progress import Listener, Progress

Array = NDArray[np.floating]

RESAMPLES = 400
"""Data sets drawn for a bootstrap."""
UNDETERMINED = 2.0
"""Factor between the ends of an interval from which on a parameter counts as not determined."""
ROUNDING = 1e-12
"""Residual that is no more than rounding."""
WIDEST_STEP = 0.5
"""Standard deviation, in logarithm, from which the search for an interval's end starts at most."""
EDGE = 1e-3
"""Distance, in logarithm, from where the curves end within which a parameter counts as held back by them."""
FARTHEST = 7.0
"""Distance in logarithm, a factor of 1000, up to which the end of an interval is looked for."""


def finite_or_none(value: float) -> float | None:
    """A number for JSON, which knows neither infinity nor nan."""
    return value if math.isfinite(value) else None


@dataclass(frozen=True)
class Estimate:
    """A fitted parameter in SI with its interval; an end that the data do not set is 0 or infinite."""

    value: float
    low: float
    high: float
    unit: str

    @property
    def determined(self) -> bool:
        """Whether the data set both ends of the interval, and close enough."""
        if not (math.isfinite(self.low) and math.isfinite(self.high)):
            return False
        return self.low < 0 or self.unit == "N" or (self.low > 0 and self.high / self.low < UNDETERMINED)

    @property
    def rounded(self) -> tuple[str, str, str]:
        """Value and ends as text, with two digits more than the interval leaves open."""
        ends = (self.low, self.high)
        width = max((abs(end - self.value) for end in ends if math.isfinite(end)), default=0.0)
        digits = 4
        if width > 0 and self.value:
            digits = min(max(2 + math.ceil(math.log10(abs(self.value) / width)), 3), 12)
        low, high = (f"{end:.{digits}g}" if math.isfinite(end) else "open" for end in ends)
        return f"{self.value:.{digits}g}", low, high

    def row(self, name: str) -> tuple[str, str, str, str]:
        """A row of a table for people: what it is, value, interval, unit."""
        value, low, high = self.rounded
        return name.replace("_", " "), value, f"{low} to {high}", self.unit

    def to_dict(self) -> dict[str, Any]:
        """Numbers only, ready for JSON; an end that the data do not set is null."""
        ends = {"low": finite_or_none(self.low), "high": finite_or_none(self.high)}
        return {"value": self.value} | ends | {"unit": self.unit, "determined": self.determined}


def profile(model: Parametric, optimum: Optimum, name: str, confidence: float, progress: Listener | None = None) -> Estimate:
    """Interval of one parameter by the profile of the likelihood, the scatter unknown.

    With the parameter held at θ and the others fitted again the sum of squares is S(θ).  The interval holds where
    S(θ) ≤ S_min (1 + t²/(n − p)), with Student's t: exact for a linear model, and for a curved one better than so many standard
    errors.
    """
    k = model.free.index(name)
    best = optimum.x
    freedom = max(len(model.data) - best.size, 1)
    least = max(optimum.sum_of_squares, len(model.data) * ROUNDING**2)
    level = least * (1 + stats.t.ppf((1 + confidence) / 2, freedom) ** 2 / freedom)
    others = tuple(n for n in model.free if n != name)
    last = dict(model.values(best))
    held_back = False

    def excess(x: float) -> float:
        """S(θ) over the level, in logarithm."""
        nonlocal held_back
        held = dict(model.fixed) | {name: _value(model, best, k, x)}
        if others:
            rest = replace(model, fixed=held, free=others)
            found = optimise(rest, last | held)
            last.update(rest.values(found.x))
            held_back = model.limited and bool(np.any(np.isclose(found.x, rest.bounds(), rtol=0, atol=EDGE)))
            total = found.sum_of_squares
        else:
            residuals = model.residuals(held)
            total = float(residuals @ residuals)
        return math.log(max(total, 1e-300) / max(level, 1e-300))

    deviation = min(math.sqrt(max(float(optimum.covariance[k, k]), 1e-12)), WIDEST_STEP)
    ends: list[float | None] = []
    bounds = model.bounds()
    for number, sign in enumerate((-1, 1)):
        if progress is not None:
            progress(Progress(f"interval of {name}", number, 2))
        last.update(model.values(best))
        inside, step, end = float(best[k]), 2 * deviation, None
        while end is None and abs(inside - best[k]) < FARTHEST:
            outside = float(np.clip(inside + sign * step, bounds[0][k], bounds[1][k]))
            if outside == inside:  # as far as the curves reach
                break
            try:
                if excess(outside) > 0:
                    end = float(brentq(excess, inside, outside, xtol=1e-4 * deviation + 1e-12))
                    excess(end)
                    if held_back:  # the curves end there, not the parameters that describe the data
                        end = None
                        break
            except NotConvergedError:
                break
            inside, step = outside, 1.6 * step
        ends.append(end)
    return _estimate(model, name, best, ends)


def correlation_of(covariance: Array) -> Array:
    """Correlations, from a covariance."""
    deviations = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    return covariance / np.outer(deviations, deviations)


def bootstrap(
    model: Model,
    optimum: Optimum,
    confidence: float,
    random: np.random.Generator,
    robust: bool,
    progress: Listener | None = None,
) -> tuple[dict[str, Estimate], Array]:
    """Intervals from fits to rows drawn with replacement (percentiles), and the covariance of these fits."""
    found = []
    for number in range(RESAMPLES):
        if progress is not None and number % 20 == 0:
            progress(Progress("bootstrap", number, RESAMPLES))
        drawn = replace(model, data=model.data.take(random.integers(len(model.data), size=len(model.data))))
        # The unit of the offset is the median friction of the data, which differs from draw to draw.
        try:
            x = optimise(drawn, model.values(optimum.x), robust=robust).x
        except NotConvergedError:
            continue
        found.append(model.vector(drawn.values(x)))
    if len(found) < RESAMPLES / 2:
        raise NotConvergedError("most of the bootstrap's fits fail: the data do not determine the parameters")
    samples = np.array(found)
    low, high = np.quantile(samples, [(1 - confidence) / 2, (1 + confidence) / 2], axis=0)
    estimates = {name: _estimate(model, name, optimum.x, [low[k], high[k]]) for k, name in enumerate(model.free)}
    return estimates, np.atleast_2d(np.cov(samples.T))


def _estimate(model: Parametric, name: str, best: Array, ends: Sequence[float | None]) -> Estimate:
    k = model.free.index(name)

    lowest = -math.inf if name == "friction_offset" else 0.0
    low, high = (None if end is None else _value(model, best, k, end) for end in ends)
    value = _value(model, best, k, float(best[k]))
    return Estimate(value, lowest if low is None else low, math.inf if high is None else high, unit_of(name))


def _value(model: Parametric, best: Array, k: int, x: float) -> float:
    """The k-th parameter in SI where the vector's k-th entry is x."""
    return model.values(np.array([*best[:k], x, *best[k + 1 :]]))[model.free[k]]
