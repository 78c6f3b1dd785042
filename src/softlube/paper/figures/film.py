"""Figs. 8 and 9 and the inlet film against similarity theory."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from softlube.paper.figures.base import (
    BETA,
    BLACK,
    FILM,
    FITTED,
    LENGTH,
    LINES,
    MAPS,
    OKABE_ITO,
    ONE_COLUMN,
    PROFILES,
    TWO_COLUMNS,
    WIDE,
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
from softlube.theory.scaling import asymptote, fit, local_exponents


@styled
def profiles(solutions: Solutions) -> Drawn:
    """Fig. 8: film along x and along y, the contact region enlarged."""
    figure, axes = canvas(TWO_COLUMNS, 3.0, 1, 2, sharey=True)
    tables = []
    for ax, direction in zip(axes[0], "xy", strict=True):
        columns: dict[str, list[float]] = {"beta": [], f"{direction} [sqrt(R|h0|)]": [], "u [|h0|]": []}
        inset = ax.inset_axes((0.24, 0.40, 0.52, 0.50))
        for beta, colour, line in zip(PROFILES, beta_colours(len(PROFILES)), LINES, strict=False):
            solution = solutions[Case(beta)]
            place, r, theta = along(solution, direction, 2.0)
            film = solution.fields.film_at(r, theta)
            for target in (ax, inset):
                target.plot(place, film, color=colour, ls=line, label=beta_text(beta))
            for column, values in zip(columns.values(), (np.full(place.size, beta), place, film), strict=True):
                column.extend(values)
        ax.set(xlabel=rf"${direction}{LENGTH}$", xlim=(-2, 2), ylim=(0, 1.25))
        inset.set(xlim=(-1.15, 1.15), ylim=(0, 0.08), xticks=[-1, 0, 1], yticks=[0, 0.02, 0.04, 0.06, 0.08])
        inset.tick_params(labelsize=6, length=2, pad=1.5)
        tables.append(Table(f"along-{direction}", columns))
    axes[0, 0].set_ylabel(FILM)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=4, frameon=False)
    inlet_right(axes[0, 0])
    letters(axes[0])
    ends = {
        s.beta: (float(s.fields.film_at(0.9, 0.0)), float(s.fields.film_at(0.9, np.pi))) for s in chosen(solutions, PROFILES)
    }
    lobes = {s.beta: float(s.quantities["film_min_angle_deg"]) for s in chosen(solutions, PROFILES)}
    on_axis = {s.beta: float(s.quantities["film_outlet_min"] / s.quantities["film_min"]) for s in chosen(solutions, PROFILES)}
    thick = solutions[Case(1000.0)]
    place = np.linspace(-0.99, 0.99, 397)
    along_x = thick.fields.film_at(np.abs(place), np.where(place >= 0, 0.0, np.pi))
    peak = float(place[np.argmax(along_x * (np.abs(place) < 0.95))])
    return Drawn(
        figure,
        tables,
        [
            Statement(
                "The film at the intake is thicker than at the exit.",
                ", ".join(f"{a / b:.2f} times at β = {beta:g}" for beta, (a, b) in ends.items()) + " (at |x| = 0.9)",
            ),
            Statement(
                "Within r < 1 the film is thickest at the centre and falls off slowly.",
                f"at β = 1000 u rises towards the inlet: u(x = 0.9)/u(0) = "
                f"{ends[1000.0][0] / float(thick.quantities['film_center']):.3f}",
                verdict="disagrees",
                remark="Across the sliding direction the centre is the thickest. Along it the film falls from the inlet to "
                "the outlet, "
                f"slowly and then steeply; within |x| ≤ 0.95 it is thickest at x = {peak:.2f}, not at 0.",
            ),
            Statement(
                "The minimum film is at the outlet.",
                "in the side lobes, at " + ", ".join(f"{angle:.0f}°" for angle in lobes.values()) + " from the inlet",
                "outlet (180°)",
                verdict="disagrees",
                remark="On the outlet axis the film has a minimum too, but it is thicker by "
                + ", ".join(f"{100 * (ratio - 1):.0f} %" for ratio in on_axis.values())
                + " at β = 100, 200, 500, 1000. The value printed as (22b) is that of the side lobes.",
            ),
        ],
    )


@styled
def maps(solutions: Solutions) -> Drawn:
    """Fig. 9: contours of the film in the contact."""
    from matplotlib.ticker import MaxNLocator

    figure, axes = canvas(TWO_COLUMNS, 6.0, 2, 2, sharex=True, sharey=True)
    radius, angle = np.meshgrid(np.linspace(0, 1, 161), np.linspace(0, 2 * np.pi, 361), indexing="ij")
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    coarse = np.s_[::8, ::6]
    columns: dict[str, NDArray[np.floating]] = {"r [sqrt(R|h0|)]": radius[coarse].ravel(), "theta [rad]": angle[coarse].ravel()}
    for letter, ax, beta in zip("abcd", axes.flat, MAPS, strict=True):
        solution = solutions[Case(beta)]
        film = solution.fields.film_at(radius, angle)
        thinnest, center = float(solution.quantities["film_min"]), float(solution.quantities["film_center"])
        levels = MaxNLocator(18).tick_values(thinnest, 1.25 * center)
        filled = ax.contourf(x, y, film, levels=levels, cmap="viridis", extend="max")
        filled.set_edgecolor("face")
        ax.contour(x, y, film, levels=levels[1:-1:2], colors="white", linewidths=0.35)
        lobe = np.radians(float(solution.quantities["film_min_angle_deg"]))
        place = min(float(solution.quantities["film_min_radius"]), 1.0)
        ax.plot(
            [place * np.cos(lobe)] * 2,
            place * np.sin(lobe) * np.array([1, -1]),
            "+",
            color=OKABE_ITO[1],
            ms=7,
            mew=1.4,
            clip_on=False,
        )
        ax.plot(np.cos(angle[0]), np.sin(angle[0]), color=BLACK, lw=0.6)
        ax.set(aspect="equal", xlim=(-1.08, 1.08), ylim=(-1.08, 1.08), xticks=[-1, 0, 1], yticks=[-1, 0, 1])
        ax.set_title(f"({letter}) {beta_text(beta)}", loc="left")
        inlet_right(ax)
        figure.colorbar(filled, ax=ax, shrink=0.85, label=FILM, ticks=levels[::4], pad=0.02)
        columns[f"u at beta = {beta:g} [|h0|]"] = film[coarse].ravel()
    for ax in axes[1]:
        ax.set_xlabel(rf"$x{LENGTH}$")
    for ax in axes[:, 0]:
        ax.set_ylabel(rf"$y{LENGTH}$", labelpad=0)
    front = {s.beta: float(s.fields.film_at(0.95, np.pi) / s.fields.film_at(0.95, 0.0)) for s in chosen(solutions, MAPS)}
    return Drawn(
        figure,
        [Table("map", columns)],
        [
            Statement(
                "Liquid enters from the positive x direction; the film is thinner where it leaves.",
                "u(x = −0.95)/u(x = 0.95) = " + ", ".join(f"{ratio:.2f} at β = {beta:g}" for beta, ratio in front.items()),
            ),
            Statement(
                "The thinnest film (crosses).",
                ", ".join(
                    f"{number(float(s.quantities['film_min']))} at {float(s.quantities['film_min_angle_deg']):.0f}°"
                    for s in chosen(solutions, MAPS)
                ),
                verdict="more",
                remark="Two side lobes, in (a) to (d), that move from the outlet towards the sides (90°) as β grows.",
            ),
        ],
    )


@styled
def inlet_film(solutions: Solutions) -> Drawn:
    """Supporting information: film at the inlet, r = 1 and θ = 0, against the law of similarity."""
    figure, axes = canvas(ONE_COLUMN, 2.9)
    ax = axes[0, 0]
    ours = chosen(solutions, WIDE)
    beta = np.array([s.beta for s in ours])
    film = np.array([float(s.quantities["film_inlet"]) for s in ours])
    exponents = local_exponents(beta, film)
    compensated = film * beta**0.6
    law = fit(beta, film, between=(FITTED[0], FITTED[-1]))
    ax.semilogx(beta, compensated, "o", color=OKABE_ITO[0], ms=4, label=r"$u(r=1,\,\theta=0)$")
    columns = {"beta": beta, "u(1, 0) [|h0|]": film, "local exponent": exponents}
    statements = [
        Statement(
            "u(1, 0) follows the similarity law β^(−3/5) of Snoeijer, Eggers & Venner (2013): excellent agreement.",
            f"local exponent {number(exponents[2])} at β = 100, {number(exponents[-1])} at {beta[-1]:g}; fit over 100 … 10⁴: "
            f"{number(law.exponent)} ({number(law.exponent_interval[0])} … {number(law.exponent_interval[1])})",
            "−0.6",
            f"{law.exponent + 0.6:+.3f}",
            "disagrees",
            "The exponent of the similarity theory is approached, and not reached within the paper's range.",
        )
    ]
    law_of_similarity = asymptote("film_inlet")
    if law_of_similarity is not None:
        values = law_of_similarity(beta) * beta**0.6
        ax.semilogx(beta, values, "--", color=OKABE_ITO[1], label="similarity theory")
        columns["similarity theory [|h0|]"] = values / beta**0.6
        ratios = {b: float(v / t) for b, v, t in zip(beta, compensated, values, strict=True)}
        statements.append(
            Statement(
                "… and its prefactor.",
                f"{number(compensated[-1])} β^(−3/5) at β = {beta[-1]:g}",
                f"{number(values[-1])} β^(−3/5)",
                ", ".join(f"{percent(ratios[b])} at β = {b:g}" for b in (100.0, 1e4, 1e5)),
                "more",
            )
        )
    ax.set(xlabel=BETA, ylabel=r"inlet film $\beta^{3/5}\,u\,/\,|h_0|$", ylim=(0, 1.25 * compensated.max()))
    ax.legend(frameon=False, loc="lower right")
    return Drawn(figure, [Table("inlet-film", columns)], statements)


FIGURES = (
    FigureSpec(
        "8",
        "Film along x and y",
        "Film thickness along the direction of sliding (a) and across it (b); insets: the contact region.",
        reynolds(PROFILES),
        profiles,
    ),
    FigureSpec(
        "9",
        "Film in the contact",
        "Contours of the film within r ≤ 1; crosses: the minimum; white lines every second level. The inlet is on the right.",
        reynolds(MAPS),
        maps,
    ),
    FigureSpec(
        "S3",
        "inlet film against similarity theory",
        "Film at the inlet edge of the contact, times β^(3/5): constant where the similarity theory of lubricated Hertzian "
        "contacts holds.",
        reynolds(WIDE),
        inlet_film,
    ),
)
