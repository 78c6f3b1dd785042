"""Smooth functions of β through solutions that are placed where they are needed.

A function is interpolated by a cubic spline in ln β, its logarithm if it is positive.  What the spline misses is measured:
without one of its nodes it misses the solution there by some amount.  Between the nodes, which are half as far apart, a smooth
function is missed by less.  Where the amount is above the accuracy, the intervals beside the node are cut in half and solved
there, until it is not.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from softlube.model.summary import FunctionOfBeta

Array = NDArray[np.floating]
Numbers: TypeAlias = Mapping[str, tuple[float, float]]
"""Values and absolute errors by name."""

PER_DECADE = 64
"""Places of a decade of β where there may be a solution, the same ones whatever the range, so that curves share them."""
FIRST = 32
"""Distance of the first solutions, in places."""
FEWEST = 5
"""Least number of nodes of a spline."""
SAME = 1e-12
"""Difference of ln β below which a β is a node's."""
NEARBY = 2
"""Nodes beyond an interval's ends that tell of its error."""


@dataclass(frozen=True, repr=False)
class Interpolant(FunctionOfBeta):
    """A function of β through solutions, with its error.

    Attributes
    ----------
    beta : ndarray, shape (nodes,)
        β of the nodes, rising; `FEWEST` at least.
    value, error : ndarray, shape (nodes,)
        The function there, and its absolute errors.
    accuracy : float
        Relative accuracy: an interval is cut where the spline misses more without the node beside it.
    """

    beta: Array
    value: Array
    error: Array
    accuracy: float

    def _range(self) -> tuple[float, float]:
        return float(self.beta[0]), float(self.beta[-1])

    def _values(self, beta: Array) -> dict[str, tuple[Array, Array]]:
        return {"value": self(beta)}

    @cached_property
    def _scale(self) -> Array:
        """What errors are relative to: the function itself where it is positive, else its typical magnitude."""
        return self.value if np.all(self.value > 0) else np.full(self.beta.size, np.median(np.abs(self.value)))

    @cached_property
    def _spline(self) -> CubicSpline:
        return self._through(np.ones(self.beta.size, dtype=bool))

    def _through(self, nodes: NDArray[np.bool_]) -> CubicSpline:
        y = np.log(self.value) if self.positive else self.value / self._scale
        return CubicSpline(np.log(self.beta)[nodes], y[nodes])

    @property
    def positive(self) -> bool:
        """Whether the spline is one of the logarithm."""
        return bool(np.all(self.value > 0))

    @cached_property
    def missed(self) -> Array:
        """What the spline without a node misses there, relatively; for an end node, what is missed at its neighbour."""
        nodes = np.arange(self.beta.size)
        x, y = np.log(self.beta), self._spline(np.log(self.beta))
        inner = [abs(float(self._through(nodes != node)(x[node]) - y[node])) for node in nodes[1:-1]]
        return np.array([inner[0], *inner, inner[-1]])

    @cached_property
    def _between(self) -> Array:
        """Relative error of the spline in every interval: the most that is missed at the nodes nearby.

        It is 0.6 of that at most in the end intervals of smooth functions, and a sixteenth in the others
        (tests/experiments/test_adaptive.py).  At one node alone it may be small by chance, where what is missed changes sign.
        """
        nearby = (slice(max(k - NEARBY, 0), k + 2 + NEARBY) for k in range(self.beta.size - 1))
        return np.array([self.missed[nodes].max() for nodes in nearby])

    def unresolved(self) -> NDArray[np.bool_]:
        """Which intervals between the nodes are to be cut: those beside a node that the spline misses without it.

        No spline is better than its solutions: what lies within their own errors is no reason.
        """
        at = self.missed > self.accuracy + self.error / self._scale
        return at[:-1] | at[1:]

    def exponent(self, beta: ArrayLike) -> Array:
        """Local exponent d ln q/d ln β."""
        x = np.log(np.asarray(beta, dtype=float))
        slope = self._spline(x, 1)
        return slope if self.positive else slope / self._spline(x)

    def __call__(self, beta: ArrayLike) -> tuple[Array, Array]:
        """Value and absolute error at β within the range."""
        x, nodes = np.log(np.asarray(beta, dtype=float)), np.log(self.beta)
        y = self._spline(x)
        interval = np.clip(np.searchsorted(nodes, x) - 1, 0, nodes.size - 2)
        at_node = np.minimum(np.abs(x - nodes[interval]), np.abs(x - nodes[interval + 1])) < SAME
        relative = np.interp(x, nodes, self.error / self._scale) + np.where(at_node, 0.0, self._between[interval])
        value, scale = (np.exp(y), np.exp(y)) if self.positive else (y * self._scale[0], self._scale[0])
        return value, relative * scale


