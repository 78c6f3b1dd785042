"""The master curve: every quantity as a function of β, at once.

    >>> from softlube import curve
    >>> value, error = curve.film_center([1e2, 1e4])
    >>> bool(abs(value[0] / 0.0621 - 1) < 1e-3 and error[0] < 1e-3 * value[0])
    True

Each function takes `beta`, Eq. (6d), and gives the quantity normalised with the indentation, or `beta_load`, Eq. (30), and
gives it normalised with the Hertz indentation of the load; see `softlube.model.quantities.STEADY`.
Behind them is a table of solutions (made by benchmarks/master_curve.py) from 10⁻⁴ to 10⁸, interpolated by cubic splines in
ln β, and continued beyond both ends: by the laws of the Hertz limit above, by the power of β at the table's end below.  The
error is the table's, plus what the interpolation and the continuation may add.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from softlube.errors import InputError
from softlube.model.indenters import Paraboloid
from softlube.model.liquids import NewtonianLaw
from softlube.model.problem import Problem
from softlube.model.quantities import STEADY, Quantity
from softlube.model.substrates import HalfSpaceKernel
from softlube.model.summary import FunctionOfBeta
from softlube.theory import limits
from softlube.theory.scaling import asymptote

Array = NDArray[np.floating]

TABLE = "data/master_curve.csv"
SMOOTH = 3e-3
"""What leaving out every other point may change where the curve counts as smooth."""
CORRECTION = -0.4
"""Power of β with which what a law leaves out falls."""

NO_GAPS = "indentation: the master curve has no prescribed gaps; solve the problem instead"
"""Why a sphere that is held at or above the undeformed surface is refused."""


@dataclass(frozen=True, repr=False)
class Curve(FunctionOfBeta):
    """One quantity as a function of β, in one normalisation and under one cavitation condition.

    Attributes
    ----------
    name : str
    spline : CubicSpline
        Of the quantity, or of its logarithm (with the quantity's `offset`), over ln β.
    error : CubicSpline
        Of the logarithm of its error, relative where the spline is of a logarithm.
    law : callable or None
        The Hertz limit as a function of β.
    """

    name: str
    spline: CubicSpline
    error: CubicSpline
    law: Callable[[Array], Array] | None

    @classmethod
    def through(cls, name: str, beta: Array, value: Array, error: Array, law: Callable[[Array], Array] | None) -> Curve:
        """Interpolate a table; the errors grow by what leaving out every other point changes.

        By a sixteenth of that where the curve is smooth, and by all of it at a kink: near h₀ = 0 the largest gradient passes
        from one of two maxima to the other.
        """
        x = np.log(beta)
        if STEADY[name].limit is None:
            error = error / np.abs(value + STEADY[name].offset)
            value = np.log(value + STEADY[name].offset)
        coarse = CubicSpline(x[::2], value[::2])
        missed = np.abs(coarse(x) - value)
        between = np.convolve(np.where(missed < SMOOTH, missed / 16, missed), np.ones(3), mode="same")
        return cls(name, CubicSpline(x, value), CubicSpline(x, np.log(np.maximum(error, 1e-12) + between)), law)

    def _range(self) -> tuple[float, float]:
        return float(np.exp(self.spline.x[0])), float(np.exp(self.spline.x[-1]))

    def _values(self, beta: Array) -> dict[str, tuple[Array, Array]]:
        return {self.name: self(beta)}

    def __call__(self, beta: ArrayLike) -> tuple[Array, Array]:
        """Value and error at β."""
        beta = np.asarray(beta, dtype=float)
        x = np.log(beta)
        low, high = float(self.spline.x[0]), float(self.spline.x[-1])
        inside = np.clip(x, low, high)
        value, error = self.spline(inside), np.exp(self.error(inside))
        if np.any(x != inside):
            value, doubt = self._continued(value, x, inside)
            error = error + doubt
        if STEADY[self.name].limit is not None:
            return value, error
        positive = np.exp(value)
        return positive - STEADY[self.name].offset, error * positive

    def _continued(self, value: Array, x: Array, inside: Array) -> tuple[Array, Array]:
        """The spline's value beyond the table's ends, and the doubt that this adds."""
        low, high = float(self.spline.x[0]), float(self.spline.x[-1])
        below, above = np.minimum(x - inside, 0.0), np.maximum(x - inside, 0.0)
        fading = np.exp(CORRECTION * above)
        limit, exponent = STEADY[self.name].limit, STEADY[self.name].exponent
        if limit is not None:
            faded = limit + (value - limit) * np.exp((CORRECTION if exponent is None else exponent) * above)
            return np.where(above > 0, faded, value), 0.2 * np.abs(faded - value)
        # Below: the power of β at the end, as uncertain as it still changes over the last decade.
        slope, before = (float(self.spline(place, 1)) for place in (low, low + np.log(10)))
        value = value + slope * below
        doubt = np.abs((slope - before) * below)
        if self.law is None:
            power = exponent or 0.0
            drift = np.abs((float(self.spline(high, 1)) - power) * above)
            return value + power * above, doubt + drift
        at_end = float(self.law(np.exp(high)))
        off = float(self.spline(high)) - np.log(at_end)
        law = np.log(self.law(np.exp(np.maximum(x, high))))
        return np.where(above > 0, law + off * fading, value), doubt + 0.5 * np.abs(off) * (1 - fading)

    def exponent(self, beta: ArrayLike) -> Array:
        """Local exponent d ln q/d ln β."""
        x = np.log(np.asarray(beta, dtype=float))
        step = 1e-3
        before, after = (self(np.exp(x + shift))[0] for shift in (-step, step))
        return (after - before) / (2 * step * self(beta)[0])


@cache
def _table() -> dict[tuple[str, str], dict[str, Array]]:
    """Columns of the table, by cavitation and normalisation."""
    with resources.files("softlube.theory").joinpath(TABLE).open() as file:
        rows = list(csv.DictReader(file))
    kinds = {(row["cavitation"], row["normalisation"]) for row in rows}
    columns = [name for name in rows[0] if name not in ("cavitation", "normalisation")]
    return {
        kind: {
            name: np.array([float(row[name]) for row in rows if (row["cavitation"], row["normalisation"]) == kind])
            for name in columns
        }
        for kind in kinds
    }


@cache
def curve(name: str, normalisation: str = "indentation", cavitation: str = "reynolds") -> Curve:
    """The curve of one quantity.

    Parameters
    ----------
    name : str
        A key of `softlube.model.quantities.STEADY`.
    normalisation : {"indentation", "load"}
        With β of Eq. (6d), or β_load of Eq. (30).
    cavitation : {"reynolds", "none"}
        Behind the contact.

    Raises
    ------
    InputError
        If one of them is unknown, or the quantity is prescribed in that normalisation.
    """
    if name not in STEADY:
        raise InputError(f"quantity: unknown quantity {name!r}; one of {', '.join(STEADY)}")
    if normalisation not in ("indentation", "load"):
        raise InputError(f"normalisation: expected 'indentation' or 'load', got {normalisation!r}")
    if cavitation not in ("reynolds", "none"):
        raise InputError(f"cavitation: expected 'reynolds' or 'none', got {cavitation!r}")
    if name not in available(normalisation):
        raise InputError(f"quantity: {name} is prescribed where quantities are normalised with the {normalisation}")
    table = _table()[cavitation, normalisation]
    return Curve.through(name, table["beta"], table[name], table[f"{name}_error"], asymptote(name, cavitation))


def available(normalisation: str) -> list[str]:
    """Names of the quantities that are not prescribed in a normalisation."""
    prescribed = "load" if normalisation == "load" else "height"
    return [name for name in STEADY if name != prescribed and name in _table()["reynolds", normalisation]]


def evaluate(
    name: str, beta: ArrayLike | None = None, *, beta_load: ArrayLike | None = None, cavitation: str = "reynolds"
) -> tuple[Array, Array]:
    """Value and error of a quantity.

    Parameters
    ----------
    name : str
        A key of `softlube.model.quantities.STEADY`.
    beta, beta_load : array_like
        One of them, positive: β of Eq. (6d), for values normalised with the indentation, or β of Eq. (30), with the load.
    cavitation : {"reynolds", "none"}
        Behind the contact.

    Returns
    -------
    value, error : ndarray
        Of the shape of β.

    Raises
    ------
    InputError
        If not exactly one β is given, or it is not positive and finite; see also `curve`.
    """
    if (beta is None) == (beta_load is None):
        raise InputError("beta, beta_load: give exactly one of them")
    given = np.asarray(beta if beta is not None else beta_load, dtype=float)
    if not np.all((given > 0) & (given < np.inf)):
        raise InputError(f"{'beta' if beta is not None else 'beta_load'}: expected positive, finite numbers")
    return curve(name, "indentation" if beta is not None else "load", cavitation)(given)


def quantities(problem: Problem) -> Mapping[str, Quantity]:
    """All quantities of a problem, as `softlube.solve` would give them, from the curve.

    Raises
    ------
    InputError
        For a prescribed gap, h₀ ≥ 0, which has no curve of its own.
    """
    if (problem.substrate, problem.liquid) != (HalfSpaceKernel(), NewtonianLaw()):
        raise InputError(
            "thickness, pressure_viscosity: the master curve is for a half-space and constant viscosity; "
            "solve the problem instead"
        )
    if problem.indenter != Paraboloid():
        raise InputError("indenter: the master curve is for the paraboloid; solve the problem instead")
    if problem.height != -1:
        raise InputError(NO_GAPS)
    given: dict[str, Any] = {"beta_load" if problem.load_controlled else "beta": problem.parameter}
    exact = ("load", limits.HERTZ_LOAD) if problem.load_controlled else ("height", -1.0)
    known = available("load" if problem.load_controlled else "indentation")
    result = {}
    for name in STEADY:  # in its order; a quantity younger than the table has no curve yet
        if name == exact[0]:
            result[name] = Quantity(exact[1], 0.0)
        elif name in known:
            value, error = evaluate(name, **given, cavitation=problem.cavitation)
            result[name] = Quantity(float(value), float(error))
    return result


@cache
def _function(name: str) -> Callable[..., tuple[Array, Array]]:
    def of_beta(
        beta: ArrayLike | None = None, *, beta_load: ArrayLike | None = None, cavitation: str = "reynolds"
    ) -> tuple[Array, Array]:
        return evaluate(name, beta, beta_load=beta_load, cavitation=cavitation)

    of_beta.__name__ = of_beta.__qualname__ = name
    of_beta.__doc__ = f"Value and error of the {STEADY[name].words} as a function of β; see `evaluate`."
    return of_beta


def __getattr__(name: str) -> Callable[..., tuple[Array, Array]]:
    """A function of β for every quantity of the table, such as `film_center`."""
    if name in STEADY:
        return _function(name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *STEADY})
