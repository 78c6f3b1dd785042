"""Models that files know by a name: laws of liquids, kernels of substrates, shapes of indenters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from softlube.errors import InputError


class Named:
    """A model that files know by its `kind`.  What a family of models has in common is a class that derives from this one.

    Attributes
    ----------
    kinds : dict
        Of a family: every model by its name; defining a class with a `kind` of its own puts it there.
    usual : str
        Of a family: the kind where nothing was written.
    unknown : str
        Of a family: how a message begins that knows no such kind.
    """

    kinds: ClassVar[dict[str, type[Any]]]
    usual: ClassVar[str]
    unknown: ClassVar[str]
    kind: ClassVar[str]

    def __init_subclass__(cls) -> None:
        if "kind" in vars(cls):  # not yet where a worker of a sweep puts a class together
            cls.kinds[cls.kind] = cls

    @classmethod
    def from_plain(cls, values: Mapping[str, Any] | None) -> Any:
        """The model of the family that `to_plain` wrote; the usual one where nothing was written.

        Raises
        ------
        InputError
            If no model of the family has the name that is written.
        """
        written = dict(values or {"kind": cls.usual})
        kind = written.pop("kind")
        if kind not in cls.kinds:
            raise InputError(f"{cls.unknown} {kind!r} is known; expected {' or '.join(map(repr, sorted(cls.kinds)))}")
        made = {name: cls.from_plain(value) if isinstance(value, dict) else value for name, value in written.items()}
        return cls.kinds[kind](**made)


def to_plain(model: Any) -> dict[str, Any]:
    """A model, and the models that it stands on, in plain values for files."""
    values = {name: to_plain(value) if hasattr(value, "kind") else value for name, value in vars(model).items()}
    return {"kind": model.kind} | values
