"""Beyond the paper: friction in its parts, local exponents, engineering formulas, and the README's picture."""

from __future__ import annotations

import numpy as np

from softlube.paper.figures.base import (
    BETA,
    BLACK,
    CONTACT,
    LINES,
    MARKERS,
    OKABE_ITO,
    TWO_COLUMNS,
    WIDE,
    Case,
    Drawn,
    FigureSpec,
    Solutions,
    Statement,
    Table,
    canvas,
    chosen,
    letters,
    number,
    percent,
    reynolds,
    styled,
)
from softlube.plots.solution import plot
from softlube.readout import friction
from softlube.theory import engineering
from softlube.theory.scaling import LAWS, PAPER_RANGE, compare

SYMBOLS = {
    "20": r"$|\partial p/\partial r|_{\max}$",
    "21": r"boundary layer $\delta$",
    "22a": r"centre film $u(0)$",
    "22b": r"minimum film",
    "28": r"friction, $r\leq 2$",
}
CUTOFFS = np.concatenate([np.linspace(0.1, 0.9, 17), np.linspace(0.92, 1.3, 39), np.geomspace(1.35, 15, 30)])


@styled
def parts(solutions: Solutions) -> Drawn:
    """Friction against the cut-off radius, split in Couette and Poiseuille parts, and the balance of forces."""
    solution = solutions[Case(1000.0)]
    splits = friction.against_cutoff(solution, CUTOFFS)
    figure, axes = canvas(TWO_COLUMNS, 2.9, 1, 2)
    ax, other = axes[0]
    columns = {"cutoff [sqrt(R|h0|)]": CUTOFFS}
    curves = {
        "couette": "Couette part",
        "poiseuille": "Poiseuille part (sphere)",
        "sphere": "shear on the sphere (27a)",
        "substrate": "shear on the substrate",
        "sphere_pressure": "pressure on the sphere",
        "drag": "whole drag on the sphere",
    }
    for (name, label), colour, line in zip(curves.items(), OKABE_ITO, (*LINES, LINES[0]), strict=True):
        values = np.array([getattr(part, name) for part in splits])
        ax.semilogx(CUTOFFS, values, color=BLACK if name == "drag" else colour, ls=line, label=label)
        columns[f"{name} [(2 pi/3) G h0^2]"] = values
    for radius in (1.0, 2.0):
        ax.axvline(radius, color="0.8", lw=0.6, zorder=0)
    ax.set(
        xlabel=r"cut-off radius $\,/\,\sqrt{R|h_0|}$",
        ylabel=r"force $\,/\,(2\pi/3)\,G h_0^2$",
        xlim=(0.1, 15),
        ylim=(-0.07, 0.56),
    )
    ax.set_xticks([0.1, 0.3, 1, 2, 5, 15], ["0.1", "0.3", "1", "2", "5", "15"])
    ax.minorticks_off()
    ax.legend(frameon=False, loc="upper left", fontsize=6.5)
    ours = chosen(solutions, WIDE)
    whole = [friction.split(s, 2.0) for s in ours]
    beta = np.array([s.beta for s in ours])
    for name, label, marker, colour in (
        ("drag", "whole drag", "o", BLACK),
        ("substrate", "shear on the substrate", "s", OKABE_ITO[3]),
    ):
        other.semilogx(
            beta,
            [getattr(part, name) / part.sphere for part in whole],
            marker + "-",
            color=colour,
            ms=3.5,
            mfc="none" if marker == "s" else colour,
            label=f"{label} over (27a)",
        )
    other.axhline(1, color="0.6", lw=0.6, ls=":")
    other.set(xlabel=BETA, ylabel=r"force over $r\leq 2$ over (27a)", ylim=(0.9, 1.5))
    other.legend(frameon=False, loc="upper right")
    letters(axes[0])
    edge = [friction.split(s, float(s.fields.r[-1])) for s in ours]
    horizontal = max(abs(part.drag - part.substrate - part.edge_force) / part.drag for part in edge)
    vertical = max(friction.vertical_balance(s).imbalance for s in ours)
    at = {b: whole[WIDE.index(b)] for b in (100.0, 1000.0, 1e4)}
    table = {
        "beta": beta,
        **{f"{n} over r <= 2": [getattr(p, n) for p in whole] for n in curves},
        "horizontal imbalance, whole plane": [(p.drag - p.substrate - p.edge_force) / p.drag for p in edge],
        "elastic self-force over drag": [p.substrate_pressure / p.drag for p in edge],
        "vertical imbalance": [friction.vertical_balance(s).imbalance for s in ours],
    }
    return Drawn(
        figure,
        [Table("against-cutoff", columns), Table("against-beta", table)],
        [
            Statement(
                "The friction is the shear on the sphere (27a).",
                "the whole horizontal force on the sphere over r ≤ 2, pressure included, is "
                + ", ".join(f"{percent(part.drag / part.sphere)} at β = {b:g}" for b, part in at.items()),
                "0",
                percent(at[1000.0].drag / at[1000.0].sphere),
                "disagrees",
                "(27a) leaves out the horizontal component of the pressure, which is of the same order as the Poiseuille "
                "part. An experiment "
                "measures the whole force, which for the whole plane is the shear on the substrate plus the pressure on the "
                "film's edge.",
            ),
            Statement(
                "Horizontal forces on sphere and substrate balance.",
                f"largest imbalance over the whole plane {horizontal:.0e} of the drag, β = 10 … 10⁵",
                verdict="more",
            ),
            Statement(
                "Vertical forces balance.",
                f"load on the sphere against the load that the substrate's displacement feels: within {vertical:.0e}",
                verdict="more",
            ),
        ],
    )


