"""NetCDF 4 files as plain arrays, whatever has happened to them: read in a child process, then checked against a schema.

A schema says which arrays a file has, over which axes, and what physics says of their signs.  `softlube.files.netcdf` and
`softlube.files.transient` have one each, which is also what they write.
"""

from __future__ import annotations

import atexit
import json
import os
import subprocess
import sys
import threading
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Literal, cast

import numpy as np
from numpy.typing import NDArray

from softlube.files.reading import Damaged, read_bytes

Array = NDArray[np.floating]

LARGEST = 100_000_000
"""Bytes of a file that is read; solutions have less than one million, films in time some ten millions at most."""

GREATEST = 1e30
"""Largest magnitude in a file: beyond all results, and its powers are finite."""


@dataclass(frozen=True)
class Variable:
    """An array of a file.

    Attributes
    ----------
    values : ndarray
    attributes : mapping of str to str or float
    """

    values: Array
    attributes: Mapping[str, Any]


@dataclass(frozen=True)
class Content:
    """What is in a file.

    Attributes
    ----------
    attributes : mapping of str to str or float
        Of the whole.
    variables : mapping of str to Variable
    """

    attributes: Mapping[str, Any]
    variables: Mapping[str, Variable]


@dataclass(frozen=True)
class Rule:
    """What an array of a file must be.

    Attributes
    ----------
    axes : tuple of str
        Names of the variables along whose values it stands; its own name alone for an axis.
    sign : {"any", "not negative", "positive"}
        What all its numbers are.
    gaps : bool
        Whether a number may be nan, for one that is not given.
    """

    axes: tuple[str, ...]
    sign: Literal["any", "not negative", "positive"] = "any"
    gaps: bool = False


def read(source: str | os.PathLike[str] | bytes) -> Content:
    """What is in a NetCDF 4 file.

    Parameters
    ----------
    source : path or bytes
        The file, or all of its bytes.

    Raises
    ------
    Damaged
        If it is missing, too large, no such file, damaged, or has a part in another file.
    """
    image = source if isinstance(source, bytes) else read_bytes(source, LARGEST)
    with _LOCK:
        about, values = _CHILD.ask(image)
    if "refused" in about:
        raise Damaged(str(about["refused"]))
    variables, start = {}, 0
    for name, each in about["variables"].items():
        size = int(np.prod(each["shape"], dtype=int))
        array = np.frombuffer(values, dtype=float, count=size, offset=start).reshape(each["shape"])
        variables[name], start = Variable(array, each["attributes"]), start + array.nbytes
    return Content(about["attributes"], variables)


def check(content: Content, schema: Mapping[str, Rule]) -> None:
    """Refuse a file that has not what a schema says.

    Parameters
    ----------
    content : Content
        The file.
    schema : mapping of str to Rule
        Arrays by their names.

    Raises
    ------
    Damaged
        If an array is missing or has another shape, a number is not finite or has the wrong sign, or an axis does not increase.
    """
    for name, rule in schema.items():
        found = content.variables.get(name)
        if found is None:
            raise Damaged(f"{name}: missing")
        values, shape = (
            found.values,
            tuple(content.variables[axis].values.size for axis in rule.axes if axis in content.variables),
        )
        if values.shape != shape or not values.size:
            raise Damaged(f"{name}: expected shape {_shape(shape)} by {', '.join(rule.axes)}, got {_shape(values.shape)}")
        wrong = ~(np.abs(values) <= GREATEST) & ~(rule.gaps & np.isnan(values))
        if rule.sign != "any":
            wrong |= values < 0 if rule.sign == "not negative" else values <= 0
        if wrong.any():
            what = "finite" if rule.sign == "any" else f"finite and {rule.sign}"
            raise Damaged(f"{name}: expected {what} numbers, got {values[wrong][0]:g}")
        if rule.axes == (name,) and np.any(np.diff(values) <= 0):
            raise Damaged(f"{name}: expected numbers that increase")


def _shape(shape: tuple[int, ...]) -> str:
    return " × ".join(map(str, shape)) or "of one number"


class _Child:
    """The process of `softlube.files.hdf5_child`: started for the first file, kept for the next, started anew if it dies."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._owner = 0

    def ask(self, image: bytes) -> tuple[dict[str, Any], bytes]:
        """What the child says of a file, and its values."""
        process = self._running()
        requests, answers = cast("IO[bytes]", process.stdin), cast("IO[bytes]", process.stdout)
        try:
            requests.write(b"%d\n" % len(image))
            requests.write(image)
            requests.flush()
            about = json.loads(answers.readline())
            shapes = [each["shape"] for each in about.get("variables", {}).values()]
            size = 8 * sum(int(np.prod(shape, dtype=int)) for shape in shapes)
            values = answers.read(size)
        except (OSError, ValueError):
            self.stop()
            raise Damaged("is damaged: the HDF5 library does not get to its end") from None
        except BaseException:  # an answer that nobody waits for must not be taken for the next file's
            self.stop()
            raise
        return about, values

    def _running(self) -> subprocess.Popen[bytes]:
        if self._process is None or self._owner != os.getpid():  # a forked process must not listen to its parent's child
            self._owner = os.getpid()
            # A group of its own: Ctrl-C is for softlube, which closes the pipe, and with it ends the child.
            self._process = subprocess.Popen(
                [sys.executable, "-P", str(Path(__file__).with_name("hdf5_child.py"))],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
                env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
            )
        return self._process

    def stop(self) -> None:
        """End the child, if there is one."""
        process, self._process = self._process, None
        if process is not None and self._owner == os.getpid():
            process.kill()
            with suppress(OSError), process:  # what it has not read cannot be flushed
                process.wait()


_CHILD, _LOCK = _Child(), threading.Lock()
atexit.register(_CHILD.stop)
