"""What an object says of itself in a console and in a notebook: a line, and a small table of texts.

The command line prints the rows of the same tables.
"""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from softlube.model.prefixes import prefixed
from softlube.model.quantities import DERIVED, HYSTERESIS, QUANTITIES, SPIKE, STEADY, THINNING, Quantity, header

if TYPE_CHECKING:
    import pandas

    from softlube.model.problem import Problem

Array = NDArray[np.floating]
Row = tuple[str, ...]

QUANTITY_COLUMNS = ("quantity", "value", "± error", "unit")
"""Heads of a table of quantities."""
MOST_ROWS = 13
"""Rows of a table that has one for every case, speed or time; the others are left out."""
_STYLE = ".softlube td,.softlube th{text-align:left}.softlube .n{text-align:right}"


@dataclass(frozen=True, repr=False)
class Summary:
    """A table of texts with a line above it and notes below; a notebook shows it as HTML, ``print`` as text.

    Attributes
    ----------
    title : str
        A line that stands alone.
    header : tuple of str
        Heads of the columns.
    rows : tuple of tuple of str
        A text for each column.
    notes : tuple of str
        Sentences without their full stop: warnings, and what is left out.
    """

    title: str
    header: Row
    rows: tuple[Row, ...]
    notes: tuple[str, ...] = ()

    @property
    def numeric(self) -> tuple[bool, ...]:
        """Which columns hold numbers, and stand flush right."""
        return tuple(all(_is_number(row[column]) for row in self.rows) for column in range(len(self.header)))

    def __str__(self) -> str:
        widths = [max(len(row[column]) for row in (self.header, *self.rows)) for column in range(len(self.header))]
        lines = [
            "  ".join(
                cell.rjust(width) if flush else cell.ljust(width)
                for cell, width, flush in zip(row, widths, self.numeric, strict=True)
            ).rstrip()
            for row in (self.header, *self.rows)
        ]
        return "\n".join([self.title, *lines, *(f"{note}." for note in self.notes)])

    def __repr__(self) -> str:
        return str(self)

    def _repr_html_(self) -> str:
        def line(row: Row, tag: str) -> str:
            cells = (
                f"<{tag}{' class=n' if flush else ''}>{html.escape(cell, quote=False).replace('  ', '&emsp;')}</{tag}>"
                for cell, flush in zip(row, self.numeric, strict=True)
            )
            return f"<tr>{''.join(cells)}</tr>"

        rows = "".join(line(row, "td") for row in self.rows)
        notes = "".join(f"<p>{_escaped(note)}.</p>" for note in self.notes)
        return (
            f"<div class=softlube><style>{_STYLE}</style><b>{_escaped(self.title)}</b>"
            f"<table><thead>{line(self.header, 'th')}</thead><tbody>{rows}</tbody></table>{notes}</div>"
        )


