"""The command line; the only module that touches the terminal.  Heavy imports live inside the commands: start-up counts."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import App, CycloptsError, Group, Parameter, UnknownOptionError

from softlube.cli.inputs import Physical, Sliding

if TYPE_CHECKING:
    from softlube.steady.solution import Solution

EXIT_INPUT = 2
EXIT_NOT_CONVERGED = 3
EXIT_SYSTEM = 1
EXIT_INTERRUPTED = 130
EXIT_BROKEN_PIPE = 141


def _version() -> str:
    from softlube import __version__

    return __version__


app = App(
    name="softlube",
    help="Lubricated sliding of a sphere on a soft elastic substrate: film, pressure and friction, with error bars.",
    version=_version,
)

# Commands in modules of their own, which are imported when they are called.
app.command("softlube.cli.sweep:sweep", name="sweep", help="Solve many contacts; every finished one is kept.")
app.command("softlube.cli.stribeck:stribeck", name="stribeck", help="Film and friction against speed and Hersey number.")
app.command("softlube.cli.fit:fit", name="fit", help="Fit viscosity, modulus or offset to measured friction.")
app.command("softlube.cli.curve:curve", name="curve", help="Print or draw any quantity as a function of β, at once.")
app.command(
    "softlube.cli.reproduce:reproduce",
    name="reproduce",
    help="Draw the paper's figures and report our numbers beside its.",
)
app.command("softlube.cli.flow:flow", name="flow", help="Draw the flow in the gap: streamlines, velocities, wall shear.")
app.command(
    "softlube.cli.squeeze:squeeze",
    name="squeeze",
    help="Press a sphere through a film, or pull it away: film, pressure and load against time.",
)

_DIMENSIONLESS = Group("Dimensionless contact", sort_key=2)
_METHOD = Group("Method", sort_key=3)
_OUTPUT = Group("Output", sort_key=4)


@app.command
def solve(
    *,
    contact: Sliding | None = None,
    roughness: Physical = None,
    density: Physical = None,
    beta: Annotated[float | None, Parameter(group=_DIMENSIONLESS)] = None,
    beta_load: Annotated[float | None, Parameter(group=_DIMENSIONLESS)] = None,
    cavitation: Annotated[str, Parameter(group=_METHOD)] = "reynolds",
    accuracy: Annotated[float, Parameter(group=_METHOD)] = 1e-3,
    method: Annotated[str, Parameter(group=_METHOD)] = "newton",
    output: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    plot: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    as_json: Annotated[bool, Parameter(name="--json", negative=(), group=_OUTPUT)] = False,
    fast: Annotated[bool, Parameter(negative=(), group=_METHOD)] = False,
) -> int:
    """Solve one contact and print film thickness, pressure and friction with their errors.

    Give --radius, --viscosity, --speed, one of --young-modulus and --shear-modulus, and one of --load and --indentation; or
    --beta (or --beta-load) alone for the dimensionless problem.

    Parameters
    ----------
    contact
        The sliding sphere.
    roughness
        Roughness height; a film below it is warned of.
    density
        Density of the liquid, for the warning of inertia [default: 1000 kg/m^3].
    beta
        β = (2/3)(h0²/R) πG/(ηv) of a given indentation.
    beta_load
        The same with the Hertz indentation of a given load.
    cavitation
        "reynolds" (no negative pressure) or "none".
    accuracy
        Relative error aimed at; the grids follow from it.
    method
        "newton", or the paper's own "relaxation" or "cartesian" (slower, without errors; for comparison).
    output
        NetCDF file for the whole solution.
    plot
        Picture of film and pressure (.png, .pdf or .svg).
    as_json
        Print one JSON object and nothing else.
    fast
        Read the numbers off the master curve instead of solving; no fields, so neither --output nor --plot.
    """
    from softlube.errors import InputError

    doubted = {"roughness": roughness, "density": density}
    given = (contact or Sliding()).given() | {name: value for name, value in doubted.items() if value is not None}
    dimensionless = [name for name, value in (("beta", beta), ("beta_load", beta_load)) if value is not None]
    if dimensionless and given:
        raise InputError(f"{dimensionless[0]}, {next(iter(given))}: give a dimensionless or a physical contact, not both")
    if not dimensionless and not given:
        raise InputError("radius: missing; describe the contact (--radius, --viscosity, …) or give --beta; see --help")

    if fast:
        for name, wanted in (
            ("output", output),
            ("plot", plot),
            ("method", method != "newton"),
            ("accuracy", accuracy != 1e-3),
        ):
            if wanted:
                raise InputError(f"fast, {name}: the master curve has no {name}; leave one of them out")
        return _fast(given, {"beta": beta, "beta_load": beta_load}, cavitation, as_json)

    # Everything that can be refused is refused before anything is computed or written.
    if output is not None or plot is not None:
        from softlube.files.writing import check_destination

        if output is not None:
            check_destination("output", output)
        if plot is not None:
            from softlube.plots.solution import check_format

            check_format("plot", plot)
            if check_destination("plot", plot).absolute() == (output and check_destination("output", output).absolute()):
                raise InputError("output, plot: expected two different files")

    if accuracy >= 1e-3:
        # The matrices of the coarser grids are too small to share out: threads would spend their time waiting for each other.
        import os

        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

    import time

    began = time.perf_counter()
    options = {"accuracy": accuracy, "method": method}
    solution = _solve(given, {"beta": beta, "beta_load": beta_load}, cavitation, options, quiet=as_json)
    seconds = time.perf_counter() - began
    _write_files(solution, output, plot)
    if as_json:
        import json

        print(json.dumps(solution.to_dict(), allow_nan=False), flush=True)
    else:
        _report(solution, seconds, [path for path in (output, plot) if path is not None])
    return 0


def _solve(
    physical: dict[str, str],
    dimensionless: dict[str, Any],
    cavitation: str,
    options: dict[str, Any],
    *,
    quiet: bool,
) -> Solution:
    from softlube.cli.progress import status_line
    from softlube.physical.contact import Contact
    from softlube.steady.ladder import solve

    contact = Contact(**physical, cavitation=cavitation) if physical else None
    with status_line("solving", quiet=quiet) as show:
        if contact is not None:
            return contact.solve(**options, progress=show)
        return solve(**dimensionless, cavitation=cavitation, **options, progress=show)


def _fast(physical: dict[str, str], dimensionless: dict[str, Any], cavitation: str, as_json: bool) -> int:
    """Numbers from the master curve, said to be so."""
    from softlube.model.problem import Problem
    from softlube.physical.contact import Contact
    from softlube.theory import master_curve as curve

    contact = Contact(**physical, cavitation=cavitation) if physical else None
    problem = contact.problem() if contact is not None else Problem(**dimensionless, cavitation=cavitation)  # type: ignore[arg-type]
    quantities = curve.quantities(problem)
    dimensional = contact.dimensional(quantities) if contact is not None else {}
    doubts = contact.doubts(dimensional) if contact is not None else ()
    name = "beta_load" if problem.load_controlled else "beta"
    if as_json:
        import json

        plain = {key: {"value": float(q), "error": q.error} for key, q in quantities.items()}
        result: dict[str, Any] = {name: problem.parameter, "cavitation": cavitation, "method": "curve", "quantities": plain}
        if contact is not None:
            result["dimensional"] = {
                key: {"value": float(q), "error": q.error, "unit": q.unit} for key, q in dimensional.items()
            }
        print(json.dumps(result | {"warnings": list(doubts)}, allow_nan=False), flush=True)
        return 0
    from rich.console import Console

    from softlube.cli.table import solution_table

    console = Console(highlight=False, soft_wrap=True)
    console.print(f"{name} = {problem.parameter:.5g}, read off the master curve: not solved", markup=False)
    console.print(solution_table(problem, quantities, dimensional), soft_wrap=False)
    for doubt in doubts:
        console.print(f"[bold yellow]Warning:[/] {doubt}.")
    return 0


def _write_files(solution: Solution, output: str | None, plot: str | None) -> None:
    """Both files, or none."""
    from contextlib import ExitStack

    from softlube.files.writing import whole_file

    with ExitStack() as stack:
        temporary_output = stack.enter_context(whole_file(output)) if output is not None else None
        temporary_plot = stack.enter_context(whole_file(plot)) if plot is not None else None
        if temporary_output is not None:
            solution.save(temporary_output)
        if temporary_plot is not None:
            solution.plot(temporary_plot)


# --- what is printed --------------------------------------------------------------------------------------------------


def _report(solution: Solution, seconds: float, files: Sequence[str]) -> None:
    from rich.console import Console

    from softlube.cli.table import solution_table

    console = Console(highlight=False, soft_wrap=True)
    condition = "Reynolds condition" if solution.problem.cavitation == "reynolds" else "no cavitation condition"
    console.print(f"β = {solution.beta:.5g} (by the load: {solution.beta_load:.5g}), {condition}", markup=False)
    if solution.contact is None and solution.problem.load_controlled:
        console.print("δ is the Hertz indentation of the load, Eq. (29).")
    console.print(solution_table(solution.problem, solution.quantities, solution.dimensional), soft_wrap=False)
    sizes = ", ".join(f"{level.n_r} × {level.n_theta}" for level in solution.levels)
    steps = " + ".join(str(sum(record.count for record in level.history)) for level in solution.levels)
    what = "Newton steps" if solution.method == "newton" else f"sweeps of the paper's method ({solution.method})"
    console.print(f"Converged in {seconds:.2f} s: grids of {sizes} cells, {steps} {what}.")
    if solution.method == "newton":
        from softlube.steady.error_estimate import looser

        times = f"{looser(solution.problem)['film_min']:g}"
        console.print(
            f"Errors aimed at: {solution.accuracy:g} of each value (minimum film, largest shear: {times} times that)."
        )
    else:
        console.print("One mesh, so the errors are not known; softlube's own method (--method newton) estimates them.")
    for doubt in solution.warnings:
        console.print(f"[bold yellow]Warning:[/] {doubt}.")
    for path in files:
        console.print(f"Wrote {path}", markup=False)


# --- entry point ----------------------------------------------------------------------------------------------------


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit code: 0 done, 2 bad input, 3 not converged."""
    from softlube.errors import InputError, NotConvergedError

    if arguments is None:
        # One short job: looking for cycles in what the imports make costs more than it frees.
        import gc

        gc.disable()
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a terminal without Greek letters gets question marks, not a crash
            stream.reconfigure(errors="replace")
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        result = app(
            given,
            exit_on_error=False,
            print_error=False,
            result_action="return_value",
        )
    except UnknownOptionError as error:
        return _complain(_unknown(error, (*given, "")[0]), EXIT_INPUT)
    except CycloptsError as error:
        return _complain(" ".join(str(error).split()) + " See softlube --help.", EXIT_INPUT)
    except InputError as error:
        return _complain(_as_options(str(error)), EXIT_INPUT)
    except NotConvergedError as error:
        return _complain(str(error), EXIT_NOT_CONVERGED)
    except BrokenPipeError:
        # The reader (head, less) has gone; leave quietly, and keep Python from flushing into the closed pipe at exit.
        import os

        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return EXIT_BROKEN_PIPE
    except OSError as error:
        return _complain(f"{error.filename or 'output'}: {error.strerror or error}", EXIT_SYSTEM)
    except KeyboardInterrupt:
        return _complain("interrupted", EXIT_INTERRUPTED)
    return result if isinstance(result, int) else 0


