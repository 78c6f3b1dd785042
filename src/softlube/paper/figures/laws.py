"""Figs. 7, 10, 12 and 13: quantities against β, beside the paper's laws."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from softlube.model.exact import HERTZ_LOAD
from softlube.paper.figures.base import (
    BETA,
    BLACK,
    FILM,
    GREY,
    OKABE_ITO,
    ONE_COLUMN,
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
from softlube.paper.figures.pressure import load_statement
from softlube.theory.scaling import (
    BOUNDARY_LAYER,
    FILM_CENTER,
    FILM_MIN,
    FRICTION,
    GRADIENT,
    PAPER_RANGE,
    Comparison,
    asymptote,
    compare,
    fit,
    friction_reading,
)


def law_statements(comparison: Comparison, remark: str = "", tolerance: float = 0.02) -> list[Statement]:
    """Exponent and prefactor of a law, ours beside the paper's, and the largest distance."""
    law, ours = comparison.law, comparison.fit
    where, ratio = comparison.largest_ratio()
    interval = f"{number(ours.exponent_interval[0])} … {number(ours.exponent_interval[1])}"
    differs = abs(comparison.exponent_difference) > tolerance
    bends = (
        f"Our local exponent runs from {number(comparison.exponents[np.argmin(np.abs(comparison.beta - PAPER_RANGE[0]))])} "
        f"at β = 100 to "
        f"{number(comparison.exponents[np.argmin(np.abs(comparison.beta - PAPER_RANGE[1]))])} at 10⁴."
    )
    at_1000 = float(ours(1000.0) / law(1000.0))
    return [
        Statement(
            f"({law.equation}) exponent: {law.text}",
            f"{number(ours.exponent)} ({interval})",
            number(law.exponent),
            f"{comparison.exponent_difference:+.4f}".replace("-", "−"),
            "disagrees" if differs else "agrees",
            f"{bends} {remark}".strip(),
        ),
        Statement(
            f"({law.equation}) prefactor, and the fits at β = 1000",
            f"{number(ours.prefactor)}; {number(float(ours(1000.0)))}",
            f"{number(law.prefactor)}; {number(float(law(1000.0)))}",
            f"{percent(ours.prefactor / law.prefactor)}; {percent(at_1000)}",
            "agrees" if abs(at_1000 - 1) < 0.05 else "disagrees",
            remark="A prefactor is the value extrapolated to β = 1; within the range the laws are much closer.",
        ),
        Statement(
            f"({law.equation}) over 100 ≤ β ≤ 10⁴, farthest from our solutions",
            f"{percent(ratio)} at β = {where:g}",
            verdict="agrees" if abs(ratio - 1) < 0.06 else "disagrees",
            remark="" if abs(ratio - 1) < 0.06 else "A power law cannot follow the bend over two decades.",
        ),
    ]


def _draw_law(ax, comparison: Comparison, colour: str, marker: str, label: str) -> None:
    beta = np.geomspace(comparison.beta[0], comparison.beta[-1], 200)
    inside = (beta >= PAPER_RANGE[0]) & (beta <= PAPER_RANGE[1])
    ax.loglog(comparison.beta, comparison.values, marker, color=colour, ms=4, label=label, zorder=3)
    law = comparison.law
    ax.loglog(beta[inside], law(beta[inside]), "-", color=BLACK, lw=1.0, label=f"paper ({law.equation})")
    ax.loglog(beta, law(beta), ":", color=BLACK, lw=0.7)
    limit = asymptote(law.quantity)
    if limit is not None:
        ax.loglog(beta, limit(beta) / law.unit, "--", color=GREY, lw=0.8, label=r"$\beta\to\infty$")
    ax.set(xlabel=BETA)


def _table(name: str, *comparisons: Comparison) -> Table:
    columns: dict[str, np.ndarray] = {"beta": comparisons[0].beta}
    for comparison in comparisons:
        law = comparison.law
        columns[f"({law.equation}) {law.text}"] = comparison.values
        columns[f"({law.equation}) paper"] = law(comparison.beta)
        columns[f"({law.equation}) local exponent"] = comparison.exponents
        limit = asymptote(law.quantity)
        if limit is not None:
            columns[f"({law.equation}) Hertz limit"] = limit(comparison.beta) / law.unit
    return Table(name, columns)


