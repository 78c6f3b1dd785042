"""The picture of a squeeze film: profiles at some times, and the histories."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from softlube.physical.units import prefixed
from softlube.plots.solution import FILM_COLOUR, PRESSURE_COLOUR, STYLE, check_format

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from softlube.physical.sliding import Slide
    from softlube.transient.squeeze.result import Squeeze

Array = NDArray[np.floating]

PROFILES = 7
WIDTH = 1.6
"""Radius of the profiles, over that of the grid's edge."""


def _prefix(largest: float, unit: str) -> tuple[float, str]:
    """Factor and label of the SI prefix that suits the largest value."""
    if not unit:
        return 1.0, ""
    factor, prefixed_unit = prefixed(largest, unit, below=2e3)
    return factor, f" [{prefixed_unit}]"


def _chosen(time: Array, film_center: Array) -> NDArray[np.intp]:
    """Steps whose profiles tell the story: evenly spaced in the logarithm of the film at the centre, or in time."""
    course = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(np.log(film_center))))])
    if course[-1] < 0.1:
        course = time
    return np.unique(np.searchsorted(course, np.linspace(0, course[-1], PROFILES)).clip(max=course.size - 1))


def picture(result: Squeeze, path: str | os.PathLike[str] | None = None) -> Figure:
    """Draw film and pressure profiles over time, and films, pressure, height and load against time.

    Parameters
    ----------
    result : Squeeze
        What to draw.
    path : path-like, optional
        Where to write the picture (.png, .pdf or .svg).
    """
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    if path is not None:
        check_format("plot", path)
    chosen = _chosen(result.run.time, result.histories["film_center"])
    grid = result.run.film.grid
    length, length_label = _prefix(WIDTH * grid.edge * result.scale("length")[0], result.scale("length")[1])
    film, film_label = _prefix(float(result.history("film_center").max()), result.scale("height")[1])
    pressure, pressure_label = _prefix(float(np.abs(result.pressure).max()), result.scale("pressure")[1])
    clock, clock_label = _prefix(float(result.time[-1]), result.scale("time")[1])
    fine = np.linspace(0, WIDTH * grid.edge, 600)
    place = fine * result.scale("length")[0] * length
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.9, 5.4), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots(2, 2)
        colours = mpl.colormaps["viridis"](np.linspace(0, 0.9, chosen.size))
        xi = np.concatenate([-grid.xi[2::-1], grid.xi])
        for step, colour in zip(chosen, colours, strict=True):
            label = _instant(float(result.time[step]), clock, clock_label)
            for ax, values, scale in ((axes[0, 0], result.film, film), (axes[0, 1], result.pressure, pressure)):
                even = np.concatenate([values[step, 2::-1], values[step]])
                ax.plot(place, CubicSpline(xi, even)(grid.xi_of(fine)) * scale, color=colour, label=label)
        axes[0, 0].set(xlabel=f"$r${length_label}", ylabel=f"film $u${film_label}", yscale="log", xlim=(0, place[-1]))
        axes[0, 1].set(xlabel=f"$r${length_label}", ylabel=f"pressure $p${pressure_label}", xlim=(0, place[-1]))
        axes[0, 1].legend(title="time", frameon=False)

        # A logarithmic axis where the approach slows down, as under a load; the start itself is then left out.
        slowing = result.run.motion.control == "load" and result.time[-1] > 1e3 * result.time[1]
        begin = int(np.argmax(result.histories["film_center"] < 0.9 * result.histories["film_center"][0])) if slowing else 0
        time = result.time[begin:] * clock

        def shown(name: str, scale: float) -> Array:
            return result.history(name)[begin:] * scale

        left, right = axes[1]
        left.plot(time, shown("film_center", film), color=FILM_COLOUR, label="at the centre")
        left.plot(time, shown("film_min", film), "--", color=FILM_COLOUR, label="minimum")
        if not np.isnan(result.dimple_time):
            left.axvline(result.dimple_time * clock, color="0.6", lw=0.7, ls=":")
        left.set(xlabel=f"time{clock_label}", ylabel=f"film $u${film_label}", yscale="log")
        left.legend(frameon=False)
        right.plot(time, shown("pressure_center", pressure), color=PRESSURE_COLOUR)
        right.set(xlabel=f"time{clock_label}")
        right.set_ylabel(f"pressure at the centre{pressure_label}", color=PRESSURE_COLOUR)
        other = right.twinx()
        name = "height" if result.run.motion.control == "load" else "load"
        kind = result.scale(name)
        scale, label = _prefix(float(np.abs(result.history(name)[begin:]).max()), kind[1])
        other.plot(time, shown(name, scale), color="0.35")
        other.set_ylabel(f"{'height $h_0$' if name == 'height' else 'load'}{label}", color="0.35")
        if slowing:
            for ax in (left, right):
                ax.set_xscale("log")
        _finish(figure, axes, path)
    return figure


