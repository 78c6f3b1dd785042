"""``softlube substrate``: viscoelastic substrates from measurements, from the command line."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from softlube.cli.material import FIT, AsJson, Output, Plot, check_files, conclude
from softlube.cli.numbers import FLOAT, WHOLE
from softlube.errors import printable


def fit(
    data: str,
    /,
    *,
    terms: Annotated[int | None, WHOLE, Parameter(group=FIT)] = None,
    poisson_ratio: Annotated[float, FLOAT, Parameter(group=FIT)] = 0.5,
    plot: Plot = None,
    output: Output = None,
    as_json: AsJson = False,
) -> int:
    """Fit a Prony series to a test of a viscoelastic solid, and say what the data determine.

    The table has frequency with E' and E'' (or G' and G''), or time with E or G (relaxation modulus) or with D or J (tensile or
    shear creep compliance), with units in the header: frequency [Hz], E' [MPa], E'' [MPa]. The series is printed as the inputs
    of other commands and of Python.

    Parameters
    ----------
    data
        CSV file.
    terms
        Number of times of the series [default: that which the data call for, by Akaike's criterion].
    poisson_ratio
        Poisson's ratio of the substrate, 0 to 0.5.
    plot
        Picture of the data with the series and of the residuals (.png, .pdf or .svg).
    output
        JSON file with the result.
    as_json
        Print one JSON object and nothing else.
    """
    check_files(data, output, plot)

    from softlube.experiments.substrate_fit import fit_substrate

    found = fit_substrate(data, terms=terms, poisson_ratio=poisson_ratio)
    if plot is not None:
        from softlube.plots.moduli import plot_substrate

        plot_substrate(found, plot)
    measured = found.data
    title = f"{len(measured)} rows of {printable(measured.source)}; {measured.procedure.name}"
    least = min(each.criterion for each in found.trials)
    rows = [
        (str(each.times.size), f"{each.criterion - least:.1f}", *(f"{100 * size:.2g} %" for size in each.scatter.values()))
        for each in found.trials
        if each.times.size
    ]
    heads = "times", "AICc over least", *(f"scatter of {name.replace('_', ' ')}" for name in measured.procedure.measured)
    conclude(found, title, measured.notices, rows, heads, output=output, plot=plot, as_json=as_json)
    return 0
