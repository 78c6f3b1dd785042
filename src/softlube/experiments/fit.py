"""Measured friction in, fitted parameters out, with what the data can and cannot tell (Fig. 13 of the paper)."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError, SoftlubeError, printable, warn
from softlube.experiments.fit_checks import FEWEST_SIGNS, HoldOut, check_held_out, order_of_residuals
from softlube.experiments.friction_model import Model, make_model, normalised_friction
from softlube.experiments.intervals import Estimate, bootstrap, correlation_of, finite_or_none, profile
from softlube.experiments.load_curve import FORCES
from softlube.experiments.measurements import Measurements, read_measurements
from softlube.experiments.optimum import solve_model
from softlube.experiments.parameters import unit_of
from softlube.model.summary import Summarised, Summary
from softlube.physical.inputs import BODIES, documented
from softlube.solvers.notebook import watched
from softlube.solvers.progress import Listener, Progress

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

Array = NDArray[np.floating]

INTERVALS = ("profile", "bootstrap")
FEWEST_HELD = 3
TIED = 0.95
"""Correlation from which on two parameters count as determined together only."""
DOUBTFUL = 0.01
"""Probability below which chance is no good explanation."""
LARGE = 100_000
"""Rows above which the fit is not repeated for other forces and regions."""
OTHER_REGIONS = (1.0, 2.0, 5.0)
TOGETHER = {
    frozenset(("viscosity", "young_modulus")): (
        ": along a power law friction depends on one combination of both; only the curve's bend parts them"
    ),
    frozenset(("relaxation_time", "index")): (
        ": a liquid that only begins to thin shows one combination of both; only faster sliding, where it thins by its power "
        "law, parts them"
    ),
    frozenset(("viscosity", "relaxation_time")): (
        ": a liquid that thins by its power law everywhere shows one combination of both; only slower sliding, where it hardly "
        "thins, parts them"
    ),
}
"""Why two parameters are determined together only."""


@dataclass(frozen=True, repr=False)
class Fit(Summarised):
    """What `fit` returns.

    Attributes
    ----------
    model : Model
        Data, fixed parameters, load curve.
    values : mapping of str to float
        All parameters, fitted and fixed, in SI.
    estimates : mapping of str to Estimate
        The fitted ones.
    correlation : ndarray, shape (free, free)
        Between the fitted ones (logarithms of viscosity and modulus).
    scatter : float
        Standard deviation of the residuals: relative, or of the median friction for absolute noise.
    residuals, beta : ndarray, shape (rows,)
    confidence : float
    interval : {"profile", "bootstrap"}
    robust : bool
    trend : tuple of str and float
        Along what the residuals are most ordered (beta, load, speed or friction), and the probability of that by chance; nan
        where there are too few rows to tell.
    hold_out : HoldOut or None
    region : float or str
        Where the friction was counted.
    others : mapping of (force, region) to float
        The viscosity that the same data give if the friction is another force, or counted over another region.
    """

    model: Model
    values: Mapping[str, float]
    estimates: Mapping[str, Estimate]
    correlation: Array
    scatter: float
    residuals: Array
    beta: Array
    confidence: float
    interval: str
    robust: bool
    trend: tuple[str, float]
    hold_out: HoldOut | None
    region: str | float
    others: Mapping[tuple[str, float], float]

    @property
    def verdicts(self) -> tuple[str, ...]:
        """Whether the data determine the parameters, in sentences."""
        return verdicts(self)

    @property
    def headline(self) -> str:
        """The fitted parameters, how many rows they are from, and what β these span."""
        values = ", ".join(" ".join((name, estimate.rounded[0], estimate.unit)) for name, estimate in self.estimates.items())
        data = f"{len(self.model.data)} rows of {printable(self.model.data.source)}"
        return f"Fit: {values}; {data}, beta {self.beta.min():.4g} to {self.beta.max():.4g}"

    def summary(self) -> Summary:
        """Every parameter with its interval, fitted or held, and the verdicts."""
        fitted = [estimate.row(name) for name, estimate in self.estimates.items()]
        held = [
            (name.replace("_", " "), f"{self.values[name]:.5g}", "held", unit_of(name))
            for name in sorted(self.values.keys() - self.estimates.keys())
        ]
        header = ("parameter", "value", f"{100 * self.confidence:g} % interval ({self.interval})", "unit")
        return Summary(self.headline, header, (*fitted, *held), tuple(each.removesuffix(".") for each in self.verdicts))

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each parameter, by its name: value, ends of its interval, unit, and whether it was fitted."""
        import pandas as pd

        rows = {name: (e.value, e.low, e.high, e.unit, True) for name, e in self.estimates.items()}
        rows |= {name: (value, value, value, unit_of(name), False) for name, value in self.values.items() if name not in rows}
        index = pd.Index(list(rows), name="parameter")
        return pd.DataFrame(list(rows.values()), index=index, columns=["value", "low", "high", "unit", "fitted"])

    @property
    def points(self) -> tuple[Array, Array]:
        """β and normalised friction of the data, the points of Fig. 13."""
        return normalised_friction(self.model, dict(self.values))

    def to_dict(self) -> dict[str, Any]:
        """Numbers only, ready for JSON; an end of an interval that the data do not set is null."""
        return {
            "rows": len(self.model.data),
            "free": list(self.model.free),
            "values": dict(self.values),
            "estimates": {name: each.to_dict() for name, each in self.estimates.items()},
            "confidence": self.confidence,
            "interval": self.interval,
            "robust": self.robust,
            "correlation": self.correlation.tolist(),
            "scatter": self.scatter,
            "noise": self.model.noise,
            "force": self.model.force,
            "region": self.region,
            "beta": [float(self.beta.min()), float(self.beta.max())],
            "trend": {"along": self.trend[0] or None, "probability": finite_or_none(self.trend[1])},
            "hold_out": None if self.hold_out is None else vars(self.hold_out) | {"lines": list(self.hold_out.lines)},
            "viscosity_otherwise": [{"force": f, "region": r, "viscosity": v} for (f, r), v in self.others.items()],
            "verdicts": list(self.verdicts),
            "notices": list(self.model.data.notices),
        }

    def plot(self, path: str | os.PathLike[str] | None = None) -> Figure:
        """Collapse on the load curve and residuals; written to `path` if given."""
        from softlube.plots.experiments import plot_fit

        return plot_fit(self, path)


