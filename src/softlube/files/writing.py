"""Writing files: checked before the work, whole or not at all after it."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from softlube.errors import InputError


def check_destination(name: str, path: str | os.PathLike[str]) -> Path:
    """A path that can be written to.

    Raises
    ------
    InputError
        If its folder does not exist or it is a folder itself.
    """
    path = Path(path)
    if not path.parent.is_dir():
        raise InputError(f"{name}: the folder {str(path.parent)!r} does not exist; expected a file in an existing folder")
    if path.is_dir():
        raise InputError(f"{name}: {str(path)!r} is a folder; expected the name of a file")
    if not os.access(path.parent, os.W_OK):
        raise InputError(f"{name}: the folder {str(path.parent)!r} cannot be written to")
    return path


@contextmanager
def whole_file(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A temporary file beside `path` that takes its place when the block ends well, and vanishes otherwise."""
    path = Path(path)
    handle, name = tempfile.mkstemp(prefix=f".{path.stem}-", suffix=path.suffix, dir=path.parent)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        umask = os.umask(0)
        os.umask(umask)
        temporary.chmod(0o666 & ~umask)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)
