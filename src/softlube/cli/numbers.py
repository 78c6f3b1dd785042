"""How options without unit are read.  Light, as the commands import it before they say ``--help``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

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


FLOAT, WHOLE = Parameter(converter=_number, allow_leading_hyphen=True), Parameter(converter=_whole, allow_leading_hyphen=True)
"""How options without unit are read: numbers, and whole numbers.  A negative one is a value, to be refused with the reason."""
