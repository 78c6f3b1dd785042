"""``softlube squeeze``: normal approach and separation.  Heavy imports live inside."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Group, Parameter

from softlube.cli.inputs import Bodies, Physical

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rich.table import Table

    from softlube.model.quantities import Quantity
    from softlube.physical.sliding import Slide
    from softlube.transient.squeeze.result import Squeeze

MOTION = Group("Motion (give one of load, approach speed, history)", sort_key=2)
SLIDING = Group("Start of sliding", sort_key=3)
OUTPUT = Group("Output", sort_key=4)
Moved = Annotated[str | None, Parameter(group=MOTION, allow_leading_hyphen=True)]


def squeeze(
    *,
    bodies: Bodies | None = None,
    density: Physical = None,
    load: Moved = None,
    approach_speed: Moved = None,
    history: Moved = None,
    initial_height: Moved = None,
    duration: Moved = None,
    film_limit: Moved = None,
    speed: Annotated[str | None, Parameter(group=SLIDING, allow_leading_hyphen=True)] = None,
    pressed: Annotated[str | None, Parameter(group=SLIDING)] = None,
    cavitation: Annotated[str | None, Parameter(group=SLIDING)] = None,
    accuracy: float | None = None,
    output: Annotated[str | None, Parameter(group=OUTPUT)] = None,
    plot: Annotated[str | None, Parameter(group=OUTPUT)] = None,
    as_json: Annotated[bool, Parameter(name="--json", negative=(), group=OUTPUT)] = False,
) -> int:
    """Press a sphere through a liquid film onto a soft substrate, or pull it away, and follow the film.

    Give --radius, --viscosity, one of --young-modulus and --shear-modulus, and one of --load, --approach-speed and --history.

    Parameters
    ----------
    bodies
        Sphere, substrate and liquid.
    density
        Density of the liquid, for the warning of inertia [default: 1000 kg/m^3].
    load
        Constant load, such as "100 mN".
    approach_speed
        Constant speed of approach, such as "10 um/s"; negative for separation.
    history
        CSV file with columns headed "time, load" or "time, height"; units in brackets if not SI, as in "time [ms]".
    initial_height
        Height of the lowest point over the undeformed surface at the start, such as "100 um".
    duration
        How long to follow, such as "10 s".
    film_limit
        Minimum film at which to stop, such as the roughness, "20 nm".
    speed
        Speed of sliding from time 0 on, such as "1 mm/s" [default: no sliding].
    pressed
        How long the sphere is pressed, by the load of time 0, before it slides, such as "1 s" [default: not at all].
    cavitation
        "reynolds" (no negative pressure) or "none"; without sliding negative pressures are always allowed.
    accuracy
        Relative error of the films aimed at, at every time [default: 1e-3; sliding: 2e-2].
    output
        NetCDF file for film, pressure and load against time.
    plot
        Picture of the profiles and histories (.png, .pdf or .svg).
    as_json
        Print one JSON object and nothing else.
    """
    import os
    import time

    # The matrices are small: threads would spend their time waiting for each other.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from softlube.cli.progress import status_line
    from softlube.errors import InputError
    from softlube.files.writing import check_destination

    for option, path in (("output", output), ("plot", plot)):
        if path is not None:
            check_destination(option, path)
    if plot is not None:
        from softlube.plots.solution import check_format

        check_format("plot", plot)
        if output is not None and os.path.abspath(output) == os.path.abspath(plot):
            raise InputError("output, plot: expected two different files")
    from softlube.transient.squeeze.result import Squeeze

    sliding = {"pressed": pressed, "cavitation": cavitation}
    if speed is None:
        for name, unwanted in sliding.items():
            if unwanted is not None:
                raise InputError(f"{name}: only a start of sliding has it; give --speed or leave it out")
        from softlube.physical.squeeze import squeeze as follow
    else:
        from softlube.physical.sliding import slide as follow
    moved = {"load": load, "approach_speed": approach_speed, "history": history, "initial_height": initial_height}
    moved |= {"duration": duration, "film_limit": film_limit, "density": density, "accuracy": accuracy, "speed": speed}
    options: dict[str, Any] = {name: value for name, value in (moved | sliding).items() if value is not None}
    options |= (bodies or Bodies()).given()

    began = time.perf_counter()
    with status_line("starting", quiet=as_json) as show:
        result = follow(**options, progress=show)
        if output is not None:
            show("writing")
            result.save(output)
        if plot is not None:
            show("drawing")
            result.plot(plot)
    if as_json:
        import json

        print(json.dumps(result.to_dict(), allow_nan=False), flush=True)
        return 0
    seconds, written = time.perf_counter() - began, [path for path in (output, plot) if path is not None]
    if isinstance(result, Squeeze):
        _report(result, seconds, written)
    else:
        _report_sliding(result, seconds, written)
    return 0


def _table(quantities: Mapping[str, Quantity], names: Mapping[str, str]) -> Table:
    """Values with errors and units."""
    from softlube.cli.table import empty_table, rounded
    from softlube.physical.units import prefixed

    table = empty_table()
    for name, quantity in quantities.items():
        factor, unit = prefixed(float(quantity), quantity.unit)
        error = quantity.error * factor
        text, doubt = rounded(float(quantity) * factor, error if error > 1e-9 * abs(float(quantity) * factor) else 0.0)
        table.add_row(names[name], text, f"± {doubt}", unit)
    return table


def _report(result: Squeeze, seconds: float, written: list[str]) -> None:
    from softlube.transient.squeeze.result import DESCRIPTION

    scale = 1e-3 * abs(float(result.final["pressure_center"]))
    # The far field's pressure is next to nothing.
    shown = {name: q for name, q in result.final.items() if name not in ("pressure_max", "pressure_min") or abs(q) > scale}
    remarks = []
    if result.dimple_time == result.dimple_time:  # not nan
        remarks.append(f"The film is thinnest off the axis (a dimple) after {result.dimple_time:.3g} s.")
    last = (
        f"{result.run.time.size} time steps on {result.rings[-1]} rings in {seconds:.1f} s; "
        f"balance of volume to {result.run.volume_error:.0e}."
    )
    doubt = result.time_error * result.scale("time")[0]
    _print(result, doubt, "", _table(shown, DESCRIPTION), remarks, last, written)


def _report_sliding(result: Slide, seconds: float, written: list[str]) -> None:
    from softlube.physical.sliding import DESCRIPTION

    last = f"{result.time.size} time steps on {result.angles[-1]} angles in {seconds:.1f} s."
    _print(result, result.time_error, " of sliding", _table(result.final, DESCRIPTION), [], last, written)


def _print(
    result: Squeeze | Slide, doubt: float, what: str, table: Table, remarks: list[str], last: str, written: list[str]
) -> None:
    """When and why it ended, the last values, warnings, what it took."""
    from rich.console import Console

    console = Console(highlight=False, soft_wrap=True)
    why = "the film reached its limit" if result.run.ended_by == "film_limit" else "the end of the motion"
    error = f" ± {doubt:.2g}" if doubt else ""
    console.print(f"After {result.time[-1]:.6g}{error} s{what} ({why}):", markup=False)
    console.print(table, soft_wrap=False)
    for remark in remarks:
        console.print(remark, markup=False)
    for warning in result.warnings:
        console.print(f"[bold yellow]Warning:[/] {warning}.")
    console.print(last, markup=False)
    for path in written:
        console.print(f"Wrote {path}", markup=False)
