"""Families of models: what files keep of them comes back, and what they do not know is refused."""

from dataclasses import dataclass
from typing import Any, ClassVar

import pytest

from softlube.errors import InputError
from softlube.model.named import Named, to_plain


class Wood(Named):
    kinds: ClassVar[dict[str, type[Any]]] = {}
    usual: ClassVar[str] = "oak"
    unknown: ClassVar[str] = "wood: no"


@dataclass(frozen=True)
class Oak(Wood):
    kind: ClassVar[str] = "oak"


@dataclass(frozen=True)
class Veneer(Wood):
    thickness: float
    core: Wood
    kind: ClassVar[str] = "veneer"


def test_a_model_on_another_comes_back():
    model = Veneer(0.6, Veneer(2.0, Oak()))
    assert to_plain(model) == {
        "kind": "veneer",
        "thickness": 0.6,
        "core": {"kind": "veneer", "thickness": 2.0, "core": {"kind": "oak"}},
    }
    assert Wood.from_plain(to_plain(model)) == model


def test_nothing_written_is_the_usual_one():
    assert Wood.from_plain(None) == Oak()


def test_a_name_of_no_model_of_the_family_is_refused():
    with pytest.raises(InputError, match="wood: no 'newtonian' is known; expected 'oak' or 'veneer'"):
        Wood.from_plain({"kind": "newtonian"})
