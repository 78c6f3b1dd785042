"""Tables of texts on the terminal."""

from softlube.cli.table import summary_table


def test_the_rows_are_those_of_the_summary(physical):
    table = summary_table(physical.summary())
    rows = list(zip(*(list(column.cells) for column in table.columns), strict=True))
    assert rows == list(physical.summary().rows)
    assert [column.header for column in table.columns] == ["quantity", "value", "± error", "unit"]
    assert [column.justify for column in table.columns] == ["left", "right", "left", "left"]