class Summarised:
    """An object that shows a line in a console and a table in a notebook."""

    @property
    def headline(self) -> str:
        """What it is and what matters most of it, in a line."""
        raise NotImplementedError

    def summary(self) -> Summary:
        """What it holds as a table of texts: numbers with their errors, rounded, in SI if the input was physical."""
        raise NotImplementedError

    def to_dataframe(self) -> pandas.DataFrame:
        """What it holds as a table of numbers, not rounded, in SI if the input was physical."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"<{self.headline}>"

    def _repr_html_(self) -> str:
        return self.summary()._repr_html_()


class FunctionOfBeta(Summarised):
    """Functions of β with their errors, which show some of their values."""

    def _range(self) -> tuple[float, float]:
        """Least and greatest β of what is known."""
        raise NotImplementedError

    def _values(self, beta: Array) -> dict[str, tuple[Array, Array]]:
        """Value and absolute error of each function by its name."""
        raise NotImplementedError

    @property
    def headline(self) -> str:
        """Names of the functions, and the range of β."""
        low, high = self._range()
        return f"{type(self).__name__}: {', '.join(self._values(np.array([low])))} from beta {low:.4g} to {high:.4g}"

    def summary(self) -> Summary:
        """Values with their errors at some β, equally far apart in ln β."""
        beta = np.geomspace(*self._range(), MOST_ROWS)
        found = self._values(beta)
        rows = [
            (f"{place:.4g}", *(" ± ".join(rounded(float(value[k]), float(error[k]))) for value, error in found.values()))
            for k, place in enumerate(beta)
        ]
        return Summary(self.headline, ("beta", *found), tuple(rows))

    def to_dataframe(self, points: int = 61) -> pandas.DataFrame:
        """A row for each of some β, equally far apart in ln β: every function with its error.

        Parameters
        ----------
        points : int
            Number of rows.
        """
        import pandas as pd

        beta = np.geomspace(*self._range(), points)
        columns = {"beta": beta}
        for name, (value, error) in self._values(beta).items():
            columns |= {header(name): value, header(name, error=True): error}
        return pd.DataFrame(columns)


def _escaped(text: str) -> str:
    """A text for HTML, which keeps an indentation of two spaces."""
    return html.escape(text, quote=False).replace("  ", "&emsp;")


def _is_number(cell: str) -> bool:
    return cell in ("none", "-") or cell[:1].isdigit() or (cell[:1] in "+-." and cell[1:2].isdigit())


def spread(count: int, most: int = MOST_ROWS) -> list[int]:
    """Rows to show of many: all, or some that are equally far apart, with the first and the last.

    Examples
    --------
    >>> spread(3), spread(101, 5)
    ([0, 1, 2], [0, 25, 50, 75, 100])
    """
    return list(range(count)) if count <= most else [round(step * (count - 1) / (most - 1)) for step in range(most)]


# --- quantities as texts ----------------------------------------------------------------------------------------------


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
    if unit in ("m", "N", "N/m", "Pa", "Pa/m") and not math.isnan(value):
        factor, unit = prefixed(value, unit)
    return *rounded(value * factor, quantity.error * factor), unit


def in_words(name: str, quantity: Quantity) -> str:
    """A quantity with its error, for a line: "film_min 104.5 ± 0.2 nm"."""
    value, error, unit = engineering(quantity)
    return f"{name} {value} ± {error} {unit}".rstrip()


def row(words: str, value: str, error: str, unit: str) -> Row:
    """A line of a table of quantities."""
    return words, value, f"± {error}", unit


def rows_at_the_end(quantities: Mapping[str, Quantity]) -> list[Row]:
    """A line for each quantity of a film in time.

    An error that is no more than the integrator's rounding counts as none.
    """
    lines = []
    for name, quantity in quantities.items():
        factor, unit = prefixed(float(quantity), quantity.unit)
        value, error = float(quantity) * factor, quantity.error * factor
        lines.append(row(QUANTITIES[name].words, *rounded(value, error if error > 1e-9 * abs(value) else 0.0), unit))
    return lines


def steady_rows(problem: Problem, quantities: Mapping[str, Quantity], dimensional: Mapping[str, Quantity]) -> list[Row]:
    """A line for every quantity of a solution, in SI if it has them.

    Parameters
    ----------
    problem : Problem
        What was solved.
    quantities : mapping of str to Quantity
        Normalised with what the problem prescribes.
    dimensional : mapping of str to Quantity
        In SI; empty for a dimensionless problem.
    """
    lines, physical = [], bool(dimensional)
    unit_of_height = "δ" if problem.load_controlled else "|h0|"
    for name in ("indentation", "contact_radius"):
        if name in dimensional:
            lines.append(row(DERIVED[name].words, *engineering(dimensional[name])))
    for name, definition in (STEADY | SPIKE | HYSTERESIS | THINNING).items():
        if name not in quantities:
            continue
        quantity = quantities[name]
        if name == "height" and (physical or not problem.load_controlled):
            continue  # the input, or the indentation above
        unit = definition.unit.formula.format(unit_of_height)
        if definition.place:
            where = dimensional.get(name)  # an angle is no SI value
            shown = rounded(float(quantity), quantity.error)
            place = (*shown, unit.split(" = ")[0]) if where is None else engineering(where)
            lines.append(row(f"  {definition.place}", *place))
        elif physical:
            lines.append(row(definition.words, *engineering(dimensional[name])))
        else:
            lines.append(row(definition.words, *rounded(float(quantity), quantity.error), unit))
    if physical:
        lines.append(row(DERIVED["friction_coefficient"].words, *engineering(dimensional["friction_coefficient"])))
    return lines


def with_units(quantities: Mapping[str, Quantity], dimensional: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Every quantity once: in SI where it has such a value, an angle in degrees, normalised without a physical input."""
    angles = {name: q.scaled(1.0, "°") for name, q in quantities.items() if QUANTITIES[name].dimension == "angle"}
    found = (dict(dimensional) or dict(quantities)) | angles
    return {name: found[name] for name in QUANTITIES if name in found}


def quantities_frame(quantities: Mapping[str, Quantity]) -> pandas.DataFrame:
    """Value, error, unit and words of quantities, with their names as the index."""
    import pandas as pd

    lines: Iterable[tuple[float, float, str, str]] = (
        (float(q), q.error, q.unit, QUANTITIES[name].words) for name, q in quantities.items()
    )
    index = pd.Index(list(quantities), name="quantity")
    return pd.DataFrame(lines, index=index, columns=["value", "error", "unit", "words"])