@documented(BODIES)
@watched
def fit(
    data: Measurements | str | os.PathLike[str],
    *,
    friction_offset: float = 0.0,
    free: Sequence[str] = ("viscosity",),
    noise: str = "relative",
    robust: bool = False,
    interval: str | None = None,
    confidence: float = 0.95,
    hold_out: float = 0.0,
    seed: int = 0,
    force: str = "total",
    region: str | float = 2.0,
    compare: bool = True,
    progress: Listener | None = None,
    **given: Any,
) -> Fit:
    """Fit viscosity, modulus, a friction offset or another parameter to measured friction.

    Parameters
    ----------
    data : Measurements or path
        Measurements, or a CSV file for `softlube.experiments.measurements.read_measurements`.
    friction_offset : float
        Force that is added to the friction of the film, N.
    free : sequence of str
        Of viscosity, young_modulus (or modulus), friction_offset (or offset), and any other positive input with a unit or of a
        liquid, such as thickness, pressure_viscosity, relaxation_time or index, which needs a value to start from.
    noise : {"relative", "absolute"}
        Whether the scatter is in proportion to the friction, or the same for all.  Its size is taken from the residuals.
    robust : bool
        Let outliers count little.
    interval : {"profile", "bootstrap"}, optional
        Profile likelihood, or rows drawn again; the latter is the default for a robust fit, which has no likelihood.
    confidence : float
        Of the intervals.
    hold_out : float
        Fraction of the rows, drawn at random, that is left out and then predicted.
    seed : int
        Of what is drawn.
    force, region
        Which friction was measured, see `softlube.experiments.load_curve.LoadCurve.friction`; it matters for the viscosity
        (`Fit.others`).
    compare : bool
        Whether to repeat the fit for the other forces and regions.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each solution and for each parameter.
    **given
        Bodies and liquid: parts, or the inputs that follow, as for `softlube.Contact`.  A parameter that is fitted may be given
        to start from.
    {inputs}

    Returns
    -------
    Fit

    Raises
    ------
    InputError
        If the data or another input is not as described.
    NotConvergedError
        If the fit fails, or leads to contacts that cannot be solved.
    """
    interval = interval or ("bootstrap" if robust else "profile")
    if interval not in INTERVALS:
        raise InputError(f"interval: expected one of {', '.join(INTERVALS)}, got {interval!r}")
    if interval == "profile" and robust:
        raise InputError("interval: a robust fit has no likelihood to profile; expected bootstrap")
    for name, value, ends in (("confidence", confidence, (0.5, 0.9999)), ("hold_out", hold_out, (0.0, 0.9))):
        if isinstance(value, (bool, str)) or not ends[0] <= value <= ends[1]:
            raise InputError(f"{name}: expected a fraction from {ends[0]:g} to {ends[1]:g}, got {value!r}")
    if not isinstance(data, Measurements):
        data = read_measurements(data)
    random = np.random.default_rng(seed)
    everything, held = data, None
    if hold_out:
        order = random.permutation(len(data))
        count = round(hold_out * len(data))
        if count < FEWEST_HELD:
            raise InputError(f"hold_out: leaves out {count} of {len(data)} rows; expected {FEWEST_HELD} at least")
        held = data.take(np.sort(order[:count]))
        data = replace(data.take(np.sort(order[count:])), notices=everything.notices)
    model = make_model(
        data,
        friction_offset=friction_offset,
        free=free,
        noise=noise,
        force=force,
        region=region,
        **given,
    )

    model, optimum = solve_model(model, region, robust=robust, progress=progress)
    values = model.values(optimum.x)
    residuals = model.residuals(values)
    freedom = max(len(data) - optimum.x.size, 1)
    scatter = math.sqrt(optimum.sum_of_squares / freedom)
    if interval == "profile":
        estimates = {name: profile(model, optimum, name, confidence, progress) for name in model.free}
        covariance = optimum.covariance
    else:
        estimates, covariance = bootstrap(model, optimum, confidence, random, robust, progress)
    # With the modulus free, too, the comparison would show how loosely both are tied to the data, and nothing else.
    warn(doubts(model, values))
    compared = compare and "viscosity" in model.free and "young_modulus" not in model.free and len(data) <= LARGE
    return Fit(
        model=model,
        values=values,
        estimates=estimates,
        correlation=correlation_of(covariance),
        scatter=scatter,
        residuals=residuals,
        beta=model.beta(values),
        confidence=confidence,
        interval=interval,
        robust=robust,
        trend=order_of_residuals(model, values, residuals),
        hold_out=None if held is None else check_held_out(model, values, held, scatter, freedom, confidence),
        region=region,
        others=_others(model, region, robust, values, progress) if compared else {},
    )


