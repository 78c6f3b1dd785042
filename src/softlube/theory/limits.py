"""Exact solutions and the laws of the Hertz limit β → ∞, normalised as in the paper."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.model.exact import (
    HERTZ_LOAD,
    HERTZ_PRESSURE,
    disc_displacement,
    far_field_profile,
    far_front_angle,
    half_sommerfeld_load,
    hertz_displacement,
    hertz_pressure,
    kapitza_pressure,
)

__all__ = [
    "EDGE_PRESSURE",
    "HERTZ_LOAD",
    "HERTZ_PRESSURE",
    "SIDE_FILM",
    "SIDE_TIME",
    "disc_displacement",
    "far_field_profile",
    "far_front_angle",
    "film_center_asymptote",
    "film_center_power_law",
    "film_constant",
    "film_contact_asymptote",
    "film_inlet_asymptote",
    "film_min_angle_asymptote",
    "film_min_asymptote",
    "film_outlet_min_asymptote",
    "friction_contact_asymptote",
    "half_sommerfeld_load",
    "hertz_displacement",
    "hertz_pressure",
    "kapitza_pressure",
    "load_asymptote",
    "outlet_film_exponent",
    "outlet_film_ratio",
    "pressure_gradient_inlet_asymptote",
]

Array = NDArray[np.floating]

# --- the Hertz limit β → ∞ --------------------------------------------------------------------------------------------------
#
# Inside the contact the pressure is Hertz's; the film is what the inlet lets in, carried along x.  The constants come from the
# similarity problems of `softlube.inlet`, solved on demand (a second).  The flow that the Hertz pressure drives in the
# contact is smaller than the Couette flow by β u² p ~ β^(−1/5): that is the second term where `terms` is offered.  What is
# left out then is O(β^(−2/5) ln β) of the first term, if nothing else is said.  docs/theory/asymptotics.md has the derivations.

EDGE_PRESSURE = np.sqrt(2) * HERTZ_PRESSURE
"""A in p = A√s, the Hertz pressure at a distance s ≪ 1 inside the contact's edge."""


def _terms(terms: int, available: int = 2) -> int:
    if terms not in range(1, available + 1):
        raise ValueError(f"terms: expected 1 to {available}, got {terms!r}")
    return terms


@cache
def film_constant(index: float = 1.0, slide_to_roll: float = 2.0) -> float:
    """Constant c of the law u(0) → c β^(−3/(3n+2)), by the inlet's similarity problem; 1.1070049254 for constant viscosity.

    For a power-law liquid β is formed with the viscosity K (v/h)^(n−1) that it has at the shear rate v/h, where v is the sum of
    the surface speeds and h the unit of height.  As that depends on v, the film goes like v^(3n/(3n+2)).

    Parameters
    ----------
    index : float
        Power-law index n, from 0.25 to 1.5.
    slide_to_roll : float
        Difference of the surface speeds over their mean: 0 in pure rolling, 2 where one surface rests.

    Raises
    ------
    ValueError
        If the index is beyond.
    """
    from softlube.theory.inlet import inlet
    from softlube.theory.power_law import PowerLawFlow

    layer = inlet(flow=PowerLawFlow(index, abs(slide_to_roll) if index != 1 else 0.0))
    entrainment = ((2 * index + 1) / index) ** index / 3
    return float(EDGE_PRESSURE ** (-4 / (3 * index + 2)) * entrainment ** (3 / (3 * index + 2)) * layer.film_inside)


def film_contact_asymptote(x: ArrayLike, y: ArrayLike, beta: float, terms: int = 2) -> Array:
    """Film inside the contact as β → ∞.

    The leading term c β^(−3/5) (1 − y²)^(3/10) is set by the inlet, where the entrainment normal to the edge is √(1 − y²), and
    is the same all along x.  The second is the flux u³∇p of that film under the Hertz pressure, taken off the Couette flux.

    Parameters
    ----------
    x, y : array_like
        Place, r < 1 and away from the edge by much more than β^(−2/5); the inlet is at x > 0.
    beta : float
        Eq. (6d).
    terms : {1, 2}
        Number of terms.
    """
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    half_chord = np.sqrt(1 - y**2)
    film = film_constant() * beta**-0.6 * half_chord**0.6
    if _terms(terms) == 1:
        return film + 0 * x
    along = x / (half_chord**2 * np.sqrt(half_chord**2 - x**2))
    across = (1 - 9 / 5 * (y / half_chord) ** 2) * np.arccos(x / half_chord)
    return film * (1 + beta * HERTZ_PRESSURE * film**2 * (along - across))


