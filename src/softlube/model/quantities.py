"""Quantities: what each of them means, and a number with its error.

A new quantity takes one row of `STEADY` here and one line in `softlube.discretization.measure.measure`.  Printed tables, JSON,
NetCDF files, headers of CSV files, SI values, axis labels, error estimates, docs/reference/quantities.md follow from the row.
The shipped master curve has the quantity after `benchmarks/master_curve.py` has made its table anew.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import takewhile
from math import isfinite

BOUNDARY_LAYER_LEVEL = 0.05
"""p/p_max at the end of the inlet boundary layer, Eq. (21)."""


class Quantity(float):
    """A float that knows its error.

    Attributes
    ----------
    error : float
        Estimate of |value − exact|, same unit; nan where nothing is known.
    unit : str
        SI unit, empty for a dimensionless number.
    """

    error: float
    unit: str

    def __new__(cls, value: float, error: float = float("nan"), unit: str = "") -> Quantity:
        self = super().__new__(cls, value)
        self.error = float(error)
        self.unit = unit
        return self

    def __reduce__(self) -> tuple[type[Quantity], tuple[float, float, str]]:
        return type(self), (float(self), self.error, self.unit)

    @property
    def value(self) -> float:
        """The plain number."""
        return float(self)

    def scaled(self, factor: float, unit: str = "") -> Quantity:
        """Value and error times a positive factor, in another unit."""
        return Quantity(factor * float(self), factor * self.error, unit)

    def plain(self) -> dict[str, float | None]:
        """Value and error for JSON, which has no nan: None where a number is not known."""
        return {name: each if isfinite(each) else None for name, each in (("value", float(self)), ("error", self.error))}

    def __repr__(self) -> str:
        return f"{float(self):.6g} ± {self.error:.1g}" + (f" {self.unit}" if self.unit else "")

    __str__ = __repr__


@dataclass(frozen=True)
class Unit:
    """What the quantities of one dimension are normalised with, Eqs. (4) and (26).

    Attributes
    ----------
    formula : str
        Formula of the unit; {0} stands for the unit of height, |h₀| or the Hertz indentation δ of the load.
    si : str
        SI unit of the dimension.
    power : float
        The unit grows like this power of the unit of height, everything else being equal.
    tex : str
        The formula for axis labels; empty where no label needs it.
    """

    formula: str
    si: str
    power: float
    tex: str = ""

    def rescaled(self, quantity: Quantity, unit_of_height: float) -> Quantity:
        """A normalised quantity after a change of the unit of height.

        Parameters
        ----------
        quantity : Quantity
            Normalised with the present unit of height.
        unit_of_height : float
            The new unit of height over the present one.
        """
        return quantity.scaled(unit_of_height**-self.power)


UNITS = {
    "height": Unit("{0}", "m", 1, "{0}"),
    "length": Unit("L = √(R {0})", "m", 1 / 2, r"\sqrt{{R{0}}}"),
    "pressure": Unit("4πG L/R", "Pa", 1 / 2, r"4\pi G\sqrt{{{0}/R}}"),
    "pressure_gradient": Unit("4πG/R", "Pa/m", 0),
    "load": Unit("4πG {0} L", "N", 3 / 2),
    "friction": Unit("(2π/3)G {0}²", "N", 2),
    "shear_rate": Unit("v/{0}", "1/s", -1),
    "viscosity": Unit("η", "Pa s", 0),
    "time": Unit("3ηR/(πG {0} √({0}/R))", "s", -3 / 2),
    "volume": Unit("R {0}²", "m^3", 2),
    "line_load": Unit("4πG {0}", "N/m", 1),
    "line_friction": Unit("(2π/3)G {0}²/L", "N/m", 3 / 2),
    "angle": Unit("°", "°", 0),
    "number": Unit("", "", 0),
}
"""Units of the normalised problem by dimension; `softlube.physical.materials.Materials.scales` has their values in SI."""


@dataclass(frozen=True)
class Definition:
    """What a quantity means: one row of the tables below.

    Attributes
    ----------
    name : str
        Name in Python and in files.
    words : str
        What it is, as tables, files and labels say it.
    symbol : str
        Symbol in formulas.
    dimension : str
        Key of `UNITS`.
    equation : str
        Equation of the paper that defines or uses it; empty where the paper has none.
    compared_with : tuple of str or float
        The error is compared with the sum of these magnitudes: names of quantities, and numbers.  Empty: with the magnitude of
        the quantity itself.  Others are named where that magnitude can vanish.
    place : str
        Words of a row that is printed below another quantity and says where that is; empty for other quantities.  A place has
        an error, which does not decide when a grid is fine enough.
    offset : float
        Added to a quantity that changes sign, to give one that does not, on the master curve.
    limit : float or None
        Limit for β → ∞ of a quantity that the master curve interpolates as it is, not by its logarithm.
    exponent : float or None
        The quantity goes with this power of β for β → ∞: with `offset` added, or `limit` taken off; None where that is unknown.
    """

    name: str
    words: str
    symbol: str
    dimension: str
    equation: str = ""
    compared_with: tuple[str | float, ...] = ()
    place: str = ""
    offset: float = 0.0
    limit: float | None = None
    exponent: float | None = None

    @property
    def unit(self) -> Unit:
        """What it is normalised with."""
        return UNITS[self.dimension]

    def size(self, values: Mapping[str, float]) -> float:
        """What the error is compared with, from the values of all quantities; see `compared_with`."""
        parts = self.compared_with or (self.name,)
        return sum(abs(values[part]) if isinstance(part, str) else part for part in parts)


def _table(*rows: Definition) -> dict[str, Definition]:
    return {row.name: row for row in rows}


STEADY = _table(
    Definition("load", "normal load, whole plane", "N", "load", "27b", exponent=0),
    Definition("load_contact", "normal load over r ≤ a", "N_a", "load", "27b", exponent=0),
    Definition(
        "height",
        "height over the undeformed surface",
        "h₀",
        "height",
        "4",
        compared_with=("height", "film_center"),
        offset=1.0,  # what is left of the height of a Hertz contact, −1
        exponent=-3 / 5,
    ),
    Definition("film_center", "film at the centre", "u(0)", "height", "22a", exponent=-3 / 5),
    Definition("film_min", "minimum film", "u_min", "height", "22b", exponent=-3 / 4),
    Definition(
        "film_min_radius",
        "radius of the minimum film",
        "r_min",
        "length",
        compared_with=(1.0,),
        place="at a radius of",
        limit=1.0,
    ),
    Definition(
        "film_min_angle_deg",
        "angle of the minimum film from the inlet",
        "θ_min",
        "angle",
        compared_with=(1.0,),
        place="at an angle from the inlet of",
        limit=90.0,
        exponent=-1 / 4,
    ),
    Definition("film_inlet", "film at the inlet, r = a", "u(a)", "height", exponent=-3 / 5),
    Definition("film_outlet_min", "minimum film on the outlet axis", "u_out", "height"),
    Definition("pressure_center", "pressure at the centre", "p(0)", "pressure", "4", exponent=0),
    Definition("pressure_max", "maximum pressure", "p_max", "pressure", "4", exponent=0),
    Definition(
        "pressure_gradient_inlet",
        "largest |dp/dr| on the inlet axis",
        "max |dp/dr|",
        "pressure_gradient",
        "20",
        exponent=1 / 5,
    ),
    Definition(
        "boundary_layer",
        "inlet boundary layer, to p/p_max = 5 %",
        "ℓ",
        "length",
        "21",
        # In a Hertz contact p/p_max = 5 % at 1 − r = 0.00125.
        compared_with=("boundary_layer", BOUNDARY_LAYER_LEVEL**2 / 2),
        offset=1.0,  # the place on the axis instead of its distance from r = 1
        exponent=-2 / 5,
    ),
    Definition(
        "friction_total",
        "total friction on the ball over r ≤ 2a",
        "F",
        "friction",
        exponent=-2 / 5,
    ),
    Definition("friction_contact", "shear on the ball over r ≤ a", "F_a", "friction", "27a", exponent=-2 / 5),
    Definition("friction_domain", "shear on the ball over r ≤ 2a", "F_2a", "friction", "28", exponent=-2 / 5),
    Definition(
        "shear_rate_max",
        "maximum shear rate at the walls",
        "γ_max",
        "shear_rate",
        "25",
        exponent=3 / 4,
    ),
)
"""Quantities of every contact that slides steadily, in the order in which they are printed."""

SPIKE = _table(
    Definition("spike_pressure", "pressure spike on the outlet axis", "p_s", "pressure"),
    Definition("spike_radius", "radius of the spike", "r_s", "length"),
)
"""Quantities of the Petrusevich spike, where a liquid that thickens with the pressure has one."""

PARTS = ("friction_couette", "friction_poiseuille")
"""Parts of a line contact's friction; their sum and their difference may vanish."""

