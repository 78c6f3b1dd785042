"""A substrate that remembers from a test of its material: the Prony series, and what the data can tell."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError
from softlube.experiments.fit import DOUBTFUL
from softlube.experiments.fit_checks import runs
from softlube.experiments.intervals import finite_or_none
from softlube.experiments.moduli import Moduli, read_moduli
from softlube.experiments.prony import ENOUGH, Series, chosen, series_of
from softlube.model.creep import Creep, Term, creep_of, relaxation_of
from softlube.model.prefixes import shown
from softlube.model.substrates import Viscoelastic
from softlube.model.substrates.viscoelastic import series_text
from softlube.model.summary import Summarised, Summary

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.floating]

FEWEST_ROWS = 5
NARROWEST = 10.0
"""Factor between the frequencies or times of a test below which it tells no series."""
FAR, FARTHEST = 1.1, 10.0
"""Factors between a modulus at an end of the data and its limit from which on the limit counts as a guess, and as unknown."""
UNTOLD = {
    "oscillation": "the data do not tell the relaxed modulus, which carries the load in the end; measure lower frequencies",
    "relaxation": "the data do not tell the relaxed modulus, which carries the load in the end; measure longer times",
    "creep": "the data do not tell the compliance that creep begins with, or ends with; measure shorter and longer times",
}
"""What to say where a limit is not told."""
DIGITS = 4
"""Digits of moduli and times that are printed."""


@dataclass(frozen=True, repr=False)
class SubstrateFit(Summarised):
    """What `fit_substrate` returns.

    Attributes
    ----------
    data : Moduli
        The test.
    poisson_ratio : float
    relaxed : float
        Modulus for t → ∞ [Pa]: Young's, or the shear modulus if the test is of that.
    terms : tuple of Term
        Eᵢ [Pa] and τᵢ [s] of the relaxation modulus, times ascending.
    series : Series
        What was fitted; of a creep test compliances and retardation times.
    trials : tuple of Series
        Series with other numbers of times, the most first.
    order : float
        Probability by chance of the order that the residuals have along frequency or time; nan where there are too few to tell.
    """

    data: Moduli
    poisson_ratio: float
    relaxed: float
    terms: tuple[Term, ...]
    series: Series
    trials: tuple[Series, ...]
    order: float

    @property
    def instantaneous(self) -> float:
        """Modulus for t → 0 [Pa]."""
        return self.relaxed + math.fsum(term.weight for term in self.terms)

    @property
    def creep(self) -> Creep:
        """The creep compliance [1/Pa], exactly."""
        return creep_of(self.relaxed, self.terms)

    @property
    def substrate(self) -> Viscoelastic:
        """The substrate, for `softlube.Contact`."""
        prony = series_text((_rounded(term.weight), _rounded(term.time)) for term in self.terms)
        return Viscoelastic(**{self._modulus: _rounded(self.relaxed)}, prony=prony, poisson_ratio=self.poisson_ratio)

    @property
    def _modulus(self) -> str:
        return "shear_modulus" if self.data.procedure.shear else "young_modulus"

    @property
    def symbol(self) -> str:
        """Which modulus it is: "E" for Young's, "G" for the shear modulus."""
        return "G" if self.data.procedure.shear else "E"

    @property
    def _inputs(self) -> dict[str, str]:
        """Inputs of a contact as texts."""
        prony = "; ".join(f"{_text(term.weight, 'Pa')} @ {_text(term.time, 's')}" for term in self.terms)
        inputs = {self._modulus: _text(self.relaxed, "Pa"), "prony": prony}
        return inputs if self.poisson_ratio == 0.5 else inputs | {"poisson_ratio": f"{self.poisson_ratio:.10g}"}

    @property
    def options(self) -> str:
        """The substrate as options of the command line."""
        return " ".join(f'--{name.replace("_", "-")} "{value}"' for name, value in self._inputs.items())

    @property
    def python(self) -> str:
        """The substrate as a call in Python."""
        return f"softlube.Viscoelastic({', '.join(f'{name}={value!r}' for name, value in self._inputs.items())})".replace(
            "'", '"'
        )

    def complex_modulus(self, frequency: Array) -> NDArray[np.complexfloating]:
        """E′ + iE″ = E_relaxed + Σ Eᵢ iωτᵢ/(1 + iωτᵢ) [Pa] at angular frequencies [rad/s]."""
        x = 1j * np.asarray(frequency, dtype=float)
        return self.relaxed + sum((w * (x * t / (1 + x * t)) for w, t in self.terms), start=np.zeros_like(x))

    def predicted(self, where: Array) -> dict[str, Array]:
        """The measured columns of the test, by the series, at angular frequencies [rad/s] or times [s]."""
        where = np.asarray(where, dtype=float)
        matrix, _ = self.data.procedure.kernels(where, self.series.times)
        stacked = matrix @ np.array([self.series.constant, *self.series.weights])
        measured = self.data.procedure.measured
        return dict(zip(measured, stacked.reshape(len(measured), -1), strict=True))

    @property
    def ends(self) -> tuple[float, float]:
        """The modulus [Pa] at the slow and at the fast end of the data, by the series: storage modulus, stress over strain."""
        column = self.predicted(np.array([self.data.where.min(), self.data.where.max()]))[self.data.procedure.measured[0]]
        moduli = 1 / column if self.data.procedure.name == "creep" else column
        return float(moduli.min()), float(moduli.max())

    @property
    def largest(self) -> tuple[float, str, int]:
        """Largest |1 − series/measured|, the column and the row where it is."""
        sizes = {name: np.abs(each) for name, each in self.series.residuals.items()}
        return max((float(each.max()), name, int(each.argmax())) for name, each in sizes.items())

    @property
    def told(self) -> tuple[float, float]:
        """Shortest and longest time that the data tell [s].

        From moduli known between two frequencies the spectrum of times follows between e^(π/2)/ω_max and e^(−π/2)/ω_min only
        (Davies & Anderssen, J. Non-Newtonian Fluid Mech. 73, 163, 1997); from a step, between the first and the last row.
        """
        low, high = float(self.data.where.min()), float(self.data.where.max())
        return (math.exp(math.pi / 2) / high, math.exp(-math.pi / 2) / low) if self.data.procedure.rates else (low, high)

    @property
    def verdicts(self) -> tuple[str, ...]:
        """What the data can tell, in sentences."""
        return verdicts(self)

    @property
    def headline(self) -> str:
        """The relaxed and the instantaneous modulus, how many times there are, and how many rows they are from."""
        ends = f"{self.symbol} from {_text(self.relaxed, 'Pa')} to {_text(self.instantaneous, 'Pa')}"
        return f"SubstrateFit: {_counted(len(self.terms), 'time')}, {ends}; {len(self.data)} rows"

    def summary(self) -> Summary:
        """Every term of the series, and the verdicts."""
        rows = [("relaxed", _text(self.relaxed, "Pa"), "∞")]
        rows += [(str(k), _text(term.weight, "Pa"), _text(term.time, "s")) for k, term in enumerate(self.terms, 1)]
        rows.append(("instantaneous", _text(self.instantaneous, "Pa"), "0"))
        notes = tuple(each.removesuffix(".") for each in self.verdicts)
        return Summary(self.headline, ("term", f"modulus {self.symbol}", "time"), tuple(rows), notes)

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each term of the series: modulus and time."""
        import pandas as pd

        return pd.DataFrame(self.terms, columns=["modulus [Pa]", "time [s]"])

    def to_dict(self) -> dict[str, Any]:
        """Numbers only, ready for JSON."""
        size, column, row = self.largest
        return {
            "rows": len(self.data),
            "test": self.data.procedure.name,
            "shear": self.data.procedure.shear,
            "relaxed": self.relaxed,
            "instantaneous": self.instantaneous,
            "terms": [{"modulus": term.weight, "time": term.time} for term in self.terms],
            "poisson_ratio": self.poisson_ratio,
            "range": [float(self.data.where.min()), float(self.data.where.max())],
            "times_told": list(self.told),
            "scatter": self.series.scatter,
            "largest_misfit": {"size": size, "column": column, "line": int(self.data.lines[row])},
            "numbers_of_times": [
                {"times": each.times.size, "scatter": each.scatter, "criterion": finite_or_none(each.criterion)}
                for each in self.trials
            ],
            "order": finite_or_none(self.order),
            "options": self.options,
            "python": self.python,
            "verdicts": list(self.verdicts),
            "notices": list(self.data.notices),
        }


def _rounded(value: float) -> float:
    """A value with the digits that are printed, so that what is pasted and what is computed are one substrate."""
    return float(f"{value:.{DIGITS}g}")


def _text(value: float, unit: str) -> str:
    return shown(_rounded(value), unit)


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def fit_substrate(
    data: Moduli | str | os.PathLike[str], *, terms: int | None = None, poisson_ratio: float = 0.5
) -> SubstrateFit:
    """Fit a Prony series to moduli or compliances of a viscoelastic solid, and say what the data determine.

    The scatter of each measured column is taken to be in proportion to its values; its size is taken from the residuals.  The
    number of times is that with the least AICc, or a smaller one whose AICc is at most 4 more.

    Parameters
    ----------
    data : Moduli or path
        A test, or a CSV file for `softlube.experiments.moduli.read_moduli`.
    terms : int, optional
        Number of times; chosen by the data if not given.
    poisson_ratio : float
        Of the substrate, constant.

    Returns
    -------
    SubstrateFit

    Raises
    ------
    InputError
        If the data are not as described, show no memory, or do not tell a modulus that is left at the end.
    """
    poisson_ratio = Viscoelastic.inputs["poisson_ratio"].read(poisson_ratio)
    if terms is not None and (isinstance(terms, bool) or not isinstance(terms, int) or terms < 1):
        raise InputError(f"terms: expected a whole number from 1 on, got {terms!r}")
    if not isinstance(data, Moduli):
        data = read_moduli(data)
    against, spread = data.procedure.against, float(data.where.max() / data.where.min())
    if len(data) < FEWEST_ROWS or spread < NARROWEST:
        raise InputError(
            f"{data.source}: {len(data)} rows over a factor of {spread:.3g} in {against} tell no series; "
            f"measure {FEWEST_ROWS} rows or more, over two decades or more"
        )
    trials = series_of(data)
    if terms is not None and terms >= len(trials):
        raise InputError(f"terms: the data take {_counted(len(trials) - 1, 'time')} at most, got {terms}")
    series = chosen(trials) if terms is None else next(each for each in trials if each.times.size == terms)
    if not series.times.size:
        raise InputError(f"{data.source}: the data show no memory; take an elastic half-space")
    relaxed, found = series.constant, tuple(map(Term, series.weights.tolist(), series.times.tolist()))
    if data.procedure.name == "creep":
        relaxed, found = relaxation_of(Creep(relaxed, found))
    # Each column is looked at alone, so the least probability is counted as often (Bonferroni).
    told = [each for name, each in series.residuals.items() if series.scatter[name] > ENOUGH]
    orders = [runs(data.where, each) for each in told] or [math.nan]
    order = min(1.0, len(orders) * min(orders)) if all(map(math.isfinite, orders)) else math.nan
    result = SubstrateFit(data, poisson_ratio, relaxed, found, series, trials, order)
    slow, fast = result.ends
    if slow > FARTHEST * relaxed or (data.procedure.name == "creep" and result.instantaneous > FARTHEST * fast):
        raise InputError(f"{data.source}: {UNTOLD[data.procedure.name]}")
    return result


def verdicts(found: SubstrateFit) -> tuple[str, ...]:
    """What the data can tell of the substrate, in sentences."""
    data, symbol = found.data, found.symbol
    low, high = float(data.where.min()), float(data.where.max())
    span = f"{low:.3g} to {high:.3g} {data.unit}, {math.log10(high / low):.1f} decades"
    asked = "angular frequencies of about v/a" if data.procedure.rates else "times of about a/v"
    result = [f"The data span {span}: beyond, the series is a guess. A contact of radius a at a speed v asks for {asked}."]
    size, column, row = found.largest
    scatters = ", ".join(f"{name.replace('_', ' ')} {100 * each:.2g} %" for name, each in found.series.scatter.items())
    at = f"at {data.where[row]:.3g} {data.unit}, line {data.lines[row]}"
    result.append(f"Scatter: {scatters}. Largest misfit: {100 * size:.2g} %, of the {column.replace('_', ' ')} {at}.")
    shortest, longest = found.told
    outside = [term.time for term in found.terms if not shortest <= term.time <= longest]
    if outside:
        told = f"{_text(shortest, 's')} to {_text(longest, 's')}"
        are = "is" if len(outside) == 1 else "are"
        result.append(
            f"The data tell times of {told}: {', '.join(_text(each, 's') for each in outside)} {are} outside, and "
            f"stand{'s' if len(outside) == 1 else ''} for all that lies beyond."
        )
    slow, fast = found.ends
    if slow > FAR * found.relaxed:
        result.append(
            f"{symbol} still falls at the slow end of the data, {_text(slow, 'Pa')}: the relaxed modulus, "
            f"{_text(found.relaxed, 'Pa')}, is a guess."
        )
    if found.instantaneous > FAR * fast:
        result.append(
            f"{symbol} still rises at the fast end of the data, {_text(fast, 'Pa')}: the instantaneous modulus, "
            f"{_text(found.instantaneous, 'Pa')}, is a guess."
        )
    if found.order < DOUBTFUL:
        result.append(
            f"The residuals are ordered along {data.procedure.against} (probability by chance {found.order:.1g}): no series "
            "with weights that are not negative describes the data to their scatter."
        )
    return tuple(result)
