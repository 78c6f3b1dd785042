"""The installed command, as a newcomer runs it: a process of its own, its streams, its exit code."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr

BALL = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]


def softlube(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    program = shutil.which("softlube", path=str(Path(sys.executable).parent)) or shutil.which("softlube")
    assert program, "the command is not installed"
    return subprocess.run([program, *arguments], cwd=cwd, capture_output=True, text=True, encoding="utf-8", check=False)


def test_the_main_job(tmp_path):
    run = softlube("solve", *BALL, "--output", "a.nc", "--plot", "a.pdf", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert run.stderr == ""
    assert "174.09" in run.stdout  # nm at the centre; Eq. (22a) gives 178
    assert "friction coefficient over r ≤ 2a" in run.stdout
    with xr.open_dataset(tmp_path / "a.nc") as data:
        assert float(data.film_center_SI) == pytest.approx(174.1e-9, rel=1e-3)
    assert (tmp_path / "a.pdf").stat().st_size > 5000


def test_json_on_stdout_and_nothing_else(tmp_path):
    run = softlube("solve", "--beta", "1000", "--json", cwd=tmp_path)
    assert run.returncode == 0
    assert run.stderr == ""
    assert json.loads(run.stdout)["quantities"]["film_center"]["value"] == pytest.approx(0.016150, rel=1e-3)


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (["solve", *BALL[:-1], "minus five", "--output", "a.nc"], 2),
        (["solve", "--beta", "1e12", "--output", "a.nc", "--plot", "a.png"], 3),
    ],
)
def test_failures_leave_one_line_and_no_file(tmp_path, arguments, code):
    run = softlube(*arguments, cwd=tmp_path)
    assert run.returncode == code
    assert run.stdout == ""
    assert run.stderr.startswith("softlube: ")
    assert run.stderr.count("\n") == 1
    assert "Traceback" not in run.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_reader_that_leaves_early_is_no_error(tmp_path):
    program = shutil.which("softlube", path=str(Path(sys.executable).parent)) or shutil.which("softlube")
    with subprocess.Popen(
        [program, "solve", "--beta", "100", "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 141


def test_start_up_is_lean(tmp_path):
    """Asking for help must not load the numerics."""
    code = "import sys; from softlube.cli.main import main; main(['--help']); sys.exit('numpy' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, check=False)
    assert run.returncode == 0