def _instant(time: float, clock: float, label: str) -> str:
    """A time with its unit."""
    return " ".join([f"{time * clock:.3g}", *label.strip(" []").split()])


def _finish(figure: Figure, axes: Any, path: str | os.PathLike[str] | None) -> None:
    """Letters on the axes, and the file."""
    for label, ax in zip("abcd", axes.flat, strict=True):
        ax.set_title(f"({label})", loc="left")
    if path is not None:
        from softlube.files.writing import check_destination, whole_file

        with whole_file(check_destination("plot", path)) as temporary:
            figure.savefig(temporary)


def sliding_picture(result: Slide, path: str | os.PathLike[str] | None = None) -> Figure:
    """Draw film and pressure along the direction of sliding over time, and films, friction, height and load against time.

    Parameters
    ----------
    result : Slide
        What to draw.
    path : path-like, optional
        Where to write the picture (.png, .pdf or .svg).
    """
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    if path is not None:
        check_format("plot", path)
    histories = result.histories
    units = {kind: result.scale(kind) for kind in ("time", "length", "height", "pressure", "load", "friction")}
    width = WIDTH * max(1.0, float(np.sqrt(max(-result.values["height"].min(), 0))))
    r = np.linspace(0, width, 300)
    x = np.concatenate([-r[:0:-1], r])
    length, length_label = _prefix(width * units["length"][0], units["length"][1])
    film, film_label = _prefix(float(histories["film_center"].max()), units["height"][1])
    pressure, pressure_label = _prefix(float(histories["pressure_max"].max()), units["pressure"][1])
    friction, friction_label = _prefix(float(np.abs(histories["friction_domain"]).max()), units["friction"][1])
    clock, clock_label = _prefix(float(result.time[-1]), units["time"][1])
    chosen = _chosen(result.time, histories["film_center"])
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.9, 5.4), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots(2, 2)
        for step, colour in zip(chosen, mpl.colormaps["viridis"](np.linspace(0, 0.9, chosen.size)), strict=True):
            fields, label = result.run.fields[step], _instant(float(result.time[step]), clock, clock_label)
            for ax, along, scale in (
                (axes[0, 0], fields.film_at, units["height"][0] * film),
                (axes[0, 1], fields.pressure_at, units["pressure"][0] * pressure),
            ):
                # The inlet is at x > 0.
                values = np.concatenate([along(r[:0:-1], np.pi), along(r, 0.0)])
                ax.plot(x * units["length"][0] * length, values * scale, color=colour, label=label)
        axes[0, 0].set(xlabel=f"$x${length_label}", ylabel=f"film $u${film_label}", yscale="log")
        axes[0, 1].set(xlabel=f"$x${length_label}", ylabel=f"pressure $p${pressure_label}")
        axes[0, 1].legend(title="time", frameon=False)
        left, right = axes[1]
        time = result.time * clock
        left.plot(time, histories["film_center"] * film, color=FILM_COLOUR, label="at the centre")
        left.plot(time, histories["film_min"] * film, "--", color=FILM_COLOUR, label="minimum")
        left.set(xlabel=f"time{clock_label}", ylabel=f"film $u${film_label}", yscale="log")
        left.legend(frameon=False)
        right.plot(time, histories["friction_domain"] * friction, color=PRESSURE_COLOUR)
        right.set(xlabel=f"time{clock_label}")
        right.set_ylabel(f"friction over $r \\leq 2a${friction_label}", color=PRESSURE_COLOUR)
        other = right.twinx()
        name, text = ("height", "height $h_0$") if result.motion.control == "load" else ("load", "load")
        scale, label = _prefix(float(np.abs(histories[name]).max()), units[name][1])
        other.plot(time, histories[name] * scale, color="0.35")
        other.set_ylabel(f"{text}{label}", color="0.35")
        _finish(figure, axes, path)
    return figure
