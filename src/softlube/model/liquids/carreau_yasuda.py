"""Viscosities with a plateau at rest, a power law, and perhaps a second plateau: Carreau, Yasuda, Cross."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import ClassVar

from softlube.errors import InputError
from softlube.model.inputs import NUMBER, TIME, VISCOSITY, given
from softlube.model.lazy import numpy as np
from softlube.model.liquids.base import Array, Liquid, check_not_negative
from softlube.model.liquids.thinning import ThinningLaw, WithViscosity, check_index, index_input

KNOTS_PER_UNIT = 150
"""Knots of the table of ln ψ for each unit of ln(λt), over the sharpness of the transition: its error is about 1e-10."""
FARTHEST = 150.0
"""Largest |ln λt| of the table; the fluidity is that of its end beyond."""
FLAT = 40.0
"""Powers of e after which nothing is left of what decays like e^−x, in double precision."""


@dataclass(frozen=True)
class CarreauYasudaLaw(ThinningLaw):
    """η = η∞ + (η₀ − η∞)[1 + (λγ̇)^a]^((n−1)/a) (Carreau 1972, Yasuda, Armstrong & Cohen 1981).

    Parameters
    ----------
    time : float
        λ over η₀ over the unit of stress.
    index : float
        n, 0 < n ≤ 1.
    infinite : float
        η∞/η₀, 0 ≤ η∞ ≤ η₀.
    transition : float
        a; 2 is Carreau's law, 1 − n is Cross's.
    """

    time: float
    index: float
    infinite: float = 0.0
    transition: float = 2.0
    kind: ClassVar[str] = "carreau-yasuda"

    def __post_init__(self) -> None:
        check_not_negative("time", self.time)
        check_index(self.index)
        if not 0 <= self.infinite <= 1:
            raise InputError(f"infinite: expected a viscosity ratio from 0 to 1, got {self.infinite!r}")
        if not 0 < self.transition < np.inf:
            raise InputError(f"transition: expected a positive number, got {self.transition!r}")

    def in_units(self, unit: float) -> CarreauYasudaLaw:
        """The same liquid with another unit of height."""
        return replace(self, liquid=self.liquid.in_units(unit), time=self.time * unit)

    def fluidity_at(self, stress: Array) -> tuple[Array, Array]:
        """Ln ψ and its slope, from a table over ln λt."""
        if self.time == 0:
            return np.zeros_like(stress), np.zeros_like(stress)
        start, spacing, pieces = _table(self.index, self.infinite, self.transition)
        place = (np.log(stress) + (np.log(self.time) - start)) / spacing
        knot = np.clip(place, 0, pieces.shape[1] - 1).astype(np.int32)
        x = place - knot
        constant, linear, square, cube = pieces.take(knot, axis=1)
        value = constant + x * (linear + x * (square + x * cube))
        return value, (linear + x * (2 * square + 3 * x * cube)) / spacing

    def flow_curve(self, rate: Array) -> Array:
        """The rate times η/η₀ there."""
        with np.errstate(divide="ignore"):
            return rate * np.exp(_ln_viscosity(np.log(self.time * rate), self.index, self.infinite, self.transition)[0])


def _ln_viscosity(x: Array, index: float, infinite: float, transition: float) -> tuple[Array, Array]:
    """Ln η/η₀ at x = ln λγ̇, and its derivative."""
    share = (1 - infinite) * np.exp((index - 1) / transition * np.logaddexp(0, transition * x))
    power = (index - 1) * np.exp(-np.logaddexp(0, -transition * x))  # of the share, up to n − 1
    return np.log(infinite + share), power * share / (infinite + share)


@lru_cache(maxsize=32)
def _table(index: float, infinite: float, transition: float) -> tuple[float, float, Array]:
    """Ln ψ over ln λt in cubic pieces of equal length: first knot, spacing, and the coefficients of the pieces.

    The first and the last piece are straight: what the law is beyond.
    """
    low = max(-FLAT / transition, -FARTHEST)
    end = FLAT / transition if infinite == 0 else FLAT / transition + (FLAT - np.log(infinite)) / max(1 - index, 1e-3)
    high = min(end, FARTHEST)
    low, high = (float(x + _ln_viscosity(np.array(x), index, infinite, transition)[0]) for x in (low, high))
    n = int(np.ceil((high - low) * KNOTS_PER_UNIT * max(1.0, transition / 2)))
    knots = np.linspace(low, high, n + 1)
    x = knots.copy()
    for _ in range(50):  # y = x + ln η/η₀ rises with a slope from n to 1
        value, slope = _ln_viscosity(x, index, infinite, transition)
        step = (x + value - knots) / (1 + slope)
        x -= step
        if np.max(np.abs(step)) < 1e-13 * FARTHEST:
            break
    value, slope = _ln_viscosity(x, index, infinite, transition)
    spacing = (high - low) / n
    value, slope = -value, -slope / (1 + slope) * spacing
    rise = np.diff(value)
    pieces = np.stack([value[:-1], slope[:-1], 3 * rise - 2 * slope[:-1] - slope[1:], slope[:-1] + slope[1:] - 2 * rise])
    straight = np.zeros((4, 1))
    first, last = straight.copy(), straight.copy()
    first[0], first[1] = value[0] - slope[0], slope[0]
    last[0], last[1] = value[-1], slope[-1]
    return low - spacing, spacing, np.ascontiguousarray(np.concatenate([first, pieces, last], axis=1))


class _Plateaus(WithViscosity):
    """What has a viscosity at rest, a relaxation time and a power law, and perhaps a viscosity at high rates."""

    infinite_viscosity: float | None = given(
        "Viscosity at high shear rates, the second plateau", VISCOSITY, "2 mPa s", default=None, absent="none"
    )
    relaxation_time: float = given("Time whose inverse is the shear rate from which on a liquid thins", TIME, "10 ms")
    index: float = index_input()

    def checked(self, values: dict[str, float | None]) -> dict[str, float | None]:
        """The values, if the second plateau is not above the first."""
        infinite, viscosity = values["infinite_viscosity"], values["viscosity"]
        if infinite is not None and viscosity is not None and infinite > viscosity:
            raise InputError(
                f"infinite_viscosity: expected less than the viscosity at rest, {viscosity:g} Pa s, got {infinite:g} Pa s"
            )
        return values

    def _law(self, law: Liquid, stress_unit: float, transition: float) -> CarreauYasudaLaw:
        ratio = (self.infinite_viscosity or 0.0) / self.viscosity
        return CarreauYasudaLaw(law, self.relaxation_time * stress_unit / self.viscosity, self.index, ratio, transition)


class Carreau(_Plateaus):
    """A liquid that thins by Carreau's law, from one plateau of the viscosity by a power law to another."""

    kind: ClassVar[str] = "carreau"
    usual: ClassVar[bool] = True

    def sheared(self, law: Liquid, pressure_unit: float, stress_unit: float) -> CarreauYasudaLaw:
        """On top of the law at rest, with the transition 2."""
        return self._law(law, stress_unit, 2.0)


