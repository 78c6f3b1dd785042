"""What a motion came to at most: all that the doubts about it go by."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating]


@dataclass(frozen=True)
class Extremes:
    """Extremes of the histories of a motion, in any units.

    Attributes
    ----------
    least_height : float
    least_pressure, largest_pressure : float
    largest_speed : float
        Of approach or separation.
    largest_film : float
        At the centre.
    """

    least_height: float
    least_pressure: float
    largest_pressure: float
    largest_speed: float
    largest_film: float

    @classmethod
    def of(cls, time: Array, history: Callable[[str], Array]) -> Extremes:
        """From "height", "film_center", "pressure_min" and "pressure_max" at some times."""
        return cls(
            least_height=float(history("height").min()),
            least_pressure=float(history("pressure_min").min()),
            largest_pressure=float(history("pressure_max").max()),
            largest_speed=float(np.max(np.abs(np.diff(history("height")) / np.diff(time)))),
            largest_film=float(history("film_center").max()),
        )

    def scaled(self, height: float, pressure: float, time: float) -> Extremes:
        """In other units, given their scales."""
        return Extremes(
            self.least_height * height,
            self.least_pressure * pressure,
            self.largest_pressure * pressure,
            self.largest_speed * height / time,
            self.largest_film * height,
        )
