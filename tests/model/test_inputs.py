"""Declarations of inputs: what they read, refuse and say."""

from decimal import Decimal

import numpy as np
import pytest

from softlube.errors import InputError
from softlube.model.inputs import LENGTH, NUMBER, PRESSURE, TIME, Declaring, Input, declared, given, read, register


class Slab(Declaring):
    tallness = given("Tallness of the slab; more is better", LENGTH, "3 mm")
    ageing = given("Age of the slab", TIME, "1 s", default=None, signed=True)
    glue = given("Share of glue", NUMBER, "0.1", default=0.25, between=(0, 1))
    colouring = given("Colour of the slab", default="red", choices=("red", "blue", "green"))
    weight = given("Not kept", LENGTH, "1 m", default=None, derived=lambda slab: 2 * slab.tallness)

    def __init__(self, **values):
        vars(self).update({name: value for name, value in read(self.inputs, values).items() if name != "weight"})


def test_values_stand_on_the_instance_in_si():
    slab = Slab(tallness="3 mm", colouring="blue")
    assert (slab.tallness, slab.ageing, slab.glue, slab.colouring) == (pytest.approx(3e-3), None, 0.25, "blue")
    assert slab.weight == pytest.approx(6e-3)
    assert isinstance(Slab.tallness, Input)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({}, "tallness: missing; expected a length such as '3 mm'"),
        ({"tallness": "3"}, "tallness: '3' has no unit; expected a length such as '3 mm'"),
        ({"tallness": "0 m"}, "tallness: expected a positive, finite quantity, a length such as '3 mm'; got 0 m"),
        ({"tallness": 1.0, "ageing": "inf s"}, "ageing: cannot read 'inf s': expected a finite number; expected a time"),
        ({"tallness": 1.0, "ageing": float("inf")}, "ageing: expected a finite quantity"),
        ({"tallness": 1.0, "glue": 2}, "glue: expected a number between 0 and 1, got 2"),
        ({"tallness": 1.0, "glue": float("nan")}, "glue: expected a number between 0 and 1"),
        ({"tallness": 1.0, "colouring": "black"}, "colouring: expected 'red' or 'blue' or 'green', got 'black'"),
        ({"tallness": 1.0, "colouring": 3}, "colouring: expected 'red'"),
    ],
)
def test_what_is_refused(values, message):
    with pytest.raises(InputError, match=message):
        Slab(**values)


def test_an_input_under_another_name():
    with pytest.raises(InputError, match="gap: 1 s has the wrong dimension; expected a length"):
        Slab.tallness.read("1 s", "gap")
    assert Slab.ageing.read("-2 ms") == pytest.approx(-2e-3)


def test_numbers_are_si():
    for value in (2, 2.0, np.float32(2), np.int64(2), np.array(2.0), Decimal(2)):
        assert Slab.tallness.read(value) == 2.0
    for value in (True, np.True_, 2j, np.complex128(2), [2.0], np.array([2.0]), b"2 m", None):
        with pytest.raises(InputError, match=r"tallness: cannot read .*; expected a length such as '3 mm'"):
            Slab.tallness.read(value)


def test_several_values_have_all_a_unit_or_none():
    assert Slab.tallness.read_all(["2 mm", "2,5 mm"]) == [2e-3, 2.5e-3]
    assert Slab.tallness.read_all([1, 2.5]) == [1.0, 2.5]
    assert Slab.glue.read_all(["0,5", 0.25]) == [0.5, 0.25]
    with pytest.raises(InputError, match="tallness: 50 has no unit, and others have"):
        Slab.tallness.read_all(["20 mm", 50])


def test_the_factor_of_a_unit():
    assert Slab.tallness.factor("mm") == 1e-3
    with pytest.raises(InputError, match="s has the wrong dimension"):
        Slab.tallness.factor("s")


def test_the_help_is_a_sentence():
    assert Slab.tallness.help == 'Tallness of the slab, such as "3 mm"; more is better.'
    assert Slab.glue.help == "Share of glue [default: 0.25]."
    assert Slab.colouring.help == 'Colour of the slab, "red", "blue" or "green" [default: red].'


def test_a_name_is_one_quantity():
    new = Input("Another tallness", PRESSURE, "1 Pa")
    new.name = "tallness"
    with pytest.raises(InputError, match="tallness: declared twice, in 'm' and in 'Pa'"):
        register(new)
    assert declared()["tallness"] is Slab.tallness


def test_inherited_inputs_come_first():
    class Board(Slab):
        broadness = given("Width", LENGTH, "1 m", default=1.0)

    assert list(Board.inputs) == [*Slab.inputs, "broadness"]
