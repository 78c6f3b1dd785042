"""Squeeze films and starts of sliding as a room of the sweep."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any, ClassVar

from softlube.errors import InputError, shown
from softlube.files.histories import read_history
from softlube.model import liquids, substrates
from softlube.model.motions import Sliding
from softlube.model.quantities import QUANTITIES, Quantity, header
from softlube.physical.inputs import SLIDING_BODIES, Approach, StartOfSliding, names_of
from softlube.physical.sliding import read_sliding
from softlube.physical.squeeze import WRITTEN_WAYS, History, Setup, check_one_way, read_motion
from softlube.sweeps.tasks import Outcome, Value
from softlube.transient.extremes import Extremes
from softlube.transient.history import Transient
from softlube.transient.motion import Motion
from softlube.transient.sliding import result as sliding
from softlube.transient.squeeze import result as squeezing

DIGITS = 12
"""Digits of the normalised motion that count: cases that differ by rounding only are solved once."""


@dataclass(frozen=True)
class SqueezeTask:
    """A normalised motion without sliding.

    Attributes
    ----------
    motion : mapping
        See `softlube.transient.motion.Motion.to_plain`.
    bodies : mapping
        The motion's "substrate" and "liquid" as objects: a worker may not know the name of one that the caller's code defines.
    film_limit : float
    """

    kind: ClassVar[str] = "squeeze"
    motion: Mapping[str, Any]
    bodies: Mapping[str, Any]
    film_limit: float

    @property
    def place(self) -> tuple[float, ...]:
        """Grids follow the height at the start and the duration."""
        return self.motion["initial_height"], self.motion["duration"]

    def to_plain(self) -> dict[str, Any]:
        """Its attributes; the motion names the bodies."""
        return {"motion": dict(self.motion), "film_limit": self.film_limit}

    def solve(self, accuracy: float, with_fields: bool) -> Outcome:
        """See `softlube.transient.squeeze.result.follow`."""
        film = squeezing.follow(_motion(self), accuracy=accuracy, film_limit=self.film_limit)
        facts = {"ended_by": film.run.ended_by, "dimple_time": film.dimple_time}
        return _outcome(film, facts, with_fields)


@dataclass(frozen=True)
class SlidingTask:
    """A normalised motion with sliding from time 0 on.

    Attributes
    ----------
    motion : mapping
        See `softlube.transient.motion.Motion.to_plain`.
    bodies : mapping
        The motion's "substrate" and "liquid" as objects: a worker may not know the name of one that the caller's code defines.
    sliding : mapping
        Arguments of `softlube.transient.sliding.result.follow_sliding`.
    film_limit : float
    """

    kind: ClassVar[str] = "sliding"
    motion: Mapping[str, Any]
    bodies: Mapping[str, Any]
    sliding: Mapping[str, Any]
    film_limit: float

    @property
    def place(self) -> tuple[float, ...]:
        """The grids of the steady solver follow β."""
        return self.sliding["beta"], self.motion["initial_height"], self.motion["duration"]

    def to_plain(self) -> dict[str, Any]:
        """Its attributes; the motion names the bodies."""
        return {"motion": dict(self.motion), "sliding": dict(self.sliding), "film_limit": self.film_limit}

    def solve(self, accuracy: float, with_fields: bool) -> Outcome:
        """See `softlube.transient.sliding.result.follow_sliding`."""
        start = sliding.follow_sliding(_motion(self), **self.sliding, film_limit=self.film_limit, accuracy=accuracy)
        return _outcome(start, {"ended_by": start.run.ended_by}, with_fields)


def _motion(task: SqueezeTask | SlidingTask) -> Motion:
    return replace(Motion.from_plain({**task.motion, **dict.fromkeys(task.bodies)}), **task.bodies)


def _outcome(result: Transient, facts: Mapping[str, Value], with_fields: bool) -> Outcome:
    """When and why a normalised motion ended, and its last values."""
    from softlube.files.transient import contents

    facts = {**facts, **asdict(result.extremes)}
    final = {"end_time": Quantity(float(result.time[-1]), result.time_error)} | result.final
    return Outcome(
        quantities={name: (float(quantity), quantity.error) for name, quantity in final.items()},
        facts=facts,
        fields=contents(result) if with_fields else None,
    )


@dataclass(frozen=True)
class ApproachCase:
    """A sphere that comes down or goes up, and may slide.

    Attributes
    ----------
    inputs : mapping of str to float or str
        Arguments of `softlube.squeeze` or `softlube.slide` in SI.
    task : SqueezeTask or SlidingTask
        Normalised, rounded to `DIGITS` digits.
    setup : Setup
        What it is normalised with.
    sliding : mapping of str to object
        See `softlube.transient.history.Transient`; empty without sliding.
    """

    inputs: Mapping[str, Value]
    task: SqueezeTask | SlidingTask
    setup: Setup
    sliding: Mapping[str, Any]

    def numbers(self, outcome: Outcome) -> dict[str, Value]:
        """Warnings, why and when it ended, the last values with their errors, and since when there is a dimple, in SI."""
        if outcome.failed:
            return {}
        scales = {kind: scale for kind, (scale, _) in self.setup.units.items()}
        extremes = Extremes(**{each.name: float(outcome.facts[each.name]) for each in fields(Extremes)})
        doubts = self.setup.doubts(extremes.scaled(scales["height"], scales["pressure"], scales["time"]))
        row: dict[str, Value] = {"warnings": "; ".join(doubts), "ended_by": outcome.facts["ended_by"]}
        for name, (value, error) in outcome.quantities.items():
            scale, unit = self.setup.units[QUANTITIES[name].dimension]
            row[header(name, unit)] = value * scale
            row[header(name, unit, error=True)] = error * scale
        if row["ended_by"] == "duration":
            row["end_time [s]"] = self.setup.duration  # as given, not as rounded to be normalised
        if "dimple_time" in outcome.facts:
            scale, unit = self.setup.units[QUANTITIES["dimple_time"].dimension]
            row[header("dimple_time", unit)] = float(outcome.facts["dimple_time"]) * scale
        return row

    def write(self, fields: bytes, path: Path) -> None:
        """Write the file that the case's own `save` would write."""
        from softlube.files.transient import in_units, load
        from softlube.files.writing import netcdf, write_whole

        write_whole({path: netcdf(in_units(load(fields), self.setup, self.sliding))})


