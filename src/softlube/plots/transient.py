"""The picture of a squeeze film or of a start of sliding: profiles at some times, and histories."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from softlube.files.writing import check_destination, write_whole
from softlube.model.prefixes import prefixed
from softlube.plots.axes import label_logarithmic
from softlube.plots.solution import FILM_COLOUR, PRESSURE_COLOUR, STYLE, check_format, image
from softlube.transient.sliding.result import Slide
from softlube.transient.squeeze.result import Squeeze

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from softlube.transient.history import Transient

Array = NDArray[np.floating]

PROFILES = 7
"""Number of times at which profiles are drawn, at most."""
WIDTH = 1.6
"""Largest distance from the axis in the profiles, over the contact radius."""
SLOWING = 1e3
"""Duration over the first time step above which a squeeze film under a load has a logarithmic time axis."""


@dataclass(frozen=True)
class Profiles:
    """Lines through the contact along which film and pressure are drawn, normalised.

    Attributes
    ----------
    place : ndarray
        Places along the line.
    film, pressure : callable
        Film and pressure there at the step of a number.
    symbol : str
        Symbol of the place, for the axis labels.
    course, course_label : str
        Name of the history that is drawn besides height or load, and its axis label.
    """

    place: Array
    film: Callable[[int], Array]
    pressure: Callable[[int], Array]
    symbol: str
    course: str
    course_label: str


def _across(result: Squeeze) -> Profiles:
    """Profiles from the axis outwards."""
    grid, run = result.run.film.grid, result.run
    place = np.linspace(0, WIDTH * grid.edge, 600)
    xi = np.concatenate([-grid.xi[2::-1], grid.xi])

    def along(values: Array) -> Array:
        return CubicSpline(xi, np.concatenate([values[2::-1], values]))(grid.xi_of(place))

    return Profiles(
        place,
        lambda step: along(run.films[step]),
        lambda step: along(run.pressures[step]),
        "r",
        "pressure_center",
        "pressure at the centre",
    )


def _along(result: Slide) -> Profiles:
    """Profiles along the direction of sliding; the inlet is at x > 0."""
    fields = result.run.fields
    r = np.linspace(0, WIDTH * max(1.0, float(np.sqrt(max(-result.values["height"].min(), 0)))), 300)

    def along(at: Callable[[Array, float], Array]) -> Array:
        return np.concatenate([at(r[:0:-1], np.pi), at(r, 0.0)])

    return Profiles(
        np.concatenate([-r[:0:-1], r]),
        lambda step: along(fields[step].film_at),
        lambda step: along(fields[step].pressure_at),
        "x",
        "friction_total",
        "total friction over $r \\leq 2a$",
    )


def _prefix(largest: float, unit: str) -> tuple[float, str]:
    """Factor and axis label of the SI prefix that suits the largest value; 1 and "" without a unit."""
    if not unit:
        return 1.0, ""
    factor, prefixed_unit = prefixed(largest, unit, below=2e3)
    return factor, f" [{prefixed_unit}]"


def _chosen(time: Array, film_center: Array) -> NDArray[np.intp]:
    """Steps whose profiles are drawn: evenly spaced in the logarithm of the film at the centre, or in time where it rests."""
    course = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(np.log(film_center))))])
    if course[-1] < 0.1:
        course = time
    return np.unique(np.searchsorted(course, np.linspace(0, course[-1], PROFILES)).clip(max=course.size - 1))


def _instant(time: float, clock: float, label: str) -> str:
    """A time with its unit."""
    digits = f"{time * clock:.3g}"
    return " ".join([f"{float(digits):g}", *label.strip(" []").split()])


def picture(result: Transient, path: str | os.PathLike[str] | None = None) -> Figure:
    """Draw film and pressure profiles at some times; below them films, pressure or friction, and height or load against time.

    A squeeze film is drawn from the axis outwards, a start of sliding along the direction of sliding.

    Parameters
    ----------
    result : Transient
        A squeeze film or a start of sliding.
    path : path-like, optional
        Where to write the picture (.png, .pdf or .svg).

    Raises
    ------
    InputError
        If the path has another ending, or its folder does not exist.
    """
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    if path is not None:
        check_format("plot", path)
    profiles = _across(result) if isinstance(result, Squeeze) else _along(cast("Slide", result))
    histories, by_load = result.histories, result.motion.control == "load"
    other = "height" if by_load else "load"
    scales = {kind: result.scale(kind) for kind in ("time", "length", "height", "pressure", "load", "friction")}
    length, length_label = _prefix(float(profiles.place[-1]) * scales["length"][0], scales["length"][1])
    film, film_label = _prefix(float(histories["film_center"].max()), scales["height"][1])
    pressure, pressure_label = _prefix(float(np.abs(result.pressure).max()), scales["pressure"][1])
    clock, clock_label = _prefix(float(result.time[-1]), scales["time"][1])
    chosen = _chosen(result.run.time, result.values["film_center"])
    place = profiles.place * scales["length"][0] * length

    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.9, 5.4), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots(2, 2)
        for step, colour in zip(chosen.tolist(), mpl.colormaps["viridis"](np.linspace(0, 0.9, chosen.size)), strict=True):
            label = _instant(float(result.time[step]), clock, clock_label)
            axes[0, 0].plot(place, profiles.film(step) * scales["height"][0] * film, color=colour, label=label)
            axes[0, 1].plot(place, profiles.pressure(step) * scales["pressure"][0] * pressure, color=colour, label=label)
        ends = {"xlim": (place[0], place[-1])} if profiles.symbol == "r" else {}
        axes[0, 0].set(xlabel=f"${profiles.symbol}${length_label}", ylabel=f"film $u${film_label}", yscale="log", **ends)
        axes[0, 1].set(xlabel=f"${profiles.symbol}${length_label}", ylabel=f"pressure $p${pressure_label}", **ends)
        axes[0, 1].legend(title="time", frameon=False)

        # A squeeze film under a load slows down: its time axis is logarithmic, and the start itself is left out.
        slowing = isinstance(result, Squeeze) and by_load and result.time[-1] > SLOWING * result.time[1]
        begin = int(np.argmax(histories["film_center"] < 0.9 * histories["film_center"][0])) if slowing else 0
        time = result.time[begin:] * clock
        left, right = axes[1]
        left.plot(time, histories["film_center"][begin:] * film, color=FILM_COLOUR, label="at the centre")
        left.plot(time, histories["film_min"][begin:] * film, "--", color=FILM_COLOUR, label="minimum")
        if isinstance(result, Squeeze) and not np.isnan(result.dimple_time):
            left.axvline(result.dimple_time * clock, color="0.6", lw=0.7, ls=":", label="birth of the dimple")
        left.set(xlabel=f"time{clock_label}", ylabel=f"film $u${film_label}", yscale="log")
        left.legend(frameon=False)
        scale, label = pressure, pressure_label
        if profiles.course == "friction_total":
            scale, label = _prefix(float(np.abs(histories[profiles.course]).max()), scales["friction"][1])
        right.plot(time, histories[profiles.course][begin:] * scale, color=PRESSURE_COLOUR)
        right.set(xlabel=f"time{clock_label}")
        right.set_ylabel(f"{profiles.course_label}{label}", color=PRESSURE_COLOUR)
        twin = right.twinx()
        scale, label = _prefix(float(np.abs(histories[other][begin:]).max()), scales[other][1])
        twin.plot(time, histories[other][begin:] * scale, color="0.35")
        twin.set_ylabel(f"{'height $h_0$' if other == 'height' else 'load'}{label}", color="0.35")
        if slowing:
            for ax in (left, right):
                ax.set_xscale("log")
        for letter, ax in zip("abcd", axes.flat, strict=True):
            ax.set_title(f"({letter})", loc="left")
            label_logarithmic(ax)
        if path is not None:
            write_whole({check_destination("plot", path): image(figure, path)})
    return figure
