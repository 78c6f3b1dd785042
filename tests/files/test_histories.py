"""Histories from CSV files as rigs and spreadsheets write them, or refusals with the line."""

import numpy as np
import pytest

import softlube
from softlube.errors import InputError
from softlube.files.histories import read_history


def write(tmp_path, content):
    path = tmp_path / "h.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(
    "content",
    [
        "time,load\n0,0.1\n0.0005,-0.2\n0.002,0\n",
        "time [ms], load [mN]\n0, 100\n0.5, -200\n2, 0\n",
        "time (ms), load (mN)\n0, 100\n0.5, -200\n2, 0\n",
        "time / ms, Normal load / mN\n0, 100\n0.5, -200\n2, 0\n",
        "time [ms];load [mN]\n0;100\n0,5;-200\n2;0\n",
        "time [ms]\tload [mN]\n0\t100\n0,5\t-200\n2\t0\n",
        "# pressed\n\ntime [ms],load [mN],note\n0,100,a # begin\n0.5,-200,\n# held\n2,0,c\n",
        "\ufefftime [ms],load [mN]\r\n0,100\r\n0.5,−200\r\n2,0\r\n",
        "load [mN],time [ms]\n100,0\n-200,0.5\n0,2\n",
        "time,load [mN]\n0,100\n5e-4,-200\n2e-3,0\n",
    ],
    ids=["SI", "units", "round", "slashes", "semicolons", "tabs", "comments", "mark", "order", "one unit"],
)
def test_the_right_numbers(tmp_path, content):
    found = read_history(write(tmp_path, content))
    assert found.control == "load"
    assert found.time == pytest.approx([0, 5e-4, 2e-3], rel=1e-15)
    assert found.values == pytest.approx([0.1, -0.2, 0], rel=1e-15)
    assert found.source == "h.csv"


def test_a_height(tmp_path):
    found = softlube.read_history(write(tmp_path, "time [s]; height [um]\n0; 20\n1,5; -10,5\n"))
    assert isinstance(found, softlube.History)
    assert found.control == "height"
    np.testing.assert_allclose([found.time, found.values], [[0, 1.5], [20e-6, -10.5e-6]], rtol=1e-15)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "h.csv, line 1: the file is empty"),
        ("time,speed\n0,1\n1,2\n", "h.csv, line 1: expected columns headed 'time, load' or 'time, height'"),
        ("0,1\n1,2\n", "h.csv, line 1: expected columns headed"),
        ("load\n1\n", "h.csv, line 1: no column time; the header has 'load'"),
        ("time,load,height\n0,1,1\n", "h.csv, line 1: load and height are both there"),
        ("time,load\n0,a\n", "h.csv, line 2: load: 'a' under 'load' is no number"),
        ("time [kg],load\n0,1\n1,1\n", "h.csv, line 1: time cannot be in 'kg'; expected a unit of a time"),
        ("time,load\n0\n1\n", "h.csv, line 2: 1 cells under 2 columns"),
        ("time,load\n0,1,5\n1,2,5\n", "h.csv, line 2: 3 cells under 2 columns; a decimal comma needs semicolons"),
        ("# a rig\ntime,load\n\n0,1\n1,nan\n", "h.csv, line 5: load is missing; expected a force"),
        ("time,load\n0,1\n1,inf\n", "h.csv, line 3: load: 'inf' under 'load' is no number .*expected a finite number"),
        ("time,load\n1,1\n2,1\n", "h.csv, line 2: expected times that start at 0"),
        ("time,load\n0,1\n2,1\n2,1\n", "h.csv, line 4: expected times that start at 0 and increase, got 2 s"),
        ("time,load\n0,1\n", "h.csv, line 2: expected at least two points of time and load"),
    ],
)
def test_bad_files_are_refused_with_the_line(tmp_path, text, message):
    with pytest.raises(InputError, match=f"^history: {message}"):
        read_history(write(tmp_path, text))


def test_an_absent_file(tmp_path):
    with pytest.raises(InputError, match=r"^history: .*none.csv: the file does not exist"):
        read_history(tmp_path / "none.csv")