def film_center_asymptote(beta: ArrayLike, terms: int = 2) -> Array:
    """Film at the centre as β → ∞: c β^(−3/5) (1 − (c²/π) β^(−1/5)).

    Parameters
    ----------
    beta : array_like
        Eq. (6d).
    terms : {1, 2}
        Number of terms.
    """
    beta, c = np.asarray(beta, dtype=float), film_constant()
    second = c**2 / np.pi * beta**-0.2 if _terms(terms) == 2 else 0.0
    return c * beta**-0.6 * (1 - second)


def film_center_power_law(beta: ArrayLike, index: float, slide_to_roll: float = 2.0) -> Array:
    """Film of a power-law liquid at the centre as β → ∞, the leading term c β^(−3/(3n+2)).

    What is left out falls like β^(−1/(3n+2)) relative to it; in pure rolling like β^(−1/(n(3n+2))) for n > 1/2, and like
    β^(−2/(3n+2)) below.

    Parameters
    ----------
    beta : array_like
        Eq. (6d), with the viscosity as in `film_constant`.
    index, slide_to_roll
        See `film_constant`.
    """
    return film_constant(index, slide_to_roll) * np.asarray(beta, dtype=float) ** (-3 / (3 * index + 2))


def film_inlet_asymptote(beta: ArrayLike, terms: int = 2) -> Array:
    """Film at the inlet, r = 1 and θ = 0, as β → ∞: 2.49548 β^(−3/5) (1 − 0.26344 β^(−1/5)).

    The second term is the contact's growth: the film that props up the sphere moves the edge outwards by (c/2) G β^(−3/5),
    G = −B(−1/4, 13/10)/4, so that r = 1 lies a little further inside the layer.

    Parameters
    ----------
    beta : array_like
        Eq. (6d).
    terms : {1, 2}
        Number of terms.
    """
    from scipy.special import beta as euler_beta

    from softlube.theory.inlet import inlet

    beta, layer, h = np.asarray(beta, dtype=float), inlet(), 1e-3
    film = layer.film_at(0.0)
    if _terms(terms) == 2:
        shift = -film_constant() * euler_beta(-0.25, 1.3) / 8 * EDGE_PRESSURE**1.2 * beta**-0.2
        film = film + shift * (layer.film_at(h) - layer.film_at(-h)) / (2 * h)
    return EDGE_PRESSURE**-0.8 * film * beta**-0.6


def pressure_gradient_inlet_asymptote(beta: ArrayLike) -> Array:
    """Largest |dp/dr| on the inlet axis as β → ∞, 0.1208918771 β^(1/5).

    The unit is that of the pressure p̄; divided by `HERTZ_PRESSURE` it is 0.596578 β^(1/5), to compare with Eq. (20).
    """
    from softlube.theory.inlet import inlet

    return EDGE_PRESSURE**1.6 * inlet().gradient_max * np.asarray(beta, dtype=float) ** 0.2


@cache
def outlet_film_ratio(cavitation: str = "reynolds") -> float:
    """Minimum film on the outlet axis over the film at the centre as β → ∞.

    Parameters
    ----------
    cavitation : {"reynolds", "none"}
        With the Reynolds condition (0.7962020560), or a film that stays full (0.7580100432).
    """
    from softlube.theory.inlet import outlet

    solution = outlet(cavitation)
    return solution.film_min / solution.film_inside


@cache
def outlet_film_exponent(cavitation: str = "reynolds") -> float:
    """Logarithmic slope d ln(minimum film)/d ln(film sent) at the outlet on the axis."""
    from softlube.theory.inlet import outlet

    inside, h = outlet(cavitation).film_inside, 0.01
    by_step = [np.log(outlet(cavitation, inside * np.exp(k * h)).film_min) for k in (-2, -1, 1, 2)]
    return float((by_step[0] - 8 * by_step[1] + 8 * by_step[2] - by_step[3]) / (12 * h))


