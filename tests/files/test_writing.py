"""Files are written whole or not at all."""

import os

import pytest

from softlube.errors import InputError
from softlube.files.writing import check_destination, whole_file


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


def test_a_new_file_has_the_usual_permissions(tmp_path):
    path = tmp_path / "a.csv"
    before = os.umask(0o027)
    try:
        with whole_file(path) as temporary:
            assert temporary.parent == tmp_path
            assert temporary.suffix == ".csv"
            temporary.write_text("new")
    finally:
        os.umask(before)
    assert path.read_text() == "new"
    assert path.stat().st_mode & 0o777 == 0o640
    assert list(tmp_path.iterdir()) == [path]


def test_a_destination_is_checked_before_the_work(tmp_path):
    assert check_destination("output", str(tmp_path / "a.nc")) == tmp_path / "a.nc"
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(InputError, match=r"output: the folder .* does not exist"):
        check_destination("output", tmp_path / "none" / "a.nc")
    with pytest.raises(InputError, match=r"output: .* is a folder; expected the name of a file"):
        check_destination("output", tmp_path)


def test_a_folder_that_cannot_be_written_to(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda path, mode: False)  # whoever runs the tests as root may write anywhere
    with pytest.raises(InputError, match="cannot be written to"):
        check_destination("plot", tmp_path / "a.png")
