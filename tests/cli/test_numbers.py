"""Options without unit are read as all numbers are, by every command."""

import subprocess
import sys

import pytest

from softlube.cli.main import main


@pytest.mark.parametrize("given", ["1e3", "two", "9" * 5000, "1.5"])
def test_what_is_no_whole_number_is_refused(tmp_path, capsys, given):
    (tmp_path / "plan.toml").write_text("[parameters]\nbeta = 10\n")
    assert main(["sweep", str(tmp_path / "plan.toml"), "--workers", given]) == 2
    assert "--workers" in capsys.readouterr().err


def test_it_is_light():
    """``softlube sweep --help`` needs no models."""
    code = "import sys, softlube.cli.sweep, softlube.cli.reproduce; sys.exit('softlube.physical' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], timeout=60).returncode == 0
