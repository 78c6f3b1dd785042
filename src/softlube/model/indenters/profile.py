"""An indenter whose profile was measured: radius and height at many places, smoothed by a spline.

The spline is of degree five, even about the axis, and has pieces of equal length; the fewest are taken that come as near to the
measured heights as the tolerance says.  Beyond the last place the surface goes on as the paraboloid that touches it there.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar

from softlube.errors import InputError
from softlube.model.indenters.base import Array, Curved, IndenterPart
from softlube.model.inputs import LENGTH, given
from softlube.model.lazy import numpy as np
from softlube.model.lazy import readers

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

DEGREE = 5
SIZES = (3, 4, 5, 6, 7, 8, 10, 12, 16, 20, 24, 32, 48, 64)
"""Numbers of coefficients on the positive side that are tried."""
FEWEST_PLACES = 12
"""Least number of measured places."""
PLACES_EACH = 4
"""Least number of places for each coefficient."""
NOISE, ROUND_OFF = 1.15, 1e-12
"""Deviation over that of the smoothing with the best cross-validation score that is noise, too; and over the heights' range."""
DIP = 3.0
"""Depth, over the deviation from the heights, of a dip below the lowest point on the axis up to which the profile is taken."""
AXIS = 0.1
"""Largest distance of the innermost place from the axis, over the outermost's."""
TABLE = 400
"""Places at which the transform of a spline is kept."""


@dataclass(frozen=True)
class SplineShape(Curved):
    """A smoothed profile.

    Parameters
    ----------
    reach : float
        Radius of the last place over the reference radius.
    coefficients : tuple of float
        Of the spline's B-splines on the positive side, and as many on the other, over the reference radius.
    """

    reach: float
    coefficients: tuple[float, ...]
    kind: ClassVar[str] = "spline"
    words: ClassVar[str] = "a rigid indenter of measured profile"

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "coefficients", tuple(self.coefficients))  # a list where it comes from a file

    @property
    def end(self) -> float:
        """Radius of the last place."""
        return self.reach

    def outline(self, x: Array) -> tuple[Array, Array, Array]:
        """The spline and its derivatives."""
        value, slope, bend = _splines(self.reach, self.coefficients)
        return value(x) - value(0.0), slope(x), bend(x)

    def transform(self, x: Array) -> tuple[Array, Array]:
        """From a table up to the last place, since every first guess asks at thousands of places."""
        if np.any(x > self.reach):
            return super().transform(x)
        table = _table(self)
        return table(x), table(x, 1)


@lru_cache(maxsize=32)
def _splines(reach: float, coefficients: tuple[float, ...]) -> tuple[BSpline, BSpline, BSpline]:
    """The spline, its slope and its curvature."""
    from scipy.interpolate import BSpline

    value = BSpline(_knots(reach, len(coefficients)), np.array([*coefficients[::-1], *coefficients]), DEGREE)
    return value, value.derivative(), value.derivative(2)


@lru_cache(maxsize=32)
def _table(shape: SplineShape) -> Any:
    """The transform by quadrature, interpolated."""
    from scipy.interpolate import CubicHermiteSpline

    x = np.linspace(0, shape.reach, TABLE)
    return CubicHermiteSpline(x, *Curved.transform(shape, x))


def _knots(reach: float, half: int) -> Array:
    """Knots of an even spline with so many coefficients on one side; the axis is in the middle of a piece."""
    inner = np.linspace(-reach, reach, 2 * half - DEGREE + 1)
    return np.concatenate([np.full(DEGREE, -reach), inner, np.full(DEGREE, reach)])


@dataclass(frozen=True)
class Smoothed:
    """A profile smoothed with some number of pieces.

    Attributes
    ----------
    reach : float
        Radius of the last place [m].
    coefficients : tuple of float
        Of the B-splines on the positive side [m].
    deviation : float
        Root mean square of its distance from the measured heights [m].
    scatter : float
        Root mean square of the heights' distance from their mean over the angle [m]; 0 where a line was measured.
    """

    reach: float
    coefficients: tuple[float, ...]
    deviation: float
    scatter: float = 0.0

    def outline(self, r: Array) -> tuple[Array, Array]:
        """Height over the axis [m] and slope at radii."""
        value, slope, _ = _splines(self.reach, self.coefficients)
        return value(r) - value(0.0), slope(r)

    @property
    def reference_radius(self) -> float:
        """Radius of the paraboloid through the axis and the last place [m]."""
        return self.reach**2 / (2 * float(self.outline(np.array(self.reach))[0]))

    def shape(self, unit: float, share: float, reference: float | None = None) -> SplineShape:
        """The shape, see `Curved`, over its own reference radius or another one [m]."""
        radius = reference or self.reference_radius
        return SplineShape(unit, share, self.reach / radius, tuple(each / radius for each in self.coefficients))


def smooth(r: Array, z: Array, half: int) -> Smoothed:
    """The even spline of a number of coefficients that is nearest to measured heights, by least squares."""
    from scipy.interpolate import BSpline

    reach = float(np.max(np.abs(r)))
    whole = BSpline.design_matrix(np.clip(np.abs(r), 0, reach), _knots(reach, half), DEGREE).toarray()
    even = whole[:, half:] + whole[:, :half][:, ::-1]
    found, *_ = np.linalg.lstsq(even, z, rcond=None)
    return Smoothed(reach, tuple(found.tolist()), float(np.sqrt(np.mean((even @ found - z) ** 2))))


