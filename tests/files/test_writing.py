"""Files are written whole or not at all."""

import pytest

from softlube.files.writing import whole_file


def test_a_failed_write_leaves_the_old_file(tmp_path):
    path = tmp_path / "a.nc"
    path.write_text("old")

    def fail_midway():
        with whole_file(path) as temporary:
            temporary.write_text("half")
            raise RuntimeError("midway")

    with pytest.raises(RuntimeError, match="midway"):
        fail_midway()
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
