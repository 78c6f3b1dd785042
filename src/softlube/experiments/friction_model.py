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
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.errors import InputError
from softlube.experiments.curves import clipped
from softlube.experiments.load_curve import check_friction
from softlube.experiments.load_family import LoadFamily, load_family
from softlube.experiments.measurements import Measurements
from softlube.experiments.parameters import MODULI, OFFSET, PRINCIPAL, SHORT, TYPICAL, parameters
from softlube.experiments.problem_numbers import SAME, SHARES, Path, moved, nodes_around, numbers_of, powers, with_numbers
from softlube.model.indenters import IndenterPart
from softlube.model.motions import Rolling
from softlube.model.parts import Part, resolve
from softlube.model.problem import Problem
from softlube.physical.contact import Contact
from softlube.physical.inputs import BODIES, check_names, names_of
from softlube.solvers.progress import Listener

Array = NDArray[np.floating]

NOISE = ("relative", "absolute")
ACCURACY = {True: 5e-3, False: 1.5e-2}
"""Relative accuracy of the solutions behind `Model.plain` curves and others: the friction is good to 0.1 or 0.3 %."""
ROOM = {True: 4.0, False: 2.0}
"""How far, as a factor of β, the curve reaches beyond the data at first, for `Model.plain` contacts and for others, whose
parameters are looked for nearby."""
SPREAD = {True: 8.0, False: 3.0}
"""How far, as a factor of the load, curves reach beyond the data where a fitted parameter acts like another load, for
`Model.plain` contacts and for others: a thickness or a time is looked for within a factor of 2 or 3 of where the search is."""
COARSE = 0.2
"""Steps, in logarithm, of the parameters of curves where contacts are not `Model.plain`, so that they are found again."""
OFF_CENTRE = 0.6
"""Share of the reach of the curves beyond which they are solved again around what has been found."""
PAPER_FIT = (4.806, 0.4398)
"""Eq. (28), from which the first guess of the viscosity is taken."""
WEAK = 5e-3
"""Relative change of a liquid's law, by the viscosity that is fitted, for which curves are not solved again."""
STEP = 1 / 1.1
"""Factor by which a parameter is changed to see what it does."""


