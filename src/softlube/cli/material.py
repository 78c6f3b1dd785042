"""What commands that fit a material to its measurements have in common: their files, and how they end."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any, Protocol, TypeAlias

from cyclopts import Group, Parameter

from softlube.errors import InputError, printable

if TYPE_CHECKING:
    from softlube.model.summary import Row, Summary

FIT = Group("Fit", sort_key=1)
_OUTPUT = Group("Output", sort_key=2)
Plot: TypeAlias = Annotated[str | None, Parameter(group=_OUTPUT)]
Output: TypeAlias = Annotated[str | None, Parameter(group=_OUTPUT)]
AsJson: TypeAlias = Annotated[bool, Parameter(name="--json", negative=(), group=_OUTPUT)]


class Found(Protocol):
    """A fitted material."""

    @property
    def options(self) -> str:
        """It as options of the command line."""
        ...

    @property
    def python(self) -> str:
        """It as a call in Python."""
        ...

    @property
    def verdicts(self) -> tuple[str, ...]:
        """What the data can tell, in sentences."""
        ...

    def summary(self) -> Summary:
        """Its parameters as a table."""
        ...

    def to_dict(self) -> dict[str, Any]:
        """Numbers only, ready for JSON."""
        ...


def check_files(data: str, output: str | None, plot: str | None) -> None:
    """Refuse files that cannot be written, before anything is fitted.

    Raises
    ------
    InputError
        If a file cannot be written, has no ending of a picture, or is another one of them.
    """
    from softlube.files.writing import check_destination

    if output is not None:
        check_destination("output", output)
    if plot is not None:
        from softlube.plots.solution import check_format

        check_format("plot", plot)
        check_destination("plot", plot)
    paths = [check_destination(name, path) for name, path in (("output", output), ("plot", plot)) if path is not None]
    if len({path.resolve() for path in [check_destination("data", data), *paths]}) <= len(paths):
        raise InputError("output, plot: expected files of their own")


def conclude(found: Found, title: str, notices: tuple[str, ...], tried: Sequence[Row], heads: Row, **files: Any) -> None:
    """Write the result, and print it or, in place of all else, its JSON.

    Parameters
    ----------
    found : LiquidFit or SubstrateFit
        The material.
    title : str
        First line of what is printed.
    notices : tuple of str
        What was left out of the data.
    tried, heads : sequence of tuple of str, and tuple of str
        Table of what was tried, and the heads of its columns.
    **files
        `output`, `plot` and `as_json` of the command; the picture is drawn already.
    """
    text = json.dumps(found.to_dict(), allow_nan=False)
    if files["output"] is not None:
        from softlube.files.writing import write_whole

        write_whole({files["output"]: f"{text}\n".encode()})
    if files["as_json"]:
        print(text, flush=True)
        return
    from rich.console import Console

    from softlube.cli.table import show, summary_table, text_table

    console = Console(highlight=False, soft_wrap=True)
    console.print(title, markup=False)
    for notice in notices:
        console.print(f"Note: {printable(notice)}.", markup=False)
    show(console, summary_table(found.summary()))
    show(console, text_table(list(tried), heads))
    for verdict in found.verdicts:
        console.print(verdict, markup=False)
    console.print("As inputs of the other commands, and in Python:")
    console.print(f"  {found.options}", markup=False)
    console.print(f"  {found.python}", markup=False)
    for path in (files["output"], files["plot"]):
        if path is not None:
            console.print(f"Wrote {printable(path)}", markup=False)
