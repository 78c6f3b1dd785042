"""``softlube stribeck``: film and friction against speed from the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Group, Parameter

from softlube.cli.inputs import takes
from softlube.cli.numbers import CHOICE, FLOAT, WHOLE, Cavitation
from softlube.errors import printable
from softlube.physical.inputs import BODIES

if TYPE_CHECKING:
    import pandas

_BODIES = Group("Bodies and liquid", sort_key=1)
_MOTION = Group("Load and motion", sort_key=2)
_FRICTION = Group("Which friction", sort_key=3)
_OUTPUT = Group("Output", sort_key=4)
Body = Annotated[str | None, Parameter(group=_BODIES, allow_leading_hyphen=True)]
Motion = Annotated[str | None, Parameter(group=_MOTION, allow_leading_hyphen=True)]


@takes((_BODIES, BODIES))
def stribeck(
    *,
    cavitation: Annotated[Cavitation, Parameter(group=_BODIES)] = "reynolds",
    roughness: Body = None,
    load: Annotated[list[str] | None, Parameter(group=_MOTION, negative=(), allow_leading_hyphen=True)] = None,
    slowest: Motion = None,
    fastest: Motion = None,
    slide_to_roll: Annotated[float, FLOAT, Parameter(group=_MOTION)] = 2.0,
    points: Annotated[int, WHOLE, Parameter(group=_MOTION)] = 61,
    force: Annotated[Literal["total", "sphere", "couette"], CHOICE, Parameter(group=_FRICTION)] = "total",
    region: Annotated[str, Parameter(group=_FRICTION)] = "2",
    accuracy: Annotated[float, FLOAT, Parameter(group=_FRICTION)] = 3e-3,
    output: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    plot: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    against: Annotated[Literal["hersey", "speed"], CHOICE, Parameter(group=_OUTPUT)] = "hersey",
    as_json: Annotated[bool, Parameter(name="--json", negative=(), group=_OUTPUT)] = False,
    **physical: str,
) -> int:
    """Film and friction coefficient against speed and Hersey number, for one or more loads.

    Any contact that softlube solve solves. A half-space with constant viscosity is read off a table; others are computed, in
    parallel, and kept for the next time (softlube cache).

    Parameters
    ----------
    cavitation
        "reynolds" (no negative pressure) or "none".
    roughness
        Root mean square roughness of both surfaces together, such as "30 nm", for the ratio λ of least film to roughness.
    load
        Normal load, such as "100 mN"; may be given several times.
    slowest
        Least entrainment speed, the mean of both surface speeds, such as "1 um/s" [default: as far as can be solved].
    fastest
        Greatest entrainment speed.
    slide_to_roll
        Speed of the substrate's surface less the ball's, over their mean: 2 for a ball that does not turn, 0 for pure rolling.
    points
        Number of speeds.
    force
        "total" (the whole horizontal force, what a force sensor reads), "sphere" (shear on the ball, as in the paper) or
        "couette" (mean of both surfaces).
    region
        Where friction is counted, in radii of the dry contact under the load; or "domain", "contact" as in softlube solve.
    accuracy
        Relative accuracy of the solutions behind the curve.
    output
        Table, .csv, .parquet or .nc.
    plot
        Picture (.png, .pdf or .svg).
    against
        "hersey" or "speed": what the picture is drawn against.
    as_json
        Print one JSON object and nothing else.
    **physical
        Inputs of the experiment, as they are declared.
    """
    from softlube.cli.echo import echo, understood
    from softlube.cli.progress import Bar
    from softlube.errors import InputError
    from softlube.experiments.load_curve import described, parse_region
    from softlube.physical.contact import Contact

    if output is not None:
        from softlube.sweeps.results import check_table

        check_table("output", output)
    if plot is not None:
        from softlube.files.writing import check_destination
        from softlube.plots.solution import check_format

        check_format("plot", plot)
        check_destination("plot", plot)
    if against not in ("hersey", "speed"):
        raise InputError(f"against: expected 'hersey' or 'speed', got {against!r}")
    if not load:
        raise InputError("load: missing; expected a force such as '100 mN'")
    contact = Contact(**physical, load=load[0], speed=1.0, cavitation=cavitation)
    from softlube.experiments.stribeck import doubts, stribeck_curve

    with Bar("solving", quiet=as_json) as bar:
        table = stribeck_curve(
            contact,
            load,
            slowest=slowest,
            fastest=fastest,
            points=points,
            slide_to_roll=slide_to_roll,
            roughness=roughness,
            force=force,
            region=parse_region(region),
            accuracy=accuracy,
            progress=bar.show,
        )
    if output is not None:
        from softlube.sweeps.results import save_table

        save_table(table, output, ("load", "entrainment_speed", "slide_to_roll"))
    if plot is not None:
        from softlube.plots.experiments import plot_stribeck

        plot_stribeck(table, plot, against=against)
    motion = {"load": load, "slowest": slowest, "fastest": fastest, "slide_to_roll": slide_to_roll}
    inputs = understood(physical | {"roughness": roughness} | motion)
    if as_json:
        import json

        # nan, where nothing could be solved, becomes null: JSON has no nan.
        rows = [
            {name: None if value != value else value for name, value in row.items()} for row in table.to_dict(orient="records")
        ]
        result = {"inputs": inputs, "rows": rows, "warnings": list(doubts(contact, table))}
        print(json.dumps(result, allow_nan=False), flush=True)
    else:
        print(echo(inputs))
        paths = [path for path in (output, plot) if path is not None]
        _report(table, described(force, parse_region(region)), doubts(contact, table), paths)
    return 0


def _report(table: pandas.DataFrame, what: str, doubts: tuple[str, ...], files: list[str]) -> None:
    from rich.console import Console

    from softlube.cli.table import number_table, show
    from softlube.experiments.stribeck import printed
    from softlube.model.summary import spread

    console = Console(highlight=False, soft_wrap=True)
    for load, rows in table.groupby("load [N]", sort=False):
        head, texts = printed(rows)
        chosen = [texts[row] for row in spread(len(texts))]
        show(console, number_table(chosen, head, title=f"load {1e3 * float(str(load)):.4g} mN"))
    console.print("Speed: mean of both surfaces. Friction: coefficient. Least: thinnest film. Errors: see --output.")
    console.print(f"Friction is {what}.", markup=False)
    beyond = int(table["friction [N]"].isna().sum())
    if beyond:
        console.print(f"{beyond} of {len(table)} speeds are beyond what can be solved (-).")
    for doubt in doubts:
        console.print(f"[bold yellow]Warning:[/] {doubt}.")
    for path in files:
        console.print(f"Wrote {printable(path)}", markup=False)
