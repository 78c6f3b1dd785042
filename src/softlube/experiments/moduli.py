"""Tests of viscoelastic solids: moduli against frequency, relaxation modulus or creep compliance against time."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError, printable
from softlube.experiments.columns import checked_columns, summary_of
from softlube.files.tables import header_names, read_table
from softlube.model.inputs import INVERSE_PRESSURE, PRESSURE, TIME, Dimension, Input
from softlube.model.summary import Summarised, Summary

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.floating]


class FrequencyInput(Input):
    """A frequency, kept as angular frequency [rad/s]: its unit says whether cycles or radians are counted."""

    units: ClassVar[Mapping[str, float]] = {
        "Hz": 2 * math.pi,
        "mHz": 2e-3 * math.pi,
        "kHz": 2e3 * math.pi,
        "MHz": 2e6 * math.pi,
        "rad/s": 1.0,
    }
    """Units that are taken, in rad/s."""

    def factor(self, unit: str) -> float:
        """What a number in a unit is multiplied by to be in rad/s.

        Raises
        ------
        InputError
            If the unit is not one that says what is counted.
        """
        if unit not in self.units:
            raise InputError(f"{', '.join(self.units)} say whether cycles or radians are counted")
        return self.units[unit]


class AngularFrequencyInput(FrequencyInput):
    """An angular frequency [rad/s], which is in no other unit."""

    units: ClassVar[Mapping[str, float]] = {"rad/s": 1.0}


_FREQUENCY = Dimension("rad/s", "a frequency")
COLUMNS = {
    "frequency": FrequencyInput("Frequency", _FREQUENCY, "1 Hz"),
    "time": Input("Time since the step of strain or stress", TIME, "1 s"),
    "storage_modulus": Input("Storage modulus", PRESSURE, "2 MPa"),
    "loss_modulus": Input("Loss modulus", PRESSURE, "0.2 MPa"),
    "relaxation_modulus": Input("Relaxation modulus", PRESSURE, "2 MPa"),
    "creep_compliance": Input("Creep compliance", INVERSE_PRESSURE, "0.5 1/MPa"),
}
"""Columns of a test."""
ANGULAR = ("angular_frequency", "omega", "ω")
"""Headers of an angular frequency."""
_PRIMES = (("'", "''"), ("′", "″"), ("′", "′′"), ("'", '"'))
"""Ways to write the primes of a storage and of a loss modulus."""


@dataclass(frozen=True)
class Procedure:
    """A test of a linear viscoelastic solid.

    Attributes
    ----------
    name : {"oscillation", "relaxation", "creep"}
    against : {"frequency", "time"}
        What is set.
    measured : tuple of str
        Columns of `COLUMNS` that answer.
    shear : bool
        Whether they are of the shear modulus G, or of Young's modulus E.
    spellings : tuple of tuple of str
        Headers of the measured columns, without their units and in lower case.
    """

    name: str
    against: str
    measured: tuple[str, ...]
    shear: bool
    spellings: tuple[tuple[str, ...], ...]

    @property
    def rates(self) -> bool:
        """Whether it is a frequency that is set."""
        return self.against == "frequency"

    def kernels(self, where: Array, times: Array) -> tuple[Array, Array]:
        """What a unit of the constant part and a unit of each time give, one measured column below the other.

        With x = ωτ: storage 1 and x²/(1 + x²), loss 0 and x/(1 + x²).  Relaxation 1 and e^(−t/τ), creep 1 and 1 − e^(−t/τ).

        Parameters
        ----------
        where : ndarray, shape (rows,)
            Angular frequencies or times.
        times : ndarray, shape (times,)
            Relaxation times; retardation times of a creep test.

        Returns
        -------
        ndarray, shape (columns·rows, 1 + times), and ndarray, shape (columns·rows, times)
            The matrix, and the derivatives of its last columns by ln τ.
        """
        if self.rates:
            x = np.multiply.outer(where, times)
            below = 1 + x**2
            of_times = np.vstack((x**2 / below, x / below))
            slopes = np.vstack((2 * x**2 / below**2, x * (1 - x**2) / below**2))
        else:
            x = np.divide.outer(where, times)
            decay = np.exp(-x)
            of_times, slopes = (decay, x * decay) if self.name == "relaxation" else (-np.expm1(-x), -x * decay)
        constant = np.zeros((of_times.shape[0], 1))
        constant[: where.size] = 1.0
        return np.hstack((constant, of_times)), slopes


def _procedures() -> tuple[Procedure, ...]:
    found = []
    for shear, symbol, compliance, word in ((False, "e", "d", "tensile"), (True, "g", "j", "shear")):
        pairs = [(symbol + one, symbol + two) for one, two in _PRIMES]
        pairs.append((f"{word}_storage_modulus", f"{word}_loss_modulus"))
        found.append(Procedure("oscillation", "frequency", ("storage_modulus", "loss_modulus"), shear, tuple(pairs)))
        for name, column, letter in (
            ("relaxation", "relaxation_modulus", symbol),
            ("creep", "creep_compliance", compliance),
        ):
            found.append(Procedure(name, "time", (column,), shear, ((letter,), (f"{word}_{column}",))))
    return tuple(found)


PROCEDURES = _procedures()
"""The tests that are read."""


@dataclass(frozen=True, repr=False)
class Moduli(Summarised):
    """A test of a viscoelastic solid, in SI.

    Attributes
    ----------
    procedure : Procedure
    where : ndarray, shape (rows,)
        Angular frequencies [rad/s] or times [s], positive.
    values : mapping of str to ndarray, shape (rows,)
        The measured columns, [Pa] or [1/Pa], positive.
    lines : ndarray of int, shape (rows,)
        Where each row stands in the file.
    source : str
        Name of the file.
    notices : tuple of str
        What was left out of the file, with the lines.
    """

    procedure: Procedure
    where: Array
    values: Mapping[str, Array]
    lines: NDArray[np.integer]
    source: str = "data"
    notices: tuple[str, ...] = ()

    def __len__(self) -> int:
        return self.where.size

    @property
    def stacked(self) -> Array:
        """The measured columns one below the other, shape (columns·rows,)."""
        return np.concatenate([self.values[name] for name in self.procedure.measured])

    @property
    def unit(self) -> str:
        """Unit of `where`."""
        return "rad/s" if self.procedure.rates else "s"

    @classmethod
    def from_arrays(
        cls,
        *,
        frequency: object = None,
        storage_modulus: object = None,
        loss_modulus: object = None,
        time: object = None,
        relaxation_modulus: object = None,
        creep_compliance: object = None,
        shear: bool = False,
    ) -> Moduli:
        """A test from arrays in SI.

        Parameters
        ----------
        frequency : array_like
            Angular frequencies [rad/s], with `storage_modulus` and `loss_modulus`.
        time : array_like
            Times [s], with `relaxation_modulus` or `creep_compliance`.
        storage_modulus, loss_modulus, relaxation_modulus : array_like
            Moduli [Pa].
        creep_compliance : array_like
            Strain over stress [1/Pa].
        shear : bool
            Whether they are of the shear modulus; otherwise of Young's.

        Raises
        ------
        InputError
            If they are not the columns of one test, differ in length or a number is not positive and finite.
        """
        given = {
            "frequency": frequency,
            "time": time,
            "storage_modulus": storage_modulus,
            "loss_modulus": loss_modulus,
            "relaxation_modulus": relaxation_modulus,
            "creep_compliance": creep_compliance,
        }
        given = {name: column for name, column in given.items() if column is not None}
        for test in PROCEDURES:
            if test.shear == shear and given.keys() == {test.against, *test.measured}:
                where, *columns = checked_columns({name: given[name] for name in (test.against, *test.measured)})
                return cls(test, where, dict(zip(test.measured, columns, strict=True)), np.arange(1, where.size + 1))
        raise InputError(
            f"{', '.join(given) or 'moduli'}: expected frequency, storage_modulus and loss_modulus, or time and one of "
            "relaxation_modulus and creep_compliance"
        )

    @property
    def headline(self) -> str:
        """What was tested, how many rows there are, and over which frequencies or times."""
        ends = " to ".join(f"{each:.4g}" for each in (self.where.min(), self.where.max()))
        return f"Moduli: {self.procedure.name}, {len(self)} rows of {printable(self.source)}, {ends} {self.unit}"

    def _columns(self) -> tuple[tuple[str, Array, str], ...]:
        own = ((name, self.values[name], COLUMNS[name].unit) for name in self.procedure.measured)
        return ((self.procedure.against, self.where, self.unit), *own)

    def summary(self) -> Summary:
        """Least, median and greatest value of every column, and what was left out of the file."""
        return summary_of(self.headline, self._columns(), self.notices)

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each measurement, units in the headers; "line" is where it stands in the file."""
        import pandas as pd

        columns = {f"{name} [{unit}]": values for name, values, unit in self._columns()}
        return pd.DataFrame(columns | {"line": self.lines})


