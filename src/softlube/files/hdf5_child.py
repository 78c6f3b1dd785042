"""The process that opens HDF5 files for `softlube.files.hdf5`: run as a script, it needs h5py and nothing of softlube.

On a damaged file the HDF5 library may loop for ever, ask for all memory or end its process with a fault; here that costs a
child process, which gives itself half a second of processor time for each file, and memory in proportion to the file.
"""

from __future__ import annotations

import faulthandler
import io
import json
import math
import os
import signal
import sys
from collections.abc import Generator
from contextlib import contextmanager
from typing import Any, BinaryIO

SECONDS = 0.5
"""Processor time that a file may take; sound ones of some MB take hundredths of that."""
PATIENCE = 60.0
"""Time on the clock that a file may take, for a library that waits instead of working."""
MEMORY_PER_BYTE, LEAST_MEMORY = 8, 48 << 20
"""Bytes of memory that each byte of a file may take, and bytes that any file may take.  Sound files take four times their size:
the file, its numbers, and two copies of the largest variable."""
MOST_VARIABLES = 1000
FILTERS = frozenset({1, 2, 3})
"""Deflate, shuffle and Fletcher's checksum: filters that come with HDF5 and run no code from elsewhere."""

OF_NETCDF = frozenset({"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "coordinates"})
"""Attributes by which NetCDF files say what is an axis; others of them begin with an underscore."""


class Refused(Exception):
    """A file that is not read; the text says why."""


def content(image: bytes) -> tuple[dict[str, Any], list[bytes]]:
    """Attributes and variables of an HDF5 file's root group.

    Parameters
    ----------
    image : bytes
        The file.

    Returns
    -------
    about : dict
        "attributes", and "variables": name to "shape" and "attributes".  Attributes are texts and numbers, others are left out.
    values : list of bytes
        Of each variable in that order: float64 in the machine's order of bytes.

    Raises
    ------
    Refused
        If a variable is no array of numbers that stands in this file, or says to be larger than the file.
    Exception
        Whatever h5py raises for a file that it cannot read.
    """
    import h5py

    with h5py.File(io.BytesIO(image), "r") as file:
        if len(file) > MOST_VARIABLES:
            raise Refused(f"has {len(file)} variables")
        variables: dict[str, Any] = {}
        values = []
        for name in file:
            if not isinstance(file.get(name, getlink=True), h5py.HardLink):
                raise Refused(f"{name}: stands in another file")
            try:
                variables[name], array = _variable(file[name], len(image))
            except Refused as refusal:
                raise Refused(f"{name}: {refusal}") from None
            except Exception as error:
                raise Refused(f"{name}: cannot be read ({error})") from None
            values.append(array)
        return {"attributes": _attributes(file, len(image)), "variables": variables}, values


def _variable(found: Any, most: int) -> tuple[dict[str, Any], bytes]:
    import h5py

    if not isinstance(found, h5py.Dataset):
        raise Refused("is no variable")
    if found.is_virtual or found.external:
        raise Refused("stands in another file")
    if found.shape is None or found.dtype.kind not in "fiu" or found.dtype.itemsize > 8:
        raise Refused("is no array of numbers")
    # What has its numbers in the file is not larger than the file, compressed or not: noise of a solver does not compress well.
    pieces = [found.shape, *([found.chunks] if found.chunks else [])]
    if max(math.prod(shape) for shape in pieces) * 8 > most:
        raise Refused(f"says to have {' × '.join(map(str, found.shape))} numbers, more than the file can hold")
    filters = found.id.get_create_plist()
    if any(filters.get_filter(number)[0] not in FILTERS for number in range(filters.get_nfilters())):
        raise Refused("is compressed in an unknown way")
    return {"shape": found.shape, "attributes": _attributes(found, most)}, found[()].astype(float).tobytes()


def _attributes(found: Any, most: int) -> dict[str, Any]:
    result = {}
    for name in found.attrs:
        if name.startswith("_") or name in OF_NETCDF:
            continue
        kept = found.attrs.get_id(name)
        if kept.get_storage_size() > most or kept.dtype.kind not in "OSUfiu" or math.prod(kept.shape or ()) != 1:
            continue
        value = found.attrs[name]
        value = value.item() if hasattr(value, "item") else value
        value = value.decode("utf-8", "replace") if isinstance(value, bytes) else value
        if isinstance(value, (str, int, float)):
            result[name] = value
    return result


def serve(requests: BinaryIO, answers: BinaryIO) -> None:
    """Answer requests until there are no more.

    Parameters
    ----------
    requests : binary stream
        For each file its size in bytes on a line, and the file.
    answers : binary stream
        For each file a line of JSON, what `content` says or {"refused": why}, and the values.
    """
    import h5py  # so that no file pays for its memory

    del h5py
    while line := requests.readline():
        image = requests.read(int(line))
        with _timed(), _bounded(LEAST_MEMORY + MEMORY_PER_BYTE * len(image)):
            try:
                about, values = content(image)
            except Refused as refusal:
                about, values = {"refused": str(refusal)}, []
            except Exception as error:
                about, values = {"refused": f"is not a NetCDF file ({error})"}, []
        answers.write(json.dumps(about).encode() + b"\n")
        for each in values:
            answers.write(each)
        answers.flush()


@contextmanager
def _bounded(memory: int) -> Generator[None]:
    """Have the system give this process no more than some bytes beyond what it has; no bound where that is unknown.

    Memory that can be written counts, not addresses: C libraries reserve those by the ten megabytes, in every thread.
    """
    try:
        with open("/proc/self/statm") as said:
            own = int(said.read().split()[5]) * os.sysconf("SC_PAGESIZE")
    except OSError:
        yield
        return
    import resource  # not on every system

    usual = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (own + memory, usual[1]))
    yield
    resource.setrlimit(resource.RLIMIT_DATA, usual)


@contextmanager
def _timed() -> Generator[None]:
    """Have the system end this process if a file takes too long.  No Python code runs within HDF5's loops."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, SECONDS)
    faulthandler.dump_traceback_later(PATIENCE, exit=True)
    yield
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, 0.0)
    faulthandler.cancel_dump_traceback_later()


if __name__ == "__main__":
    serve(sys.stdin.buffer, sys.stdout.buffer)
