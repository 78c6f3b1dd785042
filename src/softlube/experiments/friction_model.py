"""Friction of many contacts as a function of viscosity, modulus and offset, and the parameters that fit measurements best.

The friction of every contact is F = (2π/3) G δ² f(β_N) + F₀, with the load's Hertz indentation δ of Eq. (29), β_N of Eq. (30)
and the curve f of `softlube.experiments.load_curve`.  Where f is a power β^(−m), F goes like η^m G^((m−1)/3) and the data fix
that combination only: viscosity and modulus come apart by the curvature of f alone, which a fit with both must say.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from softlube.errors import InputError, NotConvergedError
from softlube.experiments.load_curve import WIDEST, LoadCurve, check_friction, load_curve
from softlube.experiments.measurements import Measurements
from softlube.model.exact import hertz_indentation
from softlube.physical.units import to_si
from softlube.solvers.progress import Listener

Array = NDArray[np.floating]

PARAMETERS = ("viscosity", "young_modulus", "friction_offset")
SHORT = {"modulus": "young_modulus", "offset": "friction_offset"}
UNITS = {"viscosity": "Pa s", "young_modulus": "Pa", "friction_offset": "N"}
NOISE = ("relative", "absolute")
ACCURACY = 5e-3
"""Relative accuracy of the solutions behind the curve: the friction is then good to 0.1 %, far better than a measurement."""
ROBUST_ROUNDS = 3
ROOM = 4.0
"""How far, as a factor of β, the curve reaches beyond the data at first."""
BEYOND = 3.0
"""Factor of β by which rows may lie above what could be solved: the curve is all but straight there, in logarithms."""
ROUNDS = 4
"""Times that the curve is widened to where the fit has led."""
PAPER_FIT = (4.806, 0.4398)
"""Eq. (28), from which the first guess of the viscosity is taken."""


@dataclass(frozen=True)
class Model:
    """Friction as a function of the parameters.

    Attributes
    ----------
    data : Measurements
    radius : float
        Of the sphere [m].
    fixed : mapping of str to float
        Values of the parameters that are not fitted, in SI.
    free : tuple of str
        Parameters that are fitted.
    noise : {"relative", "absolute"}
        Whether the scatter is in proportion to the friction, or the same for all.
    force, slide_to_roll : see `softlube.experiments.load_curve.LoadCurve.friction`
    curve : LoadCurve or None
    """

    data: Measurements
    radius: float
    fixed: dict[str, float]
    free: tuple[str, ...]
    noise: str
    force: str
    curve: LoadCurve | None = None

    @property
    def scale(self) -> float:
        """Unit of the offset: the median friction [N]."""
        return float(np.median(np.abs(self.data.friction)))

    def values(self, x: Array) -> dict[str, float]:
        """All parameters in SI from the vector that is fitted: logarithms, and the offset in units of `scale`."""
        found = {n: float(v * self.scale if n == "friction_offset" else math.exp(v)) for n, v in zip(self.free, x, strict=True)}
        return self.fixed | found

    def vector(self, values: dict[str, float]) -> Array:
        """Inverse of `values`."""
        return np.array([values[n] / self.scale if n == "friction_offset" else math.log(values[n]) for n in self.free])

    def beta(self, values: dict[str, float], data: Measurements | None = None) -> Array:
        """β of Eq. (30)."""
        data = data or self.data
        shear_modulus = values["young_modulus"] / 3
        delta = hertz_indentation(data.load, self.radius, shear_modulus)
        return 2 * math.pi / 3 * delta**2 / self.radius * shear_modulus / (values["viscosity"] * data.speed)

    def unit(self, values: dict[str, float], data: Measurements | None = None) -> Array:
        """(2π/3) G δ², Eqs. (26), (29) [N]."""
        load = (data or self.data).load
        shear_modulus = values["young_modulus"] / 3
        return 2 * math.pi / 3 * shear_modulus * hertz_indentation(load, self.radius, shear_modulus, power=2)

    def friction(self, values: dict[str, float], data: Measurements | None = None) -> Array:
        """Friction force [N].  Beyond the ends of the curve it goes on with its last slope, so that a search does not fall
        off.
        """
        assert self.curve is not None
        beta = self.beta(values, data)
        low, high = self.curve.low, self.curve.high
        inside = np.clip(beta, low, high)
        rolls = (data or self.data).slide_to_roll
        normalised = self.curve.friction(inside, force=self.force, slide_to_roll=rolls)
        for end, inner in ((low, 1.1 * low), (high, high / 1.1)):
            beyond = beta < low if end == low else beta > high
            if beyond.any():
                at_end, further_in = (
                    self.curve.friction(b, force=self.force, slide_to_roll=rolls[beyond]) for b in (end, inner)
                )
                slope = np.log(np.abs(at_end / further_in)) / math.log(end / inner)
                normalised[beyond] *= (beta[beyond] / end) ** slope
        return self.unit(values, data) * normalised + values["friction_offset"]

    def residuals(self, values: dict[str, float], data: Measurements | None = None) -> Array:
        """ln(measured/model) for relative noise, else (measured − model)/`scale`."""
        measured, model = (data or self.data).friction, self.friction(values, data)
        if self.noise == "absolute":
            return (measured - model) / self.scale
        # An offset may take the model below zero on the way; such a point is as far off as can be without being infinite.
        return np.log(measured / np.maximum(model, 1e-3 * measured))

    def first_guess(self) -> dict[str, float]:
        """Viscosity from the median point and Eq. (28); the modulus as given or, failing that, typical."""
        values = self.fixed | {name: 0.0 for name in self.free if name == "friction_offset"}
        values.setdefault("young_modulus", 1e6)
        if "viscosity" not in values:
            beta_times_viscosity = self.beta(values | {"viscosity": 1.0})
            normalised = np.abs(self.data.friction) / self.unit(values)
            guesses = beta_times_viscosity * (np.maximum(normalised, 1e-12) / PAPER_FIT[0]) ** (1 / PAPER_FIT[1])
            values["viscosity"] = float(np.median(guesses))
        return values

    def cover(self, values: dict[str, float], region: str | float, progress: Listener | None) -> Model:
        """With a load curve around the β of the data."""
        beta = self.beta(values)
        low, high = (min(max(float(end), WIDEST[0]), WIDEST[1]) for end in (beta.min() / ROOM, beta.max() * ROOM))
        if self.curve is not None:
            low, high = min(low, self.curve.low), max(high, self.curve.high)
        return replace(self, curve=load_curve(low, high, region=region, accuracy=ACCURACY, progress=progress))


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


def optimise(model: Model, start: dict[str, float], *, robust: bool = False) -> Optimum:
    """Least squares, or with `robust` a loss that grows linearly beyond the scatter (soft L1), so that outliers hardly count.

    Raises
    ------
    NotConvergedError
        If the search does not end.
    """
    x = model.vector(start)

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
    """Fit, with a load curve that reaches over the data at the parameters found.

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
        assert model.curve is not None
        low, high, beta = model.curve.low, BEYOND * model.curve.high, model.beta(values)
        if low <= beta.min() and beta.max() <= (high if not remaining else model.curve.high):
            return model, optimum
        if not remaining:
            row = int(np.argmin(beta) if beta.min() < low else np.argmax(beta))
            raise NotConvergedError(
                f"{model.data.source}, line {model.data.lines[row]}: the fit puts it at beta = {beta[row]:.3g}, and only "
                f"{low:.3g} to {high:.3g} can be solved: leave such rows out, or check units and parameters"
            )
    raise AssertionError("unreachable")


