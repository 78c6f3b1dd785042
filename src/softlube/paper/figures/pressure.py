"""Figs. 5 and 6 and the pressure over the whole domain."""

from __future__ import annotations

import numpy as np

from softlube.model.exact import HERTZ_LOAD, HERTZ_PRESSURE, far_field_profile, hertz_pressure
from softlube.paper.figures.base import (
    BLACK,
    LENGTH,
    LINES,
    PRESSURE,
    PROFILES,
    TWO_COLUMNS,
    Case,
    Drawn,
    FigureSpec,
    Solutions,
    Statement,
    Table,
    along,
    beta_colours,
    beta_text,
    canvas,
    chosen,
    letters,
    number,
    percent,
    reynolds,
    styled,
)
from softlube.plots.flow import inlet_right
from softlube.readout import flow
from softlube.readout.free_boundary import free_boundary
from softlube.steady.solution import Solution


@styled
def profiles(solutions: Solutions) -> Drawn:
    """Fig. 5: pressure along x and along y, beside Hertz's."""
    figure, axes = canvas(TWO_COLUMNS, 2.7, 1, 2, sharey=True)
    tables = []
    for ax, direction in zip(axes[0], "xy", strict=True):
        columns: dict[str, list[float]] = {"beta": [], f"{direction} [sqrt(R|h0|)]": [], "p [4 pi G sqrt(|h0|/R)]": []}
        for beta, colour, line in zip(PROFILES, beta_colours(len(PROFILES)), LINES, strict=False):
            solution = solutions[Case(beta)]
            place, r, theta = along(solution, direction, 2.0)
            pressure = solution.fields.pressure_at(r, theta)
            ax.plot(place, pressure, color=colour, ls=line, label=beta_text(beta))
            for column, values in zip(columns.values(), (np.full(place.size, beta), place, pressure), strict=True):
                column.extend(values)
        fine = np.linspace(-1, 1, 801)
        ax.plot(fine, hertz_pressure(fine), ":", color=BLACK, lw=1.0, label="Hertz (7)")
        ax.set(xlabel=rf"${direction}{LENGTH}$", xlim=(-2, 2), ylim=(0, 0.23))
        tables.append(Table(f"along-{direction}", columns))
    axes[0, 0].set_ylabel(PRESSURE)
    axes[0, 1].legend(loc="upper right", frameon=False)
    inlet_right(axes[0, 0])
    letters(axes[0])
    heavy, light = solutions[Case(1000.0)], solutions[Case(100.0)]
    largest = {solution.beta: _distance_to_hertz(solution) for solution in (light, heavy)}
    spike = max(float(s.quantities["pressure_max"] / s.quantities["pressure_center"]) for s in chosen(solutions, PROFILES))
    return Drawn(
        figure,
        tables,
        [
            Statement(
                "The pressure approaches the Hertz pressure as β increases.",
                f"largest distance from Hertz on the x axis for |x| ≤ 0.9, over p_H(0): {largest[light.beta]:.3f} at β = 100, "
                f"{largest[heavy.beta]:.3f} at β = 1000",
            ),
            Statement(
                "No Petrusevich spike.",
                f"the maximum is at most {100 * (spike - 1):.2f} % above the pressure at the centre, and there is no second "
                f"one",
            ),
        ],
    )


def _distance_to_hertz(solution: Solution) -> float:
    place = np.linspace(-0.9, 0.9, 721)
    pressure = solution.fields.pressure_at(np.abs(place), np.where(place >= 0, 0.0, np.pi))
    return float(np.max(np.abs(pressure - hertz_pressure(place)))) / HERTZ_PRESSURE


def radial_slope(solution: Solution, r: np.ndarray, theta: float) -> np.ndarray:
    """∂p̄/∂r along a ray.

    The pressure ends as a parabola at the free boundary: from the last node before it the slope goes to zero in a straight
    line, where the spline, blind to the boundary, would ring.
    """
    slope = flow.pressure_gradient(solution, r, theta)[0]
    boundary = free_boundary(solution)
    if boundary is None or theta != np.pi:
        return slope
    front, nodes = -float(boundary.place(0.0)), solution.fields.r
    last = float(nodes[solution.fields.pressure[:, -1] > 0][-1])
    at_last = float(flow.pressure_gradient(solution, last, theta)[0])
    return np.where((r > last) & (r < front), at_last * (front - r) / (front - last), slope)


