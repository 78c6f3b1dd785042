"""``softlube fit data.csv``: viscosity, modulus or offset from measured friction, from the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from cyclopts import Group, Parameter

if TYPE_CHECKING:
    from softlube.experiments.fit import Fit
    from softlube.experiments.intervals import Estimate

_RIG = Group("Rig and liquid (give what is known; a parameter that is fitted may be given to start from)", sort_key=1)
_FIT = Group("Fit", sort_key=2)
_FRICTION = Group("Which friction was measured", sort_key=3)
_OUTPUT = Group("Output", sort_key=4)
Physical = Annotated[str | None, Parameter(group=_RIG, allow_leading_hyphen=True)]


def fit(
    data: str,
    /,
    *,
    radius: Physical = None,
    young_modulus: Physical = None,
    viscosity: Physical = None,
    slide_to_roll: Annotated[float, Parameter(group=_RIG)] = 2.0,
    free: Annotated[list[str] | None, Parameter(group=_FIT, negative=())] = None,
    noise: Annotated[str, Parameter(group=_FIT)] = "relative",
    robust: Annotated[bool, Parameter(group=_FIT, negative=())] = False,
    interval: Annotated[str | None, Parameter(group=_FIT)] = None,
    confidence: Annotated[float, Parameter(group=_FIT)] = 0.95,
    hold_out: Annotated[float, Parameter(group=_FIT, allow_leading_hyphen=True)] = 0.0,
    seed: Annotated[int, Parameter(group=_FIT)] = 0,
    force: Annotated[str, Parameter(group=_FRICTION)] = "sphere",
    region: Annotated[str, Parameter(group=_FRICTION)] = "2",
    plot: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    output: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    as_json: Annotated[bool, Parameter(name="--json", negative=(), group=_OUTPUT)] = False,
) -> int:
    """Fit viscosity, modulus or a friction offset to measured friction, and say what the data determine.

    The table has the columns load, speed (or entrainment_speed) and friction (or friction_coefficient), with units in the
    header: load [mN], speed [mm/s], friction [mN].

    Parameters
    ----------
    data
        CSV file.
    radius
        Radius of the sphere, such as "2 mm".
    young_modulus
        Young's modulus of the substrate (incompressible), such as "3 MPa".
    viscosity
        Dynamic viscosity, such as "2 Pa s".
    slide_to_roll
        Where the table has no such column; 2 for a substrate at rest.
    free
        What to fit: viscosity (the default), modulus, offset; may be given several times.
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
        "sphere" (shear on the ball, as in the paper) or "total" (the whole horizontal force).
    region
        Where friction is counted, in contact radii of the load; or "domain", "contact" as in softlube solve.
    plot
        Picture of the data on the load curve and of the residuals (.png, .pdf or .svg).
    output
        JSON file with the result.
    as_json
        Print one JSON object and nothing else.
    """
    import json

    from softlube.cli.echo import echo, understood
    from softlube.cli.progress import Bar
    from softlube.errors import InputError
    from softlube.files.writing import check_destination, whole_file

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

    measured = read_measurements(data, slide_to_roll=slide_to_roll)
    with Bar("fitting", quiet=as_json) as bar:
        found = run(
            measured,
            radius=radius,
            young_modulus=young_modulus,
            viscosity=viscosity,
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
        )
        if plot is not None:
            found.plot(plot)
    rig = {"radius": radius, "young_modulus": young_modulus, "viscosity": viscosity, "slide_to_roll": slide_to_roll}
    inputs = understood(rig)
    text = json.dumps({"inputs": inputs} | found.to_dict(), allow_nan=False)
    if output is not None:
        with whole_file(output) as temporary:
            temporary.write_text(text + "\n", encoding="utf-8")
    if as_json:
        print(text, flush=True)
    else:
        print(echo(inputs))
        _report(found, [path for path in (output, plot) if path is not None])
    return 0


def _rounded(estimate: Estimate) -> tuple[str, str, str]:
    """Value and ends as text, with two digits more than the interval leaves open."""
    import math

    ends = (estimate.low, estimate.high)
    width = max((abs(end - estimate.value) for end in ends if math.isfinite(end)), default=0.0)
    digits = 4
    if width > 0 and estimate.value:
        digits = min(max(2 + math.ceil(math.log10(abs(estimate.value) / width)), 3), 12)
    low, high = (f"{end:.{digits}g}" if math.isfinite(end) else "open" for end in ends)
    return f"{estimate.value:.{digits}g}", low, high


def _report(found: Fit, files: list[str]) -> None:
    from rich import box
    from rich.console import Console
    from rich.table import Table

    from softlube.experiments.friction_model import UNITS

    console = Console(highlight=False, soft_wrap=True)
    data = found.model.data
    console.print(f"{len(data)} rows of {data.source}, beta = {found.beta.min():.4g} to {found.beta.max():.4g}", markup=False)
    for notice in data.notices:
        console.print(f"Note: {notice}.", markup=False)
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for column in ("parameter", "value", f"{100 * found.confidence:g} % interval ({found.interval})", "unit"):
        table.add_column(column, no_wrap=True)
    for name, estimate in found.estimates.items():
        value, low, high = _rounded(estimate)
        table.add_row(name.replace("_", " "), value, f"{low} to {high}", estimate.unit)
    for name in sorted(found.values.keys() - found.estimates.keys()):
        table.add_row(name.replace("_", " "), f"{found.values[name]:.5g}", "held", UNITS[name])
    console.print(table, soft_wrap=False)
    kind = f"{100 * found.scatter:.2g} %" if found.model.noise == "relative" else f"{found.scatter:.2g} of the median friction"
    console.print(f"Scatter: {kind}. Friction: {found.model.force}, within {found.region} contact radii.")
    for verdict in found.verdicts:
        console.print(verdict, markup=False)
    if found.others:
        console.print("The same data, if the friction measured is another:")
        for (force, region), viscosity in found.others.items():
            console.print(f"  {force}, within {region:g} contact radii: viscosity {viscosity:.4g} Pa s")
    for path in files:
        console.print(f"Wrote {path}", markup=False)
