"""Inputs, each declared once: name, dimension, words, example and default.

The command line, plans of sweeps, CSV headers, files and the documentation take what they know of an input from here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple, SupportsFloat

from softlube.errors import InputError, shown

REQUIRED: Any = object()
"""Default of an input that must be given."""
LEAST, GREATEST = 1e-30, 1e30
"""Magnitudes in SI that an input may have, zero apart: beyond all that is measured, and products of some of them are finite."""


class Dimension(NamedTuple):
    """A dimension: its SI unit as `softlube.model.units` reads it, and its name with an article."""

    unit: str
    words: str


LENGTH = Dimension("m", "a length")
TIME = Dimension("s", "a time")
SPEED = Dimension("m/s", "a speed")
FORCE = Dimension("N", "a force")
LINE_LOAD = Dimension("N/m", "a force per length")
PRESSURE = Dimension("Pa", "a pressure")
INVERSE_PRESSURE = Dimension("1/Pa", "an inverse pressure")
VISCOSITY = Dimension("Pa s", "a dynamic viscosity")
DENSITY = Dimension("kg/m^3", "a density")
NUMBER = Dimension("", "a number")


class Input:
    """One input.  On an instance of the class that declares it stands its value in SI.

    Parameters
    ----------
    words : str
        What it is, as the command line's help begins; the example follows it, or its part before a semicolon.
    dimension : Dimension or None
        None for a text.
    example : str
        A value with its unit.
    default : object
        What is read where the input is not given; None for nothing, `REQUIRED` for an input that must be given.
    signed : bool
        Whether it may be zero or negative.
    between : tuple of float, optional
        Least and greatest number that is taken.
    choices : sequence of str, or callable that gives one
        Texts that are taken; any where none are listed.
    remark : str
        What follows the example where a value is refused, such as "or '-1 um' for a gap".
    absent : str
        What holds where it is not given, for the help.
    synonyms : sequence of str
        Other headers of a CSV column that mean it.
    derived : callable, optional
        The value from what the instance keeps, for an input that is another one in disguise.
    flat : str
        Its name where it stands among the inputs of a whole experiment, if the attribute's name is taken there: the
        `young_modulus` of a ball is the `ball_young_modulus` of a contact.
    kept : bool
        Whether it follows from the others, and files keep it; nobody writes it, and a contact does not show it.
    """

    name: str

    def __init__(
        self,
        words: str,
        dimension: Dimension | None = None,
        example: str = "",
        *,
        default: Any = REQUIRED,
        signed: bool = False,
        between: tuple[float, float] | None = None,
        choices: tuple[str, ...] | Callable[[], tuple[str, ...]] = (),
        remark: str = "",
        absent: str = "",
        synonyms: tuple[str, ...] = (),
        derived: Callable[[Any], float] | None = None,
        flat: str = "",
        kept: bool = False,
    ) -> None:
        self.words, self.dimension, self.example, self.default = words, dimension, example, default
        self.signed, self.between, self.remark, self.absent = signed, between, remark, absent
        self.synonyms, self.derived, self.flat, self.kept, self._choices = synonyms, derived, flat, kept, choices

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = self.flat or name

    def __get__(self, instance: Any, owner: type) -> Any:
        if instance is None:
            return self
        if self.derived is None:
            raise AttributeError(f"{self.name} of {owner.__name__} has no value yet")
        return self.derived(instance)

    @property
    def required(self) -> bool:
        """Whether it must be given."""
        return self.default is REQUIRED

    @property
    def is_text(self) -> bool:
        """Whether it is a text, not a quantity."""
        return self.dimension is None

    @property
    def unit(self) -> str:
        """SI unit; empty for a text or a plain number."""
        return self.dimension.unit if self.dimension is not None else ""

    @property
    def choices(self) -> tuple[str, ...]:
        """Texts that are taken."""
        return self._choices() if callable(self._choices) else self._choices

    @property
    def expected(self) -> str:
        """What a value should be, for messages: "a length such as '2 mm'"."""
        if self.dimension is None:
            return " or ".join(map(repr, self.choices)) or "a text"
        return f"{self.dimension.words} such as {self.example!r}" + (f", {self.remark}" if self.remark else "")

    @property
    def title(self) -> str:
        """What it is, without what the command line's help adds."""
        return self.words.partition("; ")[0].removesuffix(" instead")

    @property
    def help(self) -> str:
        """A sentence for the command line's help and the documentation."""
        quoted = [f'"{each}"' for each in self.choices]
        listed = ", ".join(quoted[:-1]) + " or " * (len(quoted) > 1) + "".join(quoted[-1:])
        optional = self.default in (REQUIRED, None)
        example = f'such as "{self.example}"' if self.example and optional else ""
        usual = self.absent or ("" if optional else f"{self.default} {self.unit}".strip())
        what, semicolon, more = self.words.partition("; ")
        sentence = ", ".join(filter(None, (what, example, listed))) + semicolon + more
        return f"{sentence} [default: {usual}]." if usual else f"{sentence}."

    def read(self, value: object, name: str | None = None) -> Any:
        """The value in SI; see `read_quantity`.  A text is one of the choices.

        Parameters
        ----------
        value : object
            As given.
        name : str, optional
            What messages call the input; its own name if not given.

        Raises
        ------
        InputError
            If the value is not what the declaration says.
        """
        name = name or self.name
        if self.dimension is None:
            if not isinstance(value, str) or (self.choices and value not in self.choices):
                raise InputError(f"{name}: expected {self.expected}, got {shown(value)}")
            return value
        number = read_quantity(name, value, self.dimension.unit, self.expected)
        if self.between is not None:
            low, high = self.between
            if not low <= number <= high:
                raise InputError(f"{name}: expected a number between {low:g} and {high:g}, got {shown(value)}")
        elif not math.isfinite(number) or (number <= 0 and not self.signed):
            sign = "" if self.signed else "positive, "
            got = value if isinstance(value, str) else shown(value)
            raise InputError(f"{name}: expected a {sign}finite quantity, {self.expected}; got {got}")
        elif number and not LEAST <= abs(number) <= GREATEST:
            size = f"{LEAST:g} to {GREATEST:g} {self.unit}".strip()
            raise InputError(f"{name}: expected a magnitude from {size}; got {shown(value)}")
        return number

    def read_all(self, values: Sequence[object]) -> list[Any]:
        """Several values in SI, as `read` reads them.

        Raises
        ------
        InputError
            If one is not what the declaration says, or some are texts with a unit and others are numbers: who writes
            ``["20 mN", 50]`` hardly means 50 N.
        """
        if self.unit and len({isinstance(value, str) for value in values}) > 1:
            number = next(value for value in values if not isinstance(value, str))
            raise InputError(f"{self.name}: {number!r} has no unit, and others have; give all of them a unit, or none (SI)")
        return [self.read(value) for value in values]

    def factor(self, unit: str) -> float:
        """What a number in a unit is multiplied by to be in SI.

        Raises
        ------
        InputError
            If the text is no unit of the input's dimension.
        """
        from softlube.model import units

        return units.unit_factor(unit, self.unit)


