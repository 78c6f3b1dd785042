"""Exceptions: what callers catch them as."""

import pytest

import softlube
from softlube.errors import InputError, NotConvergedError, SoftlubeError


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
