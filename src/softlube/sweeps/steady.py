"""Steady sliding as a room of the sweep."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar

from softlube.errors import InputError, ValidityWarning, shown
from softlube.model.problem import Problem
from softlube.model.quantities import Quantity, header
from softlube.physical.contact import Contact
from softlube.physical.inputs import SLIDING_BODIES, Loading, names_of
from softlube.physical.roughness import lubrication
from softlube.sweeps.axes import DIMENSIONLESS
from softlube.sweeps.tasks import Outcome, Value

DIGITS = 12
"""Digits of β that count: cases that differ by rounding only are solved once."""


@dataclass(frozen=True)
class SteadyTask:
    """A dimensionless problem.

    Attributes
    ----------
    problem : Problem
    """

    kind: ClassVar[str] = "steady"
    problem: Problem

    @property
    def place(self) -> tuple[float, ...]:
        """Neighbouring β share grids, so a worker that walks along β builds few elastic operators."""
        return (self.problem.parameter,)

    def to_plain(self) -> dict[str, Any]:
        """The problem's own."""
        return self.problem.to_plain()

    def solve(self, accuracy: float, with_fields: bool) -> Outcome:
        """See `softlube.solve`."""
        from softlube.files.netcdf import contents
        from softlube.steady.solve import solve_problem

        solution = solve_problem(self.problem, accuracy=accuracy)
        return Outcome(
            quantities={name: (float(quantity), quantity.error) for name, quantity in solution.quantities.items()},
            facts={"beta": solution.beta, "beta_load": solution.beta_load, "warnings": "; ".join(solution.warnings)},
            fields=contents(solution) if with_fields else None,
        )


@dataclass(frozen=True)
class SteadyCase:
    """One contact that slides steadily.

    Attributes
    ----------
    inputs : mapping of str to float or str
        Arguments of `Contact` in SI, or of `Problem`.
    problem : Problem
        The dimensionless problem, its β rounded to `DIGITS` digits.
    """

    inputs: Mapping[str, Value]
    problem: Problem

    @classmethod
    def of(cls, inputs: Mapping[str, Value]) -> SteadyCase:
        """Check the inputs.

        Raises
        ------
        InputError
            If they describe no contact.
        """
        if any(name in inputs for name in DIMENSIONLESS):
            physical = [name for name in inputs if name not in (*DIMENSIONLESS, "cavitation")]
            if physical:
                first = next(name for name in DIMENSIONLESS if name in inputs)
                raise InputError(f"{first}, {physical[0]}: give a dimensionless or a physical contact, not both")
            problem = Problem(**inputs)  # type: ignore[arg-type]
        else:
            problem = Contact(**inputs).problem()  # type: ignore[arg-type]
        beta = float(f"{problem.parameter:.{DIGITS}g}")
        rounded = replace(problem, beta_load=beta) if problem.load_controlled else replace(problem, beta=beta)
        return cls(dict(inputs), rounded)

    @property
    def contact(self) -> Contact | None:
        """The physical contact, None for a dimensionless case."""
        return None if any(name in self.inputs for name in DIMENSIONLESS) else Contact(**self.inputs)  # type: ignore[arg-type]

    @property
    def task(self) -> SteadyTask:
        """The problem."""
        return SteadyTask(self.problem)

    def numbers(self, outcome: Outcome) -> dict[str, Value]:
        """Warnings, β of Eqs. (6d) and (30), every quantity with its error: in SI, or dimensionless as in the paper."""
        if outcome.failed:
            return {"beta_load" if self.problem.load_controlled else "beta": self.problem.parameter}
        quantities = {name: Quantity(value, error) for name, (value, error) in outcome.quantities.items()}
        dimensional = self.contact.dimensional(quantities) if self.contact is not None else {}
        doubts = [str(outcome.facts["warnings"]), *(self.contact.doubts(dimensional) if self.contact is not None else ())]
        row = {"warnings": "; ".join(filter(None, doubts))} | {name: outcome.facts[name] for name in DIMENSIONLESS}
        for name, quantity in (quantities | dimensional).items():
            row[header(name, quantity.unit)] = float(quantity)
            row[header(name, quantity.unit, error=True)] = quantity.error
        if "lambda_ratio" in dimensional:
            row["lubrication"] = lubrication(dimensional["lambda_ratio"])
        return row

    def write(self, fields: bytes, path: Path) -> None:
        """Write a file that `softlube.load` reads, with its fields in SI if the case is physical."""
        from softlube.files.netcdf import load

        solution = load(fields)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ValidityWarning)  # the table has the doubts
            (solution if self.contact is None else self.contact.interpret(solution)).save(path)


class Steady:
    """Contacts that slide steadily."""

    what: ClassVar[str] = "a contact"
    needs: ClassVar[str] = "radius, viscosity, …, or beta"

    @property
    def parameters(self) -> tuple[str, ...]:
        """Inputs of `Contact`, β and β by the load."""
        return (*names_of(SLIDING_BODIES, Loading), *DIMENSIONLESS)

    def __init__(self, folder: Path) -> None:
        self.sources: tuple[Path, ...] = ()

    def accuracy(self, given: float | None, names: Iterable[str]) -> float:
        """See `softlube.solve`."""
        accuracy = 1e-3 if given is None else given
        if isinstance(accuracy, bool) or not isinstance(accuracy, (int, float)) or not 0 < accuracy <= 0.1:
            raise InputError(f"accuracy: expected a number up to 0.1 such as 1e-3, got {shown(accuracy)}")
        return float(accuracy)

    def prepare(self, inputs: Mapping[str, Value]) -> None:
        """There is nothing to look at beforehand."""

    def case(self, inputs: Mapping[str, Value]) -> SteadyCase:
        """See `SteadyCase.of`."""
        return SteadyCase.of(inputs)
