"""CSV files as rigs and spreadsheets write them: the right numbers, or a refusal with file, line and column."""

import pytest

from softlube import InputError
from softlube.files.tables import given_as, one_of, read_table
from softlube.model.inputs import FORCE, NUMBER, Input


def write(tmp_path, content):
    path = tmp_path / "data.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def test_a_missing_cell_is_refused_where_every_row_counts(tmp_path):
    with pytest.raises(InputError, match="line 3: speed is missing; expected a speed in the unit of the header"):
        read_table(write(tmp_path, "load [N], speed [m/s]\n1,1\n2,\n"), ["load", "speed"])


def test_an_absent_file():
    with pytest.raises(InputError, match="does not exist"):
        read_table("no-such-file.csv", ["load"])


def test_inputs_of_either_sign_and_without_unit(tmp_path):
    path = write(tmp_path, "approach_speed [um/s], indentation [um], poisson_ratio\n-10, 0, 0.45\n10, -1, 0.3\n")
    columns = read_table(path, ["approach_speed", "indentation", "poisson_ratio"]).columns
    assert columns["approach_speed"] == pytest.approx([-1e-5, 1e-5])
    assert columns["indentation"] == pytest.approx([0, -1e-6])
    assert columns["poisson_ratio"].tolist() == [0.45, 0.3]


def test_a_table_may_declare_its_columns(tmp_path):
    path = write(tmp_path, "friction; load (mN); wear [mm]\n0,5; -3; 1\n")
    declared = {"friction": Input("Over the load's unit", NUMBER, "0.5"), "load": Input("Load", FORCE, "1 N", signed=True)}
    columns = read_table(path, ["friction", "load"], columns=declared).columns
    assert columns["friction"] == pytest.approx([0.5])
    assert columns["load"] == pytest.approx([-3e-3])
    with pytest.raises(InputError, match="line 1: friction has no unit; expected one in the header"):
        read_table(path, ["friction", "load"])


def test_columns_without_unit_are_in_si_where_a_table_says_so(tmp_path):
    path = write(tmp_path, "load, speed [mm/s]\n2, 3\n")
    columns = read_table(path, ["load", "speed"], si_without_unit=True).columns
    assert (columns["load"].item(), columns["speed"].item()) == (2.0, pytest.approx(3e-3))
    with pytest.raises(InputError, match="load has no unit"):
        read_table(path, ["load", "speed"])


def test_columns_that_exclude_each_other(tmp_path):
    path = write(tmp_path, "load [N], speed [m/s]\n1,1\n")
    assert one_of(path, "entrainment_speed", "speed") == "speed"
    assert one_of(path, "radius", "indentation") == "radius"
    with pytest.raises(InputError, match="line 1: load and speed are both there"):
        one_of(path, "load", "speed")


def test_a_refusal_begins_with_the_input_that_gave_the_file():
    with pytest.raises(InputError, match=r"^history: none: the"), given_as("history"):
        raise InputError("none: the file does not exist")
