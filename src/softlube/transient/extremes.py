"""Extremes of a film in time, which the warnings about its physics depend on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating]


@dataclass(frozen=True)
class Extremes:
    """Extremes of a film in time, in any units.

    Attributes
    ----------
    least_height : float
        Lowest height h₀ of the sphere's lowest point over the undeformed surface.
    least_pressure, largest_pressure : float
        Over all places and times.
    largest_speed : float
        Largest speed of approach or separation, |dh₀/dt|.
    largest_film : float
        Largest film thickness at the centre.
    """

    least_height: float
    least_pressure: float
    largest_pressure: float
    largest_speed: float
    largest_film: float

    @classmethod
    def of(cls, time: Array, histories: Mapping[str, Array], pressure: Array) -> Extremes:
        """Extremes of a film in time.

        Parameters
        ----------
        time : ndarray, shape (k,)
            Times of the steps.
        histories : mapping of str to ndarray, shape (k,)
            "height", "film_center" and "pressure_max"; also "pressure_min" where that was found between the nodes.
        pressure : ndarray
            Pressure on the nodes at every step, for its minimum where no history of it is given.
        """
        height = histories["height"]
        return cls(
            least_height=float(height.min()),
            least_pressure=float(histories.get("pressure_min", pressure).min()),
            largest_pressure=float(histories["pressure_max"].max()),
            largest_speed=float(np.max(np.abs(np.diff(height) / np.diff(time)))),
            largest_film=float(histories["film_center"].max()),
        )

    def scaled(self, height: float, pressure: float, time: float) -> Extremes:
        """The extremes in other units, given the factors of heights, pressures and times."""
        return Extremes(
            self.least_height * height,
            self.least_pressure * pressure,
            self.largest_pressure * pressure,
            self.largest_speed * height / time,
            self.largest_film * height,
        )
