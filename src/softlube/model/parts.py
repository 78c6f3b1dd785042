"""Parts of an experiment: an indenter, a substrate, a liquid, its density, a motion.

Each is a class that declares its inputs (`softlube.model.inputs`) and normalises itself for the solver.  A class with a `kind`
of its own is a part that can be chosen; defining it is all it takes.  Parts are given as objects, such as `Newtonian`, or
by their inputs alone, from which `resolve` finds them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib import import_module
from inspect import Parameter, Signature
from pkgutil import iter_modules
from typing import Any, ClassVar

from softlube.errors import InputError
from softlube.model.inputs import REQUIRED, Declaring, Input, read, register


class _Constructor:
    """The signature of a part, from its inputs: the first may be positional."""

    def __get__(self, instance: Any, owner: type[Part]) -> Signature:
        defaults = {owner.over: REQUIRED} if owner.over else {}
        defaults |= {name: each.default for name, each in owner.inputs.items()}
        kinds = [Parameter.POSITIONAL_OR_KEYWORD] + [Parameter.KEYWORD_ONLY] * len(defaults)
        return Signature(
            [
                Parameter(name, kind, default=Parameter.empty if default is REQUIRED else default)
                for (name, default), kind in zip(defaults.items(), kinds, strict=False)
            ]
        )


class Part(Declaring):
    """A part of an experiment.  Immutable; inputs take text with a unit, a pint quantity or a number in SI.

    Attributes
    ----------
    slot : str
        What it is in an experiment, such as "liquid".
    selector : str
        Input that names the kind where several have the inputs given; empty for a slot without one.
    kind : str
        Its name within the slot, in files and for the selector.
    usual : bool
        Whether it is taken before others that have the inputs given.
    over : str
        Where a part is an addition to another of its slot: the attribute that is the other one.

    Raises
    ------
    InputError
        If an input is missing, contradictory or not what its declaration says; the message names the input.
    """

    slot: ClassVar[str]
    selector: ClassVar[str] = ""
    kind: ClassVar[str]
    usual: ClassVar[bool] = False
    over: ClassVar[str] = ""
    slots: ClassVar[dict[str, dict[str, type[Part]]]] = {}
    """Every kind of part by slot and name."""
    additions: ClassVar[dict[str, dict[str, type[Part]]]] = {}
    """Every kind of addition to the parts of a slot."""
    attributes: ClassVar[Mapping[str, str]] = {}
    """Its attributes by the names that their inputs have in an experiment."""
    __signature__ = _Constructor()

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.attributes = {each.name: attribute for attribute, each in cls.inputs.items()}
        if "kind" in vars(cls):
            (Part.additions if cls.over else Part.slots).setdefault(cls.slot, {})[cls.kind] = cls
            _words_of.cache_clear()
        if cls.selector:
            register(selector_input(cls.slot, cls.selector))

    def __init__(self, *first: object, **named: object) -> None:
        names = list(self.__signature__.parameters)
        given = dict(zip(names, first[:1], strict=False)) | named
        if len(first) > 1 or len(given) < len(first) + len(named) or given.keys() - set(names):
            raise TypeError(f"{type(self).__name__}: expected {type(self).__name__}{self.__signature__}")
        if self.over:
            vars(self)[self.over] = _checked_part(self.slot, given.get(self.over))
        vars(self).update(self.checked(read(self.inputs, given)))

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values to be kept, in SI: the place to refuse what does not go together.  Kept as read if not overridden."""
        return values

    def flat(self) -> dict[str, Any]:
        """Its inputs in SI by their names in an experiment, with the selector; `resolve` makes an equal part of them."""
        named = {self.inputs[name].name: value for name, value in vars(self).items() if name in self.inputs}
        if self.over:
            return vars(self)[self.over].flat() | named
        return named | ({self.selector: self.kind} if self.selector else {})

    def value(self, name: str) -> Any:
        """What an input of an experiment is in this part.

        Raises
        ------
        KeyError
            If it has no such input.
        """
        if name in self.attributes:
            return getattr(self, self.attributes[name])
        if self.over:
            return vars(self)[self.over].value(name)
        return {self.selector: self.kind}[name]

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"{type(self).__name__} is immutable; make another one")

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and vars(self) == vars(other)

    def __hash__(self) -> int:
        return hash((type(self), *vars(self).items()))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in vars(self).items())})"


def selector_input(slot: str, selector: str) -> Input:
    """The input that names the kind of a slot's part."""
    kinds = Part.slots.setdefault(slot, {})
    of = selector.removesuffix("_law")
    usual = " or ".join(kind for kind, each in kinds.items() if each.usual)
    absent = f"follows from the inputs; {usual} where several fit" if usual else ""
    made = Input(f"Law of the {of}", choices=lambda: tuple(sorted(kinds)), default=None, absent=absent)
    made.name = selector
    return made


def members(package: str, path: Iterable[str], bases: tuple[type, ...]) -> dict[str, type]:
    """Import every module of a package; the classes in them that derive from some bases, by name."""
    modules = [import_module(f"{package}.{each.name}") for each in iter_modules(path)]
    return {
        name: each
        for module in modules
        for name, each in vars(module).items()
        if isinstance(each, type) and issubclass(each, bases) and each not in bases
    }


def vocabulary(slots: Iterable[str]) -> dict[str, Input]:
    """Every input by which the parts of some slots may be given, selectors included."""
    return {name: each for slot in slots for name, each in _words_of(slot).items()}


