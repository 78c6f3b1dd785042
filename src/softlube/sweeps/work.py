"""One task solved for a sweep, in whatever process, and the key of what comes of it."""

from __future__ import annotations

import ast
import hashlib
import json
from functools import cache
from importlib.resources import files
from pathlib import Path

from softlube.errors import SoftlubeError
from softlube.sweeps.tasks import Outcome, Task

NO_SAY = ("cli", "files", "paper", "physical.contact", "plots", "sweeps")
"""Modules and packages that the code of a task can reach and that have no say in its numbers."""


@cache
def solver_version(code: str) -> str:
    """Release and a digest of the code that solves, a module with all its imports: another one's results are not ours."""
    from softlube import __version__

    digest = hashlib.sha256()
    for name, source in sorted(_sources(code).items()):
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
        if name in found or any(f"{name}.".startswith(f"{none}.") for none in NO_SAY) or not path.is_file():
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


def content_key(task: Task, accuracy: float) -> str:
    """Digest of all that determines a solution: task, accuracy and solver."""
    content = {"problem": task.to_plain(), "accuracy": accuracy, "solver": solver_version(task.code)}
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def solve_one(task: Task, accuracy: float, with_fields: bool) -> Outcome:
    """Solve; whatever goes wrong is an outcome, too."""
    try:
        return task.solve(accuracy, with_fields)
    except SoftlubeError as error:
        return Outcome(str(error))
    except Exception as error:  # a defect met in one case must not take the others with it
        return Outcome(f"{type(error).__name__}: {error}")
