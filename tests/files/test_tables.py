"""CSV files as rigs and spreadsheets write them: the right numbers, or a refusal with file, line and column."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

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


LOADS = "load [mN];speed [mm/s]\n"


@pytest.mark.parametrize(
    ("content", "load"),
    [
        (LOADS + "1,234;0,5\n", 1.234e-3),  # the second cell shows what the comma is
        (LOADS + "1234,567;5\n", 1.234567),
        (LOADS + "1.234;5\n", 1.234e-3),
        (LOADS + "–5;5\n", None),
        ('load [mN],speed [mm/s]\n"1,5",2\n', 1.5e-3),
        ("load [kg mm/s^2],speed [mm/s]\n1,2\n", 1e-3),
        ("load (kg/(m s^-2)),speed [mm/s]\n1,2\n", None),
    ],
)
def test_cells_with_one_meaning(tmp_path, content, load):
    path = write(tmp_path, content)
    if load is None:
        with pytest.raises(InputError, match=r"line [12]: load"):
            read_table(path, ["load", "speed"])
    else:
        assert read_table(path, ["load", "speed"]).columns["load"][0] == pytest.approx(load)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (LOADS + "1,234;5\n", "line 2: '1,234': the comma may part decimals or thousands; write '1.234' or '1234'"),
        ('load [mN],speed [mm/s]\n"1,234",2\n', "'1,234': the comma may part decimals or thousands"),
        (LOADS + "1_000;5\n", "load: '1_000' under .* is no number"),
        (LOADS + "2\u202f500;5\n", "write it without signs between thousands, '2500'"),
        (LOADS + "2–3;5\n", "a range is not taken"),
        (LOADS + "2±1;5\n", "a tolerance is not taken"),
        (LOADS + "5 N;5\n", r"is no number \(units belong in the header\).*it takes no unit"),
        (LOADS + "٣;5\n", "is no number"),
        ("load [MN 2];speed [mm/s]\n1;1\n", "load cannot be in 'MN 2'; expected a unit of a force"),
        ("load [2 mN];speed [mm/s]\n1;1\n", "load cannot be in '2 mN'"),
        ("load [mn];speed [mm/s]\n1;1\n", "load cannot be in 'mn'.*write 'mN'"),
    ],
)
def test_cells_and_units_with_several_meanings_are_refused(tmp_path, content, message):
    with pytest.raises(InputError, match=message):
        read_table(write(tmp_path, content), ["load", "speed"])


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("load [1e300 N], speed [m/s]\n1,1\n", "line 1: load cannot be in '1e300 N'"),
        ("load [MN], speed [m/s]\n1e300,1\n", "line 2: load: expected a positive, finite number"),
        ("load [N], speed [m/s]\n1,1e-320\n", "line 2: speed: expected a positive, finite number"),
        ("load [N], speed [m/s]\n1,2\0\n", "line 2: not a text file"),
        (f"load [N], speed [m/s]\n1,{'9' * 5000}\n", "line 2: speed: expected a positive, finite number"),
        (f'load [N], speed [m/s]\n1,"{"9" * 200_000}"\n', "line 2: no row of a table"),
        (f"a{' ' * 100_000}b [N], speed [m/s]\n1,2\n", "line 1: no column load"),
        ("load [N], speed [m/s]\n1,2\n1,\x1b[2J\n", "line 3: speed: '.x1b.2J' under"),
        ("a," * 5_000_000, "line 1: more than 1000 columns"),
        (f"load [N], speed [m/s]\n{'1,1' * 40}\n", "line 2: 41 cells under 2 columns"),
    ],
)
def test_hostile_tables_end_in_one_line(tmp_path, content, message):
    with pytest.raises(InputError, match=message) as caught:
        read_table(write(tmp_path, content), ["load", "speed"])
    assert len(str(caught.value)) <= 300
    assert str(caught.value).isprintable()


def test_more_than_any_rig_writes(tmp_path, monkeypatch):
    path = write(tmp_path, "load [N]\n" + "1\n" * 12)
    monkeypatch.setattr("softlube.files.tables.MOST_ROWS", 10)
    with pytest.raises(InputError, match="line 12: more than 10 rows"):
        read_table(path, ["load"])
    monkeypatch.setattr("softlube.files.tables.LARGEST", 20)
    with pytest.raises(InputError, match="the file has 33 bytes; softlube reads 20 at most"):
        read_table(path, ["load"])


SOUND = "load [mN], speed [mm/s]\n1.5, 2\n2.5, 3\n"


@settings(max_examples=200, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    place=st.integers(0, len(SOUND)),
    cut=st.integers(0, 9),
    put=st.text(max_size=9) | st.text("0123456789,;.e+-[]\"' \t\n", max_size=9),
)
def test_a_table_is_read_or_refused_in_one_line(tmp_path, place, cut, put):
    path, said = write(tmp_path, (SOUND[:place] + put + SOUND[place + cut :]).encode("utf-8", "surrogatepass")), ""
    try:
        columns = read_table(path, ["load", "speed"]).columns
        assert all(0 < value < 1e30 for column in columns.values() for value in column)
    except InputError as error:
        said = str(error)
    assert len(said) <= 300
    assert not said or said.isprintable()
