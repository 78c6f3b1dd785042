"""Viscoelastic half-spaces and layers: linear, with any Prony series and a constant Poisson ratio.

The relaxation modulus E(t) = E_relaxed + ΣEᵢ e^(−t/τᵢ) multiplies the elastic law, so that its inverse, the creep compliance
J(t) = J₀ + ΣJᵢ (1 − e^(−t/τᵢ′)), multiplies the elastic displacement.  A point at x was at x + vτ a time τ ago, so
in steady sliding

    w = J₀ wₑ + ΣJᵢ wᵢ,     wᵢ(x) = ∫₀^∞ e^(−s) wₑ(x + Lᵢ s) ds,     Lᵢ = v τᵢ′,

with the displacement wₑ of the elastic substrate.  Normalised here with the relaxed modulus: J₀ + ΣJᵢ = 1.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, NamedTuple, get_args

from softlube.errors import InputError, shown
from softlube.model.inputs import LENGTH, NUMBER, PRESSURE, TIME, Input, given
from softlube.model.lazy import numpy as np
from softlube.model.prefixes import shown as written
from softlube.model.substrates.base import Array, Kernel, Remainder, Substrate, SubstratePart
from softlube.model.substrates.half_space import HalfSpaceKernel
from softlube.model.substrates.layer import Base, LayerKernel, check_thickness

MOST_TERMS = 100
"""Terms of a Prony series at most: three to a decade do for any material, over all the decades that there are."""
EXAMPLE = "9 MPa @ 1 ms"
"""A term of a Prony series as text."""
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


@dataclass(frozen=True)
class ViscoelasticKernel(Kernel):
    """A viscoelastic half-space or layer under steady sliding, normalised with its relaxed modulus.

    Parameters
    ----------
    shares : tuple of float
        Jᵢ over the relaxed compliance, positive; J₀ = 1 − Σ shares is positive, too.
    lengths : tuple of float
        Lᵢ = vτᵢ′ over √(R × unit of height), not negative; Deborah numbers.
    relaxed : Substrate
        The elastic substrate that it is once relaxed: a half-space, or a layer all of one material.

    Raises
    ------
    InputError
        If an input is not as described.
    """

    shares: tuple[float, ...]
    lengths: tuple[float, ...]
    relaxed: Substrate = field(default_factory=HalfSpaceKernel)
    kind: ClassVar[str] = "viscoelastic"
    words: ClassVar[str] = "a viscoelastic substrate"

    def __post_init__(self) -> None:
        object.__setattr__(self, "shares", tuple(map(float, self.shares)))
        object.__setattr__(self, "lengths", tuple(map(float, self.lengths)))
        if len(self.shares) != len(self.lengths):
            raise InputError(f"shares, lengths: expected as many of each, got {len(self.shares)} and {len(self.lengths)}")
        if not (all(share > 0 for share in self.shares) and self.instantaneous > 0):
            raise InputError(f"shares: expected positive numbers with a sum below 1, got {self.shares!r}")
        if not all(math.isfinite(length) and length >= 0 for length in self.lengths):
            raise InputError(f"lengths: expected finite numbers, not negative, got {self.lengths!r}")

    @property
    def instantaneous(self) -> float:
        """J₀ over the relaxed compliance."""
        return 1 - math.fsum(self.shares)

    def compliance(self, radius: float) -> float:
        """About the compliance, over the relaxed one, that a contact of some radius sees: J₀ + ΣJᵢ/(1 + Lᵢ/radius)."""
        return self.instantaneous + sum(s / (1 + each / radius) for s, each in zip(self.shares, self.lengths, strict=True))

    def in_units(self, unit: float) -> ViscoelasticKernel:
        """The same half-space with another unit of height, given over the present one."""
        lengths = tuple(length / math.sqrt(unit) for length in self.lengths)
        return replace(self, lengths=lengths, relaxed=self.relaxed.in_units(unit))

    def hastened(self, factor: float) -> ViscoelasticKernel:
        """The same half-space passing so many times as fast: its lengths grow by the factor."""
        return replace(self, lengths=tuple(factor * length for length in self.lengths))

    @property
    def memory(self) -> ViscoelasticKernel | None:
        """Itself; None where every time is so short or so small that nothing is left of it."""
        return self if any(self.lengths) else None

    @property
    def elastic(self) -> Substrate:
        """The relaxed substrate."""
        return self.relaxed

    @property
    def remainder(self) -> Remainder | None:
        """That of the relaxed substrate: the memory multiplies its kernel."""
        return self.relaxed.remainder

    def spectrum(self, reach: float = 0.0) -> tuple[Array, Array]:
        """That of the relaxed substrate."""
        return self.relaxed.spectrum(reach)


class PronyInput(Input):
    """A Prony series: text such as "9 MPa @ 1 ms; 2 MPa @ 1 s", or pairs of a modulus and a time.  Kept as text."""

    @property
    def expected(self) -> str:
        """What a value should be, for messages."""
        return f"pairs of a modulus and a time such as [('9 MPa', '1 ms')] or {EXAMPLE!r}, terms parted by semicolons"

    def read(self, value: object, name: str | None = None) -> str:
        """The series as text, times ascending."""
        return series_text(series_terms(value, name or self.name, self.expected))


def series_text(terms: Iterable[tuple[float, float]]) -> str:
    """A Prony series [Pa, s] as text that reads back as itself."""
    return "; ".join(f"{_exactly(modulus, 'Pa')} @ {_exactly(time, 's')}" for modulus, time in terms)


def _exactly(value: float, unit: str) -> str:
    """A value with its unit, with a prefix if that loses nothing."""
    from softlube.model import units

    text = written(value, unit)
    return text if units.read_quantity(text, unit) == value else f"{value!r} {unit}"


def series_terms(value: object, name: str, expected: str) -> tuple[Term, ...]:
    """The terms [Pa, s] of a Prony series given as text or as pairs, times ascending.

    Raises
    ------
    InputError
        If the series is neither, or a modulus or a time is not positive.
    """
    pairs: Any = [each.split("@") for each in value.split(";")] if isinstance(value, str) else value
    if not isinstance(pairs, Sequence) or not pairs:
        raise InputError(f"{name}: expected {expected}, got {shown(value)}")
    if len(pairs) > MOST_TERMS:
        raise InputError(f"{name}: {len(pairs)} terms; {MOST_TERMS} are the most")
    terms = []
    for pair in pairs:
        if isinstance(pair, str) or not isinstance(pair, Sequence) or len(pair) != 2:
            raise InputError(f"{name}: expected {expected}, got {shown(pair)}")
        modulus, time = (each.strip() if isinstance(each, str) else each for each in pair)
        terms.append(Term(_MODULUS.read(modulus, name), _TIME.read(time, name)))
    return tuple(sorted(terms, key=lambda term: term.time))


_MODULUS = Input("Modulus of a term", PRESSURE, "9 MPa")
_TIME = Input("Time of a term", TIME, "1 ms")


class Remembering(SubstratePart):
    """A viscoelastic half-space or layer with the relaxed modulus that its inputs give."""

    thickness: float | None = given(
        "Thickness of the substrate, a layer on a rigid base", LENGTH, "2 mm", default=None, absent="a half-space"
    )
    base: Base = given("How a layer lies on its base", default="bonded", choices=get_args(Base))

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values; a half-space lies on no base, and a layer on a ball is thinner than the ball is round."""
        if values["thickness"] is not None:
            check_thickness(values)
        elif values["base"] != "bonded":
            raise InputError(f"base, thickness: {values['base']!r} means nothing without a thickness; give both or neither")
        return super().checked(values)

    @property
    def creep(self) -> Creep:
        """Compliances over the relaxed one, and times [s]."""
        raise NotImplementedError

    def kernel(self, length_unit: float, share: float = 1.0, speed: float | None = None) -> ViscoelasticKernel:
        """Its creep with the lengths by which the surface moves in its times; an elastic ball adds to the instantaneous part.

        Raises
        ------
        InputError
            If the contact is not steady, the surface moves against the liquid, or an elastic ball slides on a layer.
        """
        if speed is None:
            raise InputError(
                "substrate: one that remembers is solved in steady sliding only; the integration in time has no unknowns for "
                "what it remembers. Give the relaxed modulus alone if the film is slow beside every time, the instantaneous "
                "one if it is fast"
            )
        if speed < 0:
            raise InputError(
                "slide_to_roll: below -2 a substrate that remembers moves against the liquid, which is not solved; expected a "
                f"number from -2 on, got a substrate's speed of {speed:g} m/s"
            )
        if share < 1 and self.thickness is not None:
            raise InputError(
                "thickness: an elastic ball on a layer that remembers is not solved, as the ball's compliance does not relax; "
                "give a rigid ball, or leave the thickness out"
            )
        relaxed: Substrate = HalfSpaceKernel()
        if self.thickness is not None:
            relaxed = LayerKernel(self.thickness / length_unit, self.poisson_ratio, self.base)
        terms = self.creep.terms
        return ViscoelasticKernel(
            tuple(share * each.weight for each in terms), tuple(speed * each.time / length_unit for each in terms), relaxed
        )


