"""Which code computed a number: a release and a digest of modules, so that results of other code are not taken for its own."""

from __future__ import annotations

import ast
import hashlib
from functools import cache
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from typing import Any

NUMERICS = ("model/**/*.py", "solvers/**/*.py", "discretization/**/*.py")
"""Files of this package that decide on the numbers of every calculation: whole folders, so that no new module is missed."""
STEADY = (*NUMERICS, "steady/**/*.py")
"""Files that decide on the numbers of a contact that slides steadily."""


def package_folder() -> Path:
    """Where the modules of this package are."""
    return Path(str(files("softlube")))


@cache
def code_version(patterns: tuple[str, ...]) -> str:
    """Release, and a digest of some files of this package.

    Comments, docstrings, declarations of inputs and the layout of the text do not count, nor does the version of Python.

    Parameters
    ----------
    patterns : tuple of str
        The files, as glob patterns within the package, such as `STEADY`.
    """
    folder = package_folder()
    digest = hashlib.sha256()
    for path in sorted({path for pattern in patterns for path in folder.glob(pattern)}):
        digest.update(repr((path.relative_to(folder).as_posix(), _digest(path.read_bytes()))).encode())
    return f"{version('softlube')}+{digest.hexdigest()[:12]}"


@cache
def _digest(source: bytes) -> str:
    """Digest of what a module means; kept, for folders belong to several versions."""
    return hashlib.sha256(repr(_meaning(ast.parse(source))).encode()).hexdigest()


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
