"""Pictures of a steady solution (film, pressure, mid-plane), and of quantities against β."""

from __future__ import annotations

import io
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from softlube.errors import InputError
from softlube.model.dry import PARABOLOID, DryContact
from softlube.model.prefixes import prefixed
from softlube.model.quantities import FIELDS, QUANTITIES
from softlube.model.substrates import HalfSpaceKernel
from softlube.physical.roughness import FULL_FILM
from softlube.plots.axes import label_logarithmic
from softlube.plots.line import draw
from softlube.plots.spike import INNERMOST, Ridge, ridge
from softlube.steady.regime import Regime
from softlube.steady.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from softlube.experiments.adaptive import Interpolant
    from softlube.steady.line.solution import LineSolution
    from softlube.theory.master_curve import Curve

MAP_RADIUS, PROFILE_RADIUS = 1.4, 2.0
"""Half the side of the maps and half the length of the profiles, over the dry contact's radius; more under a thick film."""
FILM_COLOUR, PRESSURE_COLOUR = "#0072B2", "#D55E00"  # Okabe & Ito, safe for colour-blind readers
OVER = "#56B4E9"  # Okabe & Ito, too
LONG = 40
"""Characters of a legend above a map from which on it is set smaller."""
RAYS = 241
"""Rays from the axis, over half a turn, on which a pressure with a spike is drawn."""
STYLE = {
    "font.size": 8,
    "axes.labelsize": 8,
    "axes.titlesize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.1,
    "savefig.dpi": 300,
    "font.family": "sans-serif",
    "mathtext.fontset": "dejavusans",
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
}


def check_format(name: str, path: str | os.PathLike[str]) -> None:
    """Refuse a picture format that matplotlib cannot write, before anything is solved.

    Raises
    ------
    InputError
    """
    ending = os.path.splitext(path)[1].lower().lstrip(".")
    if ending not in ("png", "pdf", "svg"):
        raise InputError(f"{name}: expected a file ending in .png, .pdf or .svg, got {os.fspath(path)!r}")


def image(figure: Figure, path: str | os.PathLike[str], dpi: float = 300) -> bytes:
    """A figure as the bytes of a picture, of the format that the ending of a path says.

    Parameters
    ----------
    figure : Figure
        What to draw.
    path : path-like
        Where it is going to be.
    dpi : float
        Dots per inch of a picture that is made of dots.
    """
    stream = io.BytesIO()
    figure.savefig(stream, format=os.path.splitext(path)[1].lower().lstrip("."), dpi=dpi)
    return stream.getvalue()


def _scales(solution: Solution) -> tuple[float, str, float, str, float, str]:
    """Length, film and pressure: factor from normalised to the plotted unit, and label."""
    if solution.contact is None:
        unit = r"\delta" if solution.problem.load_controlled else "|h_0|"
        length, film, pressure = (over_unit(name, unit) for name in ("r", "film", "pressure"))
        return 1.0, f"${length}$", 1.0, _label("film", over=film), 1.0, _label("pressure", over=pressure)
    dimensional, quantities = solution.dimensional, solution.quantities

    def scale(name: str) -> float:
        return float(dimensional[name]) / float(quantities[name])

    film_factor, film_unit = prefixed(float(dimensional["film_center"]), "m")
    pressure_factor, pressure_unit = prefixed(_highest(solution) * scale("pressure_center"), "Pa")
    unit_length = solution.contact.unit_length
    length_factor, length_unit = prefixed(unit_length * _width(solution), "m")
    return (
        unit_length * length_factor,
        f" [{length_unit}]",
        scale("film_center") * film_factor,
        _label("film", film_unit),
        scale("pressure_center") * pressure_factor,
        _label("pressure", pressure_unit),
    )


def over_unit(name: str, height: str = "|h_0|") -> str:
    """The unit of a field behind a slash, inside mathematics: of a normalised problem, with its unit of height."""
    return rf"\,/\,{FIELDS[name].unit.tex.format(height)}"