class Viscoelastic(Remembering):
    """A viscoelastic half-space or layer: E(t) = E_relaxed + ΣEᵢ e^(−t/τᵢ); Young's modulus is the relaxed one.

    Beside a shear modulus the moduli of the series are shear moduli, Gᵢ.
    """

    kind: ClassVar[str] = "viscoelastic"
    prony: str = PronyInput(f'Prony series of the relaxation modulus, such as "{EXAMPLE}; 2 MPa @ 1 s"')  # type: ignore[assignment]

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values with shear moduli, as they are kept."""
        by_young = values["young_modulus"] is not None
        values = super().checked(values)
        if by_young:
            factor = 1 / (2 * (1 + values["poisson_ratio"]))
            terms = [(factor * modulus, time) for modulus, time in series_terms(values["prony"], "prony", "")]
            values["prony"] = series_text(terms)
        return values

    @property
    def terms(self) -> tuple[Term, ...]:
        """The series of the shear modulus: Gᵢ [Pa] and τᵢ [s], times ascending."""
        return series_terms(self.prony, "prony", "")

    @property
    def creep(self) -> Creep:
        """Compliances over the relaxed one, and times [s]."""
        return creep_of(1.0, [(modulus / self.shear_modulus, time) for modulus, time in self.terms])


class StandardLinearSolid(Remembering):
    """A viscoelastic half-space or layer with one time: E(t) = E_relaxed + (E_instantaneous − E_relaxed) e^(−t/τ).

    Young's modulus is the relaxed one.
    """

    kind: ClassVar[str] = "standard-linear-solid"
    stiffening: float = given("Instantaneous over relaxed modulus of a standard linear solid, above 1", NUMBER, "10")
    relaxation_time: float = given(
        "Relaxation time of a standard linear solid, at constant strain", TIME, "1 ms", flat="substrate_relaxation_time"
    )

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values; an instantaneous modulus is the larger one."""
        if not values["stiffening"] > 1:
            raise InputError(f"stiffening: expected a number above 1, got {values['stiffening']:g}")
        return super().checked(values)

    @property
    def creep(self) -> Creep:
        """Compliances over the relaxed one, and times [s]."""
        return creep_of(1.0, [(self.stiffening - 1, self.relaxation_time)])
