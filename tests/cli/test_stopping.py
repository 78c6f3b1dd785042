"""Signals at any moment of a command: one line, the conventional exit code, no process and no file left behind."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(not Path("/proc/self/environ").exists(), reason="looks for processes in /proc")

MARK = "SOFTLUBE_TEST_MARK"
PLAN = "[sweep]\naccuracy = 1e-3\n[parameters]\nbeta = { from = 30, to = 3e5, count = 300 }\n"
CURVE = {"--young-modulus": "3 GPa", "--pressure-viscosity": "20/GPa", "--radius": "2 mm", "--load": "1 N"}
CURVE |= {"--viscosity": "1 Pa s", "--start": "10", "--stop": "1e4"}
COMMANDS = {
    "sweep": ["sweep", "plan.toml", "--workers", "2"],
    "reproduce": ["reproduce", "out", "--processes", "2"],
    "curve": ["curve", *(text for pair in CURVE.items() for text in pair)],
}


def hear():
    """Signals that this process ignores, under nohup or behind a shell's &, end the command all the same."""
    for kind in ("SIGINT", "SIGTERM", "SIGHUP"):
        signal.signal(getattr(signal, kind), signal.SIG_DFL)


def start(folder, command, mark):
    (folder / "plan.toml").write_text(PLAN)
    environment = os.environ | {MARK: mark, "SOFTLUBE_CACHE": str(folder / "cache")}
    return subprocess.Popen(
        [sys.executable, "-m", "softlube", *command],
        cwd=folder,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=hear,
    )


def marked(mark):
    """Processes that have the mark in their environment."""
    found = []
    for path in Path("/proc").glob("[0-9]*"):
        try:
            if f"{MARK}={mark}".encode() in (path / "environ").read_bytes():
                found.append(path.name)
        except OSError:  # it has just ended
            continue
    return found


def until(condition, seconds):
    deadline = time.monotonic() + seconds
    while not (met := condition()) and time.monotonic() < deadline:
        time.sleep(0.02)
    return met


@pytest.mark.parametrize("name", COMMANDS)
@pytest.mark.parametrize("kind", ["SIGINT", "SIGTERM", "SIGHUP", "SIGKILL"])
def test_nothing_is_left_behind(tmp_path, name, kind):
    """The signal comes as soon as there is a worker, which is before it has started to work."""
    mark = f"{name}-{kind}-{os.getpid()}"
    process = start(tmp_path, COMMANDS[name], mark)
    assert until(lambda: len(marked(mark)) > 1, 60)
    process.send_signal(getattr(signal, kind))
    _, said = process.communicate(timeout=30)
    assert until(lambda: not marked(mark), 1.0 if kind != "SIGKILL" else 2.0), "a process is left"
    if kind != "SIGKILL":
        assert process.returncode == 128 + getattr(signal, kind)
        assert said in [f"softlube: {words}\n" for words in ("interrupted", "terminated", "hung up")]
        assert [path for path in tmp_path.rglob("*") if path.name.startswith(".") or path.name.endswith(("-wal", "-shm"))] == []


def test_a_second_signal_does_not_disturb_the_end(tmp_path):
    mark = f"twice-{os.getpid()}"
    process = start(tmp_path, COMMANDS["sweep"], mark)
    assert until(lambda: len(marked(mark)) > 2, 60)
    process.send_signal(signal.SIGTERM)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=30)
    assert (process.returncode, said) in [(143, "softlube: terminated\n"), (130, "softlube: interrupted\n")]


def test_what_is_ignored_stays_ignored():
    """As nohup does it."""
    script = (
        "import os, signal\n"
        "from softlube.cli.stopping import stoppable\n"
        "signal.signal(signal.SIGHUP, signal.SIG_IGN)\n"
        "raise SystemExit(stoppable(lambda: os.kill(os.getpid(), signal.SIGHUP) or 7))\n"
    )
    assert subprocess.run([sys.executable, "-c", script], timeout=60).returncode == 7


def test_a_command_that_does_not_end_is_ended():
    script = (
        "import os, signal, time\n"
        "from softlube.cli import stopping\n"
        "stopping.GRACE = 0.2\n"
        "def hang():\n"
        "    try:\n"
        "        os.kill(os.getpid(), signal.SIGTERM)\n"
        "    finally:\n"
        "        time.sleep(60)\n"
        "stopping.stoppable(hang)\n"
    )
    assert subprocess.run([sys.executable, "-c", script], timeout=30).returncode == 143


def run(code):
    command = [sys.executable, "-c", code]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60, preexec_fn=hear)


def test_a_signal_in_a_finaliser_is_told_again():
    """There Python swallows exceptions, and would go on."""
    ended = run(
        """
import os, signal, sys, time
from softlube.cli.stopping import stoppable

class Finalised:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(0.01)

def command():
    one = Finalised()
    del one
    time.sleep(30)
    return 0

sys.exit(stoppable(command))
"""
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (143, "", "softlube: terminated\n")


def test_a_signal_after_the_work_does_not_spoil_the_end():
    ended = run(
        """
import atexit, os, signal, sys
from softlube.cli.stopping import stoppable

atexit.register(os.kill, os.getpid(), signal.SIGTERM)
sys.exit(stoppable(lambda: 0))
"""
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")
