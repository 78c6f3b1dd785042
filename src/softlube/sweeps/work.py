"""One problem solved for a sweep, in whatever process; what it gives back is plain and small."""

from __future__ import annotations

import ast
import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from pathlib import Path

from softlube.errors import SoftlubeError
from softlube.problem import Problem

NO_SAY = frozenset({"cli", "contact", "files", "io", "paper", "plotting", "sweeps"})
"""Modules that `softlube.solver` can reach and that have no say in its numbers."""


@cache
def solver_version() -> str:
    """Release and a digest of the code that solves: results of another solver are not taken for this one's."""
    from softlube import __version__

    digest = hashlib.sha256()
    for name, source in sorted(_sources("solver").items()):
        digest.update(name.encode() + b"\0" + source + b"\0")
    return f"{__version__}+{digest.hexdigest()[:12]}"


def _sources(start: str) -> dict[str, bytes]:
    """Source of a module of this package and of all those of the package that it imports, directly or not."""
    found: dict[str, bytes] = {}
    waiting = [start]
    while waiting:
        name = waiting.pop()
        path = Path(str(files("softlube"))).joinpath(*name.split("."))
        path = path / "__init__.py" if path.is_dir() else path.parent / f"{path.name}.py"
        if name in found or name.split(".")[0] in NO_SAY or not path.is_file():
            continue
        found[name] = path.read_bytes()
        for node in ast.walk(ast.parse(found[name])):
            if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == "softlube":
                inner = node.module.split(".")[1:]
                waiting += [".".join(inner)] if inner else []
                waiting += [".".join([*inner, item.name]) for item in node.names]
            elif isinstance(node, ast.Import):
                waiting += [item.name.removeprefix("softlube.") for item in node.names if item.name.startswith("softlube.")]
    return found


def content_key(problem: Problem, accuracy: float) -> str:
    """Digest of all that determines a solution: problem, accuracy and solver."""
    content = {"problem": problem.to_plain(), "accuracy": accuracy, "solver": solver_version()}
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


@dataclass(frozen=True)
class Outcome:
    """What came of a problem.

    Attributes
    ----------
    reason : str
        Why it failed; empty if it did not.
    beta, beta_load : float
        See `softlube.Solution`; nan for a failure.
    quantities : mapping of str to (value, error)
        See `softlube.Solution.quantities`.
    fields : bytes or None
        The solution as a NetCDF file, if asked for.
    """

    reason: str = ""
    beta: float = float("nan")
    beta_load: float = float("nan")
    quantities: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    fields: bytes | None = None

    @property
    def failed(self) -> bool:
        """Whether there is no solution."""
        return bool(self.reason)


def solve_one(problem: Problem, accuracy: float, with_fields: bool) -> Outcome:
    """Solve; whatever goes wrong is an outcome, too."""
    from softlube.solver import solve_problem

    try:
        solution = solve_problem(problem, accuracy=accuracy)
        fields = None
        if with_fields:
            import tempfile

            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "solution.nc"
                solution.save(path)
                fields = path.read_bytes()
        quantities = {name: (float(quantity), quantity.error) for name, quantity in solution.quantities.items()}
        return Outcome("", solution.beta, solution.beta_load, quantities, fields)
    except SoftlubeError as error:
        return Outcome(str(error))
    except Exception as error:  # a defect met in one case must not take the others with it
        return Outcome(f"{type(error).__name__}: {error}")