def film_outlet_min_asymptote(beta: ArrayLike, cavitation: str = "reynolds", terms: int = 2) -> Array:
    """Minimum film on the outlet axis as β → ∞.

    The second term has the film that reaches the outlet, which has lost twice what it lost up to the centre.

    Parameters
    ----------
    beta : array_like
        Eq. (6d).
    cavitation : {"reynolds", "none"}
        Behind the contact.
    terms : {1, 2}
        Number of terms.
    """
    beta, c = np.asarray(beta, dtype=float), film_constant()
    lost = 2 * c**2 / np.pi * beta**-0.2 * outlet_film_exponent(cavitation) if _terms(terms) == 2 else 0.0
    return outlet_film_ratio(cavitation) * c * beta**-0.6 * (1 - lost)


def friction_contact_asymptote(beta: ArrayLike, terms: int = 2) -> Array:
    """Friction force over r ≤ 1 as β → ∞, in units of (2π/3) G h₀².

    (2/c) B(1/2, 6/5) β^(−2/5) − (c/4π) B(1/2, 9/5) β^(−3/5), all of it Couette shear under the film of
    `film_contact_asymptote`.  The Poiseuille part, like that of the layers at the edge, is O(β^(−4/5)).

    Parameters
    ----------
    beta : array_like
        Eq. (6d).
    terms : {1, 2}
        Number of terms.
    """
    from scipy.special import beta as euler_beta

    beta, c = np.asarray(beta, dtype=float), film_constant()
    second = c / (4 * np.pi) * euler_beta(0.5, 1.8) * beta**-0.6 if _terms(terms) == 2 else 0.0
    return 2 / c * euler_beta(0.5, 1.2) * beta**-0.4 - second


SIDE_FILM = {"reynolds": 0.458965, "none": 0.454036}
"""Minimum film of the side problem in its own units, `softlube.side.side_film` at τ = `SIDE_TIME`; correct to 5e-6.

Kept here because the march takes seconds; tests/theory/test_side.py repeats it."""
SIDE_TIME = {"reynolds": 0.5290, "none": 0.6377}
"""Time τ, the angle behind 90° in units of (βA³)^(−1/4), at which the side problem has its minimum film."""


def _side(table: dict[str, float], cavitation: str) -> float:
    if cavitation not in table:
        raise ValueError(f'cavitation: expected "reynolds" or "none", got {cavitation!r}')
    return table[cavitation]


def film_min_asymptote(beta: ArrayLike, cavitation: str = "reynolds") -> Array:
    """Minimum film as β → ∞: 2.1889 β^(−3/4), in the side lobes; 2.1654 without the Reynolds condition.

    What is left out falls like β^(−1/2) ln β, with a large coefficient: 8 % at β = 10⁴.

    Parameters
    ----------
    beta : array_like
        Eq. (6d).
    cavitation : {"reynolds", "none"}
        Behind the contact.
    """
    return EDGE_PRESSURE**-1.25 * _side(SIDE_FILM, cavitation) * np.asarray(beta, dtype=float) ** -0.75


def film_min_angle_asymptote(beta: ArrayLike, cavitation: str = "reynolds") -> Array:
    """Angle of the minimum film from the inlet as β → ∞, in degrees: 90° + 77.4° β^(−1/4).

    Parameters
    ----------
    beta : array_like
        Eq. (6d).
    cavitation : {"reynolds", "none"}
        Behind the contact.
    """
    return 90 + np.degrees(EDGE_PRESSURE**-0.75 * _side(SIDE_TIME, cavitation)) * np.asarray(beta, dtype=float) ** -0.25


def load_asymptote(beta: ArrayLike, terms: int = 2) -> Array:
    """Load as β → ∞: 4/(3π) + (c/π) B(1/2, 13/10) β^(−3/5), and O(β^(−4/5)) left out.

    By reciprocity with the flat punch, whose pressure is 1/(π²√(1 − r²)) per unit of depth: the film acts like a deeper
    indentation by its own thickness.

    Parameters
    ----------
    beta : array_like
        Eq. (6d).
    terms : {1, 2}
        Number of terms.
    """
    from scipy.special import beta as euler_beta

    beta = np.asarray(beta, dtype=float)
    return HERTZ_LOAD + (film_constant() / np.pi * euler_beta(0.5, 1.3) * beta**-0.6 if _terms(terms) == 2 else 0 * beta)