def _label(name: str, unit: str = "", *, over: str = "") -> str:
    """Axis label of a field, in a unit or over what it is normalised with."""
    return f"{FIELDS[name].words} ${FIELDS[name].symbol}{over}$" + (f" [{unit}]" if unit else "")


def _highest(solution: Solution) -> float:
    """The maximum pressure, or that on the nodes where a spike has none."""
    highest = float(solution.quantities["pressure_max"])
    return highest if np.isfinite(highest) else float(solution.fields.pressure.max())


def _width(solution: Solution) -> float:
    """Radius over which the pressure stands, in units of length: the dry contact's, or more under a thick film."""
    return max(Regime.of(solution.problem).edge_radius, 0.9 * np.sqrt(2 * float(solution.quantities["film_center"])))


def _dry(solution: Solution) -> DryContact | None:
    """The dry contact at rest on the solution's substrate; None where the film is thicker than a contact is deep."""
    regime = Regime.of(solution.problem)
    return regime.dry_at_rest if _width(solution) == regime.edge_radius else None


def _words_of_dry(solution: Solution) -> str:
    """What `_dry` is called: a substrate that remembers has another dry contact under way."""
    return "dry contact" if solution.problem.substrate.memory is None else "dry contact at rest"


def plot(solution: Solution | LineSolution, path: str | os.PathLike[str] | None = None) -> Figure:
    """Maps of film and pressure, and their profiles in the two mid-planes; of a line contact its profile.

    The inlet is on the right, as in the paper: the sphere slides in the direction +x.  Dashed circle and dotted line: the dry
    contact on the substrate; crosses: the minimum film.  The colours of a pressure with a spike end at the pressure in the
    middle.  Where a roughness is given, films below three times the roughness are grey.

    Parameters
    ----------
    solution : Solution or LineSolution
        Physical or dimensionless; the axes follow.
    path : path-like, optional
        Where to write the picture; its ending (.png, .pdf, .svg) gives the format.

    Returns
    -------
    matplotlib.figure.Figure
    """
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.9, 5.6) if isinstance(solution, Solution) else (4.2, 2.8), layout="constrained")
        FigureCanvasAgg(figure)
        if isinstance(solution, Solution):
            axes = figure.subplots(2, 2, height_ratios=(1.35, 1))
            _map(axes[0, 0], solution, "film")
            _map(axes[0, 1], solution, "pressure")
            _profile(axes[1, 0], solution, "x")
            _profile(axes[1, 1], solution, "y")
            for label, ax in zip("abcd", axes.flat, strict=True):
                ax.set_title(f"({label})", loc="left")
        else:
            draw(solution, figure.subplots(), FILM_COLOUR, PRESSURE_COLOUR)
        name = r"\beta_N" if solution.problem.load_controlled else r"\beta"
        figure.suptitle(rf"${name}$ = {solution.problem.parameter:.4g}", fontsize=9)
        if path is not None:
            from softlube.files.writing import check_destination, write_whole

            check_format("plot", path)
            write_whole({check_destination("plot", path): image(figure, path)})
    return figure


