"""Columns of numbers: what is taken, what is refused, and how they are described."""

import numpy as np
import pytest

from softlube.errors import InputError
from softlube.experiments.columns import checked_columns, summary_of


def test_numbers_become_arrays_of_one_length():
    first, second = checked_columns({"a": 2, "b": [-1.0]}, signed={"b"})
    assert (first.tolist(), second.tolist()) == ([2.0], [-1.0])


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"a": "x"}, "a: expected numbers in SI units, got 'x'"),
        ({"a": [1.0, np.nan]}, "a: expected a row of finite numbers above zero"),
        ({"a": [0.0]}, "a: expected a row of finite numbers above zero"),
        ({"b": [np.inf]}, "b: expected a row of finite numbers$"),
        ({"a": [[1.0]]}, "a: expected a row"),
        ({"a": [1.0], "b": [1.0, 2.0]}, "a, b: differ in length, 1, 2"),
    ],
)
def test_what_is_no_column(given, message):
    with pytest.raises(InputError, match=message):
        checked_columns(given, signed={"b"})


def test_least_median_and_greatest():
    columns = (("load", np.array([3e-3, 1e-3, 2e-3]), "N"), ("empty", np.array([]), "N"))
    text = str(summary_of("Three rows", columns, ["one was left out"]))
    assert all(each in text for each in ("Three rows", "1 mN", "2 mN", "3 mN", "one was left out"))
    assert "empty" not in text
