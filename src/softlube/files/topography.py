"""Measured surfaces of indenters in the formats of instruments, which the package SurfaceTopography reads.

A line scan is moved so that its apex is on the axis, a map is also averaged over the angle about it.  Either is turned so that
the apex is the lowest point.
"""

from __future__ import annotations

import warnings
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError
from softlube.files.reading import Damaged, read_bytes

if TYPE_CHECKING:
    Array = NDArray[np.floating]

TABLES = ("", ".csv", ".txt", ".tsv", ".dat", ".xlsx", ".ods", ".xls", ".xlsm", ".xlsb", ".numbers")
"""Endings of files that are tables; any other is an instrument's."""
LARGEST = 500_000_000
"""Bytes of a file at most."""
DEGREE, SAMPLE = 4, 20_000
"""Degree, in the squared radius, of the polynomial about the apex, and number of places that find it."""
RINGS, FEWEST = 400, 12
"""Number of rings over which a map is averaged at most, and at least."""


def is_topography(path: Path) -> bool:
    """Whether a file is an instrument's, by its ending."""
    return path.suffix.lower() not in TABLES


def read_topography(path: Path) -> tuple[Array, Array, float]:
    """Radii and heights over the lowest point [m], with the apex on the axis.

    Parameters
    ----------
    path : Path
        A file in a format that SurfaceTopography reads, with a line scan or a map.

    Returns
    -------
    r, z : ndarray
        Radii, those of a line scan with a sign, and heights, those of a map averaged over the angle.
    scatter : float
        Root mean square of what the heights of a map differ from their means; 0 for a line scan.

    Raises
    ------
    InputError
        If the package is not installed, the file is missing, damaged or of no format that the package knows, has no unit of
        length, or has its apex outside the measured places.
    """
    try:
        read_bytes(path, LARGEST)
    except Damaged as error:
        raise InputError(f"{path}: the file {error}") from None
    if find_spec("SurfaceTopography") is None:
        raise InputError(
            f"{path.name}: {path.suffix} files need the extra topography: pip install 'softlube[topography]'; "
            "or save the profile as CSV with the columns r and z"
        )
    *across, height = _positions(path)
    around = _about_apex(across, height, path.name)
    if len(across) == 1:
        return around[0], height, 0.0
    return _mean_over_angle(np.hypot(*around), height, reach=_reach(around))


def _positions(path: Path) -> list[Array]:
    """Coordinates and heights [m] of the places that were measured, flat."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a reader's own making
            with import_module("SurfaceTopography").open_topography(str(path)) as reader:
                found: Any = reader.topography()
                found = found.to_unit("m") if found.unit else found
                columns = [np.ma.masked_invalid(np.ma.ravel(each)) for each in found.positions_and_heights()]
            unit = found.unit
    except Exception as error:  # whatever the readers make of a file
        told = " ".join(str(error).split())
        reason = "is in no format that SurfaceTopography knows, or damaged" if len(told) > 200 else f"cannot be read ({told})"
        raise InputError(f"{path.name}: {reason}") from None
    if unit != "m":
        raise InputError(f"{path.name}: the file gives no unit of length; save the profile as CSV with the columns r and z")
    missing = np.any([np.ma.getmaskarray(each) for each in columns], axis=0)
    return [np.asarray(each, dtype=float)[~missing] for each in columns]


def _about_apex(across: list[Array], height: Array, name: str) -> list[Array]:
    """Coordinates from the apex; `height` becomes that over it, in place.

    The apex is the centre about which a polynomial in the squared distance comes nearest to the heights.
    """
    from scipy.optimize import least_squares

    if height.size < FEWEST:
        raise InputError(f"{name}: expected at least {FEWEST} measured places, got {height.size}")
    every = max(1, height.size // SAMPLE)
    middle = [(np.min(each) + np.max(each)) / 2 for each in across]
    size = max(float(np.ptp(each)) for each in across) / 2 or 1.0
    places = [(each[::every] - centre) / size for each, centre in zip(across, middle, strict=True)]
    sample = height[::every]

    def fitted(apex: Array) -> tuple[Array, Array]:
        squared = np.sum([(each - centre) ** 2 for each, centre in zip(places, apex, strict=True)], axis=0)
        powers = np.vander(squared, DEGREE + 1, increasing=True)
        found, *_ = np.linalg.lstsq(powers, sample, rcond=None)
        return found, powers @ found - sample

    paraboloid = np.column_stack([np.ones(sample.size), *places, np.sum(np.square(places), axis=0)])
    found, *_ = np.linalg.lstsq(paraboloid, sample, rcond=None)
    bend = found[-1]
    first = -found[1:-1] / (2 * bend) if bend else np.full(len(places), np.inf)
    outside = (
        f"{name}: the apex is not within the measured places; the surface must rise from an apex to all sides (level the scan)"
    )
    if not np.all(np.abs(first) < 1):
        raise InputError(outside)
    scale = float(np.std(sample)) or 1.0
    apex = least_squares(lambda each: fitted(each)[1] / scale, first, x_scale=0.1).x
    if not np.all(np.abs(apex) < 1):
        raise InputError(outside)
    height -= fitted(apex)[0][0]
    height *= np.sign(bend)
    return [each - (centre + size * shift) for each, centre, shift in zip(across, middle, apex, strict=True)]


def _reach(around: list[Array]) -> float:
    """Radius of the largest circle about the apex within a map's rectangle."""
    return min(abs(float(bound)) for each in around for bound in (np.min(each), np.max(each)))


def _mean_over_angle(distance: Array, height: Array, reach: float) -> tuple[Array, Array, float]:
    """Radii (by mean squares) and mean heights of rings within a reach, and the root mean square of what is left."""
    within = distance <= reach
    squared, height = distance[within] ** 2, height[within]  # in which a paraboloid is a line
    count = int(np.clip(np.sqrt(height.size) / 2, FEWEST, RINGS))
    ring = np.minimum((np.sqrt(squared) / reach * count).astype(int), count - 1)
    places = np.bincount(ring, minlength=count)
    filled = places > 0
    square, z = (np.bincount(ring, each, minlength=count)[filled] / places[filled] for each in (squared, height))
    inside = (squared >= square[0]) & (squared <= square[-1])
    scatter = height[inside] - np.interp(squared[inside], square, z)
    return np.sqrt(square), z, float(np.sqrt(np.mean(scatter**2)))