LINE = _table(
    Definition("load", "normal load per length", "N", "line_load", exponent=0),
    Definition("film_center", "film at the centre", "u(0)", "height", exponent=-3 / 5),
    Definition("film_min", "minimum film", "u_min", "height", exponent=-3 / 5),
    Definition("film_min_place", "place of the minimum film", "x_min", "length", compared_with=(1.0,), place="at x ="),
    Definition("film_carried", "flux over the mean of the surface speeds", "u*", "height", exponent=-3 / 5),
    Definition("free_boundary", "place of the free boundary", "x_f", "length", compared_with=(1.0,)),
    Definition("pressure_center", "pressure at the centre", "p(0)", "pressure", exponent=0),
    Definition("pressure_max", "maximum pressure", "p_max", "pressure", exponent=0),
    Definition("pressure_max_place", "place of the maximum pressure", "x_p", "length", compared_with=(1.0,), place="at x ="),
    Definition("pressure_gradient_inlet", "largest |dp/dx| at x > 0", "max |dp/dx|", "pressure_gradient", exponent=1 / 5),
    Definition("friction_total", "total friction per length", "F", "line_friction", compared_with=PARTS, exponent=-2 / 5),
    Definition("friction_hysteresis", "by the substrate", "F_h", "line_friction", place="by the substrate"),
    Definition("friction_viscous", "by the liquid", "F_v", "line_friction", compared_with=PARTS, place="by the liquid"),
    Definition(
        "friction_shear", "shear on the cylinder per length", "F_s", "line_friction", compared_with=PARTS, exponent=-2 / 5
    ),
    Definition(
        "friction_couette", "of it by the surface speeds", "C", "line_friction", compared_with=PARTS, place="by the sliding"
    ),
    Definition(
        "friction_poiseuille",
        "of it by the pressure gradient",
        "P",
        "line_friction",
        compared_with=PARTS,
        place="by the pressure gradient",
    ),
    Definition("shear_rate_max", "maximum shear rate at the walls", "γ_max", "shear_rate", exponent=3 / 5),
)
"""Quantities of a line contact, in the order in which they are printed; {0} stands for b²/R, L for b, half the width of the
dry contact under the load."""