@styled
def gradients(solutions: Solutions) -> Drawn:
    """Fig. 6: pressure gradient at the intake and at the outlet, with the layer at r = 1 enlarged."""
    figure, axes = canvas(TWO_COLUMNS, 2.9, 1, 2)
    tables = []
    peaks: dict[str, list[float]] = {}
    for ax, theta, name in zip(axes[0], (0.0, np.pi), ("intake", "outlet"), strict=True):
        columns: dict[str, list[float]] = {"beta": [], "r [sqrt(R|h0|)]": [], "dp/dr [4 pi G/R]": []}
        inset = ax.inset_axes((0.085, 0.10, 0.26, 0.34) if name == "intake" else (0.09, 0.10, 0.40, 0.48))
        for beta, colour, line in zip(PROFILES, beta_colours(len(PROFILES)), LINES, strict=False):
            solution = solutions[Case(beta)]
            r = np.concatenate([np.linspace(0.2, 0.9, 80), np.linspace(0.9, 1.2, 900)[1:], np.linspace(1.2, 2.0, 80)[1:]])
            slope = radial_slope(solution, r, theta)
            for target in (ax, inset):
                target.plot(r, slope, color=colour, ls=line, label=beta_text(beta))
            for column, values in zip(columns.values(), (np.full(r.size, beta), r, slope), strict=True):
                column.extend(values)
            peaks.setdefault(name, []).append(float(np.max(np.abs(slope))))
        fine = 1 - np.geomspace(0.8, 1e-4, 400)
        for target in (ax, inset):
            target.plot(fine, -HERTZ_PRESSURE * fine / np.sqrt(1 - fine**2), ":", color=BLACK, lw=1.0, label="Hertz (7)")
        floor = -1.18 * max(peaks[name])
        ax.set(xlabel=rf"$r{LENGTH}$", xlim=(0.2, 1.8) if name == "intake" else (0.4, 1.4), ylim=(floor, -0.09 * floor))
        inset.set(xlim=(0.8, 1.2) if name == "intake" else (0.96, 1.06), ylim=(floor, -0.03 * floor))
        inset.tick_params(labelsize=6, length=2, pad=1.5)
        inset.set_xticks([0.8, 1.0, 1.2] if name == "intake" else [0.96, 1.0, 1.04])
        inset.yaxis.set_major_locator(_few_ticks(3))
        ax.text(
            0.03, 0.97, rf"{name}, $\theta = {'0' if name == 'intake' else chr(92) + 'pi'}$", transform=ax.transAxes, va="top"
        )
        tables.append(Table(name, columns))
    for ax in axes[0]:
        ax.set_ylabel(r"pressure gradient $\partial p/\partial r\,/\,(4\pi G/R)$")
    axes[0, 0].legend(loc="lower right", frameon=False)
    letters(axes[0])
    intake, outlet = peaks["intake"], peaks["outlet"]
    return Drawn(
        figure,
        tables,
        [
            Statement(
                "At the intake the infinite gradient of Hertz is regularised; |dp/dr| rises with β.",
                "largest |dp/dr| " + ", ".join(f"{peak:.3f}" for peak in intake) + " at β = 100, 200, 500, 1000",
            ),
            Statement(
                "At the outlet the gradient has a sharp peak near r = 1.",
                f"{outlet[-1] / intake[-1]:.1f} times the intake's at β = 1000, {outlet[0] / intake[0]:.1f} times at β = 100",
            ),
        ],
    )


def _few_ticks(n: int):
    from matplotlib.ticker import MaxNLocator

    return MaxNLocator(n)


