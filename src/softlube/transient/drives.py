"""How a load or a height depends on time, where that can be written down: constant, steadily falling, through points."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from softlube.errors import InputError

Array = NDArray[np.floating]


@dataclass(frozen=True)
class Constant:
    """The same value at all times."""

    kind: ClassVar[str] = "constant"
    value: float

    def __call__(self, time: float) -> float:
        return self.value

    def at(self, times: Array) -> Array:
        """Values at an array of times."""
        return np.full(times.shape, self.value)


@dataclass(frozen=True)
class Descent:
    """A height that falls at a constant speed; rises at a negative one."""

    kind: ClassVar[str] = "descent"
    start: float
    speed: float

    def __call__(self, time: float) -> float:
        return self.start - self.speed * time

    def at(self, times: Array) -> Array:
        """Values at an array of times."""
        return self.start - self.speed * times


@dataclass(frozen=True)
class Points:
    """Values at some times, joined by a monotone cubic interpolant that makes no extremes of its own."""

    kind: ClassVar[str] = "points"
    time: tuple[float, ...]
    values: tuple[float, ...]

    @cached_property
    def _curve(self) -> PchipInterpolator:
        return PchipInterpolator(self.time, self.values)

    def __call__(self, time: float) -> float:
        return float(self._curve(time))

    def at(self, times: Array) -> Array:
        """Values at an array of times."""
        return self._curve(times)


KINDS: dict[str, type[Constant] | type[Descent] | type[Points]] = {cls.kind: cls for cls in (Constant, Descent, Points)}
"""Classes of drives by their names in files."""


def sampled(drive: Callable[[float], float], times: Array) -> Array:
    """Values of a drive, or of any other function of the time, at an array of times."""
    if isinstance(drive, (Constant, Descent, Points)):
        return drive.at(times)  # a plan of many cases looks at each
    return np.array([float(drive(t)) for t in times])


def to_plain(drive: Callable[[float], float]) -> dict[str, Any]:
    """A drive in plain values, for files.

    Raises
    ------
    InputError
        If it is a function of the time that is none of `KINDS`.
    """
    if not isinstance(drive, (Constant, Descent, Points)):
        raise InputError("history: a function of the time cannot be written down; expected a constant or a table of points")
    return {"kind": drive.kind} | asdict(drive)


def from_plain(values: Mapping[str, Any]) -> Constant | Descent | Points:
    """The drive that `to_plain` wrote."""
    arguments: dict[str, Any] = {
        name: tuple(value) if isinstance(value, (list, tuple)) else value for name, value in values.items()
    }
    return KINDS[arguments.pop("kind")](**arguments)
