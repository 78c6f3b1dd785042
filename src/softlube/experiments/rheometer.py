"""A liquid from a rheometer's flow curve: the law that the data call for, its parameters, and what the data can tell."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError, NotConvergedError
from softlube.experiments.fit import DOUBTFUL, TIED
from softlube.experiments.fit_checks import runs
from softlube.experiments.flow_curve import CANDIDATES, Candidate, FlowCurve, FlowModel, read_flow_curve
from softlube.experiments.intervals import Estimate, correlation_of, finite_or_none, profile
from softlube.experiments.optimum import Optimum, optimise
from softlube.model.inputs import declared
from softlube.model.parts import Part
from softlube.model.prefixes import shown
from softlube.model.summary import Summarised, Summary

if TYPE_CHECKING:
    import pandas

    from softlube.model.liquids import Lubricant

Array = NDArray[np.floating]

FEWEST_ROWS = 5
NARROWEST = 2.0
"""Factor between the rates of a flow curve below which it tells no law."""
AS_GOOD = 4.0
"""Difference of Akaike's criterion up to which the law with fewer parameters is taken: from here on support is "considerably
less" (Burnham & Anderson 2002, section 2.6), and of eight laws one is better than the true one by 2 too easily."""
MOST_STARTS = 4
"""Best of the starting points from which the least squares are looked for."""
ROUNDING = 1e-9
"""Scatter that is no more than rounding."""
SMOOTH_DATA = 1e-3
"""Scatter below which a flow curve counts as computed, not measured."""


@dataclass(frozen=True)
class Trial:
    """A law fitted to a flow curve.

    Attributes
    ----------
    candidate : Candidate
    optimum : Optimum
    scatter : float
        Standard deviation of ln(measured/law).
    criterion : float
        Akaike's, corrected for few data (AICc), over the least of all laws.
    """

    candidate: Candidate
    optimum: Optimum
    scatter: float
    criterion: float


