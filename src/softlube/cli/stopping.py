"""Signals that end a command: it lets go of its workers, removes what it has begun to write, and says so in one line."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable
from types import FrameType

AGAIN = 0.02
"""Seconds after which a signal is told again that came while Python could not raise an exception, in a finaliser."""
GRACE = 10.0
"""Seconds after which a command that has not ended by itself is ended; its workers end with it."""

WORDS = {"SIGINT": "interrupted", "SIGTERM": "terminated", "SIGHUP": "hung up"}
"""Signals, and what is said of them."""


class Stopped(BaseException):
    """A signal asks the command to end.

    Attributes
    ----------
    name : str
        Of the signal, a key of `WORDS`.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name


def stoppable(command: Callable[[], int]) -> int:
    """Run the one command of this process.

    The first signal raises `Stopped` where the command is; later ones do not disturb the end.  A signal that the process was
    started to ignore (nohup) stays ignored.

    Returns
    -------
    int
        The command's exit code, or 128 and the number of the signal that ended it (130 for Ctrl-C).
    """
    known = {getattr(signal, name): name for name in WORDS if hasattr(signal, name)}
    heard = [number for number in known if signal.getsignal(number) not in (signal.SIG_IGN, None)]

    def tell(name: str) -> None:
        print(f"softlube: {WORDS[name]}", file=sys.stderr, flush=True)

    def deaf() -> None:
        for number in heard:
            signal.signal(number, lambda number, frame: None)  # SIG_IGN would complain of one that has just come

    def give_up(number: int) -> None:
        tell(known[number])
        os._exit(128 + number)

    def later(seconds: float, function: Callable[[int], object], number: int) -> None:
        timer = threading.Timer(seconds, function, (number,))
        timer.daemon = True
        timer.start()

    def stop(number: int, frame: FrameType | None) -> None:
        deaf()
        # Something may swallow the exception, or hang before its end.
        later(GRACE, give_up, number)
        raise Stopped(known[number])

    def unraisable(told: sys.UnraisableHookArgs) -> None:
        if not isinstance(told.exc_value, Stopped):
            return sys.__unraisablehook__(told)
        number = getattr(signal, told.exc_value.name)
        signal.signal(number, stop)
        later(AGAIN, signal.raise_signal, number)
        return None

    sys.unraisablehook = unraisable
    try:
        for number in heard:
            signal.signal(number, stop)
        code = command()
        # The work is done, and the interpreter takes a moment to end, in which it hears signals by itself.
        deaf()
        if hasattr(signal, "pthread_sigmask"):
            signal.pthread_sigmask(signal.SIG_BLOCK, heard)
    except Stopped as stopped:
        tell(stopped.name)
        return 128 + getattr(signal, stopped.name)
    return code