@styled
def gradient_and_layer(solutions: Solutions) -> Drawn:
    """Fig. 7: largest inlet gradient and boundary layer."""
    ours = chosen(solutions, WIDE)
    gradient, layer = compare(ours, GRADIENT), compare(ours, BOUNDARY_LAYER)
    figure, axes = canvas(TWO_COLUMNS, 2.7, 1, 2)
    _draw_law(axes[0, 0], gradient, OKABE_ITO[0], "o", "softlube")
    _draw_law(axes[0, 1], layer, OKABE_ITO[0], "o", "softlube")
    axes[0, 0].set(ylabel=r"$|\partial p/\partial r|_{\max}\sqrt{R|h_0|}\,/\,p_H(0)$", ylim=(0.5, 10))
    axes[0, 1].set(ylabel=r"boundary layer $\delta\,/\,\sqrt{R|h_0|}$", ylim=(5e-3, 3))
    axes[0, 0].legend(frameon=False, loc="upper left")
    axes[0, 1].legend(frameon=False, loc="upper right")
    letters(axes[0])
    printed = float(ours[6].quantities["pressure_gradient_inlet"]) / float(GRADIENT(ours[6].beta))
    over_max = float(ours[6].quantities["pressure_gradient_inlet"] / ours[6].quantities["pressure_max"])
    return Drawn(
        figure,
        [_table("laws", gradient, layer)],
        [
            *law_statements(gradient),
            Statement(
                "(20) is printed for p̄, normalised by 4πG√(|h₀|/R).",
                f"our gradient over (20) at β = {ours[6].beta:g}: {printed:.4f} for p̄, {gradient.ratios[6]:.4f} for p over "
                f"the Hertz "
                f"maximum 2/π², {over_max / float(GRADIENT(ours[6].beta)):.4f} for p over its own maximum",
                "1",
                percent(printed),
                "disagrees",
                "(20) holds for the pressure over the Hertz maximum p_H(0), at every β from 100 to 10⁴ within 1.5 %; as "
                "printed it would be "
                "wrong by the factor π²/2 = 4.9.",
            ),
            *law_statements(
                layer,
                "The 5 % level of the maximum pressure is no place of the layer's own scale: it moves through the layer as β "
                "grows and ends "
                "at r = 0.99875, where Hertz's pressure has that value. So δ is no power of β, and an exponent depends on "
                "the range: "
                f"over 100 ≤ β ≤ 1000 ours is {number(fit(layer.beta, layer.values, between=(100, 1000)).exponent)}.",
            ),
        ],
    )


@styled
def films(solutions: Solutions) -> Drawn:
    """Fig. 10: film at the centre and minimum film."""
    ours = chosen(solutions, WIDE)
    center, thinnest = compare(ours, FILM_CENTER), compare(ours, FILM_MIN)
    figure, axes = canvas(ONE_COLUMN, 2.9)
    ax = axes[0, 0]
    _draw_law(ax, center, OKABE_ITO[0], "o", r"$u(0)$")
    _draw_law(ax, thinnest, OKABE_ITO[1], "s", r"$\min u$")
    ax.set(ylabel=FILM)
    ax.legend(frameon=False, loc="lower left")
    return Drawn(figure, [_table("laws", center, thinnest)], [*law_statements(center), *law_statements(thinnest)])