LINE_DERIVED = _table(
    Definition("contact_half_width", "half the width of the dry contact", "b", "length"),
    Definition("friction_coefficient", "friction coefficient", "F/N", "number"),
    Definition("lambda_ratio", "minimum film over roughness", "λ", "number"),
)
"""Quantities that only a line contact in SI has."""

THINNING = _table(
    Definition("shear_rate_mean", "mean shear rate at the walls over r ≤ a", "γ_m", "shear_rate"),
    Definition("viscosity_mean", "mean shear stress over mean shear rate there", "η_m", "viscosity"),
)
"""Quantities of a liquid that thins with shear."""

HYSTERESIS = _table(
    Definition("friction_viscous", "viscous part of the total friction", "F_v", "friction", compared_with=("friction_total",)),
    Definition(
        "friction_hysteresis", "hysteresis part of the total friction", "F_h", "friction", compared_with=("friction_total",)
    ),
)
"""Quantities of a contact on a substrate that remembers: the parts of its total friction."""

DERIVED = _table(
    Definition("indentation", "indentation", "−h₀", "height", "29"),
    Definition("contact_radius", "radius of the dry contact", "a", "length", "4"),
    Definition("friction_coefficient", "friction coefficient over r ≤ 2a", "F/N", "number"),
    Definition("lambda_ratio", "minimum film over roughness", "λ", "number"),
)
"""Quantities that only a contact in SI has; the indentation takes the place of the height there."""

