"""One task solved for a sweep, in whatever process, and the key of what comes of it."""

from __future__ import annotations

import hashlib
import json
import warnings
from collections.abc import Mapping

from softlube.errors import SoftlubeError, ValidityWarning
from softlube.solvers.code_version import NUMERICS, STEADY, code_version
from softlube.sweeps.tasks import Outcome, Task

ROOMS: Mapping[str, tuple[str, ...]] = {
    "steady": STEADY,
    "squeeze": (*NUMERICS, "transient/*.py", "transient/squeeze/*.py"),
    "sliding": (*STEADY, "transient/**/*.py"),
}
"""Files of this package that decide on the numbers of each kind of task: whole folders, so that no new module is missed."""


def solver_version(kind: str) -> str:
    """Release, and a digest of the code that solves a kind of task; see `softlube.solvers.code_version`.

    Parameters
    ----------
    kind : str
        A key of `ROOMS`.
    """
    return code_version(ROOMS[kind])


def content_key(task: Task, accuracy: float) -> str:
    """Digest of all that determines a solution: task, accuracy and solver."""
    content = {"problem": task.to_plain(), "accuracy": accuracy, "solver": solver_version(task.kind)}
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def solve_one(task: Task, accuracy: float, with_fields: bool) -> Outcome:
    """Solve; whatever goes wrong is an outcome, too."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ValidityWarning)  # the outcome has the doubts
            return task.solve(accuracy, with_fields)
    except SoftlubeError as error:
        return Outcome(str(error))
    except Exception as error:  # a defect met in one case must not take the others with it
        return Outcome(f"{type(error).__name__}: {error}")
