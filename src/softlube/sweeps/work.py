"""One task solved for a sweep, in whatever process, and the key of what comes of it."""

from __future__ import annotations

import ast
import hashlib
import json
import warnings
from collections.abc import Mapping
from functools import cache
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from typing import Any

from softlube.errors import SoftlubeError, ValidityWarning
from softlube.sweeps.tasks import Outcome, Task

NUMERICS = ("model/**/*.py", "solvers/**/*.py", "discretization/**/*.py")
STEADY = (*NUMERICS, "steady/**/*.py")
ROOMS: Mapping[str, tuple[str, ...]] = {
    "steady": STEADY,
    "squeeze": (*NUMERICS, "transient/*.py", "transient/squeeze/*.py"),
    "sliding": (*STEADY, "transient/**/*.py"),
}
"""Files of this package that decide on the numbers of each kind of task: whole folders, so that no new module is missed."""


def package_folder() -> Path:
    """Where the modules of this package are."""
    return Path(str(files("softlube")))


@cache
def solver_version(kind: str) -> str:
    """Release, and a digest of the code that solves a kind of task: results of other code are not taken for its own.

    Comments, docstrings, declarations of inputs and the layout of the text do not count, nor does the version of Python.

    Parameters
    ----------
    kind : str
        A key of `ROOMS`.
    """
    folder = package_folder()
    digest = hashlib.sha256()
    for path in sorted({path for pattern in ROOMS[kind] for path in folder.glob(pattern)}):
        digest.update(repr((path.relative_to(folder).as_posix(), _meaning(ast.parse(path.read_bytes())))).encode())
    return f"{version('softlube')}+{digest.hexdigest()[:12]}"


def _meaning(node: Any) -> Any:
    """A syntax tree as nested tuples, without strings that stand alone, declarations of inputs, and fields that are empty.

    `ast.dump` would do but for its differences between versions of Python, which are in the empty fields.
    """
    if isinstance(node, ast.AST):
        fields = ((name, _meaning(value)) for name, value in ast.iter_fields(node) if value not in (None, []))
        return type(node).__name__, *fields
    if isinstance(node, list):
        return tuple(_meaning(item) for item in node if not (_stands_alone(item) or _declares(item)))
    return node


def _stands_alone(node: Any) -> bool:
    """Whether a statement is nothing but a string: a docstring."""
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def _declares(node: Any) -> bool:
    """Whether a statement declares an input, ``radius: float = given(…)``: tasks have numbers, whatever they were read from."""
    called = node.value.func if isinstance(node, ast.AnnAssign | ast.Assign) and isinstance(node.value, ast.Call) else None
    return isinstance(called, ast.Name) and called.id == "given"


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