def _map(ax: Axes, solution: Solution, field: str) -> None:
    """One field over the plane, with the dry contact on the substrate as a dashed circle."""
    from matplotlib import colormaps
    from matplotlib.ticker import MaxNLocator

    length, length_label, film, film_label, pressure, pressure_label = _scales(solution)
    axis = np.linspace(-MAP_RADIUS, MAP_RADIUS, 401) * _width(solution)
    x, y = np.meshgrid(axis, axis)
    r, theta = np.hypot(x, y), np.arctan2(y, x)
    fields, marks = solution.fields, []
    if field == "film":
        values = fields.film_at(r, theta) * film
        # The film outside the contact is tens of times that inside, where the interest lies.
        high = 1.8 * float(solution.quantities["film_center"]) * film
        low = float(np.nanmin([solution.quantities["film_min"], fields.film.min()])) * film  # the first may not be given
        levels = MaxNLocator(24).tick_values(low, high)
        mesh = ax.contourf(x * length, y * length, values, levels=levels, cmap="viridis", extend="max")
        label = film_label
        r_min, angle = (
            float(solution.quantities["film_min_radius"]),
            np.radians(float(solution.quantities["film_min_angle_deg"])),
        )
        spots = np.array([1, -1]) * r_min * np.sin(angle)
        ax.plot([r_min * np.cos(angle) * length] * 2, spots * length, "+", color="white", ms=5, mew=0.9)
        if np.isfinite(r_min):
            marks.append("+: minimum film")
    else:
        crest = ridge(fields)
        if crest is None:
            values = fields.pressure_at(r, theta) * pressure
            highest = values.max()
        else:
            x, y, values = _along_ridge(crest, axis[-1])
            # The grid knows the height of a narrow spike at its nodes only, so the colours end at the pressure in the middle.
            values, highest = values * pressure, float(fields.pressure[fields.r < INNERMOST].max()) * pressure
        levels = MaxNLocator(14).tick_values(min(values.min(), 0.0), highest)
        colours = colormaps["magma"].with_extremes(over=OVER)
        extend = "neither" if crest is None else "max"
        mesh = ax.contourf(x * length, y * length, values, levels=levels, cmap=colours, extend=extend)
        if crest is not None:
            marks.append("blue: the spike, above the scale")
        ax.set(xlim=np.array([-1, 1]) * axis[-1] * length, ylim=np.array([-1, 1]) * axis[-1] * length)
        label = pressure_label
    mesh.set_edgecolor("face")
    dry = _dry(solution)
    if dry is not None:
        marks.insert(0, f"dashed: {_words_of_dry(solution)}")
        angle = np.linspace(0, 2 * np.pi, 200)
        ax.plot(dry.radius * np.cos(angle) * length, dry.radius * np.sin(angle) * length, "--", color="white", lw=0.7)
    ink = "black" if field == "film" else "white"  # on the brightest and the darkest colour of the maps
    legend = "; ".join(marks if field == "film" else marks[-1:])
    ax.set_title(legend, loc="right", fontsize=7 if len(legend) < LONG else 6)  # a panel's letter stands on its left
    ax.text(0.5, 0.025, "sphere slides →", transform=ax.transAxes, ha="center", color=ink, fontsize=7)
    ax.annotate(
        "inlet",
        (0.985, 0.5),
        xycoords="axes fraction",
        ha="right",
        va="center",
        rotation=-90,
        color=ink,
        fontsize=7,
    )
    ax.set(aspect="equal", xlabel=f"$x${length_label}", ylabel=f"$y${length_label}")
    bar = ax.figure.colorbar(mesh, cax=ax.inset_axes((1.04, 0, 0.05, 1)), label=label, ticks=levels[::2])
    bar.outline.set_linewidth(0.5)


def _along_ridge(crest: Ridge, side: float) -> tuple[NDArray[np.floating], NDArray[np.floating], NDArray[np.floating]]:
    """x, y and pressure on rays from the axis, which cover a square of half the side `side`."""
    angles = np.linspace(0.0, np.pi, RAYS)
    r, values = crest.pressure(angles, np.sqrt(2) * side)
    x, y = r * np.cos(angles)[:, None], r * np.sin(angles)[:, None]
    return np.vstack([x[::-1], x]), np.vstack([-y[::-1], y]), np.vstack([values[::-1], values])


