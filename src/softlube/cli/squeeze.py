"""``softlube squeeze``: normal approach and separation.  Heavy imports live inside."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Group, Parameter

from softlube.cli.echo import echo, understood
from softlube.cli.inputs import PHYSICAL, takes
from softlube.cli.numbers import FLOAT
from softlube.errors import printable
from softlube.model.motions import Sliding
from softlube.physical.inputs import BODIES, Approach, StartOfSliding, names_of

if TYPE_CHECKING:
    from softlube.transient.history import Transient
    from softlube.transient.squeeze.result import Squeeze

MOTION = Group("Motion (give one of load, approach speed, history)", sort_key=2)
SLIDING = Group("Start of sliding", sort_key=3)
OUTPUT = Group("Output", sort_key=4)


@takes((PHYSICAL, BODIES), (MOTION, (), Approach), (SLIDING, (Sliding.slot,), StartOfSliding))
def squeeze(
    *,
    accuracy: Annotated[float | None, FLOAT] = None,
    output: Annotated[str | None, Parameter(group=OUTPUT)] = None,
    plot: Annotated[str | None, Parameter(group=OUTPUT)] = None,
    as_json: Annotated[bool, Parameter(name="--json", negative=(), group=OUTPUT)] = False,
    **physical: str,
) -> int:
    """Press a sphere through a liquid film onto a soft substrate, or pull it away, and follow the film.

    Give --radius, --viscosity, one of --young-modulus and --shear-modulus, and one of --load, --approach-speed and --history.
    With a --prony series the substrate remembers: it creeps under the load.  A start of sliding takes elastic substrates only.

    Parameters
    ----------
    accuracy
        Relative error of the films aimed at, at every time [default: 1e-3; sliding: 2e-2].
    output
        NetCDF file for film, pressure and load against time.
    plot
        Picture of the profiles and histories (.png, .pdf or .svg).
    as_json
        Print one JSON object and nothing else.
    **physical
        Inputs of the experiment, as they are declared.
    """
    import os
    import time

    # The matrices are small: threads would spend their time waiting for each other.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from softlube.cli.progress import status_line
    from softlube.errors import InputError
    from softlube.files.writing import check_destination, write_whole

    for option, path in (("output", output), ("plot", plot)):
        if path is not None:
            check_destination(option, path)
    if plot is not None:
        from softlube.plots.solution import check_format

        check_format("plot", plot)
        if output is not None and os.path.abspath(output) == os.path.abspath(plot):
            raise InputError("output, plot: expected two different files")
    from softlube.experiments.approach import slide
    from softlube.experiments.approach import squeeze as film
    from softlube.files.transient import contents
    from softlube.physical.indenter_effect import notes_in_time
    from softlube.physical.squeeze import WRITTEN_WAYS, Setup, check_one_way
    from softlube.transient.squeeze.result import Squeeze

    slides = bool(names_of([Sliding.slot]).keys() & physical.keys())
    for name in names_of((), StartOfSliding):
        if name in physical and not slides:
            raise InputError(f"{name}: only a start of sliding has it; give --speed or leave it out")
    check_one_way(physical, WRITTEN_WAYS)
    follow = slide if slides else film
    options: dict[str, Any] = physical if accuracy is None else physical | {"accuracy": accuracy}

    began = time.perf_counter()
    with status_line("starting", quiet=as_json) as show:
        result = follow(**options, progress=show)
        content: dict[str | os.PathLike[str], bytes] = {}
        if output is not None:
            show("writing")
            content[output] = contents(result)
        if plot is not None:
            from matplotlib import rc_context

            from softlube.plots.solution import STYLE, image

            show("drawing")
            with rc_context(STYLE):  # ticks are made when they are drawn
                content[plot] = image(result.plot(), plot)
        write_whole(content)
    inputs = understood(physical)
    if as_json:
        import json

        print(json.dumps({"inputs": inputs} | result.to_dict(), allow_nan=False), flush=True)
        return 0
    seconds, written = time.perf_counter() - began, [path for path in (output, plot) if path is not None]
    if isinstance(result, Squeeze):
        remarks = _dimple(result)
        took = f"{result.time.size} time steps on {result.rings[-1]} rings in {seconds:.1f} s; "
        took += f"balance of volume to {result.run.volume_error:.0e}."
    else:
        remarks, took = [], f"{result.time.size} time steps on {result.angles[-1]} angles in {seconds:.1f} s."
    if isinstance(result.setup, Setup):
        remarks += [note.sentence() for note in notes_in_time(result.setup, result.motion)]
    print(echo(inputs))
    _report(result, " of sliding" if slides else "", remarks, [took, *(f"Wrote {printable(path)}" for path in written)])
    return 0


def _dimple(result: Squeeze) -> list[str]:
    """A sentence on the dimple, if there is one."""
    if result.dimple_time != result.dimple_time:  # nan
        return []
    return [f"The film is thinnest off the axis (a dimple) after {result.dimple_time:.3g} s."]


def _report(result: Transient, what: str, remarks: list[str], last: list[str]) -> None:
    """Print when and why it ended, the last values, remarks, warnings, and what it took."""
    from rich.console import Console

    from softlube.cli.table import show, summary_table

    console = Console(highlight=False, soft_wrap=True)
    error = f" ± {result.time_error:.2g}" if result.time_error else ""
    console.print(f"After {result.time[-1]:.6g}{error} s{what} ({result.why_it_ended}):", markup=False)
    show(console, summary_table(result.summary()))
    for remark in remarks:
        console.print(remark, markup=False)
    for warning in result.warnings:
        console.print(f"[bold yellow]Warning:[/] {warning}.")
    for line in last:
        console.print(line, markup=False)