_MODELS = ("--thickness", "--base", "--pressure-viscosity", "--viscosity-law")
"""Options of substrates and liquids other than the paper's."""
_WITHOUT_MODELS = {
    "stribeck": "the curve behind it is a half-space's with constant viscosity; take softlube solve or softlube sweep",
    "fit": "the curve behind it is a half-space's with constant viscosity",
    "curve": "the master curve is a half-space's with constant viscosity; take softlube solve or softlube sweep",
    "reproduce": "the paper's figures are a half-space's with constant viscosity",
    "sweep": "what is to be solved stands in the plan; give it there",
}
"""Commands that do not take them, and why."""


def _unknown(error: UnknownOptionError, command: str) -> str:
    """What to say of an option that a command does not have."""
    option = (error.token.keyword or error.token.value).split("=")[0]
    if option in _MODELS and command in _WITHOUT_MODELS:
        return f"{option}: softlube {command} does not take it, {_WITHOUT_MODELS[command]}."
    return " ".join(str(error).split()) + " See softlube --help."


def _as_options(message: str) -> str:
    """A message that names parameters of Python, with the options of the command line instead."""
    names, colon, rest = message.partition(":")
    parts = names.split(", ")
    if not colon or not all(part.isidentifier() for part in parts):
        return message
    return ", ".join(f"--{part.replace('_', '-')}" for part in parts) + colon + rest


def _complain(message: str, code: int) -> int:
    print(f"softlube: {message}", file=sys.stderr)
    return code
