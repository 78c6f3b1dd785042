"""``softlube solve``: one contact that slides steadily.  Heavy imports live inside."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group, Parameter

from softlube.cli.echo import echo, understood
from softlube.cli.inputs import PHYSICAL, takes
from softlube.cli.numbers import CHOICE, FLOAT, Cavitation
from softlube.errors import printable
from softlube.physical.inputs import SLIDING_BODIES, Loading

if TYPE_CHECKING:
    from softlube.steady.solution import Solution

_DIMENSIONLESS = Group("Dimensionless contact", sort_key=2)
_METHOD = Group("Method", sort_key=3)
_OUTPUT = Group("Output", sort_key=4)


@takes((PHYSICAL, SLIDING_BODIES, Loading))
def solve(
    *,
    beta: Annotated[float | None, FLOAT, Parameter(group=_DIMENSIONLESS)] = None,
    beta_load: Annotated[float | None, FLOAT, Parameter(group=_DIMENSIONLESS)] = None,
    cavitation: Annotated[Cavitation, Parameter(group=_METHOD)] = "reynolds",
    accuracy: Annotated[float, FLOAT, Parameter(group=_METHOD)] = 1e-3,
    method: Annotated[Literal["newton", "relaxation", "cartesian"], CHOICE, Parameter(group=_METHOD)] = "newton",
    budget: Annotated[float, Parameter(group=_METHOD)] = 60.0,
    output: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    plot: Annotated[str | None, Parameter(group=_OUTPUT)] = None,
    as_json: Annotated[bool, Parameter(name="--json", negative=(), group=_OUTPUT)] = False,
    fast: Annotated[bool, Parameter(negative=(), group=_METHOD)] = False,
    **physical: str,
) -> int:
    """Solve one contact and print film thickness, pressure and friction with their errors.

    Give --radius, --viscosity, --speed or --entrainment-speed, one of --young-modulus and --shear-modulus, and one of --load
    and --indentation; or --beta (or --beta-load) alone for the dimensionless problem.

    Parameters
    ----------
    beta
        β = (2/3)(h0²/R) πG/(ηv) of a given indentation.
    beta_load
        β with the Hertz indentation of a given load in place of h0.
    cavitation
        "reynolds" (no negative pressure) or "none".
    accuracy
        Relative error aimed at; the grids follow from it.
    method
        "newton", or the paper's own "relaxation" or "cartesian" (slower, without errors; for comparison).
    budget
        Seconds of processor time after which the solver gives up.
    output
        NetCDF file for the whole solution.
    plot
        Picture of film and pressure (.png, .pdf or .svg).
    as_json
        Print one JSON object and nothing else.
    fast
        Read the numbers off the master curve instead of solving; no fields, so neither --output nor --plot.
    **physical
        Inputs of the experiment, as they are declared.
    """
    from softlube.errors import InputError

    dimensionless = [name for name, value in (("beta", beta), ("beta_load", beta_load)) if value is not None]
    if dimensionless and physical:
        raise InputError(f"{dimensionless[0]}, {next(iter(physical))}: give a dimensionless or a physical contact, not both")
    if not dimensionless and not physical:
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
        return _fast(physical, {"beta": beta, "beta_load": beta_load}, cavitation, as_json)

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
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

    import time

    began = time.perf_counter()
    options = {"accuracy": accuracy, "method": method, "budget": budget}
    solution = _solve(physical, {"beta": beta, "beta_load": beta_load}, cavitation, options, quiet=as_json)
    seconds = time.perf_counter() - began
    _write_files(solution, output, plot)
    inputs = understood({"beta": beta, "beta_load": beta_load} | physical)
    if as_json:
        import json

        from softlube.physical import indenter_effect
        from softlube.physical.contact import Contact

        result = {"inputs": inputs} | solution.to_dict()
        if isinstance(solution.contact, Contact):
            result["notes"] = [note.plain() for note in indenter_effect.notes(solution.contact)]
        print(json.dumps(result, allow_nan=False), flush=True)
    else:
        _report(solution, echo(inputs), seconds, [path for path in (output, plot) if path is not None])
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
    from softlube.steady.solve import solve

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
    inputs = understood(dimensionless | physical)
    if as_json:
        import json

        result: dict[str, Any] = {"inputs": inputs, name: problem.parameter, "cavitation": cavitation, "method": "curve"}
        result["quantities"] = {key: q.plain() for key, q in quantities.items()}
        if contact is not None:
            result["dimensional"] = {key: q.plain() | {"unit": q.unit} for key, q in dimensional.items()}
        print(json.dumps(result | {"warnings": list(doubts)}, allow_nan=False), flush=True)
        return 0
    from rich.console import Console

    from softlube.cli.table import show, text_table
    from softlube.model.summary import steady_rows

    console = Console(highlight=False, soft_wrap=True)
    console.print(echo(inputs), markup=False)
    console.print(f"{name} = {problem.parameter:.5g}, read off the master curve: not solved", markup=False)
    show(console, text_table(steady_rows(problem, quantities, dimensional)))
    for doubt in doubts:
        console.print(f"[bold yellow]Warning:[/] {doubt}.")
    return 0


def _write_files(solution: Solution, output: str | None, plot: str | None) -> None:
    """Both files, or none."""
    content: dict[str | os.PathLike[str], bytes] = {}
    if output is not None:
        from softlube.files.netcdf import contents

        content[output] = contents(solution)
    if plot is not None:
        from matplotlib import rc_context

        from softlube.plots.solution import STYLE, image

        with rc_context(STYLE):  # ticks are made when they are drawn
            content[plot] = image(solution.plot(), plot)
    if content:
        from softlube.files.writing import write_whole

        write_whole(content)


# --- what is printed --------------------------------------------------------------------------------------------------


def _report(solution: Solution, inputs: str, seconds: float, files: Sequence[str]) -> None:
    from rich.console import Console

    from softlube.cli.table import show, summary_table
    from softlube.physical import indenter_effect
    from softlube.physical.contact import Contact

    console = Console(highlight=False, soft_wrap=True)
    console.print(inputs, markup=False)
    condition = "Reynolds condition" if solution.problem.cavitation == "reynolds" else "no cavitation condition"
    console.print(f"β = {solution.beta:.5g} (by the load: {solution.beta_load:.5g}), {condition}", markup=False)
    if solution.contact is None and solution.problem.load_controlled:
        console.print("δ is the Hertz indentation of the load, Eq. (29).")
    show(console, summary_table(solution.summary()))
    console.print(_region(solution), markup=False)
    if isinstance(solution.contact, Contact):
        for note in indenter_effect.notes(solution.contact):
            console.print(note.sentence(), markup=False)
    if "lambda_ratio" in solution.dimensional:
        from softlube.physical.roughness import lubrication

        ratio = float(solution.dimensional["lambda_ratio"])
        console.print(f"Minimum film over roughness λ = {ratio:.3g}: {lubrication(ratio)} lubrication (full film from 3 on).")
    sizes = ", ".join(f"{level.n_r} × {level.n_theta}" for level in solution.levels)
    steps = " + ".join(str(sum(record.count for record in level.history)) for level in solution.levels)
    what = "Newton steps" if solution.method == "newton" else f"sweeps of the paper's method ({solution.method})"
    console.print(f"Converged in {seconds:.2f} s: grids of {sizes} cells, {steps} {what}.")
    if solution.method == "newton":
        from softlube.steady.error_estimate import looser
        from softlube.steady.regime import Regime

        factors = looser(Regime.of(solution.problem))
        also = ", film at the inlet" if "film_inlet" in factors else ""
        console.print(
            f"Errors aimed at: {solution.accuracy:g} of each value (minimum film, largest shear{also}: "
            f"{factors['film_min']:g} times that)."
        )
    else:
        console.print("One mesh, so the errors are not known; softlube's own method (--method newton) estimates them.")
    for doubt in solution.warnings:
        console.print(f"[bold yellow]Warning:[/] {doubt}.")
    for path in files:
        console.print(f"Wrote {printable(path)}", markup=False)


def _region(solution: Solution) -> str:
    """How the total friction depends on the region over which it is counted."""
    from softlube.discretization.measure import DOMAIN
    from softlube.model.motions import FIXED_BALL
    from softlube.readout.friction import total_within
    from softlube.steady.regime import Regime

    contact, counted, ratio = solution.contact, float(solution.quantities["friction_total"]), FIXED_BALL
    if contact is not None:
        ratio = contact.slide_to_roll
        counted = float(solution.dimensional["friction_total"]) / contact.scales(contact.unit_height)["friction"][0]
    if counted != counted:  # a spike that no grid resolves
        return "The friction is not given, see the warning."
    edge = Regime.of(solution.problem).edge_radius
    more = [f"over r ≤ {2 * DOMAIN:g}a {total_within(solution, 2 * DOMAIN * edge, ratio) / counted - 1:+.1%}"]
    if contact is not None and contact.radius:  # no other indenter has one
        more.append(
            f"over r ≤ R about {total_within(solution, contact.radius / contact.unit_length, ratio) / counted - 1:+.0%}"
        )
    turns = " Where the ball turns, the shear on it over r ≤ a and the largest shear rate are not known." * (
        ratio != FIXED_BALL and solution.problem.liquid.linear
    )
    return (
        f"A force sensor reads the total friction, over all the liquid in the gap: here r ≤ {DOMAIN:g}a; {', '.join(more)}. "
        "The shear on the ball alone is the paper's friction, Eq. (27a)." + turns
    )