def first_places(low: float, high: float, rows: Sequence[float] = ()) -> list[float]:
    """Where a curve is solved first: both ends, and places between them that do not depend on the ends.

    Each place between them moves to the nearest of the β where the curve will be read, `rows`, if there are enough.
    """
    start, stop = PER_DECADE * math.log10(low), PER_DECADE * math.log10(high)
    step = FIRST
    while True:
        # None close to an end, where it would say the same.
        inner = [
            k for k in range(math.ceil(start / step) * step, math.ceil(stop), step) if start + step / 4 <= k <= stop - step / 4
        ]
        if len(inner) >= FEWEST - 2 or step == 1:
            places = [low, *map(_beta, inner), high] if len(inner) >= FEWEST - 2 else np.geomspace(low, high, FEWEST).tolist()
            moved = {nearest(place, rows) for place in places[1:-1]} - {low, high} if rows else set()
            return [low, *sorted(moved), high] if len(moved) >= FEWEST - 2 else sorted({*places, *rows})
        step //= 2


def nearest(beta: float, rows: Sequence[float]) -> float:
    """The nearest of some β, as a ratio."""
    return min(rows, key=lambda row: abs(math.log(row / beta)))


def place_between(low: float, high: float, rows: Sequence[float] = ()) -> float | None:
    """The place nearest to the middle of an interval of β; none where it is too short.

    Where the curve is read at known β alone, `rows`, it is one of these, and none where there is none in the interval.
    """
    if rows:
        inside = [row for row in rows if low < row < high]
        return nearest(math.sqrt(low * high), inside) if inside else None
    start, stop = PER_DECADE * math.log10(low), PER_DECADE * math.log10(high)
    if stop - start < 2:
        return None
    middle = _beta(round((start + stop) / 2))
    return middle if low < middle < high else None


def _beta(place: int) -> float:
    return 10 ** (place / PER_DECADE)


def place(
    solve: Callable[[Sequence[float]], Mapping[float, Numbers | None]],
    low: float,
    high: float,
    names: Iterable[str],
    accuracy: float,
    rows: Sequence[float] = (),
) -> dict[str, Interpolant]:
    """Solve until the spline through the solutions is as accurate as they are.

    Parameters
    ----------
    solve : callable
        Gives the functions at some β, by rising β; None where there is no solution.
    low, high : float
        Range of β; the interpolants cover what of it has solutions.
    names : iterable of str
        Functions whose accuracy counts.
    accuracy : float
        Relative accuracy of the spline.
    rows : sequence of float
        β from `low` to `high` at which the interpolants will be read, if these are known: the solutions are placed there.

    Returns
    -------
    dict of str to Interpolant
        Empty if there are less than `FEWEST` solutions.  A function that is nan somewhere has an interpolant through the
        others.
    """
    names = tuple(names)
    found: dict[float, Numbers | None] = dict(solve(first_places(low, high, rows)))
    while True:
        known = sorted(beta for beta, numbers in found.items() if numbers is not None)
        curves = {name: curve for name in names if (curve := through(known, found, name, accuracy)) is not None}
        wanted = set()
        for curve in curves.values():
            for (left, right), cut in zip(itertools.pairwise(curve.beta.tolist()), curve.unresolved(), strict=True):
                middle = place_between(left, right, rows) if cut else None
                if middle is not None and middle not in found:
                    wanted.add(middle)
        if not wanted:
            return curves
        found |= solve(sorted(wanted))


def through(known: Sequence[float], found: Mapping[float, Numbers | None], name: str, accuracy: float) -> Interpolant | None:
    """The interpolant of one function, None if it has too few values."""
    rows = [(beta, *numbers[name]) for beta in known if (numbers := found[beta]) is not None]
    rows = [row for row in rows if math.isfinite(row[1])]
    if len(rows) < FEWEST:
        return None
    beta, value, error = np.array(rows).T
    return Interpolant(beta, value, error, accuracy)