def _profile(ax: Axes, solution: Solution, direction: str) -> None:
    """Film (left axis) and pressure (right axis) along x or y."""
    length, length_label, film, film_label, pressure, pressure_label = _scales(solution)
    fields = solution.fields
    place = _dense_line(solution)
    theta = (np.where(place >= 0, 0.0, np.pi)) if direction == "x" else np.pi / 2
    r = np.abs(place)
    center = float(solution.quantities["film_center"]) * film
    ax.plot(place * length, fields.film_at(r, theta) * film, color=FILM_COLOUR)
    ax.set(
        xlabel=f"${direction}${length_label}",
        xlim=np.array([-1, 1]) * PROFILE_RADIUS * _width(solution) * length,
        ylim=(0, 3.5 * center),
    )
    ax.set_ylabel(film_label, color=FILM_COLOUR)
    ax.tick_params(axis="y", colors=FILM_COLOUR)
    other = ax.twinx()
    crest = ridge(fields)
    if crest is None:
        other.plot(place * length, fields.pressure_at(r, theta) * pressure, color=PRESSURE_COLOUR)
    else:
        ends = np.array([np.pi, 0.0] if direction == "x" else [np.pi / 2] * 2)
        (left, right), (behind, ahead) = crest.pressure(ends, float(place[-1]))
        line = np.concatenate([behind[::-1], ahead]) * pressure
        other.plot(np.concatenate([-left[::-1], right]) * length, line, color=PRESSURE_COLOUR)
    dry = _dry(solution)
    if dry is not None:
        of_hertz = (solution.problem.substrate, solution.problem.indenter) == (HalfSpaceKernel(), PARABOLOID)
        name = "Hertz" if of_hertz else _words_of_dry(solution)
        other.plot(place * length, dry.pressure(r) * pressure, ":", color="0.35", lw=0.9, label=name)
        other.legend(loc="upper center", frameon=False)
    if "lambda_ratio" in solution.dimensional:
        mixed = center / solution.dimensional["film_center"] * FULL_FILM
        ax.axhspan(0, mixed * solution.dimensional["film_min"] / solution.dimensional["lambda_ratio"], color="0.85", lw=0)
        ax.set_title(f"grey: below {FULL_FILM:g} × roughness", loc="right", fontsize=7)
    other.set_ylabel(pressure_label, color=PRESSURE_COLOUR)
    other.tick_params(axis="y", colors=PRESSURE_COLOUR)
    if solution.problem.cavitation == "reynolds":
        other.set_ylim(0, 1.15 * _highest(solution) * pressure)


def _dense_line(solution: Solution) -> NDArray[np.float64]:
    """Points along a diameter, dense where the grid is."""
    nodes = solution.fields.r
    fine = np.interp(np.arange(0, nodes.size - 1, 0.125), np.arange(nodes.size), nodes)
    end = PROFILE_RADIUS * _width(solution)
    fine = np.concatenate([[0.0], fine[fine < end], [end]])
    return np.concatenate([-fine[::-1], fine[1:]])


def plot_curves(curves: Mapping[str, Curve | Interpolant], symbol: str, between: tuple[float, float]) -> Figure:
    """Curves with their errors, and below them the local exponents d ln q/d ln β.

    Parameters
    ----------
    curves : mapping of str to Curve or Interpolant
        By name of the quantity; see `softlube.curve.curve` and `softlube.experiments.curves.quantity_curves`.
    symbol : {"beta", "beta_load"}
        Which β.
    between : tuple of float
        Smallest and largest β.
    """
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    beta = np.geomspace(*between, 400)
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(3.5, 4.2), layout="constrained")
        FigureCanvasAgg(figure)
        upper, lower = figure.subplots(2, 1, sharex=True)
        colours = mpl.colormaps["viridis"](np.linspace(0, 0.85, len(curves)))
        for (name, curve), colour in zip(curves.items(), colours, strict=True):
            value, error = curve(beta)
            upper.loglog(beta, np.abs(value), color=colour, lw=1.2, label=QUANTITIES[name].words)
            upper.fill_between(beta, np.abs(value) - error, np.abs(value) + error, color=colour, alpha=0.3, lw=0)
            lower.semilogx(beta, curve.exponent(beta), color=colour, lw=1.2)
        upper.legend(fontsize=6)
        upper.set_ylabel("normalised value")
        label_logarithmic(upper)
        lower.set(xlabel=r"$\beta$" if symbol == "beta" else r"$\beta$ by the load", ylabel="local exponent", xlim=between)
    return figure
