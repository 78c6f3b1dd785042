"""Reading files: regular ones of a bounded size, or a refusal that says what is there instead."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from softlube.errors import InputError


class Damaged(InputError):
    """A file that cannot be what it says; the text begins with the variable, as in "film: missing", or with a verb."""

    def about(self, name: str) -> InputError:
        """The error with the name of the file."""
        of_variable = str(self).split(maxsplit=1)[0].endswith(":")
        return InputError(f"{name}{',' if of_variable else ''} {self}")


def read_bytes(path: str | os.PathLike[str], largest: float) -> bytes:
    """All of a file.

    Parameters
    ----------
    path : path
        The file.
    largest : float
        Bytes that it may have: a bound that no real file of its kind meets, so that no other fills the memory.

    Raises
    ------
    Damaged
        If there is no such file, or it is a folder, a device or a pipe, too large, or cannot be read.
    """
    try:
        status = os.stat(path)
        regular, small = stat.S_ISREG(status.st_mode), status.st_size <= largest
        content = Path(path).read_bytes() if regular and small else b""
    except FileNotFoundError:
        raise Damaged("does not exist") from None
    except OSError as error:
        raise Damaged(f"cannot be read ({error.strerror})") from None
    except ValueError:  # NUL
        raise Damaged("is no name of a file") from None
    if not regular:
        raise Damaged("is a folder" if stat.S_ISDIR(status.st_mode) else "is a device or a pipe")
    if not small:
        raise Damaged(f"has {status.st_size:.3g} bytes; softlube reads {largest:g} at most")
    return content
