"""Prony series through a test of a viscoelastic solid: weights that are not negative, and as few times as the data ask for.

On a grid of times far finer than data can tell, least squares with weights that are not negative (Lawson & Hanson,
`scipy.optimize.nnls`) take a few times and leave out the rest.  Neighbours on the grid are taken together, and times and
weights fitted.  Then their number is taken down by one and one: two neighbours are merged or one is dropped, whichever the data
miss least, and the rest is fitted again.  So there is a series for each number of times, and Akaike's criterion chooses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares, nnls

from softlube.experiments.moduli import Moduli
from softlube.experiments.rheometer import AS_GOOD

Array = NDArray[np.floating]

PER_DECADE = 10
"""Times of the grid in each decade."""
BEYOND = 10.0
"""Factor beyond the data within which times are looked for.  Further out a time acts as one number, its weight times its time
or over it.  Times shorter than the first row are looked for in oscillation only: after a step nothing is left of them."""
ENOUGH = 1e-3
"""Misfit that no measurement has: of two series below it the one with fewer times is taken."""
ROUNDS = 2
"""Fits, each with the scatter that the one before has found for each column."""
MOST_EXCHANGES = 30
"""Exchanges of `scipy.optimize.nnls` for each time; three, its default, are too few where many fit nearly as well."""
MOST_STEPS = 60
"""Steps of least squares: series with more times than the data tell creep on without end, and are left out afterwards."""
LEAST_LOGARITHM = -60.0
"""Of a weight over the largest value of the data: nothing is left of it."""


@dataclass(frozen=True)
class Series:
    """A constant and exponentials, fitted to a test.

    Attributes
    ----------
    constant : float
        E for t → ∞ [Pa]; of a creep test J₀ [1/Pa].
    weights, times : ndarray, shape (times,)
        Eᵢ and τᵢ, or Jᵢ and τᵢ′, times ascending.
    residuals : mapping of str to ndarray, shape (rows,)
        1 − series/measured for each measured column.
    criterion : float
        Akaike's, corrected for few data (AICc); infinite where there are too few.
    """

    constant: float
    weights: Array
    times: Array
    residuals: Mapping[str, Array]
    criterion: float

    @property
    def scatter(self) -> dict[str, float]:
        """Root mean square of the residuals of each column."""
        return {name: math.sqrt(float(np.mean(each**2))) for name, each in self.residuals.items()}


@dataclass(frozen=True)
class _Fitting:
    """Least squares for the series of a test.

    Attributes
    ----------
    data : Moduli
    scatter : mapping of str to float
        Of each column, relative: what its residuals are weighted with.
    """

    data: Moduli
    scatter: Mapping[str, float]

    @property
    def ends(self) -> tuple[float, float]:
        """Shortest and longest time that is looked for."""
        low, high = float(self.data.where.min()), float(self.data.where.max())
        return (1 / (BEYOND * high), BEYOND / low) if self.data.procedure.rates else (low, BEYOND * high)

    @property
    def per_unit(self) -> Array:
        """What a row is multiplied by: one over value and scatter."""
        scatter = np.repeat([self.scatter[name] for name in self.data.procedure.measured], len(self.data))
        return 1 / (self.data.stacked * scatter)

    def linear(self, times: Array) -> tuple[Array, float]:
        """Constant and weights that are not negative, and what is left of the data."""
        matrix, _ = self.data.procedure.kernels(self.data.where, times)
        scale = self.per_unit
        found, left = nnls(matrix * scale[:, None], self.data.stacked * scale, maxiter=MOST_EXCHANGES * (times.size + 1))
        return found, float(left)

    def grid(self) -> tuple[Array, Array]:
        """Weights and times that least squares take from the grid, neighbours together."""
        low, high = (math.log10(end) for end in self.ends)
        times = np.logspace(low, high, math.ceil(PER_DECADE * (high - low)) + 1)
        weights = self.linear(times)[0][1:]
        taken = np.flatnonzero(weights)
        clusters = np.split(taken, np.flatnonzero(np.diff(taken) > 1) + 1)
        merged = [_together(weights[each], times[each]) for each in clusters if each.size]
        return np.array([weight for weight, _ in merged]), np.array([time for _, time in merged])

    def series(self, times: Array) -> Series:
        """The best series near some times: their logarithms, and those of the weights, are fitted."""
        procedure, stacked, scale = self.data.procedure, self.data.stacked, self.per_unit
        count, unit = times.size, float(stacked.max())

        def parts(x: Array) -> tuple[Array, Array]:
            return np.exp(x[: count + 1]) * unit, np.exp(x[count + 1 :])

        def residuals(x: Array) -> Array:
            weights, at = parts(x)
            return (procedure.kernels(self.data.where, at)[0] @ weights - stacked) * scale

        def jacobian(x: Array) -> Array:
            weights, at = parts(x)
            matrix, slopes = procedure.kernels(self.data.where, at)
            return np.hstack((matrix * weights, slopes * weights[1:])) * scale[:, None]

        low, high = np.log(self.ends)
        bounds = np.array([(LEAST_LOGARITHM, LEAST_LOGARITHM / -2)] * (count + 1) + [(low, high)] * count).T
        # Where the linear weights are zero the search starts from little, from which it can rise.
        weights = np.maximum(self.linear(times)[0], 1e-6 * unit)
        start = np.clip(np.concatenate((np.log(weights / unit), np.log(times))), *bounds)
        found = least_squares(
            residuals, start, jac=jacobian, bounds=tuple(bounds), xtol=1e-12, ftol=1e-12, gtol=1e-12, max_nfev=MOST_STEPS
        )
        return self._series(*parts(found.x))

    def _series(self, weights: Array, times: Array) -> Series:
        data = self.data
        model = data.procedure.kernels(data.where, times)[0] @ weights
        measured = data.procedure.measured
        residuals = dict(zip(measured, (1 - model / data.stacked).reshape(len(measured), -1), strict=True))
        # Each column has a scatter that is fitted, too.
        values, fitted = data.stacked.size, weights.size + times.size + len(measured)
        criterion = math.inf
        if values - fitted > 1:
            squares = (max(float(np.mean(each**2)), ENOUGH**2) for each in residuals.values())
            criterion = len(data) * sum(map(math.log, squares)) + 2 * fitted * (1 + (fitted + 1) / (values - fitted - 1))
        order = np.argsort(times)
        return Series(float(weights[0]), weights[1:][order], times[order], residuals, criterion)

    def fewer(self, found: Series) -> Array:
        """The times with one less: two neighbours merged or one dropped, whichever the data miss least."""
        weights, times = found.weights, found.times
        dropped = [np.delete(times, k) for k in range(times.size)]
        merged = []
        for k in range(times.size - 1):
            _, together = _together(weights[k : k + 2], times[k : k + 2])
            merged.append(np.concatenate((times[:k], [together], times[k + 2 :])))
        return min(dropped + merged, key=lambda each: self.linear(each)[1])


def _together(weights: Array, times: Array) -> tuple[float, float]:
    """Times as one: the sum of their weights, and the mean of their logarithms."""
    total = float(weights.sum())
    return total, math.exp(float(weights @ np.log(times)) / total)


def series_of(data: Moduli) -> tuple[Series, ...]:
    """A series for each number of times, the most first, down to none at all, which is an elastic solid.

    Each column's scatter is taken to be in proportion to its values.
    """
    scatter: dict[str, float] = dict.fromkeys(data.procedure.measured, 1.0)
    found: list[Series] = []
    for _ in range(ROUNDS):
        fitting = _Fitting(data, scatter)
        _, times = fitting.grid()
        found = [fitting.series(times)]
        while found[-1].times.size:
            found.append(fitting.series(fitting.fewer(found[-1])))
        scatter = {name: max(each, ENOUGH) for name, each in chosen(found).scatter.items()}
    return tuple(found)


def chosen(found: Sequence[Series]) -> Series:
    """The series with the fewest times whose criterion is at most `AS_GOOD` above the least."""
    least = min(each.criterion for each in found)
    return min((each for each in found if each.criterion <= least + AS_GOOD), key=lambda each: each.times.size)