@dataclass(frozen=True, repr=False)
class LiquidFit(Summarised):
    """What `fit_liquid` returns.

    Attributes
    ----------
    model : FlowModel
        Data and law.
    values : mapping of str to float
        Parameters of the law, in SI.
    estimates : mapping of str to Estimate
        The same with their intervals.
    correlation : ndarray, shape (parameters, parameters)
        Between the logarithms of the parameters.
    scatter : float
        Relative standard deviation of the residuals.
    residuals : ndarray, shape (rows,)
        ln(measured/law).
    confidence : float
    trials : tuple of Trial
        Every law that was fitted, best first.
    order : float
        Probability by chance of the order that the residuals have along the shear rate; nan where there are too few to tell.
    """

    model: FlowModel
    values: Mapping[str, float]
    estimates: Mapping[str, Estimate]
    correlation: Array
    scatter: float
    residuals: Array
    confidence: float
    trials: tuple[Trial, ...]
    order: float

    @property
    def liquid(self) -> Lubricant:
        """The liquid, for `softlube.Contact`."""
        return Part.slots["liquid"][self.model.candidate.kind](**self._rounded)  # type: ignore[return-value]

    @property
    def _rounded(self) -> dict[str, float]:
        """The values with the digits that are printed, so that what is pasted and what is computed are one liquid."""
        return {name: float(estimate.rounded[0]) for name, estimate in self.estimates.items()}

    @property
    def options(self) -> str:
        """The liquid as options of the command line."""
        parts = [f"--{name.replace('_', '-')} {self._quoted(name)}" for name in self.model.candidate.names]
        return " ".join([f"--viscosity-law {self.model.candidate.kind}", *parts])

    @property
    def python(self) -> str:
        """The liquid as a call in Python."""
        named = (f"{name}={self._quoted(name)}" for name in self.model.candidate.names)
        return f"softlube.{type(self.liquid).__name__}({', '.join(named)})"

    def _quoted(self, name: str) -> str:
        """A value as it is given: a text if it has a unit."""
        unit = declared()[name].unit
        text = self._text(name, unit)
        return f'"{text}"' if unit else text

    def _text(self, name: str, unit: str) -> str:
        value = self._rounded[name]
        return f"{value:.10g} {unit}" if unit == "Pa s^n" else shown(value, unit)

    def viscosity(self, rate: Array) -> Array:
        """The law's viscosity [Pa s] at shear rates [1/s]."""
        return self.model.candidate.viscosity(np.asarray(rate, dtype=float), self.values)

    @property
    def verdicts(self) -> tuple[str, ...]:
        """What the data can tell, in sentences."""
        return verdicts(self)

    @property
    def headline(self) -> str:
        """The law, its parameters, and how many rows they are from."""
        values = ", ".join(f"{name} {self._text(name, each.unit)}" for name, each in self.estimates.items())
        return f"LiquidFit: {self.model.candidate.kind}, {values}; {len(self.model.data)} rows"

    def summary(self) -> Summary:
        """Every parameter with its interval, and the verdicts."""
        rows = [estimate.row(name) for name, estimate in self.estimates.items()]
        header = ("parameter", "value", f"{100 * self.confidence:g} % interval (profile)", "unit")
        return Summary(self.headline, header, tuple(rows), tuple(each.removesuffix(".") for each in self.verdicts))

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each parameter, by its name: value, ends of its interval, unit."""
        import pandas as pd

        index = pd.Index(list(self.estimates), name="parameter")
        rows = [(each.value, each.low, each.high, each.unit) for each in self.estimates.values()]
        return pd.DataFrame(rows, index=index, columns=["value", "low", "high", "unit"])

    def to_dict(self) -> dict[str, Any]:
        """Numbers only, ready for JSON; an end of an interval that the data do not set is null."""
        return {
            "rows": len(self.model.data),
            "law": self.model.candidate.kind,
            "values": dict(self.values),
            "estimates": {name: each.to_dict() for name, each in self.estimates.items()},
            "confidence": self.confidence,
            "correlation": self.correlation.tolist(),
            "scatter": self.scatter,
            "laws": [{"law": t.candidate.words, "scatter": t.scatter, "criterion": t.criterion} for t in self.trials],
            "order": finite_or_none(self.order),
            "options": self.options,
            "python": self.python,
            "verdicts": list(self.verdicts),
            "notices": list(self.model.data.notices),
        }


def fit_liquid(
    data: FlowCurve | str | os.PathLike[str],
    *,
    law: str | None = None,
    second_plateau: bool | None = None,
    confidence: float = 0.95,
) -> LiquidFit:
    """Fit a law of a thinning liquid to viscosities against shear rates, and say what the data determine.

    The scatter is taken to be in proportion to the viscosity: the logarithms are fitted.  Where no law is asked for, that with
    the least AICc is taken, or one with fewer parameters whose AICc is at most 4 more.

    Parameters
    ----------
    data : FlowCurve or path
        A flow curve, or a CSV file for `softlube.experiments.flow_curve.read_flow_curve`.
    law : str, optional
        Of newtonian, power-law, carreau, cross, carreau-yasuda; chosen by the data if not given.
    second_plateau : bool, optional
        Whether the law has a viscosity at high rates; chosen by the data if not given.
    confidence : float
        Of the intervals.

    Returns
    -------
    LiquidFit

    Raises
    ------
    InputError
        If the data are not as described, or cannot tell the parameters of the law that is asked for.
    NotConvergedError
        If no law can be fitted.
    """
    if isinstance(confidence, (bool, str)) or not 0.5 <= confidence <= 0.9999:
        raise InputError(f"confidence: expected a fraction from 0.5 to 0.9999, got {confidence!r}")
    kinds = tuple(dict.fromkeys(each.kind for each in CANDIDATES))
    if law is not None and law not in kinds:
        raise InputError(f"law: expected one of {', '.join(kinds)}, got {law!r}")
    if not isinstance(data, FlowCurve):
        data = read_flow_curve(data)
    spread = float(data.shear_rate.max() / data.shear_rate.min())
    if len(data) < FEWEST_ROWS or spread < NARROWEST:
        raise InputError(
            f"{data.source}: {len(data)} rows over a factor of {spread:.3g} in the shear rate tell no law; "
            f"measure {FEWEST_ROWS} rates or more, over a decade or more"
        )
    asked = [
        each for each in CANDIDATES if law in (None, each.kind) and second_plateau in (None, "infinite_viscosity" in each.names)
    ]
    if not asked:
        raise InputError(f"law, second_plateau: a {law} liquid has no second plateau")
    trials = _ranked(data, asked)
    if not trials:
        raise InputError(
            f"{data.source}: {len(data)} rows are too few for the {len(asked[0].names)} parameters of {asked[0].words}"
        )
    best = min((each for each in trials if each.criterion <= AS_GOOD), key=lambda each: len(each.candidate.names))
    model = FlowModel(data, best.candidate, {}, best.candidate.names)
    estimates = {name: profile(model, best.optimum, name, confidence) for name in model.free}
    values = model.values(best.optimum.x)
    residuals = model.residuals(values)
    _check(data, best.candidate, estimates, law is not None, confidence)
    return LiquidFit(
        model=model,
        values=values,
        estimates=estimates,
        correlation=correlation_of(best.optimum.covariance),
        scatter=best.scatter,
        residuals=residuals,
        confidence=confidence,
        trials=tuple(trials),
        order=runs(data.shear_rate, residuals),
    )


def _ranked(data: FlowCurve, candidates: list[Candidate]) -> list[Trial]:
    """The laws that could be fitted, the least criterion first."""
    found = []
    rows = len(data)
    for candidate in candidates:
        count = len(candidate.names) + 1  # the scatter is fitted, too
        if rows - count - 1 < 1:
            continue
        optimum = _best(FlowModel(data, candidate, {}, candidate.names))
        if optimum is None:
            continue
        mean_square = max(optimum.sum_of_squares / rows, ROUNDING**2)
        criterion = rows * math.log(mean_square) + 2 * count + 2 * count * (count + 1) / (rows - count - 1)
        found.append(Trial(candidate, optimum, math.sqrt(optimum.sum_of_squares / (rows - count + 1)), criterion))
    least = min((each.criterion for each in found), default=0.0)
    ranked = sorted(found, key=lambda each: each.criterion)
    return [Trial(each.candidate, each.optimum, each.scatter, each.criterion - least) for each in ranked]


def _best(model: FlowModel) -> Optimum | None:
    """The least sum of squares from the best starting points; None where none leads to an end."""
    starts = sorted(model.starts(), key=lambda values: float(np.sum(model.residuals(values) ** 2)))
    found = []
    for values in starts[:MOST_STARTS]:
        try:
            found.append(optimise(model, values))
        except NotConvergedError:
            continue
    return min(found, key=lambda each: each.sum_of_squares, default=None)


def _check(data: FlowCurve, candidate: Candidate, estimates: Mapping[str, Estimate], asked: bool, confidence: float) -> None:
    """Refuse a law of which a parameter could be anything.

    Raises
    ------
    InputError
        The message says which, and why.
    """
    anything = [name for name, each in estimates.items() if each.low <= 0 and not math.isfinite(each.high)]
    if anything:
        advice = "; leave the law to the data" if asked else ""
        raise InputError(
            f"{data.source}: the data do not tell {' and '.join(anything)} of {candidate.words}: at {100 * confidence:g} % "
            f"anything fits; measure lower and higher shear rates{advice}"
        )


def verdicts(found: LiquidFit) -> tuple[str, ...]:
    """What the data can tell of the liquid, in sentences."""
    data, candidate = found.model.data, found.model.candidate
    low, high = data.shear_rate.min(), data.shear_rate.max()
    span = f"{low:.3g} to {high:.3g} 1/s, {math.log10(high / low):.1f} decades"
    result = [f"The data span {span}: beyond, the law is a guess."]
    for name, estimate in found.estimates.items():
        if estimate.determined:
            continue
        closed = estimate.low > 0 and math.isfinite(estimate.high)
        how = f"spans a factor of {estimate.high / estimate.low:.1f}" if closed else "is open"
        result.append(f"The data do not determine {name}: its {100 * found.confidence:g} % interval {how}.")
    result += _together(found)
    if all(each.determined for each in found.estimates.values()):
        names = ", ".join(candidate.names)
        result.append(f"The data determine {names} within the interval{'s' if len(candidate.names) > 1 else ''} stated.")
    others = [each for each in found.trials if each.candidate != candidate and each.criterion < AS_GOOD]
    if others:
        listed = " and ".join(each.candidate.words for each in others)
        result.append(
            f"{listed[0].upper()}{listed[1:]} would do as well: within the data they hardly differ, beyond them they may."
        )
    if found.order < DOUBTFUL and found.scatter > SMOOTH_DATA:
        result.append(
            f"The residuals are ordered along the shear rate (probability by chance {found.order:.1g}): the law does not "
            "describe the data to their scatter, and the intervals are too narrow."
        )
    return tuple(result)


def _together(found: LiquidFit) -> list[str]:
    """Which parameters the data tell together only."""
    names = found.model.candidate.names
    result = []
    for i, first in enumerate(names):
        for k in range(i + 1, len(names)):
            c = float(found.correlation[i, k])
            pair = (first, names[k])
            if abs(c) <= TIED or all(found.estimates[name].determined for name in pair):
                continue
            text = f"{first} and {names[k]} cannot be told apart (correlation {c:+.3f})"
            if pair == ("relaxation_time", "index"):
                text += ": the liquid begins to thin within the data, and goes on beyond them; measure higher shear rates"
            elif pair == ("viscosity", "relaxation_time"):
                text += ": no plateau at low shear rates is within the data; a power law says all that they tell"
            result.append(text + ".")
    return result