@styled
def exponents(solutions: Solutions) -> Drawn:
    """Local exponents over the whole range, the paper's, and those of the Hertz limit."""
    ours = chosen(solutions, WIDE)
    figure, axes = canvas(TWO_COLUMNS, 3.2)
    ax = axes[0, 0]
    columns: dict[str, np.ndarray] = {}
    statements = []
    for law, colour, marker in zip(LAWS, OKABE_ITO, MARKERS, strict=False):
        comparison = compare(ours, law)
        columns.setdefault("beta", comparison.beta)
        columns[f"({law.equation}) {law.text}"] = comparison.exponents
        ax.semilogx(
            comparison.beta,
            comparison.exponents,
            marker + "-",
            color=colour,
            ms=3.5,
            label=f"({law.equation}) {SYMBOLS[law.equation]}",
        )
        ax.hlines(law.exponent, *PAPER_RANGE, color=colour, lw=2.2, alpha=0.35)
        if law.limit is not None:
            ax.plot(2.2e5, law.limit, marker, color=colour, ms=5, mfc="none", clip_on=False)
        last = f"{number(comparison.exponents[-1])} at β = 10⁵"
        statements.append(
            Statement(
                f"Exponent of ({law.equation}) as β → ∞.",
                last,
                "none" if law.limit is None else number(law.limit),
                "" if law.limit is None else number(comparison.exponents[-1] - law.limit, 2),
                "more",
                "No power of β in this limit (see Fig. 7)."
                if law.limit is None
                else "The exponent of the Hertz limit, not the paper's.",
            )
        )
    ax.text(2.2e5, 0.34, r"$\beta\to\infty$", ha="center", fontsize=7)
    ax.set(xlabel=BETA, ylabel=r"local exponent $d\ln(\cdot)\,/\,d\ln\beta$", xlim=(7, 3.5e5), ylim=(-1.0, 0.45))
    ax.set_xticks([10, 100, 1e3, 1e4, 1e5])
    ax.legend(frameon=False, loc="upper left", bbox_to_anchor=(0.02, 0.70), ncols=3)
    return Drawn(figure, [Table("exponents", columns)], statements)


def plain_ticks(axis, values: list[float]) -> None:
    """Few ticks with plain numbers on a logarithmic axis."""
    axis.set_ticks(values, [f"{value:g}" for value in values])
    axis.set_ticks([], minor=True)


