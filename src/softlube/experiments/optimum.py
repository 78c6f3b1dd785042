"""The parameters with which a model of friction fits measurements best, by least squares."""

from __future__ import annotations

from collections.abc import Mapping, Sized
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from softlube.errors import NotConvergedError
from softlube.experiments.friction_model import Model
from softlube.experiments.parameters import unit_of
from softlube.solvers.progress import Listener

Array = NDArray[np.floating]

ROBUST_ROUNDS = 3
BEYOND = 3.0
"""Factor of β by which rows may lie above what could be solved: the curve is all but straight there, in logarithms."""
ROUNDS = 6
"""Times that the curve is widened to where the fit has led."""
CENTRED = 2
"""First rounds in which curves are solved again around what has been found; parameters that are told together only lead on."""


class Parametric(Protocol):
    """What least squares and intervals ask of a model: a dataclass that fits some of its parameters, and holds others."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    @property
    def data(self) -> Sized:
        """What is described."""
        ...

    @property
    def fixed(self) -> Mapping[str, float]:
        """Values of the parameters that are held, in SI."""
        ...

    @property
    def free(self) -> tuple[str, ...]:
        """Parameters that are fitted."""
        ...

    def values(self, x: Array) -> dict[str, float]:
        """All parameters in SI from the vector that is fitted."""
        ...

    def vector(self, values: Mapping[str, float]) -> Array:
        """Inverse of `values`."""
        ...

    def residuals(self, values: Mapping[str, float]) -> Array:
        """What remains of the data, of which the squares are added up."""
        ...

    def bounds(self) -> tuple[Array, Array]:
        """Least and greatest vector."""
        ...

    @property
    def limited(self) -> bool:
        """Whether the bounds are where curves end, and not where no parameter can be."""
        ...


@dataclass(frozen=True)
class Optimum:
    """Best parameters of a model.

    Attributes
    ----------
    x : ndarray
        As in `Model.vector`.
    sum_of_squares : float
        Sum of the squared residuals, without a loss function.
    covariance : ndarray
        Covariance of `x`, from the Jacobian of the residuals.
    """

    x: Array
    sum_of_squares: float
    covariance: Array


def optimise(model: Parametric, start: Mapping[str, float], *, robust: bool = False) -> Optimum:
    """Least squares, or with `robust` a loss that grows linearly beyond the scatter (soft L1), so that outliers hardly count.

    Raises
    ------
    NotConvergedError
        If the search does not end.
    """
    bounds = model.bounds()
    x = np.clip(model.vector(start), *bounds)  # a start on a bound may be beyond it by round-off

    def residuals(x: Array) -> Array:
        return model.residuals(model.values(x))

    jacobian = np.empty((len(model.data), x.size))
    # A robust fit takes the scatter from the residuals around the fit before, in which outliers had little say.
    for _ in range(ROBUST_ROUNDS if robust else 1):
        result = least_squares(
            residuals,
            x,
            x_scale=0.1,
            xtol=1e-10,
            ftol=1e-12,
            gtol=1e-12,
            max_nfev=200,
            bounds=bounds,
            loss="soft_l1" if robust else "linear",
            f_scale=max(_scatter(residuals(x)), 1e-9) if robust else 1.0,
        )
        jacobian = np.asarray(result.jac, dtype=float)
        if result.status <= 0:
            raise NotConvergedError("the fit did not converge; give a starting value for the viscosity or fit fewer parameters")
        x = result.x
    remaining = residuals(x)
    freedom = max(remaining.size - x.size, 1)
    variance = _scatter(remaining) ** 2 if robust else float(remaining @ remaining) / freedom
    covariance = variance * np.linalg.pinv(jacobian.T @ jacobian)
    return Optimum(x, float(remaining @ remaining), covariance)


def _listed(model: Model, values: dict[str, float]) -> str:
    return ", ".join(f"{name} = {values[name]:.3g} {unit_of(name)}" for name in model.free)


def _scatter(residuals: Array) -> float:
    """Standard deviation from the median absolute one: outliers do not count."""
    return 1.4826 * float(np.median(np.abs(residuals - np.median(residuals))))


def solve_model(
    model: Model,
    region: str | float,
    *,
    robust: bool = False,
    start: dict[str, float] | None = None,
    progress: Listener | None = None,
) -> tuple[Model, Optimum]:
    """Fit, with load curves that reach over the data at the parameters found.

    Raises
    ------
    NotConvergedError
        If the parameters put a row outside what can be solved.
    """
    values = start or model.first_guess()
    for remaining in reversed(range(ROUNDS)):
        model = model.cover(values, region, progress)
        optimum = optimise(model, values, robust=robust)
        values = model.values(optimum.x)
        assert model.family is not None
        low, high, beta = model.family.low, BEYOND * model.family.high, model.beta(values)
        inside = low <= beta.min() and beta.max() <= (high if not remaining else model.family.high)
        if inside and model.holds_for(values):
            if not (remaining >= ROUNDS - CENTRED and model.off_centre(optimum.x)):
                return model, optimum
            model = replace(model, family=None)
        if not remaining and inside:
            raise NotConvergedError(
                f"the fit leads from one set of curves to the next, at last to {_listed(model, values)}; start from there, or "
                "hold one of the parameters"
            )
        if not remaining:
            row = int(np.argmin(beta) if beta.min() < low else np.argmax(beta))
            raise NotConvergedError(
                f"{model.data.source}, line {model.data.lines[row]}: the fit puts it at beta = {beta[row]:.3g}, and only "
                f"{low:.3g} to {high:.3g} can be solved: leave such rows out, or check units and parameters"
            )
    raise AssertionError("unreachable")