def smoothings(r: Array, z: Array, tolerance: float | None) -> tuple[Smoothed, Smoothed]:
    """The smoothing within a tolerance, and the next coarser one, which tells what the smoothing does.

    Parameters
    ----------
    r, z : ndarray
        Measured radii, of either sign, and heights [m].
    tolerance : float or None
        Root mean square distance from the heights that is allowed [m]; chosen by generalised cross-validation if None.

    Raises
    ------
    InputError
        If there are too few places, no smoothing is as near as the tolerance says, or the surface does not rise from the axis.
    """
    size = np.abs(r)
    if np.unique(size).size < FEWEST_PLACES:
        raise InputError(f"profile: expected at least {FEWEST_PLACES} different radii, got {np.unique(size).size}")
    if not size.min() <= AXIS * size.max():
        raise InputError(
            f"profile: the innermost radius is {size.min():.3g} m; expected one within {AXIS:g} of the outermost, "
            f"{size.max():.3g} m, from the axis"
        )
    counts = [half for half in SIZES if half * PLACES_EACH <= np.unique(size).size]
    tried: list[Smoothed] = []
    for half in counts:
        tried.append(smooth(r, z, half))
        if tolerance is not None and tried[-1].deviation <= tolerance:
            break
    if tolerance is None:
        # Craven & Wahba (1979): the least mean square over (1 − parameters/places)².
        score = [each.deviation / (1 - half / r.size) for each, half in zip(tried, counts, strict=True)]
        tolerance = NOISE * tried[int(np.argmin(score))].deviation + ROUND_OFF * float(np.ptp(z))
    best = next((number for number, each in enumerate(tried) if each.deviation <= tolerance), None)
    if best is None:
        least = min(each.deviation for each in tried)
        raise InputError(
            f"profile_tolerance: no smoothing comes nearer than {least:.3g} m to the heights; expected a larger one, "
            f"got {tolerance:.3g} m"
        )
    _check_rise(tried[best])
    return tried[best], tried[max(best - 1, 0)]


def _check_rise(smoothed: Smoothed) -> None:
    """Refuse a surface whose lowest point is not on the axis, or that falls at its outer end."""
    height, slope = smoothed.outline(np.linspace(0, smoothed.reach, 400))
    allowed = DIP * smoothed.deviation + 1e-6 * float(np.ptp(height))
    if not (height[-1] > allowed and slope[-1] > 0):
        raise InputError(
            "profile: the surface does not rise from the axis outwards; give z as the height over the lowest point (with the "
            "other sign, if it was measured as the height of the probe)"
        )
    if height.min() < -allowed:
        place = smoothed.reach * int(np.argmin(height)) / 399
        raise InputError(
            f"profile: the lowest point is {-height.min():.3g} m below the axis, at a radius of {place:.3g} m; expected it on "
            "the axis; take a smaller tolerance if the smoothing moves it"
        )


class Profile(IndenterPart):
    """An indenter whose profile was measured, smoothed.

    A CSV file has the columns r and z, and units in its header; line scans and maps of instruments take the extra topography.
    """

    kind: ClassVar[str] = "profile"
    file: str = given(
        'CSV file of the measured profile of an indenter, with columns headed as in "r [mm], z [um]"; or a scan (.x3p, .sur)',
        flat="profile",
    )
    tolerance: float | None = given(
        "Root mean square distance of the smoothed profile from the measured heights",
        LENGTH,
        "20 nm",
        default=None,
        absent="by cross-validation",
        flat="profile_tolerance",
    )
    spline: str | None = given(
        "The smoothed profile as files of results keep it; the CSV file is not read then",
        default=None,
        flat="profile_spline",
        kept=True,
    )

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values with the smoothed profile, read from the file or taken from `spline`."""
        if values["spline"] is None:
            r, z, scatter = readers["profile"](values["file"])
            pair = smoothings(r, z, values["tolerance"])
            if values["tolerance"] is None:
                values["tolerance"] = pair[0].deviation
            values["spline"] = json.dumps(
                [[each.reach, each.deviation, list(each.coefficients), *([scatter] if scatter else [])] for each in pair]
            )
        self.smoothed_from(values["spline"])
        return super().checked(values)

    @staticmethod
    def smoothed_from(text: str) -> tuple[Smoothed, Smoothed]:
        """The two smoothings that a text keeps.

        Raises
        ------
        InputError
            If the text is no smoothed profile.
        """
        try:
            chosen, coarser = (
                Smoothed(float(reach), tuple(map(float, coefficients)), float(deviation), *map(float, scatter))
                for reach, deviation, coefficients, *scatter in json.loads(text)
            )
        except (ValueError, TypeError):
            raise InputError("profile_spline: no smoothed profile of softlube; leave it out") from None
        for each in (chosen, coarser):
            numbers = each.reach, each.deviation, each.scatter, *each.coefficients
            if not (all(map(math.isfinite, numbers)) and each.reach > 0 and len(each.coefficients) > DEGREE // 2):
                raise InputError("profile_spline: no smoothed profile of softlube; leave it out")
        _check_rise(chosen)
        return chosen, coarser

    @property
    def smoothed(self) -> tuple[Smoothed, Smoothed]:
        """The smoothed profile, and the next coarser one."""
        return self.smoothed_from(self.spline)  # type: ignore[arg-type]

    @property
    def reference_radius(self) -> float:
        """Radius of the paraboloid through the axis and the outermost place [m]."""
        return self.smoothed[0].reference_radius

    def shape(self, unit: float, share: float) -> SplineShape:
        """The smoothed profile."""
        return self.smoothed[0].shape(unit, share)
