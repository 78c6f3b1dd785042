"""Ways in which softlube says no."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable

LONGEST = 300
"""Characters of a message."""


def printable(text: object) -> str:
    r"""A text that can be sent to any terminal: control characters as escapes.

    Examples
    --------
    >>> print(printable("a\tb\x1b[2J"))
    a\tb\x1b[2J
    """
    return "".join(each if each.isprintable() else each.encode("unicode_escape").decode() for each in str(text))


def one_line(text: str) -> str:
    """`printable`, with the middle cut out of a text that is longer than `LONGEST`."""
    line, half = printable(text), (LONGEST - 3) // 2
    return line if len(line) <= LONGEST else f"{line[:half]} … {line[-half:]}"


def shown(value: object) -> str:
    """`repr`, or the kind of a thing that has none: lists in lists without end, an integer of thousands of digits."""
    try:
        return repr(value)
    except (ValueError, RecursionError):
        return f"{type(value).__name__} that is too long to be shown"


class SoftlubeError(Exception):
    """Base of the errors below.  The message is one line, see `one_line`."""

    def __init__(self, message: str) -> None:
        super().__init__(one_line(message))


class InputError(SoftlubeError, ValueError):
    """An input that is missing, contradictory or impossible; the message names the parameter and what is expected."""


class ValidityWarning(UserWarning):
    """A doubt about a result: the model may not describe the experiment, or a number is not given.

    A solution keeps its doubts as `Solution.warnings`, too.  To turn them into errors:
    ``warnings.simplefilter("error", softlube.ValidityWarning)``.
    """


class NotConvergedError(SoftlubeError, RuntimeError):
    """The equations were not solved, or not to the accuracy asked for; the message says what to try."""


def warn(doubts: Iterable[str]) -> None:
    """Say doubts as `ValidityWarning`, each once, as of the line outside softlube that led here.

    Python remembers what it has warned of, and is silent when the same line runs again, as a notebook's cell does.  These
    doubts belong to a result, so every result says them.
    """
    frame = place = sys._getframe(1)
    while frame is not None:  # to the outermost call: decorators of other packages stand in between
        if frame.f_globals.get("__name__", "").partition(".")[0] == "softlube":
            place = frame.f_back or frame
        frame = frame.f_back
    for doubt in dict.fromkeys(doubts):
        warnings.warn_explicit(doubt, ValidityWarning, place.f_code.co_filename, place.f_lineno, registry={})
