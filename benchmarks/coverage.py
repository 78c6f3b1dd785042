"""How true are the errors?  Random problems of every kind against much finer grids, as a table in Markdown.

    python benchmarks/coverage.py FOLDER [--cases 60] [--kinds light,squeeze] [--seed 19] [--accuracy 1e-3] [--by-quantity]

Every kind of `KINDS` has as many cases; one in three is without the Reynolds condition.  The values on fine grids are kept in
FOLDER, and so are the results of this version of the code, so that an interrupted run goes on where it was and another version
is compared with the same values: half a minute a case at first, a second afterwards.

"Covered" are the errors below their estimates (and the reference's own uncertainty), "ratio" is estimate over error, "target"
the share of values that are as accurate as asked.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections import defaultdict
from collections.abc import Callable, Iterable
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from fine_grid import reference
from scipy.interpolate import PchipInterpolator

from softlube.errors import NotConvergedError
from softlube.model.exact import HERTZ_LOAD, HERTZ_PRESSURE
from softlube.model.indenters import PowerShape, RoundedPunchShape, Shape, SphereShape
from softlube.model.liquids.barus import BarusLaw
from softlube.model.liquids.roelands import RoelandsLaw
from softlube.model.problem import Problem
from softlube.model.quantities import QUANTITIES
from softlube.model.substrates import CreepingKernel, LayerKernel, ViscoelasticKernel
from softlube.solvers.code_version import code_version
from softlube.steady.error_estimate import looser, yardstick
from softlube.steady.regime import Regime
from softlube.steady.solve import solve_problem
from softlube.transient.motion import Motion, constant_load, history
from softlube.transient.sliding.result import HISTORIES, follow_sliding
from softlube.transient.sliding.result import measured as slid
from softlube.transient.squeeze.integrate import integrate
from softlube.transient.squeeze.result import follow

Random = np.random.Generator
Rows = list[tuple[str, float, float, float, bool]]
"""Quantity, error, estimate, uncertainty of the reference, and whether the value is as accurate as asked."""


def _between(rng: Random, low: float, high: float) -> float:
    """A number whose logarithm is uniform."""
    return float(10 ** rng.uniform(np.log10(low), np.log10(high)))


def _half_space(rng: Random, low: float, high: float) -> dict[str, Any]:
    return {"beta" if rng.random() < 0.6 else "beta_load": _between(rng, low, high)}


def _layer(rng: Random, thinnest: float, thickest: float) -> dict[str, Any]:
    ratio, base = float(rng.choice([0.5, 0.5, 0.45, 0.3])), str(rng.choice(["bonded", "bonded", "frictionless"]))
    substrate = LayerKernel(_between(rng, thinnest, thickest), ratio, base)  # type: ignore[arg-type]
    return _half_space(rng, 10, 1e4) | {"substrate": substrate}


def _fading(rng: Random) -> tuple[float, ...]:
    """Shares of a compliance that grows by a factor of 1.2 to 10, in one to four times."""
    terms = int(rng.integers(1, 5))
    return tuple((rng.dirichlet(np.ones(terms)) * (1 - 1 / _between(rng, 1.2, 10))).tolist())


def _remembering(rng: Random) -> dict[str, Any]:
    shares = _fading(rng)
    lengths = tuple(_between(rng, 0.03, 30) for _ in shares)
    return _half_space(rng, 10, 1e5) | {"substrate": ViscoelasticKernel(shares, lengths)}


def _barus(rng: Random) -> dict[str, Any]:
    return {"beta": _between(rng, 10, 1e5), "liquid": BarusLaw(rng.uniform(0.2, 5) / HERTZ_PRESSURE)}


def _roelands(rng: Random) -> dict[str, Any]:
    law = RoelandsLaw(rng.uniform(0.2, 5) / HERTZ_PRESSURE, rng.uniform(0.4, 0.8), _between(rng, 0.03, 3))
    return {"beta": _between(rng, 10, 1e5), "liquid": law}


def _shaped(rng: Random, indenter: Shape) -> dict[str, Any]:
    """A contact of an indenter with β′ from 30 to 10⁶."""
    known = _half_space(rng, 30, 1e6)
    (name,) = known
    like = Regime.of(Problem(**{name: 1.0}, indenter=indenter)).dry.like_hertz(1.0)
    return {name: known[name] / like, "indenter": indenter}


HALF_SPACES_AND_LAYERS: dict[str, Callable[[Random], dict[str, Any]]] = {
    "light": lambda rng: {"beta_load": _between(rng, 1e-4, 3.5)},
    "touching": lambda rng: {"beta_load": _between(rng, 3.5, 12)},
    "10-1e4": lambda rng: _half_space(rng, 10, 1e4),
    "1e4-1e6": lambda rng: _half_space(rng, 1e4, 1e6),
    "above": lambda rng: _half_space(rng, 1e6, 1e8),
    "layer t>a": lambda rng: _layer(rng, 1, 4),
    "layer t<a": lambda rng: _layer(rng, 0.25, 1),
    "Barus": _barus,
    "Roelands": _roelands,
}
INDENTERS: dict[str, Callable[[Random], dict[str, Any]]] = {
    "height r^4": lambda rng: _shaped(rng, PowerShape(_between(rng, 0.01, 1), 1.0, 4.0)),
    "true sphere": lambda rng: _shaped(rng, SphereShape(0.3**2, 1.0)),
    "punch": lambda rng: _shaped(rng, RoundedPunchShape(0.1, 1.0, face := rng.uniform(0.1, 0.3), 0.4 * face)),
}
MEMORIES: dict[str, Callable[[Random], dict[str, Any]]] = {"remembers": _remembering}
STEADY = HALF_SPACES_AND_LAYERS | INDENTERS | MEMORIES
TRANSIENT = ("squeeze", "start of sliding")
CREEPING = "squeeze remembers"
KINDS = (*HALF_SPACES_AND_LAYERS, *TRANSIENT, *INDENTERS, *MEMORIES, CREEPING)


def steady_problem(kind: str, rng: Random, case: int) -> Problem:
    """One steady case."""
    return Problem(**STEADY[kind](rng), cavitation="none" if case % 3 == 2 else "reynolds")


def squeezing(rng: Random, _: int) -> Motion:
    """A squeeze film under a constant load."""
    return constant_load(_between(rng, 0.1, 1) * HERTZ_LOAD, rng.uniform(0.5, 2), _between(rng, 10, 300))


def creeping(rng: Random, case: int) -> Motion:
    """A squeeze film on a substrate that remembers, under a constant load; one in three is pressed to a depth and held."""
    shares = _fading(rng)
    times = tuple(_between(rng, 0.3, 3000) for _ in shares)
    start, end = rng.uniform(0.5, 2), _between(rng, 10, 3000)
    motion = constant_load(_between(rng, 0.1, 1) * HERTZ_LOAD, start, end)
    if case % 3 == 2:
        depth = rng.uniform(0.2, 1)
        motion = history("height", [0, min(_between(rng, 3, 30), end / 2), end], [start, -depth, -depth])
    return replace(motion, substrate=CreepingKernel(shares, times))


SQUEEZED: dict[str, Callable[[Random, int], Motion]] = {"squeeze": squeezing, CREEPING: creeping}


def starting(rng: Random, case: int) -> tuple[Motion, dict[str, Any]]:
    """A start of sliding under a constant load."""
    beta = _between(rng, 30, 3000)
    motion = constant_load(HERTZ_LOAD, rng.uniform(0.3, 1.5), beta * rng.uniform(0.5, 2))
    return motion, {"beta": beta, "cavitation": "none" if case % 3 == 2 else "reynolds"}


def exact_values(kind: str, rng: Random, case: int) -> dict[str, Any]:
    """A case on fine grids: a pair (value, uncertainty) for each quantity, or histories and their times."""
    if kind in STEADY:
        return dict(reference(steady_problem(kind, rng, case)))
    if kind in SQUEEZED:
        run = integrate(SQUEEZED[kind](rng, case), rings=256, tolerance=1e-7)
        return {"time": run.time.tolist()} | {name: each.tolist() for name, each in run.histories().items()}
    motion, sliding = starting(rng, case)
    run, histories = slid(motion, n_theta=39, tolerance=1e-4, **sliding)
    return {"time": run.time.tolist()} | {name: each.tolist() for name, each in histories.items()}


def compared(kind: str, rng: Random, case: int, exact: dict[str, Any], accuracy: float | None) -> Rows:
    """Errors and estimates of a case as this version of the code solves it; nothing where it is refused."""
    given = {} if accuracy is None else {"accuracy": accuracy}
    if kind in STEADY:
        problem = steady_problem(kind, rng, case)
        solution = solve_problem(problem, **given)
        factors = looser(Regime.of(problem))
        values = {name: pair[0] for name, pair in exact.items()}
        rows: Rows = []
        for name, (value, uncertainty) in exact.items():
            mine, size = solution.quantities[name], yardstick(name, values)
            if mine.error > 0 and not QUANTITIES[name].place:
                error = abs(mine - value) / size
                target = bool(error <= solution.accuracy * factors.get(name, 1.0))
                rows.append((name, error, mine.error / size, uncertainty / size, target))
        return rows
    sliding: dict[str, Any] = {}
    if kind in SQUEEZED:
        film = follow(SQUEEZED[kind](rng, case), **given)
    else:
        motion, sliding = starting(rng, case)
        film = follow_sliding(motion, **sliding, **given)
    rows = []
    for name in ("film_center", "film_min", "pressure_max", *(HISTORIES[-2:] if sliding else ())):
        true = PchipInterpolator(exact["time"], exact[name])(np.minimum(film.time, exact["time"][-1]))
        for mine, value, error in zip(film.histories[name][1:], true[1:], film.errors[name][1:], strict=True):
            off = abs(mine - value) / abs(value)
            rows.append((name, float(off), float(error / abs(value)), 1e-6, bool(off <= film.accuracy)))
    return rows


def kept(path: Path, key: str, compute: Callable[[], Any]) -> Any:
    """What a file of JSON lines has under a key; computed and added where it has nothing."""
    lines = path.read_text().splitlines() if path.exists() else []
    known = dict(json.loads(line) for line in lines)
    if key not in known:
        known[key] = compute()
        with path.open("a") as file:
            file.write(json.dumps([key, known[key]]) + "\n")
    return known[key]


def line(name: str, rows: Iterable[tuple[str, float, float, float, bool]], extra: str = "") -> str:
    """One line of the table."""
    error, estimate, uncertainty, target = (np.array(column) for column in zip(*[row[1:] for row in rows], strict=True))
    ratio = estimate / np.maximum(error, np.maximum(uncertainty / 2, 1e-7))
    covered = np.mean(error <= estimate + uncertainty)
    return (
        f"| {name:32s} | {error.size:6d} | {np.median(error):8.1e} | {covered:7.1%} | {np.median(ratio):6.2f} "
        f"| {np.quantile(ratio, 0.9):6.1f} | {target.mean():7.1%} |{extra}"
    )


def main() -> None:
    """Run the cases and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--cases", type=int, default=60)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--seed", type=int, default=19)
    parser.add_argument("--accuracy", type=float)
    parser.add_argument("--by-quantity", action="store_true", help="a line for every quantity of every kind")
    options = parser.parse_args()
    kinds = options.kinds.split(",")
    options.folder.mkdir(parents=True, exist_ok=True)
    version = code_version(("**/*.py",))
    found: dict[str, Rows] = defaultdict(list)
    refused: dict[str, int] = defaultdict(int)
    for case, kind in product(range(options.cases), kinds):
        seed, key = [options.seed, KINDS.index(kind), case], f"{kind} {options.seed} {case}"
        try:
            exact = kept(
                options.folder / "references.jsonl",
                key,
                lambda k=kind, s=seed, c=case: exact_values(k, np.random.default_rng(s), c),
            )
        except NotConvergedError as error:
            print(f"\r{key} has no reference, and is left out: {error}", file=sys.stderr)
            continue

        def solved(kind: str = kind, seed: list[int] = seed, case: int = case, exact: dict[str, Any] = exact) -> Any:
            try:
                return compared(kind, np.random.default_rng(seed), case, exact, options.accuracy)
            except NotConvergedError as error:
                return str(error)

        rows = kept(options.folder / f"solved-{version}.jsonl", f"{key} {options.accuracy}", solved)
        print(f"\r{key}", end="", file=sys.stderr, flush=True)
        if isinstance(rows, str):
            refused[kind] += 1
            print(f"\r{key} refused: {rows}", file=sys.stderr)
        else:
            found[kind] += rows
            if kind in STEADY:
                found["none" if case % 3 == 2 else "reynolds"] += rows
    print(f"\r{options.cases} cases of each kind, seed {options.seed}, {version}")
    print("| kind                             | values |   median | covered |  ratio | nine tenths | target | refused |")
    print("|---|---|---|---|---|---|---|---|")
    for kind, rows in found.items():
        print(line(kind, rows, f" {refused[kind]} |"))
        if options.by_quantity:
            for name in dict.fromkeys(row[0] for row in rows):
                print(line(f"{kind}: {name}", [row for row in rows if row[0] == name], " |"))
    steady = [row for kind in STEADY for row in found.get(kind, [])]
    for name in dict.fromkeys(row[0] for row in steady):
        print(line(name, [row for row in steady if row[0] == name], " |"))


if __name__ == "__main__":
    main()
