"""Checks of a fit: whether the residuals have an order left in them, and rows that the fit has not seen."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from softlube.errors import InputError
from softlube.experiments.friction_model import Model
from softlube.experiments.measurements import Measurements

Array = NDArray[np.floating]

FEWEST_SIGNS = 5
"""Residuals above and below the median that a test of their order takes."""


@dataclass(frozen=True)
class HoldOut:
    """The fit against rows that it has not seen.

    Attributes
    ----------
    lines : tuple of int
        The rows.
    scatter : float
        Root mean square of their residuals.
    covered : float
        Fraction of them within the range predicted at the confidence of the fit.
    probability : float
        Of so large a scatter by chance (F test against the scatter of the fit).
    """

    lines: tuple[int, ...]
    scatter: float
    covered: float
    probability: float


def order_of_residuals(model: Model, values: dict[str, float], residuals: Array) -> tuple[str, float]:
    """Along what the residuals are most ordered, and its probability, times the number of orders tried (Bonferroni).

    Nothing and nan where there are too few residuals to tell, see `FEWEST_SIGNS`.
    """
    orders = {
        "beta": model.beta(values),
        "load": model.data.load,
        "speed": model.data.speed,
        "friction": model.friction(values),  # the model's: the measured one shares its noise with the residual
    }
    found = {name: runs(order, residuals) for name, order in orders.items()}
    told = {name: probability for name, probability in found.items() if not math.isnan(probability)}
    if not told:
        return "", math.nan
    name = min(told, key=told.__getitem__)
    return name, min(1.0, len(orders) * told[name])


def runs(order: Array, residuals: Array) -> float:
    """Probability of so few runs of equal sign along something (Wald & Wolfowitz); nan where too few have either sign."""
    signs = residuals[np.argsort(order, kind="stable")] > np.median(residuals)
    above, below = int(signs.sum()), int((~signs).sum())
    if min(above, below) < FEWEST_SIGNS:
        return math.nan
    runs = 1 + int(np.count_nonzero(signs[1:] != signs[:-1]))
    mean = 1 + 2 * above * below / (above + below)
    variance = (mean - 1) * (mean - 2) / (above + below - 1)
    return float(stats.norm.cdf((runs + 0.5 - mean) / math.sqrt(variance)))


def check_held_out(
    model: Model, values: Mapping[str, float], held: Measurements, scatter: float, freedom: int, confidence: float
) -> HoldOut:
    """Predict rows that were left out, of a fit with so much scatter and so many degrees of freedom.

    Raises
    ------
    InputError
        If a friction is not positive and the noise is relative.
    """
    if model.noise == "relative" and np.any(held.friction <= 0):
        line = held.lines[int(np.argmax(held.friction <= 0))]
        raise InputError(f"{held.source}, line {line}: the friction is not positive; leave the row out or take noise absolute")
    residuals = model.residuals(dict(values), held)
    mean_square = float(np.mean(residuals**2))
    limit = stats.t.ppf((1 + confidence) / 2, freedom) * scatter
    return HoldOut(
        tuple(int(line) for line in held.lines),
        math.sqrt(mean_square),
        float(np.mean(np.abs(residuals) <= limit)),
        float(stats.f.sf(mean_square / max(scatter, 1e-300) ** 2, len(held), freedom)),
    )
