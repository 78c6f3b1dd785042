"""``softlube liquid``: liquids from measurements, from the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Group, Parameter

from softlube.cli.numbers import CHOICE, FLOAT
from softlube.errors import printable

if TYPE_CHECKING:
    from softlube.experiments.rheometer import LiquidFit

_FIT = Group("Fit", sort_key=1)
_OUTPUT = Group("Output", sort_key=2)
Law = Literal["newtonian", "power-law", "carreau", "cross", "carreau-yasuda"]


def fit(
    data: str,
    /,
    *,
    law: Annotated[Law | None, CHOICE, Parameter(group=_FIT)] = None,
    second_plateau: Annotated[bool | None, Parameter(group=_FIT)] = None,
    confidence: Annotated[float, FLOAT, Parameter(group=_FIT)] = 0.95,
    plot: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    output: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    as_json: Annotated[bool, Parameter(name="--json", negative=(), group=_OUTPUT)] = False,
) -> int:
    """Fit the law of a thinning liquid to a rheometer's viscosities, and say what the data determine.

    The table has the columns shear_rate and viscosity (or shear_stress), with units in the header: shear rate [1/s],
    viscosity [mPa s]. The law is printed as the inputs of other commands and of Python.

    Parameters
    ----------
    data
        CSV file.
    law
        The law to fit [default: that which the data call for, by Akaike's criterion].
    second_plateau
        Whether the law has a viscosity at high shear rates [default: as the data call for].
    confidence
        Confidence level of the intervals.
    plot
        Picture of the data with the law and of the residuals (.png, .pdf or .svg).
    output
        JSON file with the result.
    as_json
        Print one JSON object and nothing else.
    """
    import json

    from softlube.errors import InputError
    from softlube.files.writing import check_destination, write_whole

    if output is not None:
        check_destination("output", output)
    if plot is not None:
        from softlube.plots.solution import check_format

        check_format("plot", plot)
        check_destination("plot", plot)
    paths = [check_destination(name, path) for name, path in (("output", output), ("plot", plot)) if path is not None]
    if len({path.resolve() for path in [check_destination("data", data), *paths]}) <= len(paths):
        raise InputError("output, plot: expected files of their own")

    from softlube.experiments.rheometer import fit_liquid

    found = fit_liquid(data, law=law, second_plateau=second_plateau, confidence=confidence)
    if plot is not None:
        from softlube.plots.rheometer import plot_liquid

        plot_liquid(found, plot)
    text = json.dumps(found.to_dict(), allow_nan=False)
    if output is not None:
        write_whole({output: f"{text}\n".encode()})
    if as_json:
        print(text, flush=True)
    else:
        _report(found, [path for path in (output, plot) if path is not None])
    return 0


def _report(found: LiquidFit, files: list[str]) -> None:
    from rich.console import Console

    from softlube.cli.table import show, summary_table, text_table

    console = Console(highlight=False, soft_wrap=True)
    data, candidate = found.model.data, found.model.candidate
    console.print(f"{len(data)} rows of {printable(data.source)}; law: {candidate.words}", markup=False)
    for notice in data.notices:
        console.print(f"Note: {printable(notice)}.", markup=False)
    show(console, summary_table(found.summary()))
    rows = [(each.candidate.words, f"{each.criterion:.1f}", f"{100 * each.scatter:.2g} %") for each in found.trials]
    show(console, text_table(rows, ("law", "AICc over least", "scatter")))
    for verdict in found.verdicts:
        console.print(verdict, markup=False)
    console.print("As inputs of the other commands, and in Python:")
    console.print(f"  {found.options}", markup=False)
    console.print(f"  {found.python}", markup=False)
    for path in files:
        console.print(f"Wrote {printable(path)}", markup=False)
