"""Picture of a line contact: film and pressure along x."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from softlube.model.prefixes import prefixed

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from softlube.steady.line.solution import LineSolution

ENDS = (-1.6, 2.2)
"""Where the picture ends, over half the width of the dry contact; under a thick film, over the width of the pressure."""


def draw(solution: LineSolution, axes: Axes, film_colour: str, pressure_colour: str) -> None:
    """Draw film and pressure, with the pressure of the dry contact of a half-space dotted.

    Parameters
    ----------
    solution : LineSolution
        Physical or dimensionless; the axes follow.
    axes : Axes
        Where to draw.
    film_colour, pressure_colour : str
        Colours of the curves and of their axes.
    """
    table = solution.profile()
    place, film, pressure = (table.iloc[:, k].to_numpy() for k in range(3))
    contact = solution.contact
    labels = ["x/b", "film / (b²/R)", "pressure / (4πG b/R)"]
    unit = 1.0 if contact is None else contact.unit_length
    hertz = (1.0 if contact is None else contact.scales(contact.unit_height)["pressure"][0]) / (2 * np.pi)
    width = unit * max(1.0, -1.2 * solution.fields.front)
    shown = (place > ENDS[0] * width) & (place < ENDS[1] * width)
    place, film, pressure = place[shown], film[shown], pressure[shown]
    if contact is not None:
        scaled = []
        for values, symbol, name in ((place, "m", "x"), (film, "m", "film"), (pressure, "Pa", "pressure")):
            factor, prefix = prefixed(float(np.max(np.abs(values))), symbol)
            scaled.append((values * factor, f"{name} [{prefix}]", factor))
        (place, labels[0], along), (film, labels[1], _), (pressure, labels[2], up) = scaled
        unit, hertz = unit * along, hertz * up
    center = float(np.interp(0.0, place, film))
    axes.plot(place, film, color=film_colour)
    axes.set(xlabel=labels[0], xlim=(place[0], place[-1]), ylim=(0, 3.5 * center))
    axes.set_ylabel(labels[1], color=film_colour)
    axes.tick_params(axis="y", colors=film_colour)
    other = axes.twinx()
    other.plot(place, pressure, color=pressure_colour)
    dry = np.linspace(-1, 1, 201)
    other.plot(dry * unit, hertz * np.sqrt(1 - dry**2), ":", color="0.35", lw=0.9, label="Hertz")
    other.legend(loc="upper right", frameon=False)
    other.set_ylabel(labels[2], color=pressure_colour)
    other.tick_params(axis="y", colors=pressure_colour)
    if solution.problem.cavitation == "reynolds":
        other.set_ylim(0, 1.15 * max(float(np.max(pressure)), hertz))
