"""Pictures of curves: a fit against its data (Fig. 13), a Stribeck curve."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from softlube.errors import printable
from softlube.experiments.friction_model import PAPER_FIT
from softlube.files.writing import write_whole
from softlube.physical.roughness import FULL_FILM, MIXED
from softlube.plots.axes import label_logarithmic
from softlube.plots.solution import check_format, image

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from softlube.experiments.fit import Fit

Array = NDArray[np.floating]

STYLE = {
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.grid": True,
    "grid.alpha": 0.25,
    "legend.fontsize": 7,
    "legend.frameon": False,
}
COLOURS = ("#1b6ca8", "#c1432e", "#4c8c4a", "#7a5195", "#b8860b", "#444444")
MARKERS, MARKS = ("o", "s", "^", "D", "v", "X"), 8
"""Marks that tell loads apart without colour, and about how many stand on a curve."""
MOST_DOTS = 20_000
"""Points drawn; more would be a blot, and a file of many megabytes."""


def write(figure: Figure, path: str | os.PathLike[str] | None) -> Figure:
    """Write a picture if a path is given; the picture."""
    if path is not None:
        check_format("plot", path)
        write_whole({path: image(figure, path, dpi=200)})
    return figure


def plot_fit(found: Fit, path: str | os.PathLike[str] | None = None) -> Figure:
    """The data on the load curve, and the residuals along it.

    Parameters
    ----------
    found : Fit
        From `softlube.fit`.
    path : path, optional
        Written to if given (PNG, PDF, SVG by its ending).
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    with rc_context(STYLE):
        figure = Figure(figsize=(7.0, 3.0), layout="constrained")
        collapse, residuals = figure.subplots(1, 2)
        _collapse(collapse, found)
        _residuals(residuals, found)
        estimate = ", ".join(f"{name.replace('_', ' ')} = {e.value:.3g} {e.unit}" for name, e in found.estimates.items())
        source = printable(found.model.data.source)  # a file may be called "$x$.csv"
        figure.suptitle(f"{source}: {estimate}", fontsize=8, parse_math=False)
        return write(figure, path)