def make_model(
    data: Measurements,
    *,
    radius: object,
    young_modulus: object = None,
    viscosity: object = None,
    friction_offset: float = 0.0,
    free: Sequence[str] = ("viscosity",),
    noise: str = "relative",
    force: str = "sphere",
    region: str | float = 2.0,
) -> Model:
    """Check the input of a fit; parameters as in `softlube.experiments.fit.fit`.

    Raises
    ------
    InputError
        If something is missing, unknown or impossible.
    """
    names = tuple(dict.fromkeys(SHORT.get(name, name) for name in free))
    unknown = [name for name in names if name not in PARAMETERS]
    if unknown or not names:
        raise InputError(f"free: expected one or more of {', '.join(PARAMETERS)}, got {', '.join(unknown) or 'none'}")
    if noise not in NOISE:
        raise InputError(f"noise: expected one of {', '.join(NOISE)}, got {noise!r}")
    check_friction(force, region)
    if radius is None:
        raise InputError("radius: missing; expected a length such as '2 mm'")
    given = {"young_modulus": young_modulus, "viscosity": viscosity}
    fixed = {name: to_si(name, value) for name, value in given.items() if value is not None}
    for name in given:
        if name not in fixed and name not in names:
            raise InputError(f"{name}: missing; give it or fit it (free)")
    if len(data) <= len(names) + 1:
        raise InputError(f"{data.source}: {len(data)} rows are too few for {len(names)} parameters")
    if noise == "relative" and np.any(data.friction <= 0):
        line = data.lines[int(np.argmax(data.friction <= 0))]
        raise InputError(
            f"{data.source}, line {line}: the friction is not positive, and noise in proportion to it makes no sense; "
            "leave the row out or take noise absolute"
        )
    return Model(data, to_si("radius", radius), fixed | {"friction_offset": float(friction_offset)}, names, noise, force)


def normalised_friction(model: Model, values: dict[str, float]) -> tuple[Array, Array]:
    """β and the measured friction, less the offset, over (2π/3) G δ²: the points of Fig. 13."""
    return model.beta(values), (model.data.friction - values["friction_offset"]) / model.unit(values)
