"""Measured friction as rigs and spreadsheets write it: the right numbers, or a refusal with file, line and column."""

import numpy as np
import pytest

from softlube import InputError
from softlube.experiments.measurements import Measurements, read_measurements

HEADER = "load [mN], speed [mm/s], friction [mN]\n"


ROWS = "100, 0.1, 0.45\n200, 0.2, 0.90\n"


RIGHT = {"load": [0.1, 0.2], "speed": [1e-4, 2e-4], "friction": [0.45e-3, 0.9e-3]}


def write(tmp_path, content):
    path = tmp_path / "data.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(
    "content",
    [
        HEADER + ROWS,
        "\ufeff" + HEADER + ROWS,
        (HEADER + ROWS).encode("utf-16"),
        (HEADER + ROWS).replace("\n", "\r\n"),
        (HEADER + ROWS).replace(",", ";").replace(".", ","),
        (HEADER + ROWS).replace(",", "\t").replace(".", ","),
        "sep=;\n" + (HEADER + ROWS).replace(",", ";"),
        "# rig 3, Tuesday\n\n" + HEADER + "# first series\n100, 0.1, 0.45 # a good one\n\n,,\n200, 0.2, 0.90\n",
        HEADER + ROWS + HEADER,
        HEADER.replace("[", "(").replace("]", ")") + ROWS,
        "Normal load / mN, velocity / (mm/s), Friction-force / mN\n" + ROWS,
        "friction [µN],load [N],note,speed [um/s]\n450,0.1,fine,100\n900,2e-1,,200\n",
        '"load [mN]","speed [mm/s]","friction [mN]"\n"100","0.1","0.45"\n"200","0.2","0.90"\n',
        "load [mN], entrainment_speed [mm/s], friction_coefficient\n100, 0.05, 0.0045\n200, 0.1, 0.0045\n",
        HEADER + ROWS.replace("\n", ",,\n"),
    ],
    ids=[
        "plain",
        "byte order mark",
        "UTF-16",
        "CRLF",
        "semicolons and decimal commas",
        "tabs and decimal commas",
        "sep line",
        "comments and empty lines",
        "header again",
        "round brackets",
        "slashes and other names",
        "order and other columns",
        "quotes",
        "entrainment speed and friction coefficient",
        "separators at the end",
    ],
)
def test_the_right_numbers(tmp_path, content):
    data = read_measurements(write(tmp_path, content))
    for name, values in RIGHT.items():
        assert getattr(data, name) == pytest.approx(values, rel=1e-12), name


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "data.csv, line 1: the file is empty"),
        ("# nothing but a comment\n", "data.csv, line 1: the file is empty"),
        (HEADER, "data.csv, line 1: there are no rows"),
        ("load, speed [mm/s], friction [mN]\n" + ROWS, "line 1: load has no unit"),
        ("load [mm], speed [mm/s], friction [mN]\n" + ROWS, r"line 1: load cannot be in 'mm'; expected a unit of a force"),
        ("load [mN], speed [furlongsss], friction [mN]\n" + ROWS, "line 1: speed cannot be in 'furlongsss'"),
        ("load [mN], speed [mm/s]\n100, 0.1\n", "line 1: no column friction; the header has 'load"),
        ("load [mN], load [N], speed [mm/s], friction [mN]\n1,1,1,1\n", "line 1: two columns are called load"),
        ("load [mN], speed [m/s], entrainment_speed [m/s], friction [N]\n1,1,1,1\n", "line 1: speed and entrainment_speed"),
        (HEADER + "100, 0.1, 0.45\n200, fast, 0.9\n", r"line 3: speed: 'fast' under 'speed \[mm/s\]' is no number"),
        (HEADER + "100, 0.1 mm/s, 0.45\n", "line 2: speed: '0.1 mm/s' .* .units belong in the header"),
        (HEADER + "100, -0.1, 0.45\n", "line 2: speed: expected a positive, finite number .* got '-0.1'"),
        (HEADER + "100, −0.1, 0.45\n", "line 2: speed: expected a positive"),
        (HEADER + "0, 0.1, 0.45\n", "line 2: load: expected a positive"),
        (HEADER + "100, 0.1, inf\n", "line 2: friction: 'inf' under .* is no number .*expected a finite number"),
        (HEADER + "100, 0.1\n", "line 2: 2 cells under 3 columns$"),
        (HEADER + "100, 0,1, 0,45\n", "line 2: 5 cells under 3 columns; a decimal comma needs semicolons"),
        ((HEADER + "100, 0.1, 0.45\n").replace(",", ";") + "100;0,1;0,45\n", "line 3: '0,1' here and '0.1' in line 2"),
        ((HEADER + "1.000,5, 0.1, 0.45\n").replace(", ", ";"), "line 2: .* is the decimal sign a comma or a point"),
        (HEADER.replace(",", " ") + ROWS.replace(",", " "), "line 1: no column load, speed, friction"),
        (HEADER + ",0.1,0.4\nNA,0.1,0.4\n", "no row has all of load"),
        (b"PK\x03\x04\x00\x00binary", "not a text file"),
        (HEADER.encode() + "100, 0.1, 0.45 Größe".encode("latin-1"), "line 2: not UTF-8"),
    ],
)
def test_refused_with_the_line(tmp_path, content, message):
    with pytest.raises(InputError, match=message):
        read_measurements(write(tmp_path, content))


