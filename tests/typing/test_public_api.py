"""Checkers of types see the public names as they are: no error, and no Any, in a script that uses them."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import softlube

SCRIPT = Path(__file__).with_name("public_api.py")
WRONG = "import softlube\n\nsoftlube.solve(beta=1000).film_min + 'm'\nsoftlube.solv(beta=1000)\n"


def checked(command, script, folder):
    """Exit code and output of a checker, away from this repository's settings."""
    env = os.environ | {"PYTHONPATH": str(Path(softlube.__file__).parents[1])}
    run = subprocess.run(
        [sys.executable, "-m", *command, str(script)], cwd=folder, env=env, capture_output=True, text=True, check=False
    )
    return run.returncode, run.stdout + run.stderr


def test_mypy_finds_no_error_and_no_any(tmp_path):
    code, output = checked(["mypy", "--strict", "--disallow-any-expr", "--follow-imports=silent"], SCRIPT, tmp_path)
    assert code == 0, output


@pytest.mark.skipif(shutil.which("node") is None, reason="pyright needs node")
def test_pyright_finds_no_error(tmp_path):
    code, output = checked(["pyright", "--pythonpath", sys.executable], SCRIPT, tmp_path)
    assert code == 0, output
    (tmp_path / "wrong.py").write_text(WRONG)
    code, output = checked(["pyright", "--pythonpath", sys.executable], tmp_path / "wrong.py", tmp_path)
    assert code == 1
    assert output.count(" - error: ") == 2
