"""Friction of many contacts as a function of viscosity, modulus and offset, from parameters some of which are to be fitted.

The friction of every contact is F = (2π/3) G δ² f(β_N) + F₀, with the load's Hertz indentation δ of Eq. (29), β_N of Eq. (30)
and the curve f of `softlube.experiments.load_curve`, which on layers and in oils depends on the load, too.  Where f is a power
β^(−m), F goes like η^m G^((m−1)/3) and the data fix that combination only: viscosity and modulus come apart by the curvature of
f alone, which a fit with both must say.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError
from softlube.experiments.curves import clipped
from softlube.experiments.load_curve import check_friction
from softlube.experiments.load_family import LoadFamily, load_family
from softlube.experiments.measurements import Measurements
from softlube.model.inputs import declared
from softlube.model.parts import Part
from softlube.model.problem import Problem
from softlube.physical.contact import Contact
from softlube.physical.inputs import BODIES, check_names, names_of
from softlube.solvers.progress import Listener

Array = NDArray[np.floating]

OFFSET = "friction_offset"
SHORT = {"modulus": "young_modulus", "offset": OFFSET}
MODULI = ("young_modulus", "shear_modulus")
PRINCIPAL = ("viscosity", *MODULI)
"""Parameters that are told with the result where they are held."""
TYPICAL = {"young_modulus": 1e6}
"""What to start from where nothing is given, in SI."""
NOISE = ("relative", "absolute")
ACCURACY = 5e-3
"""Relative accuracy of the solutions behind the curve: the friction is then good to 0.1 %, far better than a measurement."""
ROOM = 4.0
"""How far, as a factor of β, the curve reaches beyond the data at first."""
SPREAD = 8.0
"""How far, as a factor of the load, curves reach beyond the data where a fitted parameter acts like another load.  A thickness
or a pressure coefficient is so looked for within a factor of 2 of where the search is."""
PAPER_FIT = (4.806, 0.4398)
"""Eq. (28), from which the first guess of the viscosity is taken."""
WEAK = 5e-3
"""Relative change of a liquid's law, by the viscosity that is fitted, for which curves are not solved again."""
STEP = 1.1
"""Factor by which a parameter is changed to see what it does."""
SAME = 1e-9
"""Relative difference below which two numbers are one."""


def parameters() -> tuple[str, ...]:
    """Names of what can be fitted: every positive quantity with a unit that a body or a liquid has, and the offset."""
    others = [name for name, each in names_of(BODIES).items() if each.unit and not each.signed]
    return tuple(dict.fromkeys(("viscosity", "young_modulus", OFFSET, *others)))


def unit_of(name: str) -> str:
    """SI unit of a parameter."""
    return "N" if name == OFFSET else declared()[name].unit


@lru_cache(maxsize=64)
def _contact(inputs: tuple[tuple[str, Any], ...]) -> Contact:
    return Contact(**dict(inputs), speed=1.0)