def _others(
    model: Model, region: str | float, robust: bool, values: dict[str, float], progress: Listener | None
) -> dict[tuple[str, float], float]:
    found: dict[tuple[str, float], float] = {}
    pairs = [(force, other) for force in FORCES[:2] for other in OTHER_REGIONS if (force, other) != (model.force, region)]
    for number, (force, other) in enumerate(pairs):
        if progress is not None:
            progress(Progress("other forces and regions", number, len(pairs)))
        try:
            again, optimum = solve_model(replace(model, force=force, family=None), other, robust=robust, start=values)
        except SoftlubeError:  # such as contacts beyond what can be solved: then there is no comparison
            continue
        found[force, other] = again.values(optimum.x)["viscosity"]
    return found


def doubts(model: Model, values: Mapping[str, float]) -> tuple[str, ...]:
    """Where the model may not describe the experiment: under the greatest load, and at the greatest friction coefficient."""
    data = model.data
    heaviest, steepest = int(np.argmax(data.load)), int(np.argmax(np.abs(data.friction) / data.load))
    widest = model.contact(values, float(data.load[heaviest]))
    found = [(heaviest, each) for each in widest.width_doubt(widest.dry_radius)]
    load = float(data.load[steepest])
    contact = model.contact(values, load)
    stress = contact.traction_doubt(float(data.friction[steepest]), load, contact.dry_radius)
    found += [(steepest, each) for each in stress]
    return tuple(f"{data.source}, line {data.lines[row]}: {text}" for row, text in found)


def verdicts(found: Fit) -> tuple[str, ...]:
    """Whether the data determine the parameters, in sentences."""
    low, high = float(found.beta.min()), float(found.beta.max())
    result = [f"The data span beta = {low:.3g} to {high:.3g}, {math.log10(high / low):.1f} decades."]
    curve = found.model.family
    if curve is not None and high > curve.high:
        result.append(
            f"{int((found.beta > curve.high).sum())} rows lie above beta = {curve.high:.3g}, up to which the curve was "
            "solved; it goes on there with its last slope."
        )
    for name, estimate in found.estimates.items():
        if estimate.determined:
            continue
        closed = estimate.low > 0 and math.isfinite(estimate.high)
        how = f"spans a factor of {estimate.high / estimate.low:.1f}" if closed else "is open"
        result.append(f"The data do not determine {name}: its {100 * found.confidence:g} % interval {how}.")
    offset = found.estimates.get("friction_offset")
    if offset is not None and offset.low <= 0 <= offset.high:
        result.append("The interval of friction_offset holds zero: the data do not call for an offset.")
    names = found.model.free
    for i, first in enumerate(names):
        for k in range(i + 1, len(names)):
            c = float(found.correlation[i, k])
            text = f"Correlation of {first} and {names[k]}: {c:+.3f}"
            reason = TOGETHER.get(frozenset((first, names[k])), "")
            neither = not (found.estimates[first].determined or found.estimates[names[k]].determined)
            if abs(c) > TIED or (neither and reason):  # where no value is the best, its correlation tells of that place only
                text += f", so that the data determine them together and hardly each by itself{reason}"
            result.append(text + ".")
    if all(estimate.determined for estimate in found.estimates.values()):
        result.append("The data determine " + ", ".join(names) + f" within the interval{'s' if len(names) > 1 else ''} stated.")
    along, probability = found.trend
    if math.isnan(probability):
        result.append(
            f"{len(found.residuals)} rows are too few to tell whether the residuals have an order, "
            f"and so whether the model describes the data: measure {2 * FEWEST_SIGNS} or more."
        )
    elif probability < DOUBTFUL:
        result.append(
            f"The residuals are ordered along the {along} (probability by chance {probability:.1g}): the model, or a "
            "parameter that is held, does not describe the data, and the intervals are too narrow."
        )
    held = found.hold_out
    if held is not None:
        verdict = "as well as those fitted" if held.probability > DOUBTFUL else "worse than those fitted"
        result.append(
            f"{len(held.lines)} rows left out are predicted {verdict}: scatter {held.scatter:.3g} against {found.scatter:.3g}, "
            f"{100 * held.covered:.0f} % of them within the range predicted for {100 * found.confidence:g} %."
        )
    result += [f"In doubt: {each}." for each in doubts(found.model, found.values)]
    return tuple(result)
