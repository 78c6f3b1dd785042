"""Inputs that belong to no part, and what is made of all declarations together."""

from inspect import signature

import pytest

import softlube
from softlube.errors import InputError
from softlube.model.parts import Part
from softlube.physical.inputs import BODIES, SLIDING_BODIES, Approach, Loading, check_names, declared, names_of


def test_a_contact_s_signature_and_docstring_are_the_declarations():
    names = [*SLIDING_BODIES, *names_of(SLIDING_BODIES, Loading)]
    assert list(signature(softlube.Contact).parameters) == names
    for name, each in names_of(SLIDING_BODIES, Loading).items():
        assert f"    {name} : " in softlube.Contact.__doc__
        assert each.help in softlube.Contact.__doc__


def test_a_squeeze_film_s_signature_is_the_declarations():
    names = [*BODIES, *names_of(BODIES, Approach)]
    assert list(signature(softlube.squeeze).parameters) == ["height", "accuracy", "progress", *names]


def test_unknown_names_are_refused_with_the_nearest():
    with pytest.raises(InputError, match="viscsity: no input; expected viscosity"):
        softlube.Contact(viscsity=1.0)
    check_names(["radius", "liquid"], SLIDING_BODIES)


def test_every_part_is_public():
    for kinds in Part.slots.values():
        for kind in kinds.values():
            assert getattr(softlube, kind.__name__) is kind
            assert kind.__name__ in dir(softlube)


def test_headers_of_measurements_are_inputs():
    assert "sliding_velocity" in declared()["speed"].synonyms
    assert declared()["friction"].signed