@styled
def whole_domain(solutions: Solutions) -> Drawn:
    """Supporting information: pressure over the whole domain r ≤ 2, and beyond it on the inlet axis."""
    from matplotlib.colors import Normalize

    figure, axes = canvas(TWO_COLUMNS, 3.0, 1, 4, width_ratios=(1, 1, 1, 1.15))
    maps, profile = axes[0, :3], axes[0, 3]
    line = np.linspace(-2, 2, 201)
    x, y = np.meshgrid(line, line)
    r, theta = np.hypot(x, y), np.arctan2(y, x)
    norm = Normalize(0, 1.05 * HERTZ_PRESSURE)
    columns: dict[str, np.ndarray] = {}
    shown = (100.0, 300.0, 1000.0)
    coarse = np.s_[::5, ::5]
    columns["x [sqrt(R|h0|)]"], columns["y [sqrt(R|h0|)]"] = x[coarse].ravel(), y[coarse].ravel()
    mesh = None
    for ax, beta in zip(maps, shown, strict=True):
        pressure = np.where(r <= 2, solutions[Case(beta)].fields.pressure_at(np.minimum(r, 2), theta), np.nan)
        mesh = ax.contourf(
            x, y, np.ma.masked_invalid(pressure), levels=np.linspace(0, norm.vmax or 1, 15), cmap="magma", norm=norm
        )
        mesh.set_edgecolor("face")
        turn = np.linspace(0, 2 * np.pi, 200)
        ax.plot(np.cos(turn), np.sin(turn), "--", color="white", lw=0.6)
        ax.set(aspect="equal", xlabel=rf"$x{LENGTH}$", xticks=[-2, 0, 2], yticks=[-2, 0, 2])
        ax.text(0, -1.72, "inlet right", ha="center", va="center", fontsize=6, color="white")
        columns[f"p at beta = {beta:g} [4 pi G sqrt(|h0|/R)]"] = pressure[coarse].ravel()
    maps[0].set_ylabel(rf"$y{LENGTH}$", labelpad=0)
    assert mesh is not None
    figure.colorbar(mesh, ax=list(maps), location="bottom", label=PRESSURE, aspect=45, ticks=[0, 0.05, 0.1, 0.15, 0.2])
    far = np.geomspace(1.0, 20.0, 300)
    table: dict[str, np.ndarray] = {"r [sqrt(R|h0|)]": far}
    profile_at_zero, profile_at_side = (float(far_field_profile(angle)) for angle in (0.0, np.pi / 2))
    found_at_side = float(solutions[Case(1000.0)].fields.pressure_at(15.0, np.pi / 2)) * 1000 * 15**3
    for beta, colour, style in zip(shown, beta_colours(3), LINES, strict=False):
        values = solutions[Case(beta)].fields.pressure_at(far, 0.0) * beta
        profile.loglog(far, values, color=colour, ls=style, label=beta_text(beta))
        table[f"beta p on the inlet axis at beta = {beta:g}"] = values
    profile.loglog(far[far > 3], profile_at_zero / far[far > 3] ** 3, ":", color=BLACK, label="far field")
    profile.set(xlabel=rf"$r{LENGTH}$", xlim=(1, 20), ylim=(5e-5, 300))
    profile.set_ylabel(r"$\beta\,p\,/\,4\pi G\sqrt{|h_0|/R}$ on the inlet axis", labelpad=1)
    profile.legend(frameon=False, loc="lower left", fontsize=6, borderaxespad=0.2, handlelength=1.6)
    for letter, ax, beta in zip("abc", maps, shown, strict=True):
        ax.set_title(f"({letter}) {beta_text(beta)}", loc="left", fontsize=7)
    profile.set_title("(d)", loc="left", fontsize=7)
    beyond = {
        beta: 1 - _load_within(solutions[Case(beta)], 2.0) / float(solutions[Case(beta)].quantities["load"]) for beta in shown
    }
    return Drawn(
        figure,
        [Table("map", columns), Table("inlet-axis", table)],
        [
            Statement(
                "p = 0 at r = 2 (17b) ends the domain.",
                "load beyond r = 2: " + ", ".join(f"{100 * v:.2g} % at β = {b:g}" for b, v in beyond.items()),
                verdict="more",
                remark="A domain that ends at r = 2 feels it at small β; softlube's reaches r ≈ 25, with the far field beyond.",
            ),
            Statement(
                "Far away p = (4/5β) cos θ/r³ (9).",
                f"with the Reynolds condition {profile_at_zero:.3f}/(βr³) at θ = 0 but {profile_at_side:.3f}/(βr³) at 90° "
                f"(ours at β = 1000, "
                f"r = 15: {found_at_side:.3f})",
                "0.800 and 0",
                f"{profile_at_zero - 0.8:+.3f} and {profile_at_side:+.3f}",
                "disagrees",
                "(9) is the far field of a full film. Under the Reynolds condition the far pressure has a free boundary of "
                "its own at "
                "108.4° from the inlet, which changes its angular profile.",
            ),
        ],
    )


def _load_within(solution: Solution, cutoff: float) -> float:
    from softlube.discretization.measure import load_within

    return load_within(solution.fields, cutoff)


def load_statement(solutions: Solutions) -> Statement:
    """N → 4/(3π)."""
    loads = {beta: float(solutions[Case(beta)].quantities["load"]) for beta in (100.0, 1000.0, 1e4)}
    return Statement(
        "The load approaches Hertz's, 4/(3π), for β ≫ 1.",
        f"{number(loads[1e4], 5)} at β = 10⁴",
        number(HERTZ_LOAD, 5),
        percent(loads[1e4] / HERTZ_LOAD),
        remark=f"From above: {percent(loads[100.0] / HERTZ_LOAD)} at β = 100, {percent(loads[1000.0] / HERTZ_LOAD)} at 1000.",
    )


FIGURES = (
    FigureSpec(
        "5",
        "Pressure along x and y",
        "Pressure along the direction of sliding (a) and across it (b) for four β, and Hertz's (7).",
        reynolds(PROFILES),
        profiles,
    ),
    FigureSpec(
        "6",
        "Pressure gradient at the intake and the outlet",
        "Radial pressure gradient on the inlet axis (a) and the outlet axis (b); insets: the layers at r = 1.",
        reynolds(PROFILES),
        gradients,
    ),
    FigureSpec(
        "S1",
        "pressure over the whole domain",
        "Pressure over the paper's domain r ≤ 2 (a-c; dashed: the Hertz contact; the inlet is on the right) and its decay "
        "along the inlet "
        "axis (d). Dotted: far field with the Reynolds condition.",
        reynolds((100.0, 300.0, 1000.0)),
        whole_domain,
    ),
)
