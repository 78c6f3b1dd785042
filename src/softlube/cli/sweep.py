"""``softlube sweep plan.toml``: many contacts or squeeze films from the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from softlube.cli.numbers import WHOLE
from softlube.errors import printable

if TYPE_CHECKING:
    from pathlib import Path

    from softlube.sweeps import Sweep

REASONS = 5
"""Failures told one by one at the end; the table has them all."""


def sweep(
    plan: str,
    /,
    *,
    output: str | None = None,
    store: str | None = None,
    fields: str | None = None,
    workers: Annotated[int | None, WHOLE] = None,
    scheduler: str | None = None,
    retry_failed: Annotated[bool, Parameter(negative=())] = False,
    salvage: str | None = None,
) -> int:
    """Solve all cases of a plan, each kept as soon as it is solved; run it again to take up what was broken off.

    A case that cannot be solved is a row that says why. The exit code is 0 if any case was solved, 3 if none.

    Parameters
    ----------
    plan
        TOML file with the parameters: values, lists, ranges, columns of a CSV file; of squeeze films with motion = "squeeze".
    output
        Table of the results, .csv, .parquet or .nc [default: PLAN-results.csv beside the plan].
    store
        Database in which finished cases are kept [default: PLAN.sweep beside the plan].
    fields
        Folder for one NetCDF file a case.
    workers
        Processes on this machine [default: one a core].
    scheduler
        Address of a Dask scheduler, such as tcp://host:8786, to solve on its workers.
    retry_failed
        Solve again what has failed before.
    salvage
        Solve nothing; copy what is sound in a damaged store into a new one of this name.
    """
    from pathlib import Path

    from softlube.cli.echo import echo, understood
    from softlube.cli.progress import Bar
    from softlube.errors import InputError
    from softlube.files.writing import check_destination
    from softlube.sweeps.plan import read_plan
    from softlube.sweeps.results import check_folder, check_table
    from softlube.sweeps.run import sweep as run

    # Everything that can be refused is refused before anything is computed or written.
    cases = read_plan(plan)
    here = Path(plan)
    table_path = check_table("output", output if output is not None else here.with_name(f"{here.stem}-results.csv"))
    store_path = check_destination("store", store if store is not None else here.with_suffix(".sweep"))
    taken = {path.resolve() for path in cases.sources}
    for name, path in (("output", table_path), ("store", store_path)):
        if path.resolve() in taken:
            raise InputError(f"{name}: {str(path)!r} is read by the plan, or written already; expected another file")
        taken.add(path.resolve())
    if salvage is not None:
        from softlube.sweeps.salvage import salvage as copy

        print(f"Copied {copy(store_path, salvage)} outcomes from {store_path} to {salvage}")
        return 0
    if fields is not None:
        check_folder("fields", fields)
    for notice in cases.notices:
        _say(f"Note: {printable(notice)}.")

    with Bar("solving") as bar:
        result = run(
            cases,
            store=store_path,
            workers=workers,
            scheduler=scheduler,
            fields=fields is not None,
            retry_failed=retry_failed,
            progress=bar.show,
        )
    result.save(table_path)
    written = result.save_fields(fields) if fields is not None else []
    print(echo(understood(cases.inputs())))
    _report(result, table_path, store_path, written)
    return 3 if result.n_failed == len(result.keys) else 0


def _say(text: str) -> None:
    from rich.console import Console

    Console(stderr=True, highlight=False, soft_wrap=True).print(text, markup=False)


def _report(result: Sweep, table: Path, store: Path, written: list[Path]) -> None:
    from rich.console import Console

    console, total = Console(highlight=False, soft_wrap=True), len(set(result.keys))
    console.print(
        f"{len(result.keys)} cases, {total} different problems: {result.n_found} were in the store, "
        f"{total - result.n_found} solved now. {result.n_failed} cases failed.",
        markup=False,
    )
    if result.n_foreign:
        console.print(f"The store also has {result.n_foreign} outcomes of another version of softlube: kept, not used.")
    if warned := result.n_warned:
        console.print(f"{warned} {'case has' if warned == 1 else 'cases have'} warnings; see the column warnings of the table.")
    reasons: dict[str, list[int]] = {}
    for number, key in enumerate(result.keys, 1):
        if result.outcomes[key].failed:
            reasons.setdefault(result.outcomes[key].reason, []).append(number)
    for reason, numbers in list(reasons.items())[:REASONS]:
        console.print(
            f"  case {', '.join(map(str, numbers[:REASONS]))}{', …' if len(numbers) > REASONS else ''}: {reason}", markup=False
        )
    if len(reasons) > REASONS:
        console.print(f"  and {len(reasons) - REASONS} other reasons; the table has them.", markup=False)
    files = [str(table), str(store), *([f"{len(written)} NetCDF files in {written[0].parent}"] if written else [])]
    console.print(f"Wrote {printable(', '.join(files))}", markup=False)