@cache
def _words_of(slot: str) -> dict[str, Input]:
    """Inputs of a slot's kinds, those of the simplest first; forgotten when a new kind is defined."""
    kinds = sorted(Part.slots[slot].values(), key=_simplicity)
    selector = kinds[0].selector
    kinds += Part.additions.get(slot, {}).values()
    found = {each.name: each for kind in reversed(kinds) for each in kind.inputs.values()}
    ordered = {name: found[name] for kind in kinds for name in kind.attributes}
    return ordered | ({selector: selector_input(slot, selector)} if selector else {})


def resolve(slots: Sequence[str], given: Mapping[str, object]) -> dict[str, Any]:
    """The parts of an experiment, from parts or from inputs; names of other things are passed over.

    Raises
    ------
    InputError
        If a part is given and inputs of its slot as well, or the inputs make no part, or more than one.
    """
    return {slot: _part(slot, given) for slot in slots}


def _part(slot: str, given: Mapping[str, object]) -> Part:
    names = _words_of(slot)
    flat = {name: given[name] for name in names if given.get(name) is not None}
    part = given.get(slot)
    if part is None:
        return _by_inputs(slot, flat)
    part = _checked_part(slot, part)
    if flat:
        raise InputError(f"{slot}, {next(iter(flat))}: {part!r} says it already; give the part, or its inputs instead")
    return part


def _checked_part(slot: str, part: object) -> Part:
    if not isinstance(part, Part) or part.slot != slot:
        kinds = [*Part.slots[slot].values(), *Part.additions.get(slot, {}).values()]
        raise InputError(f"{slot}: expected {' or '.join(each.__name__ for each in kinds)}, got {part!r}")
    return part


def _by_inputs(slot: str, flat: dict[str, object]) -> Part:
    kinds = Part.slots[slot]
    names = _words_of(slot)
    for addition in Part.additions.get(slot, {}).values():
        own = {name: value for name, value in flat.items() if name in addition.attributes}
        if own:
            missing = next((name for name in addition.attributes if name in _required(addition) - own.keys()), None)
            if missing is not None:
                raise _incomplete(next(iter(own)), missing)
            below = _by_inputs(slot, {name: value for name, value in flat.items() if name not in own})
            return addition(below, **{addition.attributes[name]: value for name, value in own.items()})
    selector = next(iter(kinds.values())).selector
    simplest = min(kinds.values(), key=_simplicity)
    alike = [kind for kind in kinds.values() if _required(kind) & _required(simplest)] or [simplest]
    everywhere = set.intersection(*map(_required, alike))
    # A default says nothing: a half-space's file of an earlier version has base = "bonded".
    said = {name: value for name, value in flat.items() if name != selector and not _same(value, names[name].default)}
    usual = next((each for each in kinds.values() if each.usual), None)
    candidates: Iterable[type[Part]] = kinds.values()
    choice = flat.get(selector)
    if choice is not None:
        chosen = kinds[names[selector].read(choice)]
        other = next((name for name in said if name not in chosen.attributes), None)
        if other is not None:
            raise InputError(f"{selector}, {other}: {choice!r} has no such input; leave one of them out")
        if chosen is not usual or said.keys() - everywhere:
            candidates = [chosen]
    fitting = [each for each in candidates if said.keys() <= each.attributes.keys()]
    if not fitting:
        one, other = _apart(said, kinds.values())
        raise InputError(f"{one}, {other}: no {slot} has both; leave one of them out")
    complete = [each for each in fitting if _required(each) - everywhere <= said.keys()]
    if not complete:
        nearest = min(fitting, key=lambda each: (len(_required(each) - said.keys()), not each.usual))
        missing = next(name for name in nearest.attributes if name in _required(nearest) - everywhere - said.keys())
        first = selector if choice is not None else next((name for name in said if name not in simplest.attributes), None)
        if first is None:
            raise InputError(f"{missing}: missing; expected {names[missing].expected}")
        raise _incomplete(first, missing)
    complete.sort(key=_simplicity)
    best = complete[0]
    if [(len(each.inputs), each.usual) for each in complete[:2]] == [(len(best.inputs), best.usual)] * 2:
        several = ", ".join(each.kind for each in complete)
        advice = f"; say which by {selector}" if selector else "; give the part itself"
        raise InputError(f"{next(reversed(said), slot)}: an input of several, {several}{advice}")
    return best(**{best.attributes[name]: value for name, value in flat.items() if name in best.attributes})


def _simplicity(kind: type[Part]) -> tuple[int, bool]:
    """What the kinds of a slot are ordered by: few inputs first, the usual one first of those that have as many."""
    return len(kind.inputs), not kind.usual


def _incomplete(given: str, missing: str) -> InputError:
    return InputError(f"{given}, {missing}: the first means nothing without the second; give both or neither")


@cache
def _required(kind: type[Part]) -> set[str]:
    return {each.name for each in kind.inputs.values() if each.required}


def _same(value: object, default: object) -> bool:
    return type(value) is type(default) and value == default


def _apart(said: Iterable[str], kinds: Iterable[type[Part]]) -> tuple[str, str]:
    """Two inputs that no kind has both."""
    names, kinds = list(said), list(kinds)
    pairs = ((one, other) for i, one in enumerate(names) for other in names[i + 1 :])
    return next(
        (pair for pair in pairs if not any(set(pair) <= kind.attributes.keys() for kind in kinds)), (names[0], names[-1])
    )
