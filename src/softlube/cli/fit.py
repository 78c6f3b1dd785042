"""``softlube fit data.csv``: viscosity, modulus or offset from measured friction, from the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group, Parameter

from softlube.cli.inputs import takes
from softlube.cli.numbers import CHOICE, FLOAT, WHOLE
from softlube.errors import printable
from softlube.physical.inputs import BODIES

if TYPE_CHECKING:
    from softlube.experiments.fit import Fit

_RIG = Group("Rig and liquid (give what is known; a parameter that is fitted may be given to start from)", sort_key=1)
_FIT = Group("Fit", sort_key=2)
_FRICTION = Group("Which friction was measured", sort_key=3)
_OUTPUT = Group("Output", sort_key=4)


@takes((_RIG, BODIES))
def fit(
    data: str,
    /,
    *,
    slide_to_roll: Annotated[float, FLOAT, Parameter(group=_RIG)] = 2.0,
    free: Annotated[list[str] | None, Parameter(group=_FIT, negative=())] = None,
    noise: Annotated[Literal["relative", "absolute"], CHOICE, Parameter(group=_FIT)] = "relative",
    robust: Annotated[bool, Parameter(group=_FIT, negative=())] = False,
    interval: Annotated[Literal["profile", "bootstrap"] | None, CHOICE, Parameter(group=_FIT)] = None,
    confidence: Annotated[float, FLOAT, Parameter(group=_FIT)] = 0.95,
    hold_out: Annotated[float, FLOAT, Parameter(group=_FIT)] = 0.0,
    seed: Annotated[int, WHOLE, Parameter(group=_FIT)] = 0,
    force: Annotated[Literal["total", "sphere"], CHOICE, Parameter(group=_FRICTION)] = "total",
    region: Annotated[str, Parameter(group=_FRICTION)] = "2",
    plot: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    output: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    as_json: Annotated[bool, Parameter(name="--json", negative=(), group=_OUTPUT)] = False,
    **physical: str,
) -> int:
    """Fit viscosity, modulus, a friction offset or another parameter to measured friction, and say what the data determine.

    The table has the columns load, speed (or entrainment_speed) and friction (or friction_coefficient), with units in the
    header: load [mN], speed [mm/s], friction [mN].

    Parameters
    ----------
    data
        CSV file.
    slide_to_roll
        Where the table has no such column; 2 for a ball that does not turn.
    free
        What to fit: viscosity (the default), modulus, offset, or another input such as thickness, pressure_viscosity,
        relaxation_time or index, whose value is then where the search starts; may be given several times.
    noise
        "relative" (in proportion to the friction) or "absolute".
    robust
        Let outliers count little.
    interval
        "profile" (likelihood) or "bootstrap" [default: profile; bootstrap for a robust fit].
    confidence
        Confidence level of the intervals.
    hold_out
        Fraction of the rows that is left out and then predicted, such as 0.2.
    seed
        Seed of the random draws.
    force
        "total" (the whole horizontal force, what a force sensor reads) or "sphere" (shear on the ball, as in the paper).
    region
        Where friction is counted, in radii of the dry contact under the load; or "domain", "contact" as in softlube solve.
    plot
        Picture of the data on the load curve and of the residuals (.png, .pdf or .svg).
    output
        JSON file with the result.
    as_json
        Print one JSON object and nothing else.
    **physical
        Inputs of the experiment, as they are declared.
    """
    import json

    from softlube.cli.echo import echo, understood
    from softlube.cli.progress import Bar
    from softlube.errors import InputError
    from softlube.files.writing import check_destination, write_whole

    if output is not None:
        check_destination("output", output)
    if plot is not None:
        from softlube.plots.solution import check_format

        check_format("plot", plot)
        check_destination("plot", plot)
    paths = [path for path in (data, output, plot) if path is not None]
    if len(
        {check_destination("output", path).resolve() for path in paths[1:]} | {check_destination("data", data).resolve()}
    ) < len(paths):
        raise InputError("output, plot: expected files of their own")

    from softlube.experiments.fit import fit as run
    from softlube.experiments.load_curve import parse_region
    from softlube.experiments.measurements import read_measurements

    given: dict[str, Any] = dict(physical)
    measured = read_measurements(data, slide_to_roll=slide_to_roll)
    with Bar("fitting", quiet=as_json) as bar:
        found = run(
            measured,
            free=tuple(free or ("viscosity",)),
            noise=noise,
            robust=robust,
            interval=interval,
            confidence=confidence,
            hold_out=hold_out,
            seed=seed,
            force=force,
            region=parse_region(region),
            progress=bar.show,
            **given,
        )
        if plot is not None:
            found.plot(plot)
    inputs = understood(physical | {"slide_to_roll": slide_to_roll})
    text = json.dumps({"inputs": inputs} | found.to_dict(), allow_nan=False)
    if output is not None:
        write_whole({output: f"{text}\n".encode()})
    if as_json:
        print(text, flush=True)
    else:
        print(echo(inputs))
        _report(found, [path for path in (output, plot) if path is not None])
    return 0


def _report(found: Fit, files: list[str]) -> None:
    from rich.console import Console

    from softlube.cli.table import show, summary_table
    from softlube.experiments.load_curve import described

    console = Console(highlight=False, soft_wrap=True)
    data = found.model.data
    console.print(
        f"{len(data)} rows of {printable(data.source)}, beta = {found.beta.min():.4g} to {found.beta.max():.4g}", markup=False
    )
    for notice in data.notices:
        console.print(f"Note: {printable(notice)}.", markup=False)
    show(console, summary_table(found.summary()))
    kind = f"{100 * found.scatter:.2g} %" if found.model.noise == "relative" else f"{found.scatter:.2g} of the median friction"
    console.print(f"Scatter: {kind}. Taken as measured: {described(found.model.force, found.region)}.", markup=False)
    for verdict in found.verdicts:
        console.print(verdict, markup=False)
    if found.others:
        console.print("If something else was measured, the same data give another viscosity:")
        for (force, region), viscosity in found.others.items():
            console.print(f"  {described(force, region)}: {viscosity:.4g} Pa s", markup=False)
    for path in files:
        console.print(f"Wrote {printable(path)}", markup=False)
