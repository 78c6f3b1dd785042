"""``softlube liquid``: liquids from measurements, from the command line."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

from softlube.cli.material import FIT, AsJson, Output, Plot, check_files, conclude
from softlube.cli.numbers import CHOICE, FLOAT
from softlube.errors import printable

Law = Literal["newtonian", "power-law", "carreau", "cross", "carreau-yasuda"]


def fit(
    data: str,
    /,
    *,
    law: Annotated[Law | None, CHOICE, Parameter(group=FIT)] = None,
    second_plateau: Annotated[bool | None, Parameter(group=FIT)] = None,
    confidence: Annotated[float, FLOAT, Parameter(group=FIT)] = 0.95,
    plot: Plot = None,
    output: Output = None,
    as_json: AsJson = False,
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
    check_files(data, output, plot)

    from softlube.experiments.rheometer import fit_liquid

    found = fit_liquid(data, law=law, second_plateau=second_plateau, confidence=confidence)
    if plot is not None:
        from softlube.plots.rheometer import plot_liquid

        plot_liquid(found, plot)
    measured = found.model.data
    title = f"{len(measured)} rows of {printable(measured.source)}; law: {found.model.candidate.words}"
    rows = [(each.candidate.words, f"{each.criterion:.1f}", f"{100 * each.scatter:.2g} %") for each in found.trials]
    heads = "law", "AICc over least", "scatter"
    conclude(found, title, measured.notices, rows, heads, output=output, plot=plot, as_json=as_json)
    return 0
