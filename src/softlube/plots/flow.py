"""Pictures of the flow in the gap: streamlines in the plane and in the vertical mid-plane, shear stress on the walls."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError
from softlube.model.motions import FIXED_BALL
from softlube.plots.solution import FILM_COLOUR, PRESSURE_COLOUR, STYLE, over_unit
from softlube.readout import flow
from softlube.readout.energy import film_dissipation, surface_work
from softlube.readout.free_boundary import free_boundary, is_wet
from softlube.steady.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.contour import QuadContourSet
    from matplotlib.figure import Figure

Array = NDArray[np.floating]
Columns = dict[str, Array]

REACH = 1.6
"""How far the pictures go, over the contact radius."""
LENGTH = over_unit("r")


def inlet_right(ax: Axes) -> None:
    """Say over the axes where the inlet is: on the right, in every picture."""
    ax.set_title("inlet on the right", loc="right", fontsize=6.5, color="0.35")


def _arrows(ax: Axes, lines: list[Array], colour: str) -> None:
    """Lines with an arrow half-way along."""
    for line in lines:
        ax.plot(line[:, 0], line[:, 1], color=colour, lw=0.7)
        k = len(line) // 2
        if len(line) > 4:
            ax.annotate(
                "", line[k + 1], line[k], arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 0.7, "mutation_scale": 6}
            )


def plane(ax: Axes, solution: Solution, *, level: float | None = None, length: float = 1.0, unit: str = LENGTH) -> Columns:
    """Streamlines in the plane over the speed, frame of the sphere; of the mean flow, or at one level.

    Parameters
    ----------
    ax : matplotlib Axes
        Where to draw.
    solution : Solution
        What to draw.
    level : float, optional
        Level ζ in the film, 0 … 1.
    length, unit : float, str
        Factor from √(R|h₀|) to the unit of the axes, and its label.

    Returns
    -------
    dict
        x, y and the velocity on the grid of the picture.
    """
    side = np.linspace(-REACH, REACH, 161)
    x, y = np.meshgrid(side, side)
    r, theta = np.hypot(x, y), np.arctan2(y, x)
    if level is None:
        v_r, v_t = flow.mean_velocity(solution, r, theta, frame="sphere")
    else:
        v_r, v_t = flow.velocity(solution, r, theta, level=level, frame="sphere")
    v_x, v_y = v_r * np.cos(theta) - v_t * np.sin(theta), v_r * np.sin(theta) + v_t * np.cos(theta)
    speed = np.hypot(v_x, v_y)
    # Off the round values: half the sliding speed, that of a flat film, would be the ragged border of a plateau.
    levels = np.arange(0.025, float(np.percentile(speed, 99.5)) + 0.05, 0.05)
    mesh = ax.contourf(x * length, y * length, speed, levels=levels, cmap="cividis", extend="max")
    mesh.set_edgecolor("face")
    boundary = free_boundary(solution)
    if boundary is not None:
        ax.contourf(
            x * length, y * length, is_wet(solution, r, theta).astype(float), levels=[-1, 0.5], colors=["0.8"], alpha=0.9
        )
        edge = np.linspace(-REACH, REACH, 400)
        ax.plot(boundary.place(np.abs(edge)) * length, edge * length, color="0.25", lw=0.9)
    half = np.concatenate([[0.0], np.arange(0.15, REACH, 0.15)])
    starts = np.array([(0.0, sign * h) for h in half for sign in (1, -1)][1:])
    lines = flow.streamlines(solution, starts, level=level, frame="sphere", reach=2.3, upstream=True)
    _arrows(ax, [line * length for line in lines], "white")
    turn = np.linspace(0, 2 * np.pi, 200)
    ax.plot(np.cos(turn) * length, np.sin(turn) * length, "--", color="white", lw=0.6)
    ax.set(
        aspect="equal",
        xlabel=rf"$x{unit}$",
        ylabel=rf"$y{unit}$",
        xlim=(-REACH * length, REACH * length),
        ylim=(-REACH * length, REACH * length),
    )
    what = "mean speed" if level is None else rf"speed at level {level:g}"
    bar = ax.figure.colorbar(mesh, ax=ax, location="top", shrink=0.8, label=rf"{what} relative to the sphere, $/\,v$", pad=0.03)
    bar.set_ticks(np.arange(0.1, levels[-1], 0.1).round(1).tolist())
    inlet_right(ax)
    thin = np.s_[::4, ::4]
    return {
        "x [sqrt(R|h0|)]": x[thin].ravel(),
        "y [sqrt(R|h0|)]": y[thin].ravel(),
        "v_x [v]": v_x[thin].ravel(),
        "v_y [v]": v_y[thin].ravel(),
    }


def section(ax: Axes, solution: Solution, *, length: float = 1.0, unit: str = LENGTH) -> Columns:
    """Streamlines in the vertical mid-plane over the velocity along x, frame of the sphere; height as a share of the film."""
    x, zeta = np.linspace(-REACH, REACH, 401), np.linspace(0, 1, 101)
    across, up = np.meshgrid(x, zeta)
    theta = np.where(across >= 0, 0.0, np.pi)
    v_r, _ = flow.velocity(solution, np.abs(across), theta, level=up, frame="sphere")
    v_x = v_r * np.cos(theta)
    boundary = free_boundary(solution)
    front = -REACH if boundary is None else float(boundary.place(0.0))
    v_x = np.where(across > front, v_x, np.nan)
    levels = np.linspace(-1.25, 0.25, 13)
    mesh = ax.contourf(across * length, up, np.ma.masked_invalid(v_x), levels=levels, cmap="cividis", extend="both")
    mesh.set_edgecolor("face")
    if boundary is not None:
        ax.axvspan(-REACH * length, front * length, color="0.8")
    ax.contour(across * length, up, np.ma.masked_invalid(v_x), levels=[0.0], colors="white", linewidths=0.8, linestyles="--")
    turning = [(REACH - 0.01, level) for level in (0.03, 0.06, 0.12, 0.2, 0.3, 0.42)]
    entering = [(0.0, level) for level in (0.1, 0.25, 0.4, 0.55, 0.7, 0.85)]
    if not solution.problem.liquid.thins:
        lines = flow.section_streamlines(solution, turning, reach=REACH)
        lines += flow.section_streamlines(solution, entering, reach=REACH, upstream=True)
        _arrows(ax, [line * [length, 1] for line in lines], "white")
    ax.set(xlabel=rf"$x{unit}$", ylabel=r"level $(z-w)\,/\,u$", xlim=(-REACH * length, REACH * length), ylim=(0, 1))
    bar = ax.figure.colorbar(
        mesh, ax=ax, location="top", shrink=0.9, label=r"velocity along $x$ relative to the sphere, $/\,v$", pad=0.03
    )
    bar.set_ticks([-1.25, -1, -0.75, -0.5, -0.25, 0, 0.25])
    inlet_right(ax)
    thin = np.s_[::10, ::5]
    return {"x [sqrt(R|h0|)]": across[thin].ravel(), "level": up[thin].ravel(), "v_x [v]": v_x[thin].ravel()}


def thinned(ax: Axes, solution: Solution, what: str, *, length: float = 1.0, unit: str = LENGTH) -> Columns:
    """Shear rate ("rate") on the faster sheared wall, or viscosity ("viscosity") there over that at rest, in the plane.

    Parameters
    ----------
    ax : matplotlib Axes
        Where to draw.
    solution : Solution
        What to draw.
    what : {"rate", "viscosity"}
        Which of the two.
    length, unit : float, str
        See `plane`.
    """
    side = np.linspace(-REACH, REACH, 161)
    x, y = np.meshgrid(side, side)
    r, theta = np.hypot(x, y), np.arctan2(y, x)
    level = np.array([0.0, 1.0])[:, None, None]
    contact = solution.contact
    if what == "rate":
        values = np.max(np.hypot(*flow.shear_rate(solution, r, theta, level=level)), axis=0)
        scale, label = (1.0, r"$/\,(v/|h_0|)$") if contact is None else (contact.speed_sum / contact.unit_height, "[1/s]")
        label = f"shear rate at the walls {label}"
    else:
        values = np.min(flow.viscosity(solution, r, theta, level=level), axis=0)
        scale, label = 1.0, "viscosity at the walls over that at rest"
    mesh = ax.contourf(x * length, y * length, np.log10(values * scale), levels=24, cmap="cividis")
    column = "shear rate [v/|h0|]" if what == "rate" else "viscosity [eta]"
    return _finished(ax, mesh, f"log₁₀ of the {label}", unit, x, y, column, values)


def lost(ax: Axes, solution: Solution, where: str, *, length: float = 1.0, unit: str = LENGTH) -> Columns:
    """Dissipation in the liquid ("film") or work that the surface takes ("substrate") per area, in the plane.

    Parameters
    ----------
    ax : matplotlib Axes
        Where to draw.
    solution : Solution
        What to draw.
    where : {"film", "substrate"}
        Which of the two, see `softlube.readout.energy.film_dissipation` and `softlube.readout.energy.surface_work`.
    length, unit : float, str
        See `plane`.
    """
    side = np.linspace(-REACH, REACH, 161)
    x, y = np.meshgrid(side, side)
    r, theta, contact = np.hypot(x, y), np.arctan2(y, x), solution.contact
    if where == "film":
        values = film_dissipation(solution, r, theta)
    else:  # the surface passes at its own speed if the ball turns
        values = surface_work(solution, r, theta) * (0.5 + solution.fields.slide_to_roll / 4)
    if contact is None:
        name = r"\delta" if solution.problem.load_controlled else "|h_0|"
        scale, label = 1.0, rf"$/\,((2\pi/3)\,G v {name}/R)$"
    else:
        force, _ = contact.scales(contact.unit_height)["friction"]
        scale, label = force * contact.speed_sum / contact.unit_length**2, "[W/m²]"
    # A few places with a film far thinner than elsewhere would leave the rest without colours.
    highest = float(np.percentile(np.abs(values), 99.8)) * scale
    levels = np.linspace(0.0 if where == "film" else -highest, highest, 25)
    colours = "cividis" if where == "film" else "RdBu_r"
    mesh = ax.contourf(x * length, y * length, values * scale, levels=levels, cmap=colours, extend="both")
    what = "loss in the liquid" if where == "film" else "work taken by the substrate"
    column = f"{'dissipation' if where == 'film' else 'work'} per area [(2 pi/3) G v |h0|/R]"
    return _finished(ax, mesh, f"{what} {label}", unit, x, y, column, values)


def _finished(ax: Axes, mesh: QuadContourSet, label: str, unit: str, x: Array, y: Array, column: str, values: Array) -> Columns:
    """Colour bar and axes of a map in the plane, and its data."""
    mesh.set_edgecolor("face")
    bar = ax.figure.colorbar(mesh, ax=ax, location="top", shrink=0.8, label=label, pad=0.03)
    bar.ax.locator_params(axis="x", nbins=5)
    ax.set(aspect="equal", xlabel=rf"$x{unit}$", ylabel=rf"$y{unit}$")
    inlet_right(ax)
    thin = np.s_[::4, ::4]
    return {"x [sqrt(R|h0|)]": x[thin].ravel(), "y [sqrt(R|h0|)]": y[thin].ravel(), column: values[thin].ravel()}


def walls(ax: Axes, solution: Solution, axis: str, *, length: float = 1.0, unit: str = LENGTH) -> Columns:
    """Shear stress τ_zx on both walls along x or y; in SI if the solution is of a physical contact."""
    place = np.unique(
        np.concatenate([np.linspace(-REACH, REACH, 241), np.linspace(-1.1, -0.9, 161), np.linspace(0.9, 1.1, 161)])
    )
    theta = np.where(place >= 0, 0.0, np.pi) if axis == "x" else np.full(place.size, np.pi / 2)
    sphere, substrate = (flow.shear_stress(solution, np.abs(place), theta, level=level)[0] for level in (1.0, 0.0))
    scale, label = _stress_scale(solution)
    ax.plot(place * length, sphere * scale, color=FILM_COLOUR, label="sphere")
    ax.plot(place * length, substrate * scale, "--", color=PRESSURE_COLOUR, label="substrate")
    ax.axhline(0, color="0.7", lw=0.5, zorder=0)
    ax.set(
        xlabel=rf"${axis}{unit}$",
        ylabel=rf"shear stress $\tau_{{zx}}$ {label}",
        xlim=(-REACH * length, REACH * length),
    )
    low, high = min(sphere.min(), substrate.min()) * scale, max(sphere.max(), substrate.max()) * scale
    ax.set_ylim(low - 0.15 * (high - low), high + 0.22 * (high - low))
    ax.legend(frameon=False, loc="upper right" if axis == "x" else "lower center")
    if axis == "x":
        inlet_right(ax)
    return {
        f"{axis} [sqrt(R|h0|)]": place,
        "tau_zx on the sphere [eta v/|h0|]": sphere,
        "tau_zx on the substrate [eta v/|h0|]": substrate,
    }


def _stress_scale(solution: Solution) -> tuple[float, str]:
    """Factor from ηv/|h₀| to the unit plotted, and its label: Pa, or ηv over the centre film."""
    contact = solution.contact
    if contact is None:
        return float(solution.quantities["film_center"]), r"$/\,(\eta v/u(0))$"
    return contact.viscosity * contact.speed_sum / contact.unit_height, "[Pa]"


def _length_scale(solution: Solution) -> tuple[float, str]:
    """Factor from √(R|h₀|) to the unit plotted, and its label (inside mathematics)."""
    if solution.contact is None:
        return 1.0, over_unit("r", r"\delta" if solution.problem.load_controlled else "|h_0|")
    radius = solution.contact.unit_length
    for factor, name in ((1e9, "nm"), (1e6, "µm"), (1e3, "mm"), (1.0, "m")):
        if radius * factor < 1000:
            return radius * factor, rf"\ \mathrm{{[{name}]}}"
    return radius, r"\ \mathrm{[m]}"


def picture(solution: Solution, *, level: float | None = None) -> tuple[Figure, dict[str, Columns]]:
    """Flow in the gap in four panels: streamlines in the plane and in the mid-plane, wall shear along x and along y.

    Two more show the shear rate and the viscosity at the walls if the liquid thins with shear, and two what is lost in the
    liquid and taken by the surface if the substrate remembers.

    Parameters
    ----------
    solution : Solution
        Physical or dimensionless; the axes follow.
    level : float, optional
        Level ζ of the plane's streamlines, 0 … 1; without it the mean flow.

    Returns
    -------
    matplotlib Figure, and the data of each panel

    Raises
    ------
    InputError
        If the level is none, or the ball turns: the velocities of `softlube.flow` are those under a ball that slides.
    """
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    if level is not None and not 0 <= level <= 1:
        raise InputError(f"level: expected a share of the film between 0 (substrate) and 1 (sphere), got {level!r}")
    thins, linear = solution.problem.liquid.thins, solution.problem.liquid.linear
    if solution.contact is not None and linear and solution.contact.slide_to_roll != FIXED_BALL:
        raise InputError(
            f"slide_to_roll: velocities and stresses are drawn for a ball that does not turn, {FIXED_BALL:g}; got "
            f"{solution.contact.slide_to_roll:g}, which changes neither film nor pressure: softlube solve --plot draws those"
        )
    remembers = solution.problem.substrate.memory is not None
    length, unit = _length_scale(solution)
    rows = 2 + thins + remembers
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.9, 3.2 * rows - 0.2 * (rows == 2 or not remembers)), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots(rows, 2, height_ratios=(1.25, 1, 1.25, 1.25)[:rows])
        tables = {
            "plane": plane(axes[0, 0], solution, level=level, length=length, unit=unit),
            "section": section(axes[0, 1], solution, length=length, unit=unit),
            "shear-x": walls(axes[1, 0], solution, "x", length=length, unit=unit),
            "shear-y": walls(axes[1, 1], solution, "y", length=length, unit=unit),
        }
        if thins:
            tables["shear-rate"] = thinned(axes[2, 0], solution, "rate", length=length, unit=unit)
            tables["viscosity"] = thinned(axes[2, 1], solution, "viscosity", length=length, unit=unit)
        if remembers:
            tables["film-loss"] = lost(axes[-1, 0], solution, "film", length=length, unit=unit)
            tables["substrate-work"] = lost(axes[-1, 1], solution, "substrate", length=length, unit=unit)
        for letter, ax in zip("abcdefgh"[: axes.size], axes.flat, strict=True):
            ax.set_title(f"({letter})", loc="left")
        figure.canvas.draw()
    return figure, tables
