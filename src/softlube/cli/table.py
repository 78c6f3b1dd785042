"""Tables of texts on the terminal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from softlube.model.summary import QUANTITY_COLUMNS, Summary

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from softlube.model.summary import Row

WIDEST = 1000
"""Width at which a table is measured."""


def show(console: Console, table: Table) -> None:
    """Print a table whose numbers are never cut: words wrap where the terminal is narrow, and the rest may go beyond it."""
    from rich.measure import Measurement

    least = Measurement.get(console, console.options.update(max_width=WIDEST), table).minimum
    console.print(table, soft_wrap=False, crop=False, width=max(console.width, least))


def summary_table(summary: Summary) -> Table:
    """The table of a summary, without its title and notes."""
    return text_table(summary.rows, summary.header)


def text_table(rows: Iterable[Row], header: Sequence[str] = QUANTITY_COLUMNS) -> Table:
    """A table of texts: words in the first column, which wrap; numbers under the head "value" stand flush right."""
    table, rows = _empty(), list(rows)
    words = max(len(word) for row in (header, *rows) for word in row[0].split())
    table.add_column(header[0], min_width=words)
    for place, column in enumerate(header[1:], 1):
        longest = max(len(row[place]) for row in (header, *rows))
        table.add_column(column, no_wrap=True, min_width=longest, justify="right" if column == "value" else "left")
    for row in rows:
        table.add_row(*row)
    return table


def number_table(rows: Iterable[Row], header: Sequence[str], *, title: str | None = None) -> Table:
    """A table of numbers, flush right; a unit in a head stands below the word."""
    table, rows = _empty(title), list(rows)
    for place, column in enumerate(header):
        longest = max([*map(len, column.split()), *(len(row[place]) for row in rows)])
        table.add_column(column.replace(" ", "\n"), no_wrap=True, min_width=longest, justify="right")
    for row in rows:
        table.add_row(*row)
    return table


def _empty(title: str | None = None) -> Table:
    from rich import box
    from rich.table import Table

    return Table(box=box.SIMPLE_HEAD, pad_edge=False, title=title, title_justify="left")
