"""The solution of a line contact: profiles, and quantities with their errors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.discretization.line.measure import LineFields
from softlube.model.problem import Problem
from softlube.model.quantities import LINE, LINE_DERIVED, Quantity
from softlube.model.summary import QUANTITY_COLUMNS, Row, Summary, engineering, in_words, rounded, row
from softlube.steady.solution import Answer, PhysicalContact

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.floating]

ROWS = LINE | LINE_DERIVED
"""What every quantity means, by its name."""
UNITS = "L is half the width of the dry contact of a half-space, and H = L²/R"
"""What the units of a dimensionless contact are made of."""
BEHIND = 0.5
"""How far behind the free boundary profiles go, over the distance from there to the end of the profile ahead."""


@dataclass(frozen=True, repr=False)
class LineSolution(Answer):
    """A solved line contact: what `softlube.line.solve` returns.

    Quantities are attributes: ``solution.film_min`` is a float with an ``.error``; ``solution.quantities`` has them all, and
    ``solution.dimensional`` the same in SI units if the input was physical.

    Attributes
    ----------
    problem : Problem
        What was solved.
    fields : LineFields
        Film and pressure as functions of x, normalised like the quantities.
    quantities : mapping of str to Quantity
        See `softlube.model.quantities.LINE`.  The unit of height is b²/R, with b half the width of the dry contact of a
        half-space under the load.
    accuracy : float
        Relative accuracy asked for.
    contact : PhysicalContact or None
        The physical input.
    dimensional : mapping of str to Quantity
        SI values; empty for a dimensionless problem.
    warnings : tuple of str
        Doubts about the physics of the input.
    """

    problem: Problem
    fields: LineFields
    quantities: Mapping[str, Quantity]
    accuracy: float
    contact: PhysicalContact | None = None
    dimensional: Mapping[str, Quantity] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()

    @property
    def beta_load(self) -> float:
        """β of Eq. (6d) formed with b²/R, as Eq. (30) is with the Hertz indentation a²/R of a sphere."""
        return self.problem.parameter

    @property
    def headline(self) -> str:
        """β and the quantities that are asked for most, in SI if the input was physical."""
        names = ("film_center", "film_min", "friction_coefficient" if self.dimensional else "friction_total")
        values = self.dimensional or self.quantities
        return f"LineSolution: beta_load {self.beta_load:.6g}, " + ", ".join(in_words(name, values[name]) for name in names)

    def summary(self) -> Summary:
        """Every quantity with its error, as ``softlube line`` prints them, and the warnings."""
        notes = tuple(f"Warning: {each}" for each in self.warnings)
        return Summary(self.headline, QUANTITY_COLUMNS, tuple(self._rows()), notes if self.dimensional else (UNITS, *notes))

    def _rows(self) -> list[Row]:
        rows = []
        values = self.dimensional or self.quantities
        for name, definition in ROWS.items():
            if name not in values:
                continue
            quantity = values[name]
            words = f"  {definition.place}" if definition.place else definition.words
            if self.dimensional:
                rows.append(row(words, *engineering(quantity)))
            else:
                rows.append(
                    row(
                        words,
                        *rounded(float(quantity), quantity.error),
                        definition.unit.formula.format("H").partition(" = ")[0],
                    )
                )
        return rows

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each quantity, by its name: value, error, unit and words; in SI if the input was physical."""
        import pandas as pd

        values = self.dimensional or self.quantities
        lines = [(float(q), q.error, q.unit, ROWS[name].words) for name, q in values.items()]
        return pd.DataFrame(lines, index=pd.Index(list(values), name="quantity"), columns=["value", "error", "unit", "words"])

    def to_dict(self) -> dict[str, Any]:
        """Numbers only, ready for JSON."""
        head = {"beta_load": self.beta_load, "cavitation": self.problem.cavitation, "accuracy": self.accuracy}
        return head | self.plain_quantities()

    def profile(self, x: ArrayLike | None = None) -> pandas.DataFrame:
        """Film and pressure along x; behind a free boundary the gap, and no pressure.

        Parameters
        ----------
        x : array_like, optional
            Places on the mesh, in m if the input was physical, else over b; those of the nodes, and some behind the free
            boundary, if not given.

        Returns
        -------
        pandas.DataFrame
            Columns "x", "film" and "pressure", in SI with their units in brackets if the input was physical.
        """
        import pandas as pd

        length, height, pressure = 1.0, 1.0, 1.0
        names = ["x", "film", "pressure"]
        if self.contact is not None:
            scales = self.contact.scales(self.contact.unit_height)
            length, height, pressure = (scales[name][0] for name in ("length", "height", "pressure"))
            names = ["x [m]", "film [m]", "pressure [Pa]"]
        if x is not None:
            places = np.asarray(x, dtype=float) / length
            film, bears = self.fields.film_at(places), self.fields.pressure_at(places)
        else:
            places, film, bears = self.fields.x, self.fields.film, self.fields.pressure
            if self.problem.cavitation == "reynolds":
                reach = BEHIND * (1 - self.fields.front)
                behind, gap = self.fields.opening(reach * np.geomspace(1e-3, 1, 6))
                places = np.concatenate([behind, places])
                film, bears = np.concatenate([gap, film]), np.concatenate([np.zeros_like(gap), bears])
        return pd.DataFrame(dict(zip(names, (places * length, film * height, bears * pressure), strict=True)))
