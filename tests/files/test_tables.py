"""CSV files as rigs and spreadsheets write them: the right numbers, or a refusal with file, line and column."""

import pytest

from softlube import InputError
from softlube.files.tables import read_table


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
