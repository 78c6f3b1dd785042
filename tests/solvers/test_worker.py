"""The worker's side of the pipe: answers, errors, and the end of the pipe."""

import io
import os
import pickle
import subprocess
import sys
import time

import pytest

from softlube.solvers.worker import receive, send

COMMAND = [sys.executable, "-c", "from softlube.solvers.worker import serve; serve()"]


def test_messages_come_whole():
    stream = io.BytesIO()
    send(stream, b"first")
    send(stream, b"")
    whole = stream.getvalue()
    stream.seek(0)
    assert [receive(stream), receive(stream)] == [b"first", b""]
    for length in range(13):
        with pytest.raises((EOFError, ValueError)):
            receive(io.BytesIO(whole[:length]))


def ask(worker, function, *arguments):
    send(worker.stdin, pickle.dumps((function, arguments)))
    return pickle.loads(receive(worker.stdout))


def test_answers_and_errors_travel_and_what_is_printed_does_not():
    with subprocess.Popen(COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as worker:
        assert ask(worker, divmod, 7, 3) == (True, (2, 1))
        good, error = ask(worker, divmod, 7, 0)
        assert not good
        assert isinstance(error, ZeroDivisionError)
        assert ask(worker, print, "noise") == (True, None)
        assert ask(worker, abs, -1) == (True, 1)
        worker.stdin.close()
        assert worker.wait(10) == 0


@pytest.mark.skipif(os.name != "posix", reason="a shell's habit")
def test_the_end_of_the_pipe_ends_the_work_also_where_interrupts_are_ignored(tmp_path):
    """What was begun is cleaned up: the work ends by an exception."""
    with subprocess.Popen(["sh", "-c", 'trap "" INT; exec "$@"', "sh", *COMMAND], stdin=subprocess.PIPE) as worker:
        send(worker.stdin, pickle.dumps((exec, (f"import os, time\ntry:\n    open({str(tmp_path / 'begun')!r}, 'w')\n"
            f"    time.sleep(60)\nfinally:\n    os.remove({str(tmp_path / 'begun')!r})", {}))))  # fmt: skip
        while not (tmp_path / "begun").exists():
            time.sleep(0.01)
        began = time.monotonic()
        worker.stdin.close()
        worker.wait(10)
    assert time.monotonic() - began < 1
    assert list(tmp_path.iterdir()) == []
