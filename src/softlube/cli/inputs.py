"""The options that several commands share: the inputs of an experiment, and which contact to read."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, update_wrapper
from inspect import Parameter as Argument
from inspect import Signature, signature
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group, Parameter

from softlube.cli.numbers import CHOICE
from softlube.model.inputs import Input
from softlube.physical.inputs import names_of

if TYPE_CHECKING:
    from softlube.solvers.progress import Listener
    from softlube.steady.solution import Solution

PHYSICAL = Group("Physical contact (text with units, such as '2 mm')", sort_key=1)
GIVEN = Group("Solved or dimensionless contact", sort_key=0)


def takes(*options: tuple[Any, ...]) -> Callable[[Callable[..., int]], Command]:
    """Make a function a command whose keyword arguments ``**physical`` are the inputs of an experiment.

    Parameters
    ----------
    *options : tuple
        A group of the help, slots whose parts' inputs stand in it, and classes that declare others.
    """

    def make(function: Callable[..., int]) -> Command:
        return Command(function, options)

    return make


class Command:
    """A command that takes inputs of an experiment as options: those that are declared at the time of the call.

    Options with a name of their own in the function's signature stand as they are there.
    """

    def __init__(self, function: Callable[..., int], options: Sequence[tuple[Any, ...]]) -> None:
        update_wrapper(self, function)
        self._function, self._options = function, options

    def __call__(self, *positional: Any, **named: Any) -> int:
        return self._function(*positional, **named)

    @property
    def __signature__(self) -> Signature:
        own = [each for each in signature(self._function).parameters.values() if each.kind is not Argument.VAR_KEYWORD]
        declared = {
            each.name: _option(group, each)
            for group, slots, *groups in self._options
            for each in names_of(slots, *groups).values()
        }
        return Signature([*own, *(option for name, option in declared.items() if name not in {each.name for each in own})])


@cache
def _option(group: Group, declared: Input) -> Argument:
    # Kept: cyclopts asks for a command's signature a dozen times.  A new kind of part brings new inputs, so nothing is stale.
    # A negative number is a value, to be refused with the reason, and not an option.
    about = Parameter(group=group, help=declared.help, allow_leading_hyphen=True)
    kind: Any = str
    if declared.choices:  # the help lists them already; a shell completes them
        kind = Literal[declared.choices]  # type: ignore[invalid-literal]
        about = Parameter.combine(CHOICE, about, Parameter(show_choices=False))
    return Argument(declared.name, Argument.KEYWORD_ONLY, default=None, annotation=Annotated[kind | None, about])


def one_contact(
    physical: dict[str, str],
    *,
    solution: str | None = None,
    beta: float | None = None,
    cavitation: str | None = None,
    progress: Listener | None = None,
) -> Solution:
    """A contact that is read from a file, or solved from β or from a physical input.

    Raises
    ------
    InputError
        If not exactly one way of naming a contact is used.
    """
    from softlube.errors import InputError

    ways = [name for name, value in (("solution", solution), ("beta", beta)) if value is not None] + list(physical)[:1]
    if not ways:
        raise InputError("solution: missing; give --solution, --beta, or a physical contact (--radius, …); see --help")
    if len(ways) > 1:
        raise InputError(f"{', '.join(ways)}: give one contact, not several")
    if solution is not None:
        if cavitation is not None:
            raise InputError("cavitation: the solution has its own; leave it out")
        from softlube.files.netcdf import load

        try:
            return load(solution)
        except InputError as error:
            raise InputError(str(error).replace("path:", "solution:", 1)) from None
    cavitation = cavitation or "reynolds"
    if physical:
        from softlube.physical.contact import Contact

        return Contact(**physical, cavitation=cavitation).solve(progress=progress)
    from softlube.steady.solve import solve

    return solve(beta, cavitation=cavitation, progress=progress)
