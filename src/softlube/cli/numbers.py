"""How options without unit are read: numbers, and words of a few.  Light, as ``--help`` imports it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

if TYPE_CHECKING:
    from cyclopts import Token


def _number(kind: object, tokens: Sequence[Token]) -> float:
    """A number as softlube reads it everywhere: decimal commas, no signs between thousands, nothing infinite."""
    from softlube.model.units import read_number

    return read_number(tokens[0].value)


def _whole(kind: object, tokens: Sequence[Token]) -> int:
    """A whole number of nine digits at most."""
    from softlube.errors import InputError
    from softlube.model.units import WHOLE

    if not WHOLE.fullmatch(tokens[0].value):
        raise InputError(f"cannot read {tokens[0].value!r}: expected a whole number")
    return int(tokens[0].value)


def _word(kind: object, tokens: Sequence[Token]) -> str:
    """A word as it is given: what it may be, the command says, as Python does."""
    return tokens[0].value


CHOICE = Parameter(converter=_word, allow_leading_hyphen=True)
"""How a word is read whose choices the help shows and a shell completes."""
Cavitation = Annotated[Literal["reynolds", "none"], CHOICE]
FLOAT, WHOLE = Parameter(converter=_number, allow_leading_hyphen=True), Parameter(converter=_whole, allow_leading_hyphen=True)
"""How options without unit are read: numbers, and whole numbers.  A negative one is a value, to be refused with the reason."""
