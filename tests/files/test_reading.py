"""Files of a bounded size, and what is there instead."""

import os

import pytest

from softlube.files.reading import Damaged, read_bytes


def test_all_of_a_file(tmp_path):
    (tmp_path / "a").write_bytes(b"\0abc")
    (tmp_path / "link").symlink_to("a")
    assert read_bytes(tmp_path / "link", 4) == b"\0abc"
    with pytest.raises(Damaged, match="has 4 bytes; softlube reads 3 at most"):
        read_bytes(tmp_path / "a", 3)


def test_what_is_no_file(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for name, message in [
        ("none", "does not exist"),
        (".", "is a folder"),
        ("pipe", "is a device or a pipe"),
        ("a" * 300, "cannot be read"),
        ("a\0b", "is no name of a file"),
    ]:
        with pytest.raises(Damaged, match=message):
            read_bytes(tmp_path / name, 1e6)
    with pytest.raises(Damaged, match="is a device or a pipe"):
        read_bytes("/dev/zero", 1e6)


def test_an_error_names_the_file():
    assert str(Damaged("film: missing").about("path: 'a.nc'")) == "path: 'a.nc', film: missing"
    assert str(Damaged("does not exist").about("path: 'a.nc'")) == "path: 'a.nc' does not exist"
