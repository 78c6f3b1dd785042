"""A solution: fields, quantities with their errors, and how they were obtained."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from softlube.discretization.fields import Fields
from softlube.errors import InputError
from softlube.model.problem import Problem
from softlube.model.quantities import Quantity
from softlube.model.summary import QUANTITY_COLUMNS, Summarised, Summary, in_words, quantities_frame, steady_rows, with_units
from softlube.steady.level import Level

if TYPE_CHECKING:
    import os

    import pandas
    import xarray
    from matplotlib.figure import Figure


class PhysicalContact(Protocol):
    """What a solution and its readers know of a contact in SI; see `softlube.Contact`."""

    @property
    def unit_height(self) -> float:
        """Unit of height [m]."""
        ...

    @property
    def unit_length(self) -> float:
        """Unit of length [m]."""
        ...

    @property
    def radius(self) -> float:
        """Radius of the sphere [m]."""
        ...

    @property
    def viscosity(self) -> float:
        """Viscosity at zero pressure [Pa s]."""
        ...

    @property
    def speed_sum(self) -> float:
        """Sum of the surface speeds [m/s], v in Reynolds' equation."""
        ...

    @property
    def slide_to_roll(self) -> float:
        """Difference of the surface speeds over their mean; 2 for a ball that does not turn."""
        ...

    def inputs(self) -> dict[str, Any]:
        """All inputs in plain values, for files."""
        ...

    def scales(self, height: float, /) -> Mapping[str, tuple[float, str]]:
        """Value and name of the SI unit of each dimension."""
        ...


class Answer(Summarised):
    """What every solution has: quantities as attributes, warnings in what it says of itself, a picture.

    Attributes
    ----------
    quantities, dimensional : mapping of str to Quantity
        Normalised, and in SI if the input was physical.
    warnings : tuple of str
        Doubts about the physics of the input.
    """

    if TYPE_CHECKING:  # a dataclass would take properties for defaults

        @property
        def quantities(self) -> Mapping[str, Quantity]: ...
        @property
        def dimensional(self) -> Mapping[str, Quantity]: ...
        @property
        def warnings(self) -> tuple[str, ...]: ...

    def __getattr__(self, name: str) -> Quantity:
        if not name.startswith("_") and name in self.__dict__.get("quantities", {}):
            return self.quantities[name]
        raise AttributeError(f"{type(self).__name__!r} has no attribute {name!r}")

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.quantities})

    def __repr__(self) -> str:
        return super().__repr__() + "".join(f"\n  Warning: {doubt}." for doubt in self.warnings)

    def plain_quantities(self) -> dict[str, Any]:
        """Quantities and warnings ready for JSON."""

        def plain(quantities: Mapping[str, Quantity], unit: bool) -> dict[str, dict[str, Any]]:
            return {name: q.plain() | ({"unit": q.unit} if unit else {}) for name, q in quantities.items()}

        result: dict[str, Any] = {"quantities": plain(self.quantities, unit=False)}
        if self.dimensional:
            result["dimensional"] = plain(self.dimensional, unit=True)
        return result | {"warnings": list(self.warnings)}

    def plot(self, path: str | os.PathLike[str] | None = None) -> Figure:
        """Film and pressure: profiles and, under a sphere, maps; written to `path` if given (PNG, PDF, SVG by its ending)."""
        from softlube.plots.solution import plot

        return plot(self, path)  # type: ignore[arg-type]


