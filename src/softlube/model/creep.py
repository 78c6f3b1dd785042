"""Relaxation and creep of linear viscoelastic solids: Prony series and their exact inverses.

A relaxation modulus E(t) = E_relaxed + ΣEᵢ e^(−t/τᵢ) has the creep compliance J(t) = J₀ + ΣJᵢ (1 − e^(−t/τᵢ′)).
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from softlube.model.lazy import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.floating]

HALVINGS = 90
"""Bisections for a root of the secular equation: from `LARGEST_ODDS` down to round-off."""
LARGEST_ODDS = 300.0
"""Largest logarithm of how much nearer a root lies to one pole than to the other."""


class Term(NamedTuple):
    """A term of a series: its weight, and its time [s]."""

    weight: float
    time: float


@dataclass(frozen=True)
class Creep:
    """Creep compliance J(t) = instantaneous + Σ weight (1 − e^(−t/time)).

    Attributes
    ----------
    instantaneous : float
        J₀.
    terms : tuple of Term
        Jᵢ and τᵢ′, times ascending.
    """

    instantaneous: float
    terms: tuple[Term, ...]

    @property
    def relaxed(self) -> float:
        """J for t → ∞."""
        return self.instantaneous + math.fsum(term.weight for term in self.terms)


ELASTIC = Creep(1.0, ())
"""Creep of an elastic solid over its own compliance."""


def creep_of(relaxed: float, terms: Iterable[tuple[float, float]]) -> Creep:
    """The creep compliance of a relaxation modulus E(t) = relaxed + Σ Eᵢ e^(−t/τᵢ), exactly.

    Parameters
    ----------
    relaxed : float
        E for t → ∞, positive.
    terms : iterable of (float, float)
        Eᵢ and τᵢ, positive, in any order; equal times are taken together.

    Notes
    -----
    With Laplace's variable p = −1/t the modulus is f(t) = E − Σ Eᵢτᵢ/(t − τᵢ), the compliance 1/f(t) = J₀ + Σ Jᵢ t/(t − τᵢ′).
    f rises from −∞ to ∞ between two poles, so there is one root τᵢ′ between each τᵢ and the next and one beyond the last, and
    Jᵢ = 1/(τᵢ′ f′(τᵢ′)).  Bisection in the logarithm of (t − τᵢ)/(τᵢ₊₁ − t) loses no digit over any number of decades.

    Examples
    --------
    >>> creep = creep_of(1.0, [(9.0, 1.0)])
    >>> print(creep.instantaneous, *(f"{each.weight:.9g} in {each.time:.9g} s" for each in creep.terms))
    0.1 0.9 in 10 s
    """
    merged: dict[float, float] = {}
    for modulus, duration in terms:
        merged[duration] = merged.get(duration, 0.0) + modulus
    times = np.array(sorted(merged))
    moduli = np.array([merged[each] for each in times.tolist()])
    instantaneous = 1 / (relaxed + math.fsum(moduli))
    if not times.size:
        return Creep(instantaneous, ())
    strength = moduli * times
    # f(t) ≥ E − Σ Eᵢτᵢ/(t − τₙ) beyond the last pole, so the last root is not further from it than this.
    width = np.append(np.diff(times), math.fsum(strength) / relaxed)
    from_pole = times[:, None] - times  # of the pole below each root from every pole

    def distances(odds: Array) -> Array:
        """Of points from every pole, shape (points, poles), without cancellation next to the nearest two."""
        share = 1 / (1 + np.exp(-odds))
        result = from_pole + (width * share)[:, None]
        above = np.arange(times.size - 1)
        result[above, above + 1] = -width[:-1] / (1 + np.exp(odds[:-1]))
        return result

    low, high = np.full(times.size, -LARGEST_ODDS), np.full(times.size, LARGEST_ODDS)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        below = relaxed < np.sum(strength / distances(middle), axis=1)
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    apart = distances((low + high) / 2)
    roots = times + np.diagonal(apart)
    weights = 1 / (roots * np.sum(strength / apart**2, axis=1))
    return Creep(instantaneous, tuple(map(Term, weights.tolist(), roots.tolist())))


def relaxation_of(creep: Creep) -> tuple[float, tuple[Term, ...]]:
    """The relaxation modulus of a creep compliance, exactly: E for t → ∞, and Eᵢ and τᵢ, times ascending.

    Parameters
    ----------
    creep : Creep
        With a positive instantaneous compliance.

    Notes
    -----
    With Laplace's variable p the modulus is E + Σ Eᵢ pτᵢ/(1 + pτᵢ), its inverse J₀ + Σ Jᵢ/(1 + pτᵢ′).  In q = 1/p the second is
    J₀ + Σ Jᵢ qθᵢ/(1 + qθᵢ) with θᵢ = 1/τᵢ′: a modulus, whose inverse `creep_of` knows.

    Examples
    --------
    >>> relaxed, terms = relaxation_of(creep_of(1.0, [(9.0, 1.0)]))
    >>> print(f"{relaxed:.9g}", *(f"{each.weight:.9g} in {each.time:.9g} s" for each in terms))
    1 9 in 1 s
    """
    inverse = creep_of(creep.instantaneous, [(term.weight, 1 / term.time) for term in creep.terms])
    return inverse.instantaneous, tuple(Term(term.weight, 1 / term.time) for term in reversed(inverse.terms))
