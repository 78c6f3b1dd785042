"""Supporting information: results without the Reynolds condition."""

from __future__ import annotations

import numpy as np

from softlube.paper.figures.base import (
    BETA,
    BLACK,
    LENGTH,
    LINES,
    OKABE_ITO,
    PRESSURE,
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
    letters,
    number,
    percent,
    styled,
)
from softlube.plots.flow import inlet_right

COMPARED = (10.0, 100.0, 300.0, 1000.0, 1e4)
PROFILED = (100.0, 1000.0, 1e4)


@styled
def full_film(solutions: Solutions) -> Drawn:
    """Pressure with and without the Reynolds condition, the suction, and what becomes of friction, load and film."""
    figure, axes = canvas(TWO_COLUMNS, 2.7, 1, 3)
    profile, suction, ratios = axes[0]
    columns: dict[str, list[float]] = {"beta": [], "x [sqrt(R|h0|)]": [], "p, full film": [], "p, Reynolds condition": []}
    for beta, colour, line in zip(PROFILED, beta_colours(len(PROFILED)), LINES, strict=False):
        free, bounded = solutions[Case(beta, "none")], solutions[Case(beta)]
        place, r, theta = along(free, "x", 2.0)
        full, cut = free.fields.pressure_at(r, theta), bounded.fields.pressure_at(r, theta)
        profile.plot(place, full, color=colour, ls=line, label=beta_text(beta))
        near = (place > -1.3) & (place < -0.85)
        suction.plot(place[near], full[near], color=colour, ls=line)
        for column, values in zip(columns.values(), (np.full(place.size, beta), place, full, cut), strict=True):
            column.extend(values)
    profile.set(xlabel=rf"$x{LENGTH}$", ylabel=PRESSURE, xlim=(-2, 2))
    profile.set_ylim(-0.15, 0.3)
    profile.legend(frameon=False, loc="upper right", fontsize=6, borderaxespad=0.2)
    inlet_right(profile)
    suction.axhline(0, color=BLACK, lw=0.5)
    suction.set(xlabel=rf"$x{LENGTH}$", ylabel=PRESSURE, xlim=(-1.3, -0.85))
    names = {
        "friction_domain": (r"friction, $r\leq 2$", "o", OKABE_ITO[0]),
        "load": ("load", "s", OKABE_ITO[2]),
        "film_outlet_min": ("outlet film", "^", OKABE_ITO[1]),
    }
    table: dict[str, np.ndarray] = {"beta": np.array(COMPARED)}
    for name, (label, marker, colour) in names.items():
        change = [
            float(solutions[Case(b, "none")].quantities[name] / solutions[Case(b)].quantities[name]) - 1 for b in COMPARED
        ]
        ratios.semilogx(COMPARED, 100 * np.array(change), marker + "-", color=colour, ms=4, label=label)
        table[f"{name}: full film over Reynolds condition - 1"] = np.array(change)
    deepest = []
    for beta in COMPARED:
        free = solutions[Case(beta, "none")]
        deepest.append(float(free.fields.pressure.min() / free.quantities["pressure_max"]))
    table["lowest pressure over the largest"] = np.array(deepest)
    ratios.axhline(0, color=BLACK, lw=0.5)
    ratios.set(xlabel=BETA, ylabel="change without the condition [%]", ylim=(-24, 12), xlim=(7, 1.5e4))
    ratios.set_xticks([10, 100, 1000, 10000])
    ratios.legend(frameon=False, loc="lower right", fontsize=6)
    letters(axes[0])

    def changes(name: str) -> str:
        return ", ".join(
            f"{percent(1 + c)} at β = {b:g}"
            for b, c in zip(COMPARED, table[f"{name}: full film over Reynolds condition - 1"], strict=True)
        )

    decay = float(np.log(deepest[-1] / deepest[-3]) / np.log(COMPARED[-1] / COMPARED[-3]))
    friction = table["friction_domain: full film over Reynolds condition - 1"]
    worst = int(np.argmax(np.abs(friction[1:]))) + 1
    return Drawn(
        figure,
        [Table("along-x", columns), Table("changes", table)],
        [
            Statement(
                "The negative pressure, and its region, are vanishingly small for large β.",
                "lowest pressure over the largest: "
                + ", ".join(f"{number(d, 2)} at β = {b:g}" for b, d in zip(COMPARED, deepest, strict=True)),
                "≈ 0",
                verdict="disagrees",
                remark="The region vanishes, but the suction in it falls off slowly, as the pressure in the outlet layer does: "
                f"β^({number(decay, 2)}) over the last decades, against β^(−1/5) in the Hertz limit.",
            ),
            Statement(
                "The Reynolds condition has no effect on the friction.",
                changes("friction_domain"),
                "0",
                percent(1 + friction[worst]),
                "disagrees",
                f"Small, but not nothing: without the condition the friction over r ≤ 2 is {percent(1 + friction[worst])} at "
                f"β = "
                f"{COMPARED[worst]:g} and {percent(1 + friction[-1])} at {COMPARED[-1]:g}.",
            ),
            Statement(
                "It only affects the pressure in a very small region near the outlet.",
                "load " + changes("load"),
                remark="True of the pressure for β ≥ 1000.",
            ),
            Statement("The film at the outlet", changes("film_outlet_min"), verdict="more"),
        ],
    )


FIGURES = (
    FigureSpec(
        "S2",
        "without the Reynolds condition",
        "Pressure along x if negative values are allowed (a), the suction behind the contact (b), and the change of "
        "friction, load and outlet "
        "film against the Reynolds condition (c).",
        tuple(Case(b) for b in COMPARED) + tuple(Case(b, "none") for b in COMPARED),
        full_film,
    ),
)
