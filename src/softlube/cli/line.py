"""``softlube line``: one line contact that slides steadily.  Heavy imports live inside."""

from __future__ import annotations

import os
from typing import Annotated

from cyclopts import Group, Parameter

from softlube.cli.echo import echo, understood
from softlube.cli.inputs import PHYSICAL, takes
from softlube.cli.numbers import FLOAT, Cavitation
from softlube.errors import printable
from softlube.physical.inputs import SLIDING_LINE, LineLoading

_DIMENSIONLESS = Group("Dimensionless contact", sort_key=2)
_METHOD = Group("Method", sort_key=3)
_OUTPUT = Group("Output", sort_key=4)


@takes((PHYSICAL, SLIDING_LINE, LineLoading))
def line(
    *,
    beta_load: Annotated[float | None, FLOAT, Parameter(group=_DIMENSIONLESS)] = None,
    cavitation: Annotated[Cavitation, Parameter(group=_METHOD)] = "reynolds",
    accuracy: Annotated[float, FLOAT, Parameter(group=_METHOD)] = 1e-5,
    budget: Annotated[float, Parameter(group=_METHOD)] = 60.0,
    profile: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    plot: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    as_json: Annotated[bool, Parameter(name="--json", negative=(), group=_OUTPUT)] = False,
    **physical: str,
) -> int:
    """Solve one line contact, a cylinder under a load per length, and print film, pressure and friction.

    Give --radius, --viscosity, --speed or --entrainment-speed, one of --young-modulus and --shear-modulus, and
    --load-per-length; or --beta-load alone for the dimensionless problem.

    Parameters
    ----------
    beta_load
        β with H = b²/R in place of h0, where b is half the width of the dry contact.
    cavitation
        "reynolds" (no negative pressure) or "none".
    accuracy
        Relative error aimed at.
    budget
        Seconds of processor time after which the solver gives up.
    profile
        CSV file for film and pressure along x.
    plot
        Picture of film and pressure (.png, .pdf or .svg).
    as_json
        Print one JSON object and nothing else.
    **physical
        Inputs of the experiment, as they are declared.
    """
    from softlube.errors import InputError

    if beta_load is not None and physical:
        raise InputError(f"beta_load, {next(iter(physical))}: give a dimensionless or a physical contact, not both")
    if beta_load is None and not physical:
        raise InputError("radius: missing; describe the contact (--radius, --viscosity, …) or give --beta-load; see --help")
    from softlube.files.writing import check_destination, write_whole
    from softlube.plots.solution import STYLE, check_format, image

    if profile is not None:
        check_destination("profile", profile)
    if plot is not None:
        check_format("plot", plot)
        if check_destination("plot", plot).absolute() == (profile and check_destination("profile", profile).absolute()):
            raise InputError("profile, plot: expected two different files")

    from softlube.cli.progress import status_line
    from softlube.physical.line import LineContact, solve

    with status_line("solving", quiet=as_json) as show:
        if beta_load is None:
            solution = LineContact(**physical, cavitation=cavitation).solve(accuracy=accuracy, budget=budget, progress=show)
        else:
            solution = solve(beta_load, cavitation=cavitation, accuracy=accuracy, budget=budget, progress=show)

    content: dict[str | os.PathLike[str], bytes] = {}
    if profile is not None:
        content[profile] = solution.profile().to_csv(index=False).encode()
    if plot is not None:
        from matplotlib import rc_context

        with rc_context(STYLE):  # ticks are made when they are drawn
            content[plot] = image(solution.plot(), plot)
    if content:
        write_whole(content)

    inputs = understood({"beta_load": beta_load} | physical)
    if as_json:
        import json

        print(json.dumps({"inputs": inputs} | solution.to_dict(), allow_nan=False), flush=True)
        return 0
    from rich.console import Console

    from softlube.cli.table import show as show_table
    from softlube.cli.table import summary_table

    console = Console(highlight=False, soft_wrap=True)
    console.print(echo(inputs), markup=False)
    condition = "Reynolds condition" if cavitation == "reynolds" else "no cavitation condition"
    console.print(f"β by the load = {solution.beta_load:.5g}, {condition}", markup=False)
    summary = solution.summary()
    show_table(console, summary_table(summary))
    for note in summary.notes:
        console.print(f"{note}.", markup=False)
    for path in content:
        console.print(f"Wrote {printable(path)}", markup=False)
    return 0
