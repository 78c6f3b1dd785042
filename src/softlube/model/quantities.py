"""A number with its error."""

from __future__ import annotations


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

    def __repr__(self) -> str:
        return f"{float(self):.6g} ± {self.error:.1g}" + (f" {self.unit}" if self.unit else "")

    __str__ = __repr__