class Approaches:
    """Squeeze films; with a speed, starts of sliding.

    Parameters
    ----------
    folder : Path
        Where the histories' files are.
    """

    what: ClassVar[str] = "a squeeze film"
    needs: ClassVar[str] = "radius, viscosity, …, and one of load, approach_speed and history"

    @property
    def parameters(self) -> tuple[str, ...]:
        """Inputs of `softlube.squeeze` and of `softlube.slide`."""
        return tuple(names_of(SLIDING_BODIES, Approach, StartOfSliding))

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._histories: dict[str, History] = {}

    @property
    def sources(self) -> tuple[Path, ...]:
        """The histories' files."""
        return tuple(self._folder / name for name in self._histories)

    def accuracy(self, given: float | None, names: Iterable[str]) -> float:
        """See `softlube.squeeze` and `softlube.slide`."""
        usual, ladder = (2e-2, sliding) if "speed" in names else (1e-3, squeezing)
        finest, coarsest = ladder.FINEST_ACCURACY, ladder.COARSEST_ACCURACY
        accuracy = usual if given is None else given
        if isinstance(accuracy, bool) or not isinstance(accuracy, (int, float)) or not finest <= accuracy <= coarsest:
            sort = self.what if ladder is squeezing else "a start of sliding"
            raise InputError(f"accuracy: expected a number from {finest:g} to {coarsest:g} for {sort}, got {shown(accuracy)}")
        return float(accuracy)

    def prepare(self, inputs: Mapping[str, Value]) -> None:
        """Read a history: what it says, not its name, decides on the case."""
        name = inputs.get("history")
        if isinstance(name, str) and name not in self._histories:
            self._histories[name] = read_history(self._folder / name)

    def case(self, inputs: Mapping[str, Value]) -> ApproachCase:
        """The inputs together as `softlube.squeeze` takes them, or `slide` with a speed."""
        sliding = names_of([Sliding.slot], StartOfSliding)
        slides = {name: inputs[name] for name in sliding if name in inputs}
        if slides and not slides.keys() & names_of([Sliding.slot]).keys():
            raise InputError(f"{next(iter(slides))}: only a start of sliding has it; give a speed or leave it out")
        check_one_way(inputs, WRITTEN_WAYS)
        course = self._histories.get(str(inputs.get("history")))
        setup, motion = read_motion({**inputs, "history": course})
        plain, limit = _rounded(motion.to_plain()), _rounded(setup.film_limit / setup.unit_height)
        bodies = {"substrate": substrates.from_plain(plain["substrate"]), "liquid": liquids.from_plain(plain["liquid"])}
        if not slides:
            return ApproachCase(dict(inputs), SqueezeTask(plain, bodies, limit), setup, {})
        told, normalised = read_sliding(setup, slides)
        return ApproachCase(dict(inputs), SlidingTask(plain, bodies, _rounded(normalised), limit), setup, told)


def _rounded(plain: Any) -> Any:
    """Plain values with all numbers to `DIGITS` digits."""
    if isinstance(plain, float):
        return float(f"{plain:.{DIGITS}g}")
    if isinstance(plain, Mapping):
        return {name: _rounded(value) for name, value in plain.items()}
    return [_rounded(value) for value in plain] if isinstance(plain, (list, tuple)) else plain
