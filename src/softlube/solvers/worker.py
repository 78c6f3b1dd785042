"""The other end of `softlube.solvers.processes`: a process that does what its standard input asks, and ends with it.

Its parent alone holds the other end of the pipe, so however the parent ends, also by SIGKILL, also while this process starts,
the pipe ends with it.
"""

from __future__ import annotations

import _thread
import os
import pickle
import signal
import struct
import threading
import time
from queue import SimpleQueue
from typing import BinaryIO

GRACE = 0.4
"""Seconds in which the work may remove its temporary files when the parent has gone."""

_LENGTH = struct.Struct(">Q")


def send(stream: BinaryIO, message: bytes) -> None:
    """Write one message."""
    stream.write(_LENGTH.pack(len(message)) + message)
    stream.flush()


def receive(stream: BinaryIO) -> bytes:
    """Read one message.

    Raises
    ------
    EOFError
        If the stream ends before it does.
    """
    (length,) = _LENGTH.unpack(_exactly(stream, _LENGTH.size))
    return _exactly(stream, length)


def _exactly(stream: BinaryIO, count: int) -> bytes:
    found = stream.read(count)
    if len(found) < count:
        raise EOFError
    return found


def serve() -> None:
    """Call what standard input asks for, and answer (True, result) or (False, error) on standard output, until it ends."""
    requests, replies = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_RDWR), 0)
    os.dup2(2, 1)  # what the work prints is no answer
    interrupts: list[int] = []

    def interrupt(number: int, _: object) -> None:
        """Once: a second interrupt would end the removal of temporary files."""
        interrupts.append(number)
        if len(interrupts) == 1:
            raise KeyboardInterrupt

    signal.signal(signal.SIGINT, interrupt)  # a shell may have had it ignored
    asked: SimpleQueue[bytes | None] = SimpleQueue()

    def listen() -> None:
        try:
            while True:
                asked.put(receive(requests))
        except (EOFError, OSError):
            asked.put(None)
            os.dup2(0, 2)  # nobody is left to be told anything
            end = time.monotonic() + GRACE
            while not interrupts and time.monotonic() < end:  # a signal just before a system call does not end that call
                _signal_main_thread()
                time.sleep(0.01)
            time.sleep(max(0.0, end - time.monotonic()))
            os._exit(1)

    try:
        threading.Thread(target=listen, daemon=True).start()
        while (request := asked.get()) is not None:
            send(replies, _answer(request))
    except (KeyboardInterrupt, OSError):  # the parent has gone
        pass
    os._exit(0)


def _signal_main_thread() -> None:
    """Send it SIGINT, which ends a system call where there are signals for threads."""
    if hasattr(signal, "pthread_kill"):
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
    else:
        _thread.interrupt_main()


def _answer(request: bytes) -> bytes:
    import cloudpickle

    try:
        function, arguments = pickle.loads(request)
        return cloudpickle.dumps((True, function(*arguments)))
    except Exception as error:
        try:
            return cloudpickle.dumps((False, error))
        except Exception:  # it holds what cannot travel
            return cloudpickle.dumps((False, RuntimeError(f"{type(error).__name__}: {error}")))
