"""Writing files: the target is checked before the work; afterwards the bytes move into place whole, or not at all."""

from __future__ import annotations

import io
import os
import uuid
from collections.abc import Generator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from softlube.errors import InputError

if TYPE_CHECKING:
    import xarray as xr


def check_destination(name: str, path: str | os.PathLike[str]) -> Path:
    """A path that a file can be written to.

    A symbolic link stands for the file that it names.

    Raises
    ------
    InputError
        If the folder does not exist or cannot be written to, or if there is something at the path that is no file or that may
        not be changed: a folder, a device, a pipe, a write-protected file.
    """
    path = Path(path)
    target = Path(os.path.realpath(path))
    if not target.parent.is_dir():
        raise InputError(f"{name}: the folder {str(target.parent)!r} does not exist; expected a file in an existing folder")
    _refuse_what_is_no_file(name, target)
    if not os.access(target.parent, os.W_OK):
        raise InputError(f"{name}: the folder {str(target.parent)!r} cannot be written to")
    if target.exists() and not os.access(target, os.W_OK):
        raise InputError(f"{name}: {str(path)!r} is write-protected; expected another file")
    return path


def _refuse_what_is_no_file(name: str, target: Path) -> None:
    if target.is_dir():
        raise InputError(f"{name}: {str(target)!r} is a folder; expected the name of a file")
    if target.exists() and not target.is_file():
        raise InputError(f"{name}: {str(target)!r} is a device or a pipe; expected the name of a file")


def write_whole(contents: Mapping[str | os.PathLike[str], bytes]) -> None:
    """Write files, each whole.  What was there before stays unless all the new content is safe on the disk.

    Parameters
    ----------
    contents : mapping of path to bytes
        What is to be in each file.  A symbolic link stands for the file that it names.

    Raises
    ------
    InputError
        If there is something else than a file at a path: a folder, a device, a pipe.
    OSError
        If the system refuses (no space, a quota, a folder that has gone), with the path as its `filename`.
    """
    token = uuid.uuid4().hex[:12]
    # Each in the folder of its target, so that it can take its place; named before it is made, so that it is always removed.
    moves = {}
    for path in contents:
        target = Path(os.path.realpath(path))
        _refuse_what_is_no_file("output", target)
        moves[path] = target.with_name(f".{target.stem[:100]}-{token}{target.suffix}"), target
    try:
        for path, content in contents.items():
            with _named(path), open(moves[path][0], "xb") as stream:
                stream.write(content)
                stream.flush()
                os.fsync(stream.fileno())
        for path, (temporary, target) in moves.items():
            with _named(path):
                os.replace(temporary, target)
    finally:
        for temporary, _ in moves.values():
            with suppress(OSError):
                temporary.unlink()


@contextmanager
def _named(path: str | os.PathLike[str]) -> Generator[None]:
    """An error of the system names the file that the user knows, not the temporary one."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, os.fspath(path)) from error


def netcdf(data: xr.Dataset) -> bytes:
    """A dataset as the bytes of a NetCDF 4 file.

    It is built in memory: HDF5 ends the process with a fault where the system refuses to write to a file.
    """
    import h5netcdf
    from xarray.backends import H5NetCDFStore

    image = io.BytesIO()
    store = H5NetCDFStore(h5netcdf.File(image, "w"), mode="w")
    data.dump_to_store(store)
    store.close()
    return image.getvalue()