@dataclass(frozen=True)
class Model:
    """Friction as a function of the parameters.

    Attributes
    ----------
    data : Measurements
    held : mapping of str to object
        Inputs of bodies and liquid that are no parameters, as given.
    fixed : mapping of str to float
        Values of the parameters that are not fitted, in SI.
    free : tuple of str
        Parameters that are fitted.
    noise : {"relative", "absolute"}
        Whether the scatter is in proportion to the friction, or the same for all.
    force : see `softlube.experiments.load_curve.LoadCurve.friction`
    start : mapping of str to float
        Parameters that the search starts from, in SI.
    family : LoadFamily or None
        The curves, solved with the parameters `start`.
    """

    data: Measurements
    held: Mapping[str, Any]
    fixed: dict[str, float]
    free: tuple[str, ...]
    noise: str
    force: str
    start: dict[str, float] = field(default_factory=dict)
    family: LoadFamily | None = None

    @property
    def scale(self) -> float:
        """Unit of the offset: the median friction [N]."""
        return float(np.median(np.abs(self.data.friction)))

    def values(self, x: Array) -> dict[str, float]:
        """All parameters in SI from the vector that is fitted: logarithms, and the offset in units of `scale`."""
        found = {n: float(v * self.scale if n == OFFSET else math.exp(v)) for n, v in zip(self.free, x, strict=True)}
        return self.fixed | found

    def vector(self, values: Mapping[str, float]) -> Array:
        """Inverse of `values`."""
        return np.array([values[n] / self.scale if n == OFFSET else math.log(values[n]) for n in self.free])

    def contact(self, values: Mapping[str, float], load: float = 1.0) -> Contact:
        """The contact under a load [N] at a speed of 1 m/s."""
        inputs = dict(self.held) | {name: value for name, value in values.items() if name != OFFSET} | {"load": load}
        return _contact(tuple(sorted(inputs.items())))

    def problem(self, values: Mapping[str, float], load: float) -> Problem:
        """The dimensionless problem under a load [N]."""
        return self.contact(values, load).problem()

    def beta(self, values: Mapping[str, float], data: Measurements | None = None) -> Array:
        """β of Eq. (30), which goes with the load to the power 4/3 over the speed."""
        data = data or self.data
        return self.problem(values, 1.0).parameter * data.load ** (4 / 3) / data.speed

    def unit(self, values: Mapping[str, float], data: Measurements | None = None) -> Array:
        """(2π/3) G δ², Eqs. (26), (29), which goes with the load to the power 4/3 [N]."""
        contact = self.contact(values)
        return contact.scales(contact.unit_height)["friction"][0] * (data or self.data).load ** (4 / 3)

    @property
    def _acting(self) -> tuple[str, ...]:
        """Fitted parameters that may change the normalised layer or liquid."""
        return tuple(name for name in self.free if name not in ("viscosity", OFFSET))

    def bounds(self) -> tuple[Array, Array]:
        """Least and greatest vector that the curves reach, see `values`; infinite for what the normalised layer and liquid do
        not depend on.
        """
        reach = np.full(len(self.free), math.inf)
        for k, name in enumerate(self.free):
            if name in self._acting and self.start:
                power = abs(math.log(self.acts_like_load(self.start | {name: STEP * self.start[name]}))) / math.log(STEP)
                reach[k] = math.log(SPREAD) / power if power > SAME else math.inf
        middle = np.array([math.log(self.start[n]) if n in self._acting and self.start else 0.0 for n in self.free])
        return middle - reach, middle + reach

    def acts_like_load(self, values: Mapping[str, float]) -> float:
        """Factor of the load that does to the normalised layer and liquid what the parameters do, compared with `start`.

        A layer twice as thick is, over the contact's radius, what the layer is under an eighth of the load.  The viscosity
        counts as that of `start`: a law of viscosity that depends on it, such as Roelands', does so weakly, and the curves are
        solved again where it has changed.

        Raises
        ------
        InputError
            If no change of the load does all that they do.
        """
        now = dict(values) | {name: self.start[name] for name in ("viscosity", OFFSET)}
        if now == self.start:
            return 1.0
        ours, light, heavy = (
            _numbers(self.problem(each, load)) for each, load in ((now, 1.0), (self.start, 1.0), (self.start, math.e))
        )
        factors = []
        for ours_now, at_unit, heavier in zip(ours, light, heavy, strict=True):
            power = math.log(heavier / at_unit)
            if abs(power) > SAME:
                factors.append(math.log(ours_now / at_unit) / power)
            elif abs(ours_now / at_unit - 1) > SAME:
                factors.append(math.inf)
        if factors and not max(factors) - min(factors) < 1e-6:
            changed = [name for name in now if now[name] != self.start[name]]
            raise InputError(
                f"free: {' and '.join(changed)} change the layer and the liquid each in its own way, and curves for both "
                "changes are too many; hold one of them, or compare fits with several values of it"
            )
        return math.exp(factors[0]) if factors else 1.0

    def holds_for(self, values: Mapping[str, float]) -> bool:
        """Whether the curves are those of some parameters: the loads lie within them, and the laws are those of `start`."""
        assert self.family is not None
        numbers = (_numbers(self.problem(self.start | {"viscosity": each["viscosity"]}, 1.0)) for each in (self.start, values))
        same = all(abs(math.log(now / before)) < WEAK for before, now in zip(*numbers, strict=True))
        if self.family.loads.size == 1:
            return same
        loads = self.data.load * self.acts_like_load(values)
        within = self.family.loads[0] <= (1 + SAME) * loads.min() and loads.max() <= (1 + SAME) * self.family.loads[-1]
        return same and bool(within)

    def check(self) -> None:
        """Refuse parameters that cannot be fitted together.

        Raises
        ------
        InputError
            If the friction does not depend on one of them, or the curves cannot follow; see `acts_like_load`.
        """
        values = self.first_guess()
        model = replace(self, start=values)
        for name in self._acting:
            other = values | {name: STEP * values[name]}
            told = [(*_numbers(each.problem()), each.problem().parameter) for each in map(model.contact, (values, other))]
            if told[0] == told[1]:
                raise InputError(f"free, {name}: the friction does not depend on it")
            model.acts_like_load(other)
        model.acts_like_load(values | {name: STEP * values[name] for name in self._acting})

    def friction(self, values: Mapping[str, float], data: Measurements | None = None) -> Array:
        """Friction force [N]."""
        assert self.family is not None
        rows = data or self.data
        normalised = self.family.friction(
            rows.load * self.acts_like_load(values),
            self.beta(values, rows),
            force=self.force,
            slide_to_roll=rows.slide_to_roll,
        )
        return self.unit(values, rows) * normalised + values[OFFSET]

    def residuals(self, values: Mapping[str, float], data: Measurements | None = None) -> Array:
        """ln(measured/model) for relative noise, else (measured − model)/`scale`."""
        measured, model = (data or self.data).friction, self.friction(values, data)
        if self.noise == "absolute":
            return (measured - model) / self.scale
        # An offset may take the model below zero on the way; such a point is as far off as can be without being infinite.
        return np.log(measured / np.maximum(model, 1e-3 * measured))

    def first_guess(self) -> dict[str, float]:
        """What is given, else something typical, and the viscosity from the median point and Eq. (28)."""
        values = TYPICAL | {OFFSET: 0.0} | self.start | self.fixed
        values = {name: value for name, value in values.items() if name in self.free or name in self.fixed}
        if "viscosity" not in values:
            beta_times_viscosity = self.beta(values | {"viscosity": 1.0})
            normalised = np.abs(self.data.friction) / self.unit(values | {"viscosity": 1.0})
            guesses = beta_times_viscosity * (np.maximum(normalised, 1e-12) / PAPER_FIT[0]) ** (1 / PAPER_FIT[1])
            values["viscosity"] = float(np.median(guesses))
        return values

    def cover(self, values: dict[str, float], region: str | float, progress: Listener | None) -> Model:
        """With load curves around the β of the data, for layer and liquid as they are with some values of the parameters."""
        beta = self.beta(values)
        low, high = clipped(float(beta.min()) / ROOM, float(beta.max()) * ROOM)
        if self.family is not None:
            low, high = min(low, self.family.low), max(high, self.family.high)
        # From one round to the next only what the curves cannot follow changes, so that most of them are known.
        start = values if self.family is None else self.start | {"viscosity": values["viscosity"]}
        model = replace(self, start=dict(start))
        factor = model.acts_like_load(values)
        shifted = any(
            abs(model.acts_like_load(values | {name: STEP * values[name]}) / factor - 1) > SAME for name in self._acting
        )
        family = load_family(
            lambda load: self.problem(model.start, load),
            self.data.load * factor,
            _half_decade(low, math.floor),
            _half_decade(high, math.ceil),
            spread=SPREAD if shifted else 1.0,
            region=region,
            accuracy=ACCURACY,
            progress=progress,
        )
        return replace(model, family=family)