class CarreauYasuda(_Plateaus):
    """A liquid that thins by Carreau and Yasuda's law, whose transition to the power law is as sharp as one says."""

    kind: ClassVar[str] = "carreau-yasuda"
    transition: float = given(
        "How sharply a liquid begins to thin, Yasuda's a; 2 in Carreau's law", NUMBER, "0.8", default=2.0, between=(0.1, 20.0)
    )

    def sheared(self, law: Liquid, pressure_unit: float, stress_unit: float) -> CarreauYasudaLaw:
        """On top of the law at rest."""
        return self._law(law, stress_unit, self.transition)


class Cross(_Plateaus):
    """A liquid that thins by Cross's law, η = η∞ + (η₀ − η∞)/[1 + (λγ̇)^(1−n)] (Cross 1965)."""

    kind: ClassVar[str] = "cross"

    def checked(self, values: dict[str, float | None]) -> dict[str, float | None]:
        """The values, if the liquid thins: without, the law halves the viscosity at every rate."""
        if values["index"] == 1:
            raise InputError("index: Cross's law needs an index below 1; a liquid that does not thin is Newtonian")
        return super().checked(values)

    def sheared(self, law: Liquid, pressure_unit: float, stress_unit: float) -> CarreauYasudaLaw:
        """On top of the law at rest: that of Carreau and Yasuda with the transition 1 − n."""
        return self._law(law, stress_unit, 1 - self.index)
