"""What commands that fit a material have in common: their files are checked before anything is fitted."""

import pytest

from softlube.cli.material import check_files
from softlube.errors import InputError


def test_files_are_checked(tmp_path):
    data, output, plot = (str(tmp_path / name) for name in ("d.csv", "o.json", "p.png"))
    check_files(data, output, plot)
    check_files(data, None, None)
    for wrong in ((data, data, None), (data, None, output), (data, plot, plot), (data, str(tmp_path / "no" / "o.json"), None)):
        with pytest.raises(InputError):
            check_files(*wrong)