class Switch(Input):
    """An input that is true or false, "yes" or "no" where it is written; not so if not given."""

    def __init__(self, words: str) -> None:
        super().__init__(words, default=False, choices=("yes", "no"), absent="no")

    def read(self, value: object, name: str | None = None) -> bool:
        """Whether it is so."""
        return value if isinstance(value, bool) else super().read(value, name) == "yes"


def given(words: str, dimension: Dimension | None = None, example: str = "", **more: Any) -> Any:
    """Declare an input, see `Input`; typed as its value, so that a class says ``radius: float`` of it."""
    return Input(words, dimension, example, **more)


class Declaring:
    """A class that declares inputs, as class attributes made by `given`."""

    inputs: ClassVar[Mapping[str, Input]] = {}
    """Its inputs by their names, inherited ones first."""

    def __init_subclass__(cls) -> None:
        inherited = {name: each for base in reversed(cls.__mro__[1:]) for name, each in getattr(base, "inputs", {}).items()}
        own = {name: each for name, each in vars(cls).items() if isinstance(each, Input)}
        for each in own.values():
            register(each)
        cls.inputs = inherited | own


_DECLARED: dict[str, Input] = {}


def register(new: Input) -> None:
    """Make an input known by its name.

    Raises
    ------
    InputError
        If the name is another quantity's already: in a table or a plan nobody could tell them apart.
    """
    known = _DECLARED.setdefault(new.name, new)
    if known.unit != new.unit or known.is_text != new.is_text:
        raise InputError(f"{new.name}: declared twice, in {known.unit!r} and in {new.unit!r}; take another name")


def declared() -> Mapping[str, Input]:
    """Every input that is known, by its name."""
    return _DECLARED


def read(inputs: Mapping[str, Input], given: Mapping[str, object]) -> dict[str, Any]:
    """Values in SI of inputs, their defaults where nothing is given; names of other things are passed over.

    Raises
    ------
    InputError
        If an input is missing, or not what its declaration says.
    """
    raw = {name: each.default if given.get(name) is None else given[name] for name, each in inputs.items()}
    for name, value in raw.items():
        if value is REQUIRED:
            raise InputError(f"{name}: missing; expected {inputs[name].expected}")
    return {name: None if value is None else inputs[name].read(value) for name, value in raw.items()}


def exactly_one(choices: Mapping[str, object], inputs: Mapping[str, Input]) -> None:
    """Refuse two inputs that say one thing in two ways if not exactly one is given."""
    chosen = [name for name, value in choices.items() if value is not None]
    if len(chosen) != 1:
        verb = "are both given" if chosen else "are both missing"
        expected = " or ".join(inputs[name].expected for name in choices)
        raise InputError(f"{', '.join(choices)}: {verb}; give exactly one, {expected}")


# --- numbers, and texts with units -------------------------------------------------------------------------------------


def read_quantity(name: str, value: object, unit: str, expected: str) -> float:
    """One quantity in a unit.

    Parameters
    ----------
    name : str
        What messages call it.
    value : str, float or pint.Quantity
        Text with a unit (`softlube.model.units` says which are read), a number already in the unit, or a pint quantity.
    unit : str
        The unit; empty for a plain number.
    expected : str
        What should have been given, for messages.

    Raises
    ------
    InputError
        If the value is no quantity of the unit's dimension.
    """
    if isinstance(value, str):
        from softlube.model import units

        try:
            return units.read_quantity(value, unit) if unit else units.read_number(value)
        except InputError as error:
            raise InputError(f"{name}: {error}; expected {expected}") from None
    if unit and hasattr(value, "to") and hasattr(value, "magnitude"):
        try:
            value = value.to(unit).magnitude
        except Exception as error:
            if type(error).__name__ == "DimensionalityError":
                raise InputError(f"{name}: {value!s} has the wrong dimension; expected {expected}") from None
            raise InputError(f"{name}: cannot read {shown(value)}; expected {expected}") from None
    kind = getattr(getattr(value, "dtype", None), "kind", "f")  # an array's or a scalar's of NumPy
    if not isinstance(value, SupportsFloat) or isinstance(value, bool) or kind not in "iuf" or getattr(value, "ndim", 0):
        raise InputError(f"{name}: cannot read {shown(value)}; expected {expected}")
    try:
        return float(value)
    except OverflowError:
        raise InputError(f"{name}: the number is too large; expected {expected}") from None