def test_missing_cells_and_repeated_rows_are_left_out_and_told(tmp_path):
    data = read_measurements(write(tmp_path, HEADER + "100,0.1,\n100,0.1,0.45\n100,0.1,0.45\n200,NA,0.9\n200,0.2,0.90\n"))
    assert data.friction == pytest.approx([0.45e-3, 0.9e-3])
    assert data.lines.tolist() == [3, 6]
    assert data.notices == (
        "repeated and counted once: line 4",
        "without speed, left out: line 5",
        "without friction, left out: line 2",
    )


@pytest.mark.slow
def test_a_million_rows(tmp_path):
    load = np.linspace(10, 200, 1_000_000)
    path = tmp_path / "data.csv"
    path.write_text(HEADER + "".join(f"{n:.6f},0.1,0.5\n" for n in load))
    data = read_measurements(path)
    assert len(data) == load.size
    np.testing.assert_allclose(data.load, 1e-3 * load, atol=1e-9)
    assert data.lines[-1] == load.size + 1


def test_negative_friction_is_a_number(tmp_path):
    assert read_measurements(write(tmp_path, HEADER + "100, 0.1, -0.01\n")).friction == pytest.approx([-1e-5])


@pytest.mark.parametrize(
    ("load", "speed", "friction", "message"),
    [
        ([1, 2], [1], [1, 2], "differ in length, 2, 1, 2"),
        ([1, -2], [1, 1], [1, 2], "load: expected a row of finite numbers above zero"),
        ([1, 2], [1, 1], [1, float("nan")], "friction: expected a row of finite numbers$"),
        (["a"], [1], [1], "load: expected numbers in SI units"),
    ],
)
def test_arrays_are_checked(load, speed, friction, message):
    with pytest.raises(InputError, match=message):
        Measurements.from_arrays(load, speed, friction)


def test_rows_that_are_taken_keep_their_lines():
    data = Measurements.from_arrays([1, 2, 3], [1e-3, 2e-3, 3e-3], [0.1, -0.2, 0.3], slide_to_roll=0.5)
    assert len(data) == 3
    some = data.take(np.array([2, 0, 0]))
    assert some.load.tolist() == [3, 1, 1]
    assert some.friction.tolist() == [0.3, 0.1, 0.1]
    assert some.lines.tolist() == [3, 1, 1]
    assert some.slide_to_roll.tolist() == [0.5] * 3


def test_the_ratio_of_sliding_to_rolling_is_a_column_or_the_same_for_all(tmp_path):
    assert read_measurements(write(tmp_path, HEADER + ROWS), slide_to_roll=1.5).slide_to_roll.tolist() == [1.5, 1.5]
    header = "load [mN], entrainment_speed [mm/s], slide_to_roll, friction [mN]\n"
    data = read_measurements(write(tmp_path, header + "100, 0.1, 0.2, 0.45\n200, 0.2, 2, 0.90\n"), slide_to_roll=1.5)
    assert data.slide_to_roll.tolist() == [0.2, 2.0]
    assert data.speed == pytest.approx([2e-4, 4e-4])  # the sum of both surfaces' speeds


def test_measurements_show_their_range(tmp_path):
    found = read_measurements(write(tmp_path, HEADER + ROWS))
    assert repr(found) == "<Measurements: 2 rows of data.csv>"
    assert found.summary().rows[0] == ("load", "100 mN", "150 mN", "200 mN")
    assert len(found._repr_html_().encode()) < 4000
    frame = found.to_dataframe()
    assert frame["friction [N]"].tolist() == found.friction.tolist() == pytest.approx(RIGHT["friction"])
    assert frame["line"].tolist() == [2, 3]
