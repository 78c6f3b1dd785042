"""Viscoelastic half-spaces and layers: linear, with any Prony series and a constant Poisson ratio.

The relaxation modulus E(t) = E_relaxed + ΣEᵢ e^(−t/τᵢ) multiplies the elastic law, so that its inverse, the creep compliance
J(t) = J₀ + ΣJᵢ (1 − e^(−t/τᵢ′)), multiplies the elastic displacement wₑ:

    w = J₀ wₑ + ΣJᵢ wᵢ,     τᵢ′ dwᵢ/dt = wₑ − wᵢ.

A point at x was at x + vτ a time τ ago, so in steady sliding

    wᵢ(x) = ∫₀^∞ e^(−s) wₑ(x + Lᵢ s) ds,     Lᵢ = v τᵢ′.

Normalised here with the relaxed modulus: J₀ + ΣJᵢ = 1.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, ClassVar, get_args

from softlube.errors import InputError, shown
from softlube.model.creep import Creep, Term, creep_of
from softlube.model.inputs import LENGTH, NUMBER, PRESSURE, TIME, Input, given
from softlube.model.prefixes import shown as written
from softlube.model.substrates.base import Array, Kernel, Remainder, Substrate, SubstratePart
from softlube.model.substrates.half_space import HalfSpaceKernel
from softlube.model.substrates.layer import Base, LayerKernel, check_thickness

MOST_TERMS = 100
"""Terms of a Prony series at most: three to a decade do for any material, over all the decades that there are."""
EXAMPLE = "9 MPa @ 1 ms"
"""A term of a Prony series as text."""


class RememberingKernel(Kernel):
    """A viscoelastic half-space or layer, normalised with its relaxed modulus: its creep over a relaxed substrate.

    Attributes
    ----------
    shares : tuple of float
        Jᵢ over the relaxed compliance, positive; J₀ = 1 − Σ shares is positive, too.
    relaxed : Substrate
        The elastic substrate that it is once relaxed: a half-space, or a layer all of one material.
    """

    words: ClassVar[str] = "a viscoelastic substrate"
    spans: ClassVar[str]
    """Name of the attribute that says over what each share builds up."""
    if TYPE_CHECKING:

        @property
        def shares(self) -> tuple[float, ...]: ...
        @property
        def relaxed(self) -> Substrate: ...

    def __post_init__(self) -> None:
        spans = tuple(map(float, getattr(self, self.spans)))
        object.__setattr__(self, "shares", tuple(map(float, self.shares)))
        object.__setattr__(self, self.spans, spans)
        if len(self.shares) != len(spans):
            raise InputError(f"shares, {self.spans}: expected as many of each, got {len(self.shares)} and {len(spans)}")
        if not (all(share > 0 for share in self.shares) and self.instantaneous > 0):
            raise InputError(f"shares: expected positive numbers with a sum below 1, got {self.shares!r}")
        if not all(math.isfinite(span) and span >= 0 for span in spans):
            raise InputError(f"{self.spans}: expected finite numbers, not negative, got {spans!r}")

    @property
    def instantaneous(self) -> float:
        """J₀ over the relaxed compliance."""
        return 1 - math.fsum(self.shares)

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


@dataclass(frozen=True)
class ViscoelasticKernel(RememberingKernel):
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
    spans: ClassVar[str] = "lengths"

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
    def creep(self) -> Creep:
        """None that is known: lengths say nothing of the time.

        Raises
        ------
        InputError
            Always.
        """
        raise InputError(
            "substrate: under a film that changes with time a substrate remembers over times, a CreepingKernel; got lengths of "
            "steady sliding, a ViscoelasticKernel"
        )


@dataclass(frozen=True)
class CreepingKernel(RememberingKernel):
    """A viscoelastic half-space or layer under a film that changes with time, normalised with its relaxed modulus.

    Parameters
    ----------
    shares : tuple of float
        Jᵢ over the relaxed compliance, positive; J₀ = 1 − Σ shares is positive, too.
    times : tuple of float
        τᵢ′ in units of the time of `softlube.transient.squeeze.rings`, not negative.
    relaxed : Substrate
        The elastic substrate that it is once relaxed: a half-space, or a layer all of one material.

    Raises
    ------
    InputError
        If an input is not as described.
    """

    shares: tuple[float, ...]
    times: tuple[float, ...]
    relaxed: Substrate = field(default_factory=HalfSpaceKernel)
    kind: ClassVar[str] = "creeping"
    spans: ClassVar[str] = "times"

    def in_units(self, unit: float) -> CreepingKernel:
        """The same half-space with another unit of height, given over the present one."""
        return replace(self, times=tuple(unit**1.5 * time for time in self.times), relaxed=self.relaxed.in_units(unit))

    @property
    def memory(self) -> ViscoelasticKernel:
        """None that is known: times say nothing of the lengths by which the surface moves in them.

        Raises
        ------
        InputError
            Always.
        """
        raise InputError(
            "substrate: under steady sliding a substrate remembers over lengths, a ViscoelasticKernel; got times of a film "
            "that changes with time, a CreepingKernel"
        )

    @property
    def creep(self) -> Creep:
        """J₀ with the shares that build up at once, and the others, those of equal times together."""
        shares = {
            time: math.fsum(share for share, own in zip(self.shares, self.times, strict=True) if own == time)
            for time in sorted(set(self.times))
        }
        at_once = shares.pop(0.0, 0.0)
        return Creep(self.instantaneous + at_once, tuple(Term(share, time) for time, share in shares.items()))


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

    def kernel(
        self, length_unit: float, share: float = 1.0, speed: float | None = None, time_unit: float = 1.0
    ) -> CreepingKernel | ViscoelasticKernel:
        """Its creep over the time in which the surface moves by the unit of length, or over the unit of time.

        An elastic ball adds to the instantaneous part.

        Raises
        ------
        InputError
            If the surface moves against the liquid, or an elastic ball is pressed on a layer.
        """
        if speed is not None and speed < 0:
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
        shares = tuple(share * each.weight for each in terms)
        if speed is None:
            return CreepingKernel(shares, tuple(each.time / time_unit for each in terms), relaxed)
        return ViscoelasticKernel(shares, tuple(speed * each.time / length_unit for each in terms), relaxed)


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
