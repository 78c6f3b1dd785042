"""Ways in which softlube says no."""

from __future__ import annotations

LONGEST = 300
"""Characters of a message."""


def one_line(text: str) -> str:
    """A text that can be sent to any terminal: one line, control characters as escapes, the middle cut out of a long one.

    Examples
    --------
    >>> one_line("a\\tb\\x1b[2J")
    'a\\\\tb\\\\x1b[2J'
    """
    shown = "".join(each if each.isprintable() else each.encode("unicode_escape", "backslashreplace").decode() for each in text)
    half = (LONGEST - 3) // 2
    return shown if len(shown) <= LONGEST else f"{shown[:half]} … {shown[-half:]}"


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