TRANSIENT = _table(
    Definition("pressure_min", "minimum pressure", "p_min", "pressure"),
    Definition("time", "time", "t", "time"),
    Definition("end_time", "time at the end", "t_end", "time"),
    Definition("dimple_time", "time since which the film is thinnest off the axis", "t_d", "time"),
    Definition("volume", "liquid within twice the contact radius of the grid", "V", "volume"),
    Definition("inflow", "liquid that has flowed in there since the start", "ΔV", "volume"),
)
"""Quantities that only films in time have; their other histories are quantities of `STEADY`."""

FIELDS = _table(
    Definition("pressure", "pressure", "p", "pressure", "6"),
    Definition("film", "film thickness", "u", "height", "6"),
    Definition("displacement", "surface displacement, the sum of both bodies'", "w", "height", "6"),
    Definition("recovery", "slope along x that a substrate owes to its memory, over √(unit of height/R)", "w'", "number"),
    Definition("r", "distance from the axis", "r", "length"),
    Definition("x", "distance from the axis towards the inlet", "x", "length"),
    Definition("y", "distance from the axis across the sliding", "y", "length"),
)
"""Functions of position in pictures and files."""

QUANTITIES = STEADY | SPIKE | HYSTERESIS | THINNING | DERIVED | TRANSIENT | FIELDS
"""Definition of every quantity by its name."""

REPORTED_ONLY = (*(name for name, row in STEADY.items() if row.place), *THINNING)
"""Quantities that have an error but do not decide when the grid is fine enough."""


def places_of(name: str) -> tuple[str, ...]:
    """Names of the rows that say where a quantity is: those that follow its row in `QUANTITIES`.

    Examples
    --------
    >>> places_of("film_min")
    ('film_min_radius', 'film_min_angle_deg')
    """
    below = list(QUANTITIES)[list(QUANTITIES).index(name) + 1 :]
    return tuple(takewhile(lambda each: bool(QUANTITIES[each].place), below))


def header(name: str, unit: str = "", *, error: bool = False) -> str:
    """Header of a column of a table, such as "film_min [m]" or "film_min_error [m]"."""
    return f"{name}{'_error' if error else ''}" + (f" [{unit}]" if unit else "")


def reference(table: Mapping[str, Definition], unit_of_height: str = "δ") -> str:
    """A table of quantities in Markdown, as in docs/reference/quantities.md."""

    def compared(row: Definition) -> str:
        parts = row.compared_with or (row.name,)
        return " + ".join(f"`{part}`" if isinstance(part, str) else f"{part:g}" for part in parts)

    lines = ["| name | what it is | symbol | unit | SI | error over | equation |", "|---|---|---|---|---|---|---|"]
    for row in table.values():
        unit, symbol = row.unit.formula.format(unit_of_height), row.symbol.replace("|", "\\|")
        words, equation = row.words.replace("|", "\\|"), f"({row.equation})" if row.equation else ""
        lines.append(f"| `{row.name}` | {words} | {symbol} | {unit} | {row.unit.si} | {compared(row)} | {equation} |")
    return "\n".join(lines) + "\n"
