"""Measurements from spreadsheets: what a CSV file of the same cells gives, with the row in messages."""

from pathlib import Path

import numpy as np
import openpyxl
import pandas as pd
import pytest

import softlube
from softlube.files import spreadsheets
from softlube.files.spreadsheets import is_spreadsheet

HEADER = ["load [mN]", "speed [mm/s]", "friction [mN]", "note"]
ROWS = [["# rig 3"], [], HEADER, [100, 0.1, 0.45, "fine"], [], [200, 2e-5, 0.9, None]]


@pytest.fixture(params=[".xlsx", ".ods"])
def sheet(request, tmp_path):
    """Writes rows to a spreadsheet."""

    def write(rows):
        book = openpyxl.Workbook()
        for row in rows:
            book.active.append(row or [None])
        book.save(tmp_path / "data.xlsx")
        if request.param == ".ods":
            cells = pd.read_excel(tmp_path / "data.xlsx", header=None, dtype=object)
            cells.to_excel(str(tmp_path / "data.ods"), header=False, index=False)
        return tmp_path / f"data{request.param}"

    return write


def test_a_sheet_is_read_as_its_csv(sheet, tmp_path):
    found = softlube.read_measurements(sheet(ROWS))
    (tmp_path / "data.csv").write_text("\n".join(";".join("" if cell is None else str(cell) for cell in row) for row in ROWS))
    expected = softlube.read_measurements(tmp_path / "data.csv")
    for name in ("load", "speed", "friction", "slide_to_roll", "lines"):
        assert np.array_equal(getattr(found, name), getattr(expected, name)), name
    assert found.lines.tolist() == [4, 6]


def test_the_row_of_a_wrong_cell_is_named(sheet):
    with pytest.raises(softlube.InputError, match=r"data\.(xlsx|ods), line 6: .*friction.*'ninety'"):
        softlube.read_measurements(sheet([*ROWS[:5], [200, 0.2, "ninety", None]]))


def test_what_is_no_spreadsheet(tmp_path):
    for name, content, message in (
        ("a.xlsx", b"load,speed", "is no spreadsheet, or damaged; save the table as CSV"),
        ("a.ods", b"PK\x05\x06" + bytes(18), "cannot be read"),
        ("a.xls", b"\xd0\xcf", r"\.xls files are not read; save the table as CSV or \.xlsx"),
    ):
        (tmp_path / name).write_bytes(content)
        with pytest.raises(softlube.InputError, match=message):
            softlube.read_measurements(tmp_path / name)


def test_without_the_package_the_message_says_what_to_do(sheet, monkeypatch):
    monkeypatch.setattr(spreadsheets, "find_spec", lambda name: None)
    with pytest.raises(softlube.InputError, match=r"pip install 'softlube\[spreadsheets\]'; or save the table as CSV"):
        softlube.read_measurements(sheet(ROWS))


def test_what_unpacks_to_too_much_is_refused(sheet, monkeypatch):
    monkeypatch.setattr(spreadsheets, "LARGEST", 100)
    with pytest.raises(softlube.InputError, match="is larger than 100 bytes when unpacked"):
        softlube.read_measurements(sheet(ROWS))


def test_endings():
    assert is_spreadsheet(Path("A.XLSX"))
    assert not is_spreadsheet(Path("a.csv"))