def _some(size: int) -> slice:
    return slice(None, None, -(-size // MOST_DOTS))


def _collapse(ax: Axes, found: Fit) -> None:
    family = found.model.family
    assert family is not None
    beta, friction = found.points
    some = _some(beta.size)
    load = 1e3 * found.model.data.load
    dots = ax.scatter(beta[some], friction[some], c=load[some], s=9, cmap="viridis", linewidths=0, zorder=3)
    ax.figure.colorbar(dots, ax=ax, label="load [mN]")
    low, high = max(beta.min() / 2, family.low), min(beta.max() * 2, family.high)
    line = np.geomspace(low, high, 200)
    # Where each load has a curve of its own, those of the lightest and the heaviest.
    loads = np.array([load.min(), load.max()]) / 1e3
    for number, (load_drawn, style) in enumerate(zip(loads[: family.loads.size], ("-", "--"), strict=False)):
        name = "softlube, sliding" if family.loads.size == 1 else f"softlube, {('lightest', 'heaviest')[number]} load"
        ax.plot(line, found.model.normalised(found.values, load_drawn, line), style, color="black", lw=1, label=name)
    ax.plot(line, PAPER_FIT[0] * line ** -PAPER_FIT[1], ":", color="black", lw=1, label="paper, Eq. (28)")
    ax.set(xscale="log", yscale="log", xlabel=r"$\beta$", ylabel=r"$3F/(2\pi G\delta^2)$")
    label_logarithmic(ax)
    ax.legend(loc="lower left")


def _residuals(ax: Axes, found: Fit) -> None:
    some = _some(found.beta.size)
    percent = 100 if found.model.noise == "relative" else 1
    ax.scatter(found.beta[some], percent * found.residuals[some], s=9, linewidths=0, color=COLOURS[0], zorder=3)
    ax.axhline(0, color="black", lw=0.8)
    for side in (-2, 2):
        ax.axhline(side * percent * found.scatter, color="black", lw=0.8, ls=":")
    label = "ln(measured/model) [%]" if percent == 100 else "(measured − model) over median friction"
    ax.set(xscale="log", xlabel=r"$\beta$", ylabel=label)
    label_logarithmic(ax)
    ax.set_title("dotted: twice the scatter", loc="right", fontsize=7)


PARTS = {"viscous": "--", "hysteresis": ":"}
"""Line styles of the parts of the friction."""


def plot_stribeck(table: pandas.DataFrame, path: str | os.PathLike[str] | None = None, *, against: str = "hersey") -> Figure:
    """Friction coefficient and film of `softlube.experiments.stribeck.stribeck_curve`.

    If the substrate remembers, the parts of the friction that the liquid and the substrate make are drawn, too.

    Parameters
    ----------
    table : pandas.DataFrame
        From `stribeck_curve`.
    path : path, optional
        Written to if given (PNG, PDF, SVG by its ending).
    against : {"hersey", "speed"}
        What the curves are drawn against.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    column = "hersey" if against == "hersey" else "entrainment_speed [m/s]"
    label = "Hersey number ηUR/N" if against == "hersey" else "entrainment speed [m/s]"
    rough = "lambda_ratio" in table
    parts = {name: style for name, style in PARTS.items() if f"friction_{name} [N]" in table}
    with rc_context(STYLE):
        figure = Figure(figsize=(7.0, 3.3), layout="constrained")
        friction, film = figure.subplots(1, 2)
        loads = []
        for number, (load, rows) in enumerate(table.groupby("load [N]", sort=False)):
            every = max(len(rows) // MARKS, 1)
            drawn: dict[str, Any] = {"color": COLOURS[number % len(COLOURS)], "marker": MARKERS[number % len(MARKERS)]}
            drawn |= {"ms": 3.5, "mfc": "white", "mew": 0.8, "lw": 1.2}
            loads.append(Line2D([], [], label=f"{1e3 * float(str(load)):.4g} mN", **drawn))
            drawn |= {"markevery": (number % every, every)}
            ratio = np.asarray(rows["lambda_ratio"] if rough else np.where(np.isfinite(rows[column]), np.inf, np.nan))
            for axes, style, values in (
                (friction, "-", np.abs(rows["friction_coefficient"])),
                (film, "-", 1e9 * rows["film_center [m]"]),
                (film, "--", 1e9 * rows["film_min [m]"]),
                *((friction, each, np.abs(rows[f"friction_{name} [N]"]) / rows["load [N]"]) for name, each in parts.items()),
            ):
                _in_regimes(axes, np.asarray(rows[column]), np.asarray(values), ratio, style, drawn)
        friction.set(xscale="log", yscale="log", xlabel=label, ylabel="friction coefficient (magnitude)")
        film.set(xscale="log", yscale="log", xlabel=label, ylabel="film [nm]")
        films = [Line2D([], [], color="black", ls=style, label=name) for style, name in (("-", "centre"), ("--", "minimum"))]
        if rough:
            heights = 1e9 * (table["film_min [m]"] / table["lambda_ratio"])
            films += _roughness(film, float(heights.dropna().iloc[0]))
        film.legend(handles=films, loc="upper left")
        friction.legend(handles=loads + [Line2D([], [], color="black", ls=style, label=name) for name, style in parts.items()])
        for axes in (friction, film):
            label_logarithmic(axes)
        return write(figure, path)


def _in_regimes(ax: Axes, x: Array, y: Array, ratio: Array, style: str, drawn: dict[str, Any]) -> None:
    """A curve with marks: in its colour where there is a full film, grey below, light grey for λ < 1."""
    kind = np.digitize(ratio, (MIXED, FULL_FILM))
    between = np.minimum(kind[:-1], kind[1:])
    for number, grey in enumerate(("0.75", "0.55", "")):
        ends = np.append(between == number, False) | np.append(False, between == number)
        if ends.any():
            look: dict[str, Any] = drawn | ({"color": grey} if grey else {})
            ax.plot(x, np.where(ends, y, np.nan), style, **look)


def _roughness(ax: Axes, height: float) -> list[Any]:
    """Where films are thinner than the roughness [nm], and where full films begin; gives what the legend needs of it."""
    from matplotlib.patches import Patch

    low, high = ax.get_ylim()
    found: list[Any] = []
    if low < FULL_FILM * height < high:
        found.append(ax.axhline(FULL_FILM * height, color="0.5", lw=0.8, ls=":", label=f"λ = {FULL_FILM:g}: full film above"))
    if low < MIXED * height:
        ax.axhspan(low, MIXED * height, color="0.93", lw=0, zorder=0)
        found.append(Patch(color="0.93", label=f"λ < {MIXED:g}: the surfaces touch"))
    ax.set_ylim(low, high)
    return found
