"""Ways in which softlube says no."""

from __future__ import annotations


class SoftlubeError(Exception):
    """Base of the errors below."""


class InputError(SoftlubeError, ValueError):
    """An input that is missing, contradictory or impossible; the message names the parameter and what is expected."""


class NotConvergedError(SoftlubeError, RuntimeError):
    """The equations were not solved, or not to the accuracy asked for; the message says what to try."""