def _half_decade(beta: float, rounded: Any) -> float:
    """The next half decade, so that curves over a little more or less are solved at the same β; not for the tiniest shift."""
    return 10 ** (rounded(round(2 * math.log10(beta), 9)) / 2)


def _numbers(problem: Problem) -> list[float]:
    """Numbers of the normalised substrate, liquid and indenter, in the order in which they are declared."""

    def leaves(value: Any) -> list[float]:
        if isinstance(value, Mapping):
            return [leaf for each in value.values() for leaf in leaves(each)]
        return [float(value)] if isinstance(value, int | float) and not isinstance(value, bool) else []

    plain = problem.to_plain()
    return [leaf for name in ("substrate", "liquid", "indenter") for leaf in leaves(plain.get(name, {})) if leaf > 0]


def make_model(
    data: Measurements,
    *,
    friction_offset: float = 0.0,
    free: Sequence[str] = ("viscosity",),
    noise: str = "relative",
    force: str = "total",
    region: str | float = 2.0,
    **given: Any,
) -> Model:
    """Check the input of a fit; parameters as in `softlube.experiments.fit.fit`.

    Raises
    ------
    InputError
        If something is missing, unknown or impossible.
    """
    names = tuple(dict.fromkeys(SHORT.get(name, name) for name in free))
    unknown = [name for name in names if name not in parameters()]
    if unknown or not names:
        listed = ", ".join(parameters())
        raise InputError(f"free: expected one or more of {listed}, got {', '.join(unknown) or 'none'}")
    if noise not in NOISE:
        raise InputError(f"noise: expected one of {', '.join(NOISE)}, got {noise!r}")
    check_friction(force, region)
    check_names(given, BODIES)
    known = {name: value for name, value in given.items() if value is not None}
    for slot in BODIES:
        if isinstance(known.get(slot), Part):
            known |= known.pop(slot).flat()
    if "radius" not in known:
        raise InputError("radius: missing; expected a length such as '2 mm'")
    for name, group in (("young_modulus", MODULI), ("viscosity", ("viscosity",))):
        if not set(group) & (known.keys() | set(names)):
            raise InputError(f"{name}: missing; give it or fit it (free)")
    for name in names:
        if name not in known and name not in (*TYPICAL, "viscosity", OFFSET):
            raise InputError(f"free, {name}: give a value to start from")
    if len(data) <= len(names) + 1:
        raise InputError(f"{data.source}: {len(data)} rows are too few for {len(names)} parameters")
    if noise == "relative" and np.any(data.friction <= 0):
        line = data.lines[int(np.argmax(data.friction <= 0))]
        raise InputError(
            f"{data.source}, line {line}: the friction is not positive, and noise in proportion to it makes no sense; "
            "leave the row out or take noise absolute"
        )
    inputs = names_of(BODIES)
    in_si = {name: inputs[name].read(value) for name, value in known.items()}
    fixed = {name: in_si[name] for name in PRINCIPAL if name in in_si and name not in names}
    held = {name: value for name, value in in_si.items() if name not in (*names, *PRINCIPAL)}
    start = {name: in_si[name] for name in names if name in in_si}
    model = Model(data, held, fixed | {OFFSET: float(friction_offset)}, names, noise, force, start)
    model.check()
    return model


def normalised_friction(model: Model, values: Mapping[str, float]) -> tuple[Array, Array]:
    """β and the measured friction, less the offset, over (2π/3) G δ²: the points of Fig. 13."""
    return model.beta(values), (model.data.friction - values[OFFSET]) / model.unit(values)
