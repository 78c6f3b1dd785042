"""Exceptions: what callers catch them as."""

import warnings

import pytest

import softlube
from softlube.errors import InputError, NotConvergedError, SoftlubeError, printable, shown, warn


def test_one_base_for_all():
    assert issubclass(InputError, SoftlubeError)
    assert issubclass(NotConvergedError, SoftlubeError)


def test_a_wrong_input_is_a_value_error_and_names_the_parameter():
    with pytest.raises(ValueError, match=r"^beta: expected") as caught:
        softlube.solve(beta=-1)
    assert isinstance(caught.value, InputError)


def test_what_cannot_be_solved_is_no_wrong_input():
    with pytest.raises(NotConvergedError) as caught:
        softlube.solve(beta=1e12)
    assert not isinstance(caught.value, ValueError)


def test_messages_are_one_line_that_any_terminal_can_show():
    message = str(InputError("radius: got \x1b[2J\n\x00" + "9" * 5000 + " at the end"))
    assert message.startswith("radius: got \\x1b[2J\\n\\x00999")
    assert message.endswith("999 at the end")
    assert 298 < len(message) <= 300
    assert str(NotConvergedError("β = 3 µm/s …")) == "β = 3 µm/s …"
    assert printable("a\ud800b") == "a\\ud800b"


def test_what_has_no_repr():
    nested = []
    for _ in range(5000):
        nested = [nested]
    for thing in (nested, 10**5000):
        assert shown(thing) == f"{type(thing).__name__} that is too long to be shown"
        for take in (softlube.Contact, softlube.solve):
            name = "radius" if take is softlube.Contact else "beta"
            with pytest.raises(InputError, match=f"^{name}: |^young_modulus"):
                take(**{name: thing})
    assert shown("a") == "'a'"


def test_doubts_are_said_every_time_and_each_once():
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("default")
        for _ in range(2):
            warn(["one", "two", "one"])
    assert [str(each.message) for each in heard] == ["one", "two"] * 2
    assert {each.category for each in heard} == {softlube.ValidityWarning}
    assert {each.filename for each in heard} == {__file__}
