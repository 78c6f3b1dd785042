"""The paper's figures, those of its supporting information, and some beyond: one function each, all in `FIGURES`."""

from __future__ import annotations

from softlube.paper.figures import beyond, condition, film, laws, pressure, velocity
from softlube.paper.figures.base import Case, Drawn, FigureSpec, Statement, Table

_ALL = {spec.key: spec for module in (pressure, laws, film, velocity, condition, beyond) for spec in module.FIGURES}
ORDER = (
    "5",
    "6",
    "7",
    "8",
    "9",
    "10",
    "11",
    "12",
    "13",
    "S1",
    "S2",
    "S3",
    "flow",
    "friction",
    "exponents",
    "formulas",
    "contact",
)
FIGURES: dict[str, FigureSpec] = {key: _ALL[key] for key in ORDER}
"""Every figure by its key, in the order of the report."""

__all__ = ["FIGURES", "Case", "Drawn", "FigureSpec", "Statement", "Table"]