@styled
def friction_and_load(solutions: Solutions) -> Drawn:
    """Fig. 12: friction over r ≤ 1 and r ≤ 2, and load, against β."""
    ours = chosen(solutions, WIDE)
    drag = compare(ours, FRICTION)
    contact = np.array([float(s.quantities["friction_contact"]) for s in ours])
    load = np.array([float(s.quantities["load"]) for s in ours])
    figure, axes = canvas(TWO_COLUMNS, 2.8, 1, 2)
    ax, other = axes[0]
    _draw_law(ax, drag, OKABE_ITO[0], "o", r"$F$ over $r\leq 2$")
    ax.loglog(drag.beta, contact, "s", color=OKABE_ITO[1], ms=3.5, mfc="none", label=r"$F$ over $r\leq 1$")
    over_contact = asymptote("friction_contact")
    if over_contact is not None:
        ax.loglog(drag.beta, over_contact(drag.beta), "--", color=GREY, lw=0.8, label=r"$\beta\to\infty$, $r\leq 1$")
    ax.set(ylabel=r"friction $F\,/\,(2\pi/3)\,G h_0^2$")
    ax.legend(frameon=False, loc="lower left")
    other.semilogx(drag.beta, load, "o-", color=OKABE_ITO[2], ms=3.5, label="softlube")
    other.axhline(HERTZ_LOAD, ls=":", color=BLACK, lw=1.0, label=r"Hertz, $4/(3\pi)$")
    other.set(xlabel=BETA, ylabel=r"load $N\,/\,4\pi G|h_0|\sqrt{R|h_0|}$", ylim=(0, 0.85))
    other.legend(frameon=False, loc="upper right")
    letters(axes[0])
    readings = [
        friction_reading(ours, cutoff, by_load=by_load, between=between)
        for between in (PAPER_RANGE, (500.0, 1e4))
        for by_load in (False, True)
        for cutoff in (1.0, 1.3, 1.5, 2.0, 2.5, 3.0)
    ]
    whole = {(r.cutoff, r.by_load): r for r in readings[:12]}
    upper = {(r.cutoff, r.by_load): r for r in readings[12:]}
    base = _table("laws", drag)
    columns = dict(base.columns) | {"friction over r <= 1": contact, "load": load}
    table = {
        "cutoff [sqrt(R|h0|)]": [r.cutoff for r in readings],
        "beta and unit of force by": ["load" if r.by_load else "h0" for r in readings],
        "from beta": [100.0] * 12 + [500.0] * 12,
        "prefactor": [r.fit.prefactor for r in readings],
        "exponent": [r.fit.exponent for r in readings],
        "largest |F/(28) - 1|": [r.deviation for r in readings],
    }
    best = whole[2.0, True]
    return Drawn(
        figure,
        [Table("laws", columns), Table("readings", table)],
        [
            *law_statements(
                drag,
                f"Over the upper part of the range, 500 ≤ β ≤ 10⁴, ours is {number(upper[2.0, False].fit.exponent)}; with β "
                f"and the "
                f"indentation by the load (29, 30) it is {number(best.fit.exponent)} over the whole range.",
                tolerance=0.015,
            ),
            Statement(
                "(27a), and so (28), is over r ≤ 1.",
                f"largest distance from (28) for 500 ≤ β ≤ 10⁴: {100 * upper[1.0, False].deviation:.1f} % over r ≤ 1, "
                f"{100 * upper[2.0, False].deviation:.1f} % over r ≤ 2, {100 * upper[3.0, False].deviation:.1f} % over r ≤ 3",
                "r ≤ 1",
                "r ≤ 2",
                "disagrees",
                "(28) is the friction over r ≤ 2, the paper's whole domain. It lies above the friction over r ≤ 1 at every β "
                "of the "
                f"range, and the exponent over r ≤ 1 would be {number(whole[1.0, False].fit.exponent)}.",
            ),
            Statement(
                "(28) with β and the indentation by the load, as (29), (30) and Fig. 13 use it, over r ≤ 2 and 100 ≤ β ≤ 10⁴",
                f"{number(best.fit.prefactor)} β^({number(best.fit.exponent)}), within {100 * best.deviation:.1f} % of (28)",
                "4.806 β^(−0.4398)",
                f"{best.fit.exponent - FRICTION.exponent:+.4f}".replace("-", "−"),
                remark=f"At fixed depth the distance reaches {100 * whole[2.0, False].deviation:.0f} % at β = 100. A region "
                f"r ≤ 1.3 at "
                f"fixed depth would fit as well ({100 * whole[1.3, False].deviation:.1f} %), but nothing in the paper "
                f"suggests it.",
            ),
            load_statement(solutions),
        ],
    )


