"""``softlube curve``: the master curve, printed or drawn.  Heavy imports live inside."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter


def curve(
    *quantity: str,
    beta: Annotated[float | None, Parameter(allow_leading_hyphen=True)] = None,
    beta_load: Annotated[float | None, Parameter(allow_leading_hyphen=True)] = None,
    by: Literal["indentation", "load"] = "indentation",
    start: float = 1e-2,
    stop: float = 1e8,
    points: int = 11,
    cavitation: str = "reynolds",
    csv: str | None = None,
    plot: str | None = None,
) -> int:
    """Print or draw quantities as functions of β, from the table of solutions that comes with softlube.

    Parameters
    ----------
    quantity
        Names such as film_center and film_min [default: film_center, film_min and friction_domain; at one β, all].
    beta
        One β, formed with the indentation; all quantities are printed.
    beta_load
        β with the Hertz indentation of a load in place of h0.
    by
        What a range of β and the quantities are normalised with.
    start
        Smallest β of a range.
    stop
        Largest β of a range.
    points
        Number of β in it, evenly spaced in ln β.
    cavitation
        "reynolds" (no negative pressure) or "none".
    csv
        File for the values and their errors.
    plot
        Picture of the curves with their local exponents (.png, .pdf or .svg).
    """
    import numpy as np

    from softlube.cli.echo import echo, understood
    from softlube.errors import InputError
    from softlube.files.writing import check_destination, whole_file
    from softlube.model.problem import Problem
    from softlube.theory import master_curve as master

    one = beta is not None or beta_load is not None
    if one:
        problem = Problem(beta, beta_load, cavitation)  # type: ignore[arg-type]
        by = "load" if problem.load_controlled else "indentation"
        names = quantity or tuple(master.available(by))
        place = np.array([problem.parameter])
    else:
        if not (0 < start < stop < np.inf and 2 <= points <= 100_000):
            raise InputError(
                f"start, stop, points: expected 0 < start < stop and 2 to 100000 points, got {start}, {stop}, {points}"
            )
        names = quantity or ("film_center", "film_min", "friction_domain")
        place = np.geomspace(start, stop, points)
    for option, path in (("csv", csv), ("plot", plot)):
        if path is not None:
            check_destination(option, path)
    if plot is not None:
        from softlube.plots.solution import check_format

        check_format("plot", plot)
        if one:
            raise InputError("plot: a curve takes a range; leave --beta and --beta-load out")
    curves = {name: master.curve(name, by, cavitation) for name in names}
    values = {name: curve(place) for name, curve in curves.items()}

    symbol = "beta_load" if by == "load" else "beta"
    if csv is not None:
        columns = [place, *(part for pair in values.values() for part in pair)]
        header = ",".join([symbol, *(name + ending for name in names for ending in ("", "_error"))])
        with whole_file(csv) as temporary:
            np.savetxt(temporary, np.column_stack(columns), fmt="%.9g", delimiter=",", header=header, comments="")
    if plot is not None:
        from softlube.plots.solution import plot_curves

        with whole_file(plot) as temporary:
            plot_curves(curves, symbol, (start, stop)).savefig(temporary, dpi=200)
    if one:
        print(echo(understood({symbol: float(place[0])})))
    _print(place, values, symbol, one)
    for path in (csv, plot):
        if path is not None:
            print(f"Wrote {path}")
    return 0


def _print(place, values, symbol: str, one: bool) -> None:
    from rich import box
    from rich.console import Console
    from rich.table import Table

    from softlube.cli.table import rounded

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    if one:
        for column in ("quantity", "value", "± error"):
            table.add_column(column, no_wrap=True, justify="right" if column == "value" else "left")
        for name, (value, error) in values.items():
            text, doubt = rounded(float(value[0]), float(error[0]))
            table.add_row(name, text, f"± {doubt}")
    else:
        table.add_column(symbol, justify="right", no_wrap=True)
        for name in values:
            table.add_column(name, justify="right")
        for row, beta in enumerate(place):
            cells = (rounded(float(value[row]), float(error[row])) for value, error in values.values())
            table.add_row(f"{beta:.4g}", *(f"{text} ± {doubt}" for text, doubt in cells))
    unit = "the Hertz indentation of the load" if symbol == "beta_load" else "the indentation"
    console = Console(highlight=False, soft_wrap=True)
    console.print(f"Normalised with {unit}; from the master curve.", markup=False)
    console.print(table, soft_wrap=False)
