"""Writing files: the target is checked before the work; afterwards the bytes move into place whole, or not at all."""

from __future__ import annotations

import io
import os
import uuid
from collections.abc import Generator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

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
    """A dataset as the bytes of a NetCDF 4 file: HDF5 with a dimension scale for each axis.

    It is built in memory: HDF5 ends the process with a fault where the system refuses to write to a file.  h5netcdf, which
    xarray would write it with, takes six times as long for a hundred small variables.

    Parameters
    ----------
    data : Dataset
        Every dimension has a coordinate of its own; arrays hold numbers or texts.
    """
    import h5py
    from xarray.conventions import encode_dataset_coordinates

    image, dimensions = io.BytesIO(), [str(name) for name in data.dims]
    variables, attributes = encode_dataset_coordinates(data)
    with h5py.File(image, "w", libver=("earliest", "v110"), track_order=True) as file:
        file.attrs.update(attributes)
        for name in (*dimensions, *(name for name in variables if name not in dimensions)):
            values = variables[name].to_numpy()
            texts = values.dtype.kind in "OU"
            values = values.astype(object) if texts else values
            made = file.create_dataset(name, data=values, dtype=h5py.string_dtype() if texts else None)
            made.attrs.update(variables[name].attrs)
            if name in dimensions:
                made.make_scale(name)
                made.attrs["_Netcdf4Dimid"] = np.int32(dimensions.index(name))
            else:
                for axis, dimension in enumerate(variables[name].dims):
                    made.dims[axis].attach_scale(file[dimension])
    return image.getvalue()
