"""Tables of values with their errors, as the commands print them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from softlube.model.quantities import DERIVED, SPIKE, STEADY
from softlube.physical.units import prefixed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rich.table import Table

    from softlube.model.problem import Problem
    from softlube.model.quantities import Quantity


def rounded(value: float, error: float) -> tuple[str, str]:
    """Value and error as text, the value cut at the second significant digit of the error."""
    if math.isnan(value):
        return "none", "-"
    if not (math.isfinite(error) and error > 0):
        return f"{value:.6g}", "0" if error == 0 else "unknown"
    digits = 1 - math.floor(math.log10(error))
    if abs(value) >= 1e6 or digits > 9:
        relative = max(0, math.floor(math.log10(abs(value))) + digits) if value else 0
        return f"{value:.{min(relative, 12)}e}", f"{error:.2g}"
    return f"{value:.{max(digits, 0)}f}", f"{error:.2g}"


def engineering(quantity: Quantity) -> tuple[str, str, str]:
    """Value, error and unit of an SI quantity with the prefix that suits it."""
    value, unit, factor = float(quantity), quantity.unit, 1.0
    if unit in ("m", "N", "Pa", "Pa/m") and not math.isnan(value):
        factor, unit = prefixed(value, unit)
    return *rounded(value * factor, quantity.error * factor), unit


def empty_table() -> Table:
    """A table for quantities, their values, errors and units."""
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for column in ("quantity", "value", "± error", "unit"):
        table.add_column(column, no_wrap=True, justify="right" if column == "value" else "left")
    return table


def solution_table(problem: Problem, quantities: Mapping[str, Quantity], dimensional: Mapping[str, Quantity]) -> Table:
    """Every quantity of a solution, in SI if it has them."""
    table = empty_table()

    def row(text: str, value: str, error: str, unit: str) -> None:
        table.add_row(text, value, f"± {error}", unit)

    physical = bool(dimensional)
    unit_of_height = "δ" if problem.load_controlled else "|h0|"
    if physical:
        radius = DERIVED["contact_radius"]
        row(DERIVED["indentation"].words, *engineering(dimensional["indentation"]))
        if "contact_radius" in dimensional:
            row(radius.words, *engineering(dimensional["contact_radius"]))
    for name, definition in (STEADY | SPIKE).items():
        if name not in quantities:
            continue
        quantity = quantities[name]
        if name == "height" and (physical or not problem.load_controlled):
            continue  # the input, or the indentation above
        unit = definition.unit.formula.format(unit_of_height)
        if definition.place:
            where = dimensional.get(name)  # an angle is no SI value
            shown = rounded(float(quantity), quantity.error)
            row(f"  {definition.place}", *((*shown, unit.split(" = ")[0]) if where is None else engineering(where)))
        elif physical:
            row(definition.words, *engineering(dimensional[name]))
        else:
            row(definition.words, *rounded(float(quantity), quantity.error), unit)
    if physical:
        row(DERIVED["friction_coefficient"].words, *engineering(dimensional["friction_coefficient"]))
    return table
