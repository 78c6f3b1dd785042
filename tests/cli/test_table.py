"""Tables of texts on the terminal."""

import io

import pytest
from rich.console import Console

from softlube.cli.main import main
from softlube.cli.table import number_table, show, summary_table, text_table


def test_the_rows_are_those_of_the_summary(physical):
    table = summary_table(physical.summary())
    rows = list(zip(*(list(column.cells) for column in table.columns), strict=True))
    assert rows == list(physical.summary().rows)
    assert [column.header for column in table.columns] == ["quantity", "value", "± error", "unit"]
    assert [column.justify for column in table.columns] == ["left", "right", "left", "left"]


def printed(table, width):
    console = Console(file=io.StringIO(), width=width)
    show(console, table)
    return console.file.getvalue()


@pytest.mark.parametrize("width", [80, 60, 40])
def test_numbers_are_whole_in_a_narrow_terminal(physical, width):
    text = printed(summary_table(physical.summary()), width)
    assert "…" not in text
    for _, value, error, _ in physical.summary().rows:
        assert value in text
        assert error in text
    if width >= 60:
        assert max(map(len, text.splitlines())) <= width


def test_a_table_that_is_too_wide_goes_beyond_the_terminal():
    text = printed(number_table([("123456789",) * 8], ("speed mm/s",) * 8, title="load"), 60)
    assert text.count("123456789") == 8
    assert "…" not in text
    assert "mm/s" in text.splitlines()[3]
    assert "longest-word" in printed(text_table([("the longest-word of all", "1.5")], ("words", "value")), 10)


@pytest.mark.parametrize("command", [["solve", "--beta", "100", "--fast"], ["curve"], ["curve", "--beta", "10"]])
def test_commands_cut_nothing_in_60_columns(command, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "60")
    assert main(command) == 0
    assert "…" not in capsys.readouterr().out


@pytest.mark.parametrize(
    "command", ["solve", "sweep", "stribeck", "fit", "curve", "squeeze", "flow", "reproduce", "info", "cache"]
)
def test_help_fits_80_columns(command, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    assert main([command, "--help"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80
    assert not any("…" in line for line in lines if "--" in line.split("…")[0][:6])
