"""NetCDF files, sound, damaged and hostile: what is in them, or one line that names the variable, and never an endless loop."""

import time

import h5py
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from softlube.errors import InputError
from softlube.files.hdf5 import Content, Rule, Variable, check, read
from softlube.files.reading import Damaged


@pytest.fixture(scope="module")
def image(tmp_path_factory):
    path = tmp_path_factory.mktemp("hdf5") / "a.nc"
    with h5py.File(path, "w", track_order=True) as file:
        file["r"] = [1.0, 2.0, 4.0]
        file["film"] = np.arange(6.0).reshape(3, 2) + 1
        file["count"] = np.int32(3)
        file["film"].attrs["units"] = "1"
        file.attrs["title"] = "two"
        file.attrs["height"] = np.array([-1.0])
        file.attrs["many"] = np.arange(5.0)
    return path.read_bytes()


def test_what_is_in_a_file(image, tmp_path):
    (tmp_path / "a.nc").write_bytes(image)
    for source in (image, tmp_path / "a.nc"):
        content = read(source)
        assert list(content.variables) == ["r", "film", "count"]
        assert content.variables["film"].values.tolist() == [[1, 2], [3, 4], [5, 6]]
        assert content.variables["film"].attributes == {"units": "1"}
        assert content.variables["count"].values == 3
        assert content.attributes == {"title": "two", "height": -1.0}


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda file, name: file.__setitem__("a", h5py.ExternalLink("other.nc", "/a")), "a: stands in another file"),
        (lambda file, name: file.__setitem__("a", h5py.SoftLink("/nowhere")), "a: stands in another file"),
        (lambda file, name: file.create_dataset("a", (9,), "f8", external=[(name, 0, 72)]), "a: stands in another file"),
        (lambda file, name: file.create_group("a"), "a: is no variable"),
        (lambda file, name: file.create_dataset("a", data=["text"]), "a: is no array of numbers"),
        (
            lambda file, name: file.create_dataset("a", (10**6, 10**6), "f8", chunks=(10, 10)),
            r"a: says to have 1000000 × 1000000",
        ),
        (lambda file, name: file.create_dataset("a", (10**6,), "f8", compression="gzip"), "a: says to have 1000000 numbers"),
        (
            lambda file, name: file.create_dataset("a", (4,), "f8", maxshape=(None,), chunks=(10**6,)),
            "more than the file can hold",
        ),
        (
            lambda file, name: file.create_dataset("a", (99,), "f8", compression="lzf", data=np.ones(99)),
            "compressed in an unknown",
        ),
        (lambda file, name: [file.create_dataset(f"a{i}", data=0.0) for i in range(1001)], "has 1001 variables"),
    ],
)
def test_what_is_not_read(tmp_path, make, message):
    with h5py.File(tmp_path / "a.nc", "w") as file:
        make(file, str(tmp_path / "raw"))
    with pytest.raises(Damaged, match=message):
        read(tmp_path / "a.nc")


@settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(start=st.integers(0, 4000), length=st.integers(1, 600), fill=st.sampled_from([0, 255, 85]))
def test_damage_ends_in_one_line_and_soon(image, start, length, fill):
    """Blocks that a failing disk has lost: the HDF5 library loops for ever on some of them."""
    start = min(start, len(image) - 1)
    end = min(start + length, len(image))
    began, said = time.process_time(), ""
    try:
        read(image[:start] + bytes([fill]) * (end - start) + image[end:])
    except InputError as error:
        said = str(error)
    assert len(said) <= 300
    assert not said or said.isprintable()
    assert time.process_time() - began < 2


def of(**arrays):
    return Content({}, {name: Variable(np.array(values, dtype=float), {}) for name, values in arrays.items()})


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (of(film=[1, 2]), "r: missing"),
        (of(r=[0, 1]), "film: missing"),
        (of(r=[0, 1], film=[1, 2, 3]), "film: expected shape 2 by r, got 3"),
        (of(r=[], film=[]), "r: expected shape"),
        (of(r=[0, 0], film=[1, 2]), "r: expected numbers that increase"),
        (of(r=[0, 1], film=[1, 0]), "film: expected finite and positive numbers, got 0"),
        (of(r=[0, np.nan], film=[1, 1]), "r: expected finite and not negative numbers, got nan"),
        (of(r=[0, 1], film=[1, 1], load=np.inf), "load: expected finite numbers, got inf"),
        (of(r=[0, 1], film=[1, 1], load=[1]), "load: expected shape of one number"),
    ],
)
def test_a_schema(content, message):
    schema = {"r": Rule(("r",), "not negative"), "film": Rule(("r",), "positive"), "load": Rule((), gaps=True)}
    with pytest.raises(Damaged, match=message):
        check(content, schema)
    check(of(r=[0, 1], film=[1, 1], load=np.nan), schema)
