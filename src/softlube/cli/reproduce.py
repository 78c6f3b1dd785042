"""``softlube reproduce``: the paper's figures, their data and a report.  Heavy imports live inside."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from softlube.cli.numbers import WHOLE
from softlube.errors import printable


def reproduce(
    folder: str,
    /,
    *,
    figure: Annotated[list[str] | None, Parameter(negative=())] = None,
    data: str | None = None,
    processes: Annotated[int | None, WHOLE] = None,
) -> int:
    """Solve and draw every figure of the paper, and report our numbers beside the paper's.

    Writes figures/ (PNG and PDF), data/ (CSV), solutions/ (NetCDF) and report.html.

    Parameters
    ----------
    folder
        Where to write; made if it does not exist.
    figure
        One figure only (may be repeated): 5 to 13, S1 to S3, flow, friction, exponents, formulas, contact.
    data
        CSV file with measured friction for figure 13.
    processes
        Number of processes [default: one for each processor, at most four].
    """
    from rich.console import Console

    from softlube.cli.progress import Bar
    from softlube.cli.table import show
    from softlube.paper.reproduce import disagreements
    from softlube.paper.reproduce import reproduce as run

    with Bar("starting") as bar:
        result = run(folder, figure or (), data=data, processes=processes, progress=bar.show)

    console = Console(highlight=False, soft_wrap=True)
    if result.laws:
        show(console, _law_table(result.laws))
    for section, statement in disagreements(result):
        console.print(f"{section.heading.split('.')[0]}: {statement.claim}", markup=False)
        console.print(f"    {statement.remark}", markup=False)
    console.print(
        f"{len(result.solutions)} contacts and {len(result.sections)} figures in {result.seconds:.0f} s. "
        f"Wrote {printable(result.folder / 'report.html')}",
        markup=False,
    )
    return 0


def _law_table(laws):
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, title="Exponents over 100 ≤ β ≤ 10⁴", title_justify="left")
    table.add_column("law")
    for name in ("paper", "here", "±", "differs by", "β → ∞"):
        table.add_column(name, justify="right", no_wrap=True)
    for law in laws:
        table.add_row(
            f"({law.equation}) {law.text.split(',')[0]}",
            f"{law.paper_exponent:.4f}",
            f"{law.exponent:.4f}",
            f"{(law.exponent_high - law.exponent_low) / 2:.4f}",
            f"{law.exponent - law.paper_exponent:+.4f}",
            "none" if law.limit_exponent is None else f"{law.limit_exponent:.2f}",
        )
    return table