@styled
def experiments(solutions: Solutions, data: Path | None = None) -> Drawn:
    """Fig. 13: master curve of the friction in the units of the load, with measured points if given."""
    from softlube.paper.figures.measured import read_friction

    ours = chosen(solutions, WIDE)
    beta_load = np.array([s.beta_load for s in ours])
    # In units of the load, with the Hertz indentation δ for |h₀|: (|h₀|/δ)² = β/β_load.
    ratio = np.array([s.beta for s in ours]) / beta_load
    master = {cutoff: ratio * np.array([s.friction_within(cutoff) for s in ours]) for cutoff in (1.0, 2.0)}
    figure, axes = canvas(ONE_COLUMN, 3.0)
    ax = axes[0, 0]
    inside = np.geomspace(*PAPER_RANGE, 100)
    ax.loglog(beta_load, master[2.0], "-", color=OKABE_ITO[0], label=r"softlube, $r\leq 2$")
    ax.loglog(beta_load, master[1.0], "--", color=OKABE_ITO[1], label=r"softlube, $r\leq 1$")
    ax.loglog(inside, FRICTION(inside), ":", color=BLACK, label="paper (28)")
    tables = [
        Table("theory", {"beta by the load (30)": beta_load, "friction r <= 2": master[2.0], "friction r <= 1": master[1.0]})
    ]
    statements = [
        Statement(
            "(28) is the theory of Fig. 13, with β from the load by (30).",
            "over r ≤ 2, in units of the Hertz indentation: "
            + ", ".join(
                f"{percent(f / float(FRICTION(b)))} at β_load = {b:.3g}"
                for b, f in zip(beta_load, master[2.0], strict=True)
                if 90 < b < 1.2e4
            ),
            remark="At constant load the depth |h₀| is less than Hertz's at small β, which (29) neglects.",
        )
    ]
    if data is not None:
        measured = read_friction(data)
        ax.loglog(measured.beta, measured.friction, "o", color=GREY, ms=3, mfc="none", label="measured", zorder=1)
        theory = np.exp(np.interp(np.log(measured.beta), np.log(beta_load), np.log(master[2.0])))
        tables.append(
            Table("measured", {"beta by the load (30)": measured.beta, "friction": measured.friction, "theory r <= 2": theory})
        )
        spread = np.log(measured.friction / theory)
        statements.append(
            Statement(
                f"{measured.beta.size} measured points against the curve over r ≤ 2.",
                f"mean {percent(float(np.exp(spread.mean())))}, scatter ±{100 * float(np.std(spread)):.0f} %",
                verdict="more",
            )
        )
    ax.set(xlabel=r"$\beta$ by the load (30)", ylabel=r"friction $F\,/\,(2\pi/3)\,G\delta^2$")
    ax.legend(frameon=False, loc="lower left")
    return Drawn(figure, tables, statements)


_WIDE = tuple(Case(beta) for beta in WIDE)

FIGURES = (
    FigureSpec(
        "7",
        "Largest inlet gradient and boundary layer",
        "Largest pressure gradient on the inlet axis, over p_H(0) (a), and thickness of the inlet boundary layer (b). Line: "
        "the paper's law, "
        "dotted outside its range.",
        _WIDE,
        gradient_and_layer,
    ),
    FigureSpec(
        "10", "Centre and minimum film", "Film at the centre and minimum film, with the paper's laws (22a, b).", _WIDE, films
    ),
    FigureSpec(
        "12",
        "Friction and load",
        "Friction on the sphere over two regions, with (28) (a), and load with Hertz's (b).",
        reynolds(WIDE),
        friction_and_load,
    ),
    FigureSpec(
        "13",
        "Master curve for experiments",
        "Friction against β, both by the load, as an experiment under a given load has them; measured points if given with "
        "--data.",
        reynolds(WIDE),
        experiments,
    ),
)