@styled
def formulas(solutions: Solutions) -> Drawn:
    """Films in the parameters of Moes and of Hamrock & Dowson, beside their formulas."""
    ours = chosen(solutions, WIDE)
    beta_load = np.array([s.beta_load for s in ours])
    load = engineering.moes_load(beta_load)
    center, thinnest = (
        np.array([float(engineering.moes_film(float(s.quantities[name]), s.beta)) for s in ours])
        for name in ("film_center", "film_min")
    )
    moes = engineering.nijenbanning_venner_moes(load)
    figure, axes = canvas(TWO_COLUMNS, 3.1, 1, 2)
    ax, other = axes[0]
    ax.loglog(load, center, "o", color=OKABE_ITO[0], ms=4, label="centre, softlube")
    ax.loglog(load, moes, "-", color=OKABE_ITO[0], lw=0.9, label="centre, Nijenbanning et al.")
    ax.loglog(load, thinnest, "s", color=OKABE_ITO[1], ms=4, label="minimum, softlube")
    ax.set(xlabel=r"Moes' load $M$", ylabel=r"Moes' film $H=(h/R)(2U)^{-1/2}$", ylim=(0.1, 4))
    ax.legend(frameon=False, loc="lower left", fontsize=6.5)
    speed = float(np.sqrt(np.prod(engineering.SPEEDS_OF_HAMROCK_DOWSON)))
    w = load * (2 * speed) ** 0.75
    scale = np.sqrt(2 * speed)
    fine = np.geomspace(w[0], w[-1], 100)
    low, high = engineering.LOADS_OF_HAMROCK_DOWSON
    other.loglog(w, center * scale, "o", color=OKABE_ITO[0], ms=4, label="centre, softlube")
    other.loglog(
        fine, engineering.hamrock_dowson_center(speed, fine), "-", color=OKABE_ITO[0], lw=0.9, label="centre, Hamrock & Dowson"
    )
    other.loglog(w, thinnest * scale, "s", color=OKABE_ITO[1], ms=4, label="minimum, softlube")
    other.loglog(
        fine, engineering.hamrock_dowson_min(speed, fine), "--", color=OKABE_ITO[1], lw=0.9, label="minimum, Hamrock & Dowson"
    )
    other.axvspan(low, high, color="0.92", zorder=0)
    exponent = int(np.floor(np.log10(speed)))
    other.set(
        xlabel=rf"load $W$ at $U = {speed / 10**exponent:.2g}\times10^{{{exponent}}}$", ylabel=r"film $H = h/R$  [$10^{-4}$]"
    )
    other.legend(frameon=False, loc="lower left", fontsize=6.5)
    plain_ticks(ax.yaxis, [0.1, 0.2, 0.5, 1, 2])
    other.set_yticks([5e-5, 1e-4, 2e-4], ["$0.5$", "$1$", "$2$"])
    other.minorticks_off()
    letters(axes[0])
    inside = (w >= low) & (w <= high)
    hd_center, hd_min = engineering.hamrock_dowson_center(speed, w), engineering.hamrock_dowson_min(speed, w)
    ratio = center / moes
    table = {
        "beta by the load": beta_load,
        "M": load,
        "H center, softlube": center,
        "H center, Nijenbanning et al.": moes,
        "H minimum, softlube": thinnest,
        f"W at U = {speed:.3g}": w,
        "h/R center, Hamrock & Dowson": hd_center,
        "h/R minimum, Hamrock & Dowson": hd_min,
        "h/R center, softlube": center * scale,
        "h/R minimum, softlube": thinnest * scale,
    }

    def span(values: np.ndarray) -> str:
        return f"{percent(float(values.min()))} … {percent(float(values.max()))}"

    return Drawn(
        figure,
        [Table("formulas", table)],
        [
            Statement(
                f"{engineering.NIJENBANNING_VENNER_MOES.reference}. Range: {engineering.NIJENBANNING_VENNER_MOES.range}.",
                f"our centre film over theirs: {span(ratio)} for M = {load[0]:.0f} … {load[-1]:.0f}",
                verdict="more",
                remark="Both tend to M^(−2/15), which is β^(−3/5).",
            ),
            Statement(
                f"{engineering.HAMROCK_DOWSON.reference}. Range: {engineering.HAMROCK_DOWSON.range} (grey).",
                f"within it, over theirs: centre {span((center * scale / hd_center)[inside])}, minimum "
                f"{span((thinnest * scale / hd_min)[inside])}",
                verdict="more",
                remark="Over the whole of our range: "
                f"centre {span(center * scale / hd_center)}, minimum {span(thinnest * scale / hd_min)}; their exponents do "
                f"not keep the similarity in M.",
            ),
        ],
    )


def picture(solutions: Solutions) -> Drawn:
    """The README's picture: film and pressure under a ball on rubber."""
    solution = solutions[CONTACT]
    quantities = solution.dimensional
    table = {
        "quantity": list(quantities),
        "value": [float(q) for q in quantities.values()],
        "error": [q.error for q in quantities.values()],
        "unit": [q.unit or "1" for q in quantities.values()],
    }
    return Drawn(plot(solution), [Table("quantities", table)])


FIGURES = (
    FigureSpec(
        "friction",
        "Friction in its parts",
        "Forces over r ≤ cut-off at β = 1000 (a), and what they are relative to (27a) over r ≤ 2 (b).",
        reynolds(WIDE),
        parts,
    ),
    FigureSpec(
        "exponents",
        "Local exponents",
        "Local exponents of the quantities of the paper's laws; bands: the paper's exponents over its range; open symbols: "
        "the Hertz limit.",
        reynolds(WIDE),
        exponents,
    ),
    FigureSpec(
        "formulas",
        "Engineering formulas",
        "Film against load in Moes' parameters (a) and in those of Hamrock & Dowson at one speed (b; grey: their range of "
        "load).",
        reynolds(WIDE),
        formulas,
    ),
    FigureSpec(
        "contact",
        "A ball on rubber",
        "Film and pressure under a 2 mm glass ball sliding at 0.1 mm/s over PDMS (E = 3 MPa) in an oil of 2 Pa s under 100 mN.",
        (CONTACT,),
        picture,
    ),
)
