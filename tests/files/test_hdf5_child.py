"""The process that opens HDF5 files: its answers, and that it ends itself where the library would not."""

import io
import json
import subprocess
import sys

import h5py
import numpy as np
import pytest

from softlube.files import hdf5_child
from softlube.files.hdf5_child import Refused, content, serve


def image(**arrays):
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        for name, values in arrays.items():
            file[name] = values
    return stream.getvalue()


def test_content():
    about, values = content(image(a=[1.0, 2.0], b=np.float32(3)))
    assert about == {
        "attributes": {},
        "variables": {"a": {"shape": (2,), "attributes": {}}, "b": {"shape": (), "attributes": {}}},
    }
    assert [np.frombuffer(each).tolist() for each in values] == [[1.0, 2.0], [3.0]]
    with pytest.raises(Refused, match="a: is no array of numbers"):
        content(image(a="text"))


def test_files_are_answered_one_after_the_other():
    good, bad = image(a=[1.0, 2.0]), b"no HDF5"
    answers = io.BytesIO()
    serve(io.BytesIO(b"".join(b"%d\n" % len(each) + each for each in (bad, good))), answers)
    first, rest = answers.getvalue().split(b"\n", 1)
    assert json.loads(first)["refused"].startswith("is not a NetCDF file")
    about, values = rest.split(b"\n", 1)
    assert json.loads(about)["variables"]["a"]["shape"] == [2]
    assert np.frombuffer(values).tolist() == [1.0, 2.0]


def test_it_ends_with_its_requests_and_gives_up_a_file_that_takes_too_long():
    done = subprocess.run([sys.executable, hdf5_child.__file__], input=b"3\nabc", capture_output=True, timeout=60, check=True)
    assert b"is not a NetCDF file" in done.stdout
    loop = (
        "import hdf5_child, io; hdf5_child.content = lambda image: sum(iter(int, 1)); "
        "hdf5_child.serve(io.BytesIO(b'1\\nx'), io.BytesIO())"
    )
    folder = hdf5_child.__file__.rsplit("/", 1)[0]
    assert subprocess.run([sys.executable, "-c", loop], cwd=folder, timeout=60).returncode != 0


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the system does not say how much memory a process has")
def test_a_file_gets_memory_in_proportion_to_its_size(monkeypatch):
    monkeypatch.setattr(hdf5_child, "content", lambda image: ({"size": len(bytearray(200 * len(image)))}, []))
    small, large = b"a" * 1000, b"a" * 10**7
    answers = io.BytesIO()
    serve(io.BytesIO(b"".join(b"%d\n" % len(each) + each for each in (small, large))), answers)
    first, second = map(json.loads, answers.getvalue().splitlines())
    assert first == {"size": 200_000}
    assert "refused" in second
    assert len(bytearray(10**9)) == 10**9  # the bound holds for the file only