@dataclass(frozen=True, repr=False)
class Solution(Answer):
    """What `softlube.solve` returns.

    Quantities are attributes: ``solution.film_min`` is a float with an ``.error``; ``solution.quantities`` has them all, and
    ``solution.dimensional`` the same in SI units if the input was physical.

    Attributes
    ----------
    problem : Problem
        What was solved.
    fields : Fields
        Pressure and film as functions of position, normalised like the quantities; `dataset` has them as an xarray Dataset.
    quantities : mapping of str to Quantity
        See `softlube.model.quantities.STEADY`.  Normalised with what is prescribed:
        with |h₀| as in the paper where that is, with the Hertz indentation δ of the load, Eq. (29), where the load is.
    beta, beta_load : float
        β of Eq. (6d) and β of Eq. (30).
    accuracy : float
        Relative accuracy asked for; nan for the paper's methods, which have one mesh.
    levels : tuple of Level
        The grids solved, coarse to fine.
    method : str
        The solver: "newton", or the paper's "relaxation" or "cartesian".
    contact : PhysicalContact or None
        The physical input.
    dimensional : mapping of str to Quantity
        SI values; empty for a dimensionless problem.
    warnings : tuple of str
        Doubts about the physics of the input.
    renormalise : callable
        Gives `other_quantities`; called when they are first asked for, because they take a fifth of the time of the solution.
    """

    problem: Problem
    fields: Fields
    quantities: Mapping[str, Quantity]
    beta: float
    beta_load: float
    accuracy: float
    levels: tuple[Level, ...]
    method: str = "newton"
    contact: PhysicalContact | None = None
    dimensional: Mapping[str, Quantity] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    renormalise: Callable[[], Mapping[str, Quantity]] = field(default=dict, repr=False, compare=False)

    @cached_property
    def other_quantities(self) -> Mapping[str, Quantity]:
        """Quantities normalised the other way; empty for h₀ ≥ 0, where |h₀| is no scale.  See `normalised`."""
        return self.renormalise()

    def normalised(self, by: str) -> Mapping[str, Quantity]:
        """Quantities normalised with the indentation |h₀| or with the Hertz indentation of the load.

        Parameters
        ----------
        by : {"indentation", "load"}
            Which of the two.

        Raises
        ------
        InputError
            If `by` is neither, or for "indentation" where h₀ ≥ 0.
        """
        if by not in ("indentation", "load"):
            raise InputError(f"by: expected 'indentation' or 'load', got {by!r}")
        own = "load" if self.problem.load_controlled else "indentation"
        quantities = self.quantities if by == own else self.other_quantities
        if not quantities:
            raise InputError(
                f"by: this solution has no normalisation by {by}: the sphere does not dip into the substrate (h0 >= 0)"
            )
        return quantities

    @property
    def headline(self) -> str:
        """β and the quantities that are asked for most, in SI if the input was physical."""
        names = ("film_center", "film_min", "friction_coefficient" if self.dimensional else "friction_total")
        values = self.dimensional or self.quantities
        return f"Solution: beta {self.beta:.6g}, " + ", ".join(in_words(name, values[name]) for name in names)

    def summary(self) -> Summary:
        """Every quantity with its error, as ``softlube solve`` prints them, and the warnings."""
        rows = steady_rows(self.problem, self.quantities, self.dimensional)
        return Summary(self.headline, QUANTITY_COLUMNS, tuple(rows), tuple(f"Warning: {doubt}" for doubt in self.warnings))

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each quantity, by its name: value, error, unit and words; in SI if the input was physical."""
        return quantities_frame(with_units(self.quantities, self.dimensional))

    def friction_within(self, cutoff: float) -> float:
        """Normalised friction force over r ≤ cutoff (normalised too), Eq. (27a)."""
        from softlube.discretization.measure import friction_within

        return friction_within(self.fields, cutoff) + self.friction_missed(cutoff)

    def friction_missed(self, cutoff: float) -> float:
        """What `fields` miss of that: the liquid in a pressure spike too steep for their mesh, 0 in most contacts.

        All of it where the disc holds the spike's place on the outlet axis, nothing else; nan where no mesh resolves the spike.
        """
        place = self.quantities.get("spike_radius", Quantity(0.0))
        missed = float(self.quantities["friction_domain"]) - self.levels[-1].values["friction_domain"]
        return missed if cutoff > place else 0.0

    @property
    def dataset(self) -> xarray.Dataset:
        """Fields, quantities, inputs and version as one xarray Dataset."""
        from softlube.files.netcdf import to_dataset

        return to_dataset(self)

    def to_dict(self) -> dict[str, Any]:
        """Numbers only, ready for JSON."""
        return {
            "beta": self.beta,
            "beta_load": self.beta_load,
            "cavitation": self.problem.cavitation,
            "accuracy": self.accuracy if np.isfinite(self.accuracy) else None,
            "method": self.method,
        } | self.plain_quantities()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write everything to a NetCDF file, whole or not at all; `softlube.load` reads it back."""
        from softlube.files.netcdf import save

        save(self, path)
