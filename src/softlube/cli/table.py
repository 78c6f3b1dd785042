"""Tables of texts on the terminal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from softlube.model.summary import QUANTITY_COLUMNS, Summary

if TYPE_CHECKING:
    from rich.table import Table

    from softlube.model.summary import Row


def summary_table(summary: Summary) -> Table:
    """The table of a summary, without its title and notes."""
    return text_table(summary.rows, summary.header)


def text_table(rows: Iterable[Row], header: Sequence[str] = QUANTITY_COLUMNS) -> Table:
    """A table of texts; numbers under the head "value" stand flush right."""
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for column in header:
        table.add_column(column, no_wrap=True, justify="right" if column == "value" else "left")
    for row in rows:
        table.add_row(*row)
    return table
