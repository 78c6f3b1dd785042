"""The processor time that a solve may take before it gives up.

Newton's method asks before every step, so that nothing in between needs to know.  Processor time of the thread counts: what
other programs do on the machine is no reason to give up.
"""

from __future__ import annotations

import math
import time
from collections.abc import Generator
from contextlib import contextmanager
from contextvars import ContextVar

DEFAULT_BUDGET = 60.0
"""Seconds after which a solve gives up where nothing else is said; all but the hardest contacts take less than ten."""
_END: ContextVar[float] = ContextVar("end", default=math.inf)


class OutOfTime(Exception):
    """The budget is spent.

    Attributes
    ----------
    reached : float
        Accuracy that was reached before; infinite where none is known.
    """

    reached: float = math.inf


@contextmanager
def within(seconds: float) -> Generator[None]:
    """Let `check` raise `OutOfTime` after some seconds of this thread's processor time; the nearest end counts."""
    token = _END.set(min(_END.get(), time.thread_time() + seconds))
    try:
        yield
    finally:
        _END.reset(token)


def check(ahead: float = 0.0) -> None:
    """Raise `OutOfTime` if the budget is spent, or will be before some seconds of work that lie ahead are done."""
    if time.thread_time() + ahead > _END.get():
        raise OutOfTime
