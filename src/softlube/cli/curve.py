"""``softlube curve``: quantities as functions of β, printed or drawn.  Heavy imports live inside."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group

from softlube.cli.inputs import takes
from softlube.cli.numbers import FLOAT, WHOLE, Cavitation
from softlube.errors import printable
from softlube.physical.inputs import BODIES, Loading

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from softlube.model.problem import Problem

_CONTACT = Group("Contact (for layers, oils, two bodies; else the paper's, from a table)", sort_key=1)
WIDEST = {"table": (1e-2, 1e8), "computed": (1e-2, 1e6)}
"""Range of β where none is given."""
USUAL = ("film_center", "film_min", "friction_total")


@takes((_CONTACT, BODIES, Loading))
def curve(
    *quantity: str,
    beta: Annotated[float | None, FLOAT] = None,
    beta_load: Annotated[float | None, FLOAT] = None,
    by: Literal["indentation", "load"] | None = None,
    start: Annotated[float | None, FLOAT] = None,
    stop: Annotated[float | None, FLOAT] = None,
    points: Annotated[int, WHOLE] = 11,
    cavitation: Cavitation = "reynolds",
    accuracy: Annotated[float | None, FLOAT] = None,
    output: str | None = None,
    plot: str | None = None,
    **physical: str,
) -> int:
    """Print or draw quantities as functions of β.

    Without a contact they are the paper's: a half-space, constant viscosity, from the table of solutions that comes with
    softlube. With one (--radius, --young-modulus, --thickness, --viscosity, --pressure-viscosity, …, and --load or
    --indentation, but no speed) they are computed over a range of speeds, in parallel, and kept for the next time.

    Parameters
    ----------
    quantity
        Names such as film_center and film_min [default: film_center, film_min and friction_total; at one β, all].
    beta
        One β, formed with the indentation; all quantities are printed.
    beta_load
        β with the Hertz indentation of a load in place of h0.
    by
        What a range of β and the quantities are normalised with [default: indentation; with a contact, what it prescribes].
    start
        Smallest β of a range [default: 1e-2].
    stop
        Largest β of a range [default: 1e8; 1e6 with a contact].
    points
        Number of β in it, evenly spaced in ln β.
    cavitation
        "reynolds" (no negative pressure) or "none".
    accuracy
        Relative accuracy of a computed curve [default: 3e-3].
    output
        CSV file for the values and their errors.
    plot
        Picture of the curves with their local exponents (.png, .pdf or .svg).
    **physical
        Inputs of the experiment, as they are declared.
    """
    import io

    import numpy as np

    from softlube.cli.echo import echo, understood
    from softlube.errors import InputError
    from softlube.files.writing import check_destination, write_whole
    from softlube.model.problem import Problem
    from softlube.theory import master_curve as master

    one = beta is not None or beta_load is not None
    for option, path in (("output", output), ("plot", plot)):
        if path is not None:
            check_destination(option, path)
    if plot is not None:
        from softlube.plots.solution import check_format

        check_format("plot", plot)
        if one:
            raise InputError("plot: a curve takes a range; leave --beta and --beta-load out")
    problem = _problem(physical, cavitation, by, one)
    source = "table" if problem is None else "computed"
    if one:
        asked = Problem(beta, beta_load, cavitation)  # type: ignore[arg-type]
        by = "load" if asked.load_controlled else "indentation"
        place = np.array([asked.parameter])
        names: Sequence[str] = quantity or tuple(master.available(by))
    else:
        start, stop = (usual if given is None else given for given, usual in zip((start, stop), WIDEST[source], strict=True))
        if not (0 < start < stop < np.inf and 2 <= points <= 100_000):
            raise InputError(
                f"start, stop, points: expected 0 < start < stop and 2 to 100000 points, got {start}, {stop}, {points}"
            )
        place = np.geomspace(start, stop, points)
        names = quantity or USUAL
    if problem is None:
        if accuracy is not None:
            raise InputError("accuracy: the table has its own errors; the accuracy is for a contact that is computed")
        by = by or "indentation"
        curves: Mapping[str, Callable[..., Any]] = {name: master.curve(name, by, cavitation) for name in names}
    else:
        by = "load" if problem.load_controlled else "indentation"
        curves, place = _computed(problem, place, names, accuracy)
    values = {name: curve(place) for name, curve in curves.items()}

    symbol = "beta_load" if by == "load" else "beta"
    if output is not None:
        columns = [place, *(part for pair in values.values() for part in pair)]
        header = ",".join([symbol, *(name + ending for name in names for ending in ("", "_error"))])
        stream = io.BytesIO()
        np.savetxt(stream, np.column_stack(columns), fmt="%.9g", delimiter=",", header=header, comments="")
        write_whole({output: stream.getvalue()})
    if plot is not None:
        from softlube.plots.solution import image, plot_curves

        picture = plot_curves(curves, symbol, (place[0], place[-1]))  # type: ignore[arg-type]
        write_whole({plot: image(picture, plot, dpi=200)})
    if one or physical:
        print(echo(understood({symbol: float(place[0])} if one else dict(physical))))
    _print(place, values, symbol, one, source)
    for path in (output, plot):
        if path is not None:
            print(f"Wrote {printable(path)}")
    return 0


def _problem(physical: dict[str, str], cavitation: str, by: str | None, one: bool) -> Problem | None:
    """The contact that is given, None for the paper's.

    Raises
    ------
    InputError
        If the contact is none, or contradicts another option.
    """
    from softlube.errors import InputError
    from softlube.physical.contact import Contact

    if not physical:
        return None
    first = next(iter(physical))
    if one:
        raise InputError(f"beta, {first}: a contact has one beta at each speed; give a range, or softlube solve a speed")
    problem = Contact(**physical, speed=1.0, cavitation=cavitation).problem()
    if by is not None and (by == "load") != problem.load_controlled:
        raise InputError(f"by, {first}: a curve of a contact is normalised with what it prescribes; leave by out")
    return problem


def _computed(problem: Problem, place: Any, names: Sequence[str], accuracy: float | None) -> tuple[Any, Any]:
    """Curves over as much of a range as can be solved, and the places in it."""
    import numpy as np

    from softlube.cli.progress import Bar
    from softlube.experiments.curves import quantity_curves
    from softlube.experiments.load_curve import ACCURACY

    with Bar("solving") as bar:
        curves = quantity_curves(problem, place[0], place[-1], names, accuracy=accuracy or ACCURACY, progress=bar.show)
    low, high = max(each.beta[0] for each in curves.values()), min(each.beta[-1] for each in curves.values())
    place = np.clip(place, place[0], place[-1])  # the ends to the digit
    inside = place[(place >= low) & (place <= high)]
    if inside.size < place.size:
        print(f"Solved from {low:.4g} to {high:.4g} only.")
    return curves, inside


def _print(place: Any, values: Any, symbol: str, one: bool, source: str) -> None:
    from rich.console import Console

    from softlube.cli.table import number_table, show, text_table
    from softlube.model.summary import rounded

    cells = {
        name: [rounded(float(value), float(error)) for value, error in zip(*pair, strict=True)] for name, pair in values.items()
    }
    if one:
        rows = [(name, text, f"± {doubt}") for name, ((text, doubt),) in cells.items()]
        table = text_table(rows, ("quantity", "value", "± error"))
    else:
        rows = [(f"{beta:.4g}", *(" ± ".join(column[row]) for column in cells.values())) for row, beta in enumerate(place)]
        table = number_table(rows, (symbol, *cells))
    unit = "the Hertz indentation of the load" if symbol == "beta_load" else "the indentation"
    console = Console(highlight=False, soft_wrap=True)
    origin = "from the master curve" if source == "table" else "computed for this contact"
    console.print(f"Normalised with {unit}; {origin}.", markup=False)
    show(console, table)