@lru_cache(maxsize=64)
def _contact(inputs: tuple[tuple[str, Any], ...], slide_to_roll: float) -> Contact:
    return Contact(**dict(inputs), motion=Rolling(0.5, slide_to_roll=slide_to_roll))


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
    varied : tuple of path
        Numbers for which the curves have nodes: the fitted parameters change them and no load does.
    """

    data: Measurements
    held: Mapping[str, Any]
    fixed: dict[str, float]
    free: tuple[str, ...]
    noise: str
    force: str
    start: dict[str, float] = field(default_factory=dict)
    family: LoadFamily | None = None
    varied: tuple[Path, ...] = ()

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
        return _contact(tuple(sorted(inputs.items())), float(self.data.slide_to_roll[0]))

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

    @cached_property
    def plain(self) -> bool:
        """Whether viscosity and speed act as one, β: no liquid that thins with shear, no substrate that remembers."""
        problem = self.problem(self.first_guess(), 1.0)
        return problem.liquid.linear and problem.substrate.memory is None

    limited = property(lambda self: not self.plain, doc="Whether bounds are where curves end: where contacts are not `plain`.")

    @property
    def _weak(self) -> tuple[str, ...]:
        """Parameters that do not change the normalised layer or liquid, or so weakly that curves are solved again for it."""
        return ("viscosity", OFFSET) if self.plain else (OFFSET,)

    @property
    def _acting(self) -> tuple[str, ...]:
        """Fitted parameters that may change the normalised layer or liquid."""
        return tuple(name for name in self.free if name not in self._weak)

    def bounds(self) -> tuple[Array, Array]:
        """Least and greatest vector that the curves reach; infinite where layer and liquid do not depend on a parameter."""
        ends = np.array([[-math.inf, math.inf]] * len(self.free))
        windows = dict(zip(self.varied, self.family.numbers, strict=True)) if self.family else {}
        for k, name in enumerate(self.free):
            if name not in self._acting or not self.start:
                continue
            factor, apart = self.moved(self.start | {name: STEP * self.start[name]})
            power = abs(math.log(factor) / math.log(STEP))
            reach = math.log(SPREAD[self.plain]) / power if power > SAME else math.inf
            low, high = -reach, reach
            for path in apart.keys() & windows.keys():
                own = self._numbers[path]
                slope = math.log(apart[path] / own) / math.log(STEP)
                ahead, behind = sorted(math.log(end / own) / slope for end in windows[path][[0, -1]])
                low, high = max(low, ahead), min(high, behind)
            ends[k] = low + math.log(self.start[name]), high + math.log(self.start[name])
        return ends[:, 0], ends[:, 1]

    @cached_property
    def _numbers(self) -> dict[Path, float]:
        """Numbers of the normalised layer and liquid with the parameters `start` under a load of 1 N."""
        return numbers_of(self.problem(self.start, 1.0))

    @cached_property
    def _powers(self) -> dict[Path, float]:
        """How they go with the load."""
        return powers(self._numbers, numbers_of(self.problem(self.start, math.e)))

    def moved(self, values: Mapping[str, float]) -> tuple[float, dict[Path, float]]:
        """What the parameters do to the normalised layer and liquid, compared with `start`.

        The viscosity of a liquid that does not thin counts as that of `start`: a law of viscosity that depends on it, such as
        Roelands', does so weakly, and the curves are solved again where it has changed.

        Returns
        -------
        factor : float
            Factor of the load that does the same.
        apart : mapping of path to float
            Numbers that have changed and that no load changes, such as an index.

        Raises
        ------
        InputError
            If no change of the load does all that they do to the numbers that it changes.
        """
        now = dict(values) | {name: self.start[name] for name in self._weak if name in self.start}
        if now == self.start:
            return 1.0, {}
        factor, apart = moved(numbers_of(self.problem(now, 1.0)), self._numbers, self._powers)
        stiffer = any(path[: len(SHARES)] == SHARES for path in apart)
        if factor is None or stiffer:
            changed = " and ".join(name for name in now if now[name] != self.start[name])
            what = "how much the substrate stiffens" if stiffer else "the layer and the liquid each in its own way"
            raise InputError(
                f"free: {changed} change {what}, and curves for all are too many; hold one of them, or compare fits with "
                "several values of it"
            )
        return factor, apart

    def acts_like_load(self, values: Mapping[str, float]) -> float:
        """Factor of the load, see `moved`."""
        return self.moved(values)[0]

    def numbers(self, values: Mapping[str, float]) -> tuple[float, ...]:
        """Values of the numbers that are `varied`."""
        apart = self.moved(values)[1] if self.varied else {}
        return tuple(apart.get(path, self._numbers[path]) for path in self.varied)

    def holds_for(self, values: Mapping[str, float]) -> bool:
        """Whether the curves are those of some parameters: loads and numbers lie within them, and the laws are `start`'s."""
        assert self.family is not None
        now = numbers_of(self.problem(self.start | {name: values[name] for name in self._weak if name in values}, 1.0))
        if not all(abs(math.log(now[path] / before)) < WEAK for path, before in self._numbers.items()):
            return False
        pairs = zip(self.family.numbers, self.numbers(values), strict=True)
        if not all((1 - SAME) * nodes[0] <= number <= (1 + SAME) * nodes[-1] for nodes, number in pairs):
            return False
        if self.family.loads.size == 1:
            return True
        loads = self.data.load * self.acts_like_load(values)
        return bool(self.family.loads[0] <= (1 + SAME) * loads.min() and loads.max() <= (1 + SAME) * self.family.loads[-1])

    def off_centre(self, x: Array) -> bool:
        """Whether a vector is so near to where the curves end that others around it are worth their time."""
        low, high = self.bounds()
        some = np.isfinite(low) & np.isfinite(high) & (not self.plain)
        middle, half = (high[some] + low[some]) / 2, (high[some] - low[some]) / 2
        return bool(np.any(np.abs(x[some] - middle) > OFF_CENTRE * half))

    def check(self) -> None:
        """Refuse parameters that cannot be fitted together.

        Raises
        ------
        InputError
            If the friction does not depend on one of them, or the curves cannot follow; see `moved`.
        """
        values = self.first_guess()
        model = replace(self, start=values)
        if not model.plain and np.any(self.data.slide_to_roll != self.data.slide_to_roll[0]):
            raise InputError(
                f"{self.data.source}: with this liquid and substrate the film depends on the slide-to-roll ratio, and the rows "
                "have several; fit those of each alone"
            )
        for name in model._acting:
            other = values | {name: STEP * values[name]}
            told = [(numbers_of(each.problem()), each.problem().parameter) for each in map(model.contact, (values, other))]
            if told[0] == told[1]:
                raise InputError(f"free, {name}: the friction does not depend on it")
            model.moved(other)
        model.moved(values | {name: STEP * values[name] for name in model._acting})

    def friction(self, values: Mapping[str, float], data: Measurements | None = None) -> Array:
        """Friction force [N]."""
        rows = data or self.data
        normalised = self.normalised(values, rows.load, self.beta(values, rows), rows.slide_to_roll)
        return self.unit(values, rows) * normalised + values[OFFSET]

    def normalised(
        self, values: Mapping[str, float], load: ArrayLike, beta: ArrayLike, slide_to_roll: ArrayLike = 2.0
    ) -> Array:
        """Friction over (2π/3) G δ² under loads [N] at values of β."""
        assert self.family is not None
        return self.family.friction(
            np.asarray(load) * self.acts_like_load(values),
            beta,
            numbers=self.numbers(values) if self.family.numbers else (),
            force=self.force,
            slide_to_roll=slide_to_roll,
        )

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
        if "viscosity" not in values and "viscosity" in self.free:
            beta_times_viscosity = self.beta(values | {"viscosity": 1.0})
            normalised = np.abs(self.data.friction) / self.unit(values | {"viscosity": 1.0})
            guesses = beta_times_viscosity * (np.maximum(normalised, 1e-12) / PAPER_FIT[0]) ** (1 / PAPER_FIT[1])
            values["viscosity"] = float(np.median(guesses))
        return values

    def cover(self, values: dict[str, float], region: str | float, progress: Listener | None) -> Model:
        """With load curves around the β of the data, for layer and liquid as they are with some values of the parameters."""
        beta = self.beta(values)
        room = ROOM[self.plain]
        low, high = clipped(float(beta.min()) / room, float(beta.max()) * room)
        if self.family is not None:
            low, high = min(low, self.family.low), max(high, self.family.high)
        # From one round to the next only what the curves cannot follow changes, so that most of them are known.
        weak = {name: values[name] for name in self._weak if name in values}
        start = values if self.family is None else self.start | weak
        if self.family is None and not self.plain:
            start = start | {name: math.exp(COARSE * round(math.log(start[name]) / COARSE)) for name in self._acting}
        model = replace(self, start=dict(start), family=None)
        factor = model.acts_like_load(values)
        shifted = any(
            abs(model.acts_like_load(values | {name: STEP * values[name]}) / factor - 1) > SAME for name in model._acting
        )
        changed = (model.moved(model.start | {name: STEP * model.start[name]})[1] for name in model._acting)
        model = replace(model, varied=tuple(sorted({path for each in changed for path in each})))

        def problem(load: float, *numbers: float) -> Problem:
            return with_numbers(self.problem(model.start, load), dict(zip(model.varied, numbers, strict=True)))

        family = load_family(
            problem,
            self.data.load * factor,
            _half_decade(low, math.floor),
            _half_decade(high, math.ceil),
            spread=SPREAD[model.plain] if shifted else 1.0,
            numbers=[nodes_around(path, number) for path, number in zip(model.varied, model.numbers(values), strict=True)],
            region=region,
            accuracy=ACCURACY[self.plain],
            progress=progress,
        )
        return replace(model, family=family)


def _half_decade(beta: float, rounded: Any) -> float:
    """The next half decade, so that curves over a little more or less are solved at the same β; not for the tiniest shift."""
    return 10 ** (rounded(round(2 * math.log10(beta), 9)) / 2)


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
            known |= {name: value for name, value in known.pop(slot).flat().items() if value is not None}
    indenter = resolve([IndenterPart.slot], known)[IndenterPart.slot]  # once: a measured profile is read from its file
    known |= {name: value for name, value in indenter.flat().items() if value is not None}
    for name, group in (("young_modulus", MODULI), ("viscosity", ("viscosity", "consistency"))):
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
