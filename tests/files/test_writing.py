"""Files are written whole or not at all, whatever the system says."""

import errno
import os
import resource
import subprocess
import sys

import pytest
import xarray as xr

from softlube.errors import InputError
from softlube.files.writing import check_destination, netcdf, write_whole


def test_a_failed_write_leaves_all_old_files(tmp_path):
    first, second = tmp_path / "a.csv", tmp_path / "b.csv"
    first.write_text("old")
    with pytest.raises(FileNotFoundError) as caught:
        write_whole({first: b"new", tmp_path / "none" / "b.csv": b"new"})
    assert caught.value.filename == str(tmp_path / "none" / "b.csv")
    second.mkdir()
    with pytest.raises(InputError, match="is a folder"):
        write_whole({first: b"new", second: b"new"})
    assert first.read_text() == "old"
    assert sorted(tmp_path.iterdir()) == [first, second]


@pytest.mark.skipif(sys.platform == "win32", reason="no limits there")
@pytest.mark.parametrize("size", [0, 1, 4096, 9999])
def test_a_limit_met_at_any_byte_keeps_the_old_file(tmp_path, size):
    """The limit of a quota or a full disk; in a process of its own, as it cannot be lifted again."""
    path = tmp_path / "a.nc"
    path.write_bytes(b"old")
    script = (
        "import resource, sys\n"
        "from softlube.files.writing import write_whole\n"
        f"resource.setrlimit(resource.RLIMIT_FSIZE, ({size}, resource.RLIM_INFINITY))\n"
        "try:\n"
        f"    write_whole({{{str(path)!r}: bytes(10000)}})\n"
        "except OSError as error:\n"
        "    sys.exit(f'{error.errno} {error.filename}')\n"
    )
    limited = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert limited.stderr.strip() == f"{errno.EFBIG} {path}"
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]
    assert resource.getrlimit(resource.RLIMIT_FSIZE)[0] == resource.RLIM_INFINITY


def test_a_new_file_has_the_usual_permissions(tmp_path):
    path = tmp_path / "a.csv"
    before = os.umask(0o027)
    try:
        write_whole({path: b"new"})
    finally:
        os.umask(before)
    assert path.read_text() == "new"
    assert path.stat().st_mode & 0o777 == 0o640
    assert list(tmp_path.iterdir()) == [path]


def test_a_symbolic_link_is_followed(tmp_path):
    (tmp_path / "there").mkdir()
    real, link = tmp_path / "there" / "real.csv", tmp_path / "link.csv"
    link.symlink_to(real)
    for content in (b"first", b"second"):  # to nothing, then to a file
        write_whole({check_destination("output", link): content})
        assert link.is_symlink()
        assert real.read_bytes() == content
    dangling = tmp_path / "dangling.csv"
    dangling.symlink_to(tmp_path / "none" / "real.csv")
    with pytest.raises(InputError, match=r"output: the folder .*none' does not exist"):
        check_destination("output", dangling)


@pytest.mark.skipif(sys.platform == "win32", reason="no such files there")
def test_what_is_no_file_is_refused_and_left(tmp_path):
    pipe = tmp_path / "pipe.csv"
    os.mkfifo(pipe)
    for target in (pipe, "/dev/full", "/dev/null"):
        with pytest.raises(InputError, match=r"output: .* is a device or a pipe"):
            check_destination("output", target)
        with pytest.raises(InputError, match=r"output: .* is a device or a pipe"):
            write_whole({target: b"new"})
    assert pipe.is_fifo()
    assert list(tmp_path.iterdir()) == [pipe]


def test_a_destination_is_checked_before_the_work(tmp_path):
    assert check_destination("output", str(tmp_path / "a.nc")) == tmp_path / "a.nc"
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(InputError, match=r"output: the folder .* does not exist"):
        check_destination("output", tmp_path / "none" / "a.nc")
    with pytest.raises(InputError, match=r"output: .* is a folder; expected the name of a file"):
        check_destination("output", tmp_path)


def test_what_may_not_be_written_is_refused(tmp_path, monkeypatch):
    # Whoever runs the tests as root may write anywhere.
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(InputError, match="cannot be written to"):
        check_destination("plot", tmp_path / "a.png")
    path = tmp_path / "b.png"
    path.touch()
    monkeypatch.setattr(os, "access", lambda path, mode: path != tmp_path / "b.png")
    with pytest.raises(InputError, match=r"b.png' is write-protected"):
        check_destination("plot", path)


def test_netcdf_is_built_in_memory(tmp_path):
    r = ("r", [0.0, 0.5], {"units": "1"})
    film = ("r", [0.1, 0.2], {"long_name": "film thickness u(r)"})
    data = xr.Dataset({"words": ("r", ["a µm", ""]), "film": film, "at": 0.3}, {"r": r}, {"title": "a film", "schema": 2})
    write_whole({tmp_path / "a.nc": netcdf(data)})
    again = xr.load_dataset(tmp_path / "a.nc", engine="h5netcdf")
    assert again.identical(data)
    assert list(again.data_vars) == ["words", "film", "at"]