def read_moduli(path: str | os.PathLike[str]) -> Moduli:
    """A test of a viscoelastic solid from a CSV file.

    Columns, with units in the header: frequency with E' and E'' or with G' and G''; or time with one of E, G (relaxation
    modulus), D and J (tensile and shear creep compliance).  Others are ignored.  A row without one of them is left out and one
    that repeats another in every cell is counted once; both are told in `Moduli.notices`.

    Raises
    ------
    InputError
        See `softlube.files.tables.read_table`; also if the columns of no test or of several are there.
    """
    headers = header_names(path)
    found = [(test, each) for test in PROCEDURES for each in test.spellings if set(each) <= set(headers)]
    where = f"{Path(path).name}, line 1: "
    if len(found) > 1:
        both = " and ".join(", ".join(each) for _, each in found[:2])
        raise InputError(f"{where}{both} are there; keep the columns of one test")
    if headers and not found:
        advice = "; say by the name whether a modulus is E or G" if any("modulus" in name for name in headers) else ""
        raise InputError(
            f"{where}no test: expected frequency with E' and E'' or G' and G'', or time with E or G (relaxation) or with D or "
            f"J (creep compliance){advice}; the header has {', '.join(map(repr, headers))}"
        )
    ((test, spelling),) = found or [(PROCEDURES[0], PROCEDURES[0].spellings[0])]  # an empty file, which is refused below
    rename, columns = dict(zip(spelling, test.measured, strict=True)), COLUMNS
    angular = next((name for name in ANGULAR if name in headers), None)
    if test.rates and angular is not None:
        rename |= {angular: "frequency"}
        columns = COLUMNS | {"frequency": AngularFrequencyInput("Angular frequency", _FREQUENCY, "1 rad/s")}
    names = [test.against, *test.measured]
    table = read_table(path, names, columns=columns, rename=rename, drop_repeats=True, drop_missing=True)
    values = {name: table.columns[name] for name in test.measured}
    return Moduli(test, table.columns[test.against], values, table.lines, table.source, table.notices)
