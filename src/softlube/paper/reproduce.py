"""`softlube reproduce`: solve what the paper's figures need, draw them, and write data, solutions and a report."""

from __future__ import annotations

import os
import time
from collections import deque
from collections.abc import Hashable, Iterable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from softlube.errors import InputError
from softlube.paper.figures import FIGURES, Case, FigureSpec, Statement
from softlube.paper.figures.base import BALL_ON_RUBBER, WIDE
from softlube.paper.report import Law, Section, law_table, write_report
from softlube.solvers.notebook import watched
from softlube.solvers.processes import Processes
from softlube.solvers.progress import Listener, Progress
from softlube.steady.solution import Solution

RESOLUTION = 200
"""Dots per inch of the PNG files."""
FOLDERS = ("figures", "data", "solutions")
COSTLY = 3.0
"""A β of ten times this logarithm takes as long as a full film: where the longest jobs are put first."""


@dataclass(frozen=True)
class Reproduction:
    """What was written.

    Attributes
    ----------
    folder : Path
    sections : tuple of Section
        One for each figure, in the order of the report.
    laws : tuple of Law
        The paper's laws beside ours; empty where not all their solutions were needed.
    solutions : mapping of Case to Solution
    seconds : float
    """

    folder: Path
    sections: tuple[Section, ...]
    laws: tuple[Law, ...]
    solutions: Mapping[Case, Solution]
    seconds: float

    @property
    def files(self) -> tuple[Path, ...]:
        """Every file written."""
        return tuple(sorted(path for path in self.folder.rglob("*") if path.is_file()))


def chosen_figures(keys: Iterable[str]) -> list[FigureSpec]:
    """Figures by their keys, all if none is given.

    Raises
    ------
    InputError
        If a key is unknown.
    """
    keys = list(dict.fromkeys(keys))
    for key in keys:
        if key not in FIGURES:
            raise InputError(f"figure: there is no figure {key!r}; expected one of {', '.join(FIGURES)}")
    return [spec for key, spec in FIGURES.items() if not keys or key in keys]


def solve_case(case: Case) -> Solution:
    """Solve one case at the accuracy that its figures want."""
    if case.physical:
        from softlube.physical.contact import Contact

        return Contact(**BALL_ON_RUBBER).solve()
    from softlube.steady.solve import solve

    return solve(case.beta, cavitation=case.cavitation, accuracy=case.accuracy)


def _solve_and_save(case: Case, folder: Path) -> Solution:
    solution = solve_case(case)
    solution.save(folder / "solutions" / f"{case.name}.nc")
    return solution


def _draw_and_save(key: str, solutions: Mapping[Case, Solution], folder: Path, data: Path | None) -> Section:
    """Draw one figure and write its pictures and tables; called in a process of its own."""
    from softlube.files.writing import write_whole
    from softlube.plots.solution import image

    spec = FIGURES[key]
    drawn = spec.draw(solutions, data) if key == "13" else spec.draw(solutions)
    picture = folder / "figures" / f"{spec.stem}.png"
    paths = picture, picture.with_suffix(".pdf")
    write_whole({path: image(drawn.figure, path, dpi=RESOLUTION) for path in paths})
    tables = []
    for table in drawn.tables:
        path = folder / "data" / f"{spec.stem}-{table.name}.csv"
        table.write(path)
        tables.append(path.name)
    return Section(spec.key, spec.heading, spec.caption, picture, tuple(tables), tuple(drawn.statements))


@watched
def reproduce(
    folder: str | os.PathLike[str],
    figures: Sequence[str] = (),
    *,
    data: str | os.PathLike[str] | None = None,
    processes: int | None = None,
    progress: Listener | None = None,
) -> Reproduction:
    """Solve, draw and report the paper's figures.

    Parameters
    ----------
    folder : path-like
        Where to write; made if it does not exist.  Gets figures/ (PNG and PDF), data/ (CSV), solutions/ (NetCDF) and
        report.html.
    figures : sequence of str
        Keys of `softlube.paper.figures.FIGURES`; all if empty.
    data : path-like, optional
        CSV file with measured friction for Fig. 13; see `softlube.paper.figures.measured.read_friction`.
    processes : int, optional
        Number of processes; by default as many as there are processors, at most four.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each job; its message names the job.

    Returns
    -------
    Reproduction

    Raises
    ------
    InputError
        If a figure is unknown, the data cannot be read, or the folder cannot be written to.
    NotConvergedError
        If a case cannot be solved.
    """
    began = time.perf_counter()
    specs = chosen_figures(figures)
    if processes is None:
        processes = min(os.cpu_count() or 1, 4)
    if processes < 1:
        raise InputError(f"processes: expected a positive number, got {processes!r}")
    measured = None if data is None else Path(data)
    if measured is not None:
        if not any(spec.key == "13" for spec in specs):
            raise InputError("data: measured friction goes into figure 13, which is not among those asked for")
        from softlube.paper.figures.measured import read_friction

        read_friction(measured)
    target = _prepared(folder)
    solutions, sections = _run(specs, target, measured, processes, progress)
    wide = [solutions.get(Case(beta)) for beta in WIDE]
    known = [solution for solution in wide if solution is not None]
    laws = law_table(known) if len(known) == len(WIDE) else ()
    if laws:
        _write_laws(laws, target / "data" / "laws.csv")
    seconds = time.perf_counter() - began
    write_report(target / "report.html", sections, laws, len(solutions), seconds)
    return Reproduction(target, tuple(sections), tuple(laws), solutions, seconds)


