"""One problem solved for a sweep, in whatever process; what it gives back is plain and small."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from functools import cache
from importlib.resources import files

from softlube.errors import SoftlubeError
from softlube.problem import Problem

FRONT = frozenset(
    {
        "cli.py",
        "cli_fit.py",
        "cli_stribeck.py",
        "cli_sweep.py",
        "contact.py",
        "experiments.py",
        "figures.py",
        "files.py",
        "fit_plot.py",
        "plotting.py",
        "reading.py",
        "stribeck.py",
        "tables.py",
    }
)
"""Modules that have no say in the numbers of a solution; any other change of the code counts as another solver."""


@cache
def solver_version() -> str:
    """Release and a digest of the code that solves: results of another solver are not taken for this one's."""
    from softlube import __version__

    digest = hashlib.sha256()
    for item in sorted(files("softlube").iterdir(), key=lambda item: item.name):
        if item.name.endswith(".py") and item.name not in FRONT:
            digest.update(item.name.encode())
            digest.update(item.read_bytes())
    return f"{__version__}+{digest.hexdigest()[:12]}"


def content_key(problem: Problem, accuracy: float) -> str:
    """Digest of all that determines a solution: problem, accuracy and solver."""
    content = {"problem": asdict(problem), "accuracy": accuracy, "solver": solver_version()}
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
            from pathlib import Path

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
