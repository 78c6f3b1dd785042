"""Film and pressure along the centre line y = 0 of a contact under a prescribed load, at once, from a shipped table.

    >>> from softlube.theory.centre_line import profiles
    >>> line = profiles(1e4)
    >>> bool(-1 < line.x[line.film.argmin()] < -0.9)  # the constriction at the outlet
    True

Behind it is a table of solutions (made by benchmarks/centre_line.py) from β_load = 10⁻⁴ to 10⁸, four to the decade, and
eight from 0.1 to 100, where the sphere comes to dip in.  It holds
ln u/u(0) and p/p_max at places that move with β: they crowd at x = ±1, where a contact has boundary layers of width β^(−2/5).
Between the table's β both are interpolated by cubics in ln β; u(0) and p_max are those of the master curve.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from importlib import resources

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.errors import InputError
from softlube.theory import master_curve

Array = NDArray[np.floating]

TABLE = "data/centre_line.csv"
INTERVALS = 48
"""Intervals between the places on either side of the centre."""
STEP = 1e-4
"""What one in the table's whole numbers means: ln u/u(0) and p/p_max are rounded to it."""
LAYER, WIDER, REACH = (1.0, -0.4), 0.18, (2.0, 8.0)
"""The places: width of the layers (1 + β_load)^−0.4 as in `softlube.theory.limits`; growth of the pressure's width with the
film over the indentation, as the rigid sphere's largest pressure is at 0.26 √(2h₀); and the half-width of the picture, twice
the contact radius of a Hertz contact and ten times the width under a sphere that floats."""
FILM_ERROR, PRESSURE_ERROR = 5e-3, 5e-3
"""Largest error of the film, over itself, and of the pressure, over p_max; tests/theory/test_centre_line.py measures them."""


@dataclass(frozen=True)
class CentreLine:
    """Profiles along the centre line, normalised with the Hertz indentation δ of the load, Eqs. (4) and (29).

    Attributes
    ----------
    x : ndarray, shape (n,)
        Place over √(Rδ), increasing; the inlet is at x > 0.
    film : ndarray, shape (n,)
        u/δ.
    pressure : ndarray, shape (n,)
        p/(4πG√(δ/R)).
    """

    x: Array
    film: Array
    pressure: Array


def places(beta_load: ArrayLike, film_center: ArrayLike) -> Array:
    """Places x at which the table holds the profiles.

    Parameters
    ----------
    beta_load : float
        β of Eq. (30).
    film_center : float
        Film at the centre over δ.

    Returns
    -------
    ndarray, shape (2 × `INTERVALS` + 1,)
        x over √(Rδ), increasing: ±ℓ(1 + w sinh(κξ − b)) for ξ = 0 … 1, from the centre to the ends of the picture.
    """
    beta_load, film_center = float(beta_load), float(film_center)  # type: ignore[arg-type]
    wider = 1 + WIDER * film_center
    width = (LAYER[0] + beta_load) ** LAYER[1]
    end = REACH[0] + REACH[1] * (1 - 1 / wider)
    before, behind = np.arcsinh(1 / width), np.arcsinh((end - 1) / width)
    xi = np.arange(1, INTERVALS + 1) / INTERVALS
    half = np.sqrt(wider) * (1 + width * np.sinh((before + behind) * xi - before))
    return np.concatenate([-half[::-1], [0.0], half])


@cache
def table(cavitation: str = "reynolds") -> tuple[Array, Array, Array]:
    """The table: log₁₀ β_load, shape (n,), and 10⁴ ln u/u(0) and 10⁴ p/p_max in whole numbers, shape (n, number of places).

    Parameters
    ----------
    cavitation : {"reynolds", "none"}
        Behind the contact.

    Raises
    ------
    InputError
        If the cavitation is unknown.
    """
    with resources.files("softlube.theory").joinpath(TABLE).open() as file:
        rows = [row for row in csv.reader(file) if row[0] == cavitation]
    if not rows:
        raise InputError(f"cavitation: expected 'reynolds' or 'none', got {cavitation!r}")
    film, pressure = (np.array([row[2:] for row in rows if row[1] == name], dtype=float) for name in ("film", "pressure"))
    return np.log10(film[:, 0]), film[:, 1:], pressure[:, 1:]


def profiles(beta_load: float, cavitation: str = "reynolds") -> CentreLine:
    """Film and pressure along the centre line of a contact under a prescribed load.

    Parameters
    ----------
    beta_load : float
        β of Eq. (30), from 10⁻⁴ to 10⁸.
    cavitation : {"reynolds", "none"}
        Behind the contact.

    Returns
    -------
    CentreLine
        Good to `FILM_ERROR` of the film and `PRESSURE_ERROR` of the largest pressure.

    Raises
    ------
    InputError
        If β_load is outside the table, or the cavitation is unknown.
    """
    nodes, film, pressure = table(cavitation)
    at = float(np.log10(beta_load))
    if not nodes[0] <= at <= nodes[-1]:
        raise InputError(f"beta_load: profiles are kept from 1e{nodes[0]:g} to 1e{nodes[-1]:g}, got {beta_load:g}")
    first = int(np.clip(np.searchsorted(nodes, at) - 2, 0, len(nodes) - 4))
    weights = cubic_weights(nodes[first : first + 4], at)
    center, highest = (
        float(master_curve.evaluate(name, beta_load=beta_load, cavitation=cavitation)[0])
        for name in ("film_center", "pressure_max")
    )
    return CentreLine(
        places(beta_load, center),
        center * np.exp(STEP * (weights @ film[first : first + 4])),
        highest * STEP * (weights @ pressure[first : first + 4]),
    )


def cubic_weights(nodes: Array, at: float) -> Array:
    """Lagrange's weights of the values at some nodes for a place."""
    others = [np.delete(nodes, k) for k in range(len(nodes))]
    return np.array([np.prod((at - other) / (node - other)) for node, other in zip(nodes, others, strict=True)])
