"""Tables of values with their errors, as the commands print them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from softlube.physical.units import prefixed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rich.table import Table

    from softlube.model.problem import Problem
    from softlube.model.quantities import Quantity

DIMENSIONLESS_UNIT = {
    "load": "4πG {0} a",
    "film": "{0}",
    "height": "{0}",
    "pressure": "4πG a/R",
    "friction": "(2π/3)G {0}²",
    "boundary_layer": "a = √(R {0})",
    "shear_rate_max": "v/{0}",
    "spike_pressure": "4πG a/R",
    "spike_radius": "a = √(R {0})",
    "pressure_gradient_inlet": "4πG/R",
}
"""Units of a solution without physical input; {0} is the unit of height."""


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
    from softlube.discretization.measure import DESCRIPTION
    from softlube.steady.spike.detection import DESCRIPTION as SPIKE

    table = empty_table()

    def row(text: str, value: str, error: str, unit: str) -> None:
        table.add_row(text, value, f"± {error}", unit)

    physical = bool(dimensional)
    unit = "δ" if problem.load_controlled else "|h0|"
    if physical:
        row("indentation", *engineering(dimensional["indentation"]))
        row(f"contact radius a = √(R {unit})", *engineering(dimensional["contact_radius"]))
    for name, text in (DESCRIPTION | SPIKE).items():
        if name not in quantities:
            continue
        quantity = quantities[name]
        if name == "height" and (physical or not problem.load_controlled):
            continue  # the input, or the indentation above
        if name in ("film_min_radius", "film_min_angle_deg"):
            place = "  at a radius of" if name == "film_min_radius" else "  at an angle from the inlet of"
            row(place, *rounded(float(quantity), quantity.error), "a" if name == "film_min_radius" else "°")
        elif physical:
            row(text, *engineering(dimensional[name]))
        else:
            group = name if name in DIMENSIONLESS_UNIT else name.split("_")[0]
            row(text, *rounded(float(quantity), quantity.error), DIMENSIONLESS_UNIT[group].format(unit))
    if physical:
        row("friction coefficient over r ≤ 2a", *engineering(dimensional["friction_coefficient"]))
    return table