def _prepared(folder: str | os.PathLike[str]) -> Path:
    target = Path(folder)
    if target.exists() and not target.is_dir():
        raise InputError(f"{os.fspath(folder)!r} is a file; expected the name of a folder")
    try:
        for name in FOLDERS:
            (target / name).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"the folder {os.fspath(folder)!r} cannot be made ({error.strerror})") from None
    if not os.access(target, os.W_OK):
        raise InputError(f"the folder {os.fspath(folder)!r} cannot be written to")
    return target


def _effort(case: Case) -> float:
    """Rough time of a case, to start the long ones first."""
    return case.beta ** (1 / COSTLY) * (3 if case.cavitation == "none" or case.accuracy < 1e-3 else 1) + 100 / case.beta


def _run(
    specs: Sequence[FigureSpec], folder: Path, data: Path | None, processes: int, progress: Listener | None
) -> tuple[dict[Case, Solution], list[Section]]:
    """Solve and draw, each figure as soon as its cases are there."""
    cases = sorted({case for spec in specs for case in spec.cases}, key=_effort, reverse=True)
    solutions: dict[Case, Solution] = {}
    sections: dict[str, Section] = {}
    total = len(cases) + len(specs)

    def report(what: str) -> None:
        if progress is not None:
            progress(Progress(what, len(solutions) + len(sections), total))

    report("starting")
    if processes == 1:
        for case in cases:
            solutions[case] = _solve_and_save(case, folder)
            report(f"solved {case.name}")
        for spec in specs:
            sections[spec.key] = _draw_and_save(spec.key, {c: solutions[c] for c in spec.cases}, folder, data)
            report(f"drew {spec.stem}")
        return solutions, [sections[spec.key] for spec in specs]

    pool = Processes(processes)
    unsolved, undrawn = deque(cases), list(specs)
    flying: dict[Future[Any], tuple[Hashable, Case | FigureSpec]] = {}
    try:
        while unsolved or undrawn or flying:
            busy = {lane for lane, _ in flying.values()}
            for lane in (lane for lane in pool.lanes if lane not in busy):
                spec = next((spec for spec in undrawn if all(case in solutions for case in spec.cases)), None)
                if spec is not None:
                    undrawn.remove(spec)
                    own = {case: solutions[case] for case in spec.cases}
                    flying[pool.submit(lane, _draw_and_save, spec.key, own, folder, data)] = lane, spec
                elif unsolved:
                    case = unsolved.popleft()
                    flying[pool.submit(lane, _solve_and_save, case, folder)] = lane, case
            for future in wait(flying, return_when=FIRST_COMPLETED).done:
                _, job = flying.pop(future)
                if isinstance(job, Case):
                    solutions[job] = future.result()
                    report(f"solved {job.name}")
                else:
                    sections[job.key] = future.result()
                    report(f"drew {job.stem}")
    finally:
        pool.close()
    return solutions, [sections[spec.key] for spec in specs]


def _write_laws(laws: Sequence[Law], path: Path) -> None:
    from softlube.paper.figures import Table

    columns = {name: [getattr(law, name) for law in laws] for name in Law.__dataclass_fields__}
    Table("laws", {name: ["" if value is None else value for value in values] for name, values in columns.items()}).write(path)


def disagreements(reproduction: Reproduction) -> list[tuple[Section, Statement]]:
    """Where the paper and we disagree."""
    return [(s, statement) for s in reproduction.sections for statement in s.statements if statement.verdict == "disagrees"]
