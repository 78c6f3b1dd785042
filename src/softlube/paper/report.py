"""The report of `softlube reproduce`: one self-contained HTML page."""

from __future__ import annotations

import base64
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from softlube.paper.figures.base import Statement, number
from softlube.steady.solution import Solution
from softlube.theory.scaling import LAWS, PAPER_RANGE, compare

if TYPE_CHECKING:
    from markupsafe import Markup


@dataclass(frozen=True)
class Section:
    """One figure in the report."""

    key: str
    heading: str
    caption: str
    picture: Path
    tables: tuple[str, ...]
    statements: tuple[Statement, ...]


@dataclass(frozen=True)
class Law:
    """One scaling law: the paper's and ours over the same range, with what lies beyond.

    Attributes
    ----------
    equation, text : str
    paper_prefactor, paper_exponent : float
    prefactor, exponent, exponent_low, exponent_high : float
        Our fit and the 95 % confidence interval of its exponent.
    largest_ratio, largest_ratio_at : float
        Our value over the paper's law where they are farthest apart within the range.
    local_exponent_low, local_exponent_high : float
        Local exponents at the ends of the range.
    limit_exponent : float or None
        Exponent for β → ∞.
    """

    equation: str
    text: str
    paper_prefactor: float
    paper_exponent: float
    prefactor: float
    exponent: float
    exponent_low: float
    exponent_high: float
    largest_ratio: float
    largest_ratio_at: float
    local_exponent_low: float
    local_exponent_high: float
    limit_exponent: float | None


def law_table(solutions: Sequence[Solution]) -> tuple[Law, ...]:
    """The paper's laws beside fits to our solutions over the paper's range."""
    rows = []
    for law in LAWS:
        comparison = compare(solutions, law)
        where, ratio = comparison.largest_ratio()
        local = {b: float(e) for b, e in zip(comparison.beta, comparison.exponents, strict=True)}
        rows.append(
            Law(
                equation=law.equation,
                text=law.text,
                paper_prefactor=law.prefactor,
                paper_exponent=law.exponent,
                prefactor=comparison.fit.prefactor,
                exponent=comparison.fit.exponent,
                exponent_low=comparison.fit.exponent_interval[0],
                exponent_high=comparison.fit.exponent_interval[1],
                largest_ratio=ratio,
                largest_ratio_at=where,
                local_exponent_low=local[PAPER_RANGE[0]],
                local_exponent_high=local[PAPER_RANGE[1]],
                limit_exponent=law.limit,
            )
        )
    return tuple(rows)


def _embedded(picture: Path) -> str:
    return "data:image/png;base64," + base64.b64encode(picture.read_bytes()).decode("ascii")


def _powers(text: str) -> Markup:
    """A text for HTML whose powers, written β^(−3/5), stand as superscripts."""
    from markupsafe import Markup, escape

    return Markup(re.sub(r"\^(?:\(([^()]*)\)|([−-]?[0-9/.]+|[a-z]+\b))", r"<sup>\1\2</sup>", str(escape(text))))


def write_report(path: Path, sections: Sequence[Section], laws: Sequence[Law], cases: int, seconds: float) -> None:
    """Write report.html: everything it shows is in it, so that it opens anywhere and without a network.

    Parameters
    ----------
    path : Path
        Where to.
    sections : sequence of Section
        Their pictures are read from disk.
    laws : sequence of Law
        The first table; may be empty.
    cases : int
        Number of contacts solved.
    seconds : float
        How long it all took.
    """
    from importlib.metadata import version

    from jinja2 import Environment, PackageLoader, StrictUndefined

    from softlube.files.writing import write_whole

    environment = Environment(
        loader=PackageLoader("softlube.paper"), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"embedded": _embedded, "number": number, "powers": _powers}
    counts = {verdict: sum(s.verdict == verdict for section in sections for s in section.statements) for verdict in VERDICTS}
    page = environment.get_template("report.html.jinja").render(
        sections=sections,
        laws=laws,
        cases=cases,
        seconds=seconds,
        version=version("softlube"),
        verdicts=VERDICTS,
        counts=counts,
    )
    write_whole({path: page.encode()})


VERDICTS = {"agrees": "agrees", "disagrees": "differs", "more": "not in the paper"}
