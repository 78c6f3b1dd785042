"""Ways in which softlube says no."""

from __future__ import annotations


class SoftlubeError(Exception):
    """Base of the errors below."""


class InputError(SoftlubeError, ValueError):
    """An input that is missing, contradictory or impossible; the message names the parameter and what is expected."""


class ValidityWarning(UserWarning):
    """A doubt about a result: the model may not describe the experiment, or a number is not given.

    A solution keeps its doubts as `Solution.warnings`, too.  To turn them into errors:
    ``warnings.simplefilter("error", softlube.ValidityWarning)``.
    """


class NotConvergedError(SoftlubeError, RuntimeError):
    """The equations were not solved, or not to the accuracy asked for; the message says what to try."""
