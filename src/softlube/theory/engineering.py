"""Film-thickness formulas that a practitioner knows, in their own parameters, and the way from β to those.

With E′ = 2E/(1 − ν²) = 8G (rigid sphere on an incompressible half-space) and the entrainment speed ũ, the mean of the surface
speeds (v/2 here, one surface sliding):

- Hamrock & Dowson: U = ηũ/(E′R), W = N/(E′R²), H = h/R;
- Moes: M = W (2U)^(−3/4), L = αE′ (2U)^(1/4), H = (h/R)(2U)^(−1/2).

M and Moes' H are functions of β alone for an iso-viscous liquid (L = 0).  Hamrock & Dowson's exponents do not quite keep that
similarity: at one M their film in Moes' H varies as U^(−0.025) (centre) or U^(−0.0075) (minimum).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.floating]

BETA_LOAD_OF_M = (4 * np.pi / 3) * (3 / 16) ** (4 / 3)
"""β_load = BETA_LOAD_OF_M · M^(4/3), from Eq. (30)."""


@dataclass(frozen=True)
class Source:
    """Where a formula comes from, and for what it was made."""

    name: str
    reference: str
    range: str


HAMROCK_DOWSON = Source(
    "Hamrock & Dowson, soft EHL",
    "B. J. Hamrock, D. Dowson, Elastohydrodynamic lubrication of elliptical contacts for materials of low elastic modulus I: "
    "fully "
    "flooded conjunction, J. Lubr. Technol. 100 (1978) 236-245",
    "U of 5e-9 to 5e-8, W of 2e-4 to 2e-3, ellipticity 1 to 12 (about one decade of U and W)",
)
NIJENBANNING_VENNER_MOES = Source(
    "Nijenbanning, Venner & Moes",
    "G. Nijenbanning, C. H. Venner, H. Moes, Film thickness in elastohydrodynamically lubricated elliptic contacts, Wear 176 "
    "(1994) 217-229",
    "all M and L: joins the rigid and the elastic, the iso-viscous and the piezo-viscous asymptotes; centre film only",
)
HAMROCK_DOWSON_HARD = Source(
    "Hamrock & Dowson, hard EHL",
    "B. J. Hamrock, D. Dowson, Isothermal elastohydrodynamic lubrication of point contacts III: fully flooded results, "
    "J. Lubr. Technol. 99 (1977) 264-276",
    "34 computed cases with compressible liquids",
)
SPEEDS_OF_HAMROCK_DOWSON = (5e-9, 5e-8)
LOADS_OF_HAMROCK_DOWSON = (2e-4, 2e-3)


def hamrock_dowson_center(speed: ArrayLike, load: ArrayLike, ellipticity: float = 1.0) -> Array:
    """Centre film h/R = 7.32 (1 − 0.72 e^(−0.28k)) U^0.64 W^(−0.22) of soft contacts, Hamrock & Dowson 1978.

    Parameters
    ----------
    speed, load : array_like
        U = ηũ/(E′R) and W = N/(E′R²).
    ellipticity : float
        k, 1 for a circular contact.
    """
    shape = 7.32 * (1 - 0.72 * np.exp(-0.28 * ellipticity))
    return shape * np.asarray(speed, dtype=float) ** 0.64 * np.asarray(load, dtype=float) ** -0.22


def hamrock_dowson_min(speed: ArrayLike, load: ArrayLike, ellipticity: float = 1.0) -> Array:
    """Minimum film h/R = 7.43 (1 − 0.85 e^(−0.31k)) U^0.65 W^(−0.21) of soft contacts, Hamrock & Dowson 1978."""
    shape = 7.43 * (1 - 0.85 * np.exp(-0.31 * ellipticity))
    return shape * np.asarray(speed, dtype=float) ** 0.65 * np.asarray(load, dtype=float) ** -0.21


def hamrock_dowson_hard_center(m: ArrayLike, material: ArrayLike, speed: float = 1e-11, ellipticity: float = 1.03) -> Array:
    """Centre film of hard contacts, 2.69 (1 − 0.61 e^(−0.73k)) U^0.67 G^0.53 W^(−0.067) in Moes' H, Hamrock & Dowson 1977.

    Parameters
    ----------
    m, material : array_like
        Moes' M = W (2U)^(−3/4) and L = G (2U)^(1/4), where G = αE′.
    speed : float
        U = ηũ/(E′R).  Moes' parameters leave it free, and the formula keeps their similarity only roughly: H goes like
        U^(−0.013).
    ellipticity : float
        k, 1.03 for a circular contact in their formula for k.
    """
    factor = 2.69 * (1 - 0.61 * np.exp(-0.73 * ellipticity))
    return _hard(m, material, speed, factor, (0.67, 0.53, -0.067))


def hamrock_dowson_hard_min(m: ArrayLike, material: ArrayLike, speed: float = 1e-11, ellipticity: float = 1.03) -> Array:
    """Minimum film of hard contacts, 3.63 (1 − e^(−0.68k)) U^0.68 G^0.49 W^(−0.073), like `hamrock_dowson_hard_center`."""
    factor = 3.63 * (1 - np.exp(-0.68 * ellipticity))
    return _hard(m, material, speed, factor, (0.68, 0.49, -0.073))


def _hard(m: ArrayLike, material: ArrayLike, speed: float, factor: float, exponents: tuple[float, float, float]) -> Array:
    """A power law in U, G and W, in Moes' parameters: W = M (2U)^(3/4), G = L (2U)^(−1/4), H = (h/R)(2U)^(−1/2)."""
    in_speed, in_material, in_load = exponents
    load, pressure = np.asarray(m, dtype=float) * (2 * speed) ** 0.75, np.asarray(material, dtype=float) * (2 * speed) ** -0.25
    return factor * speed**in_speed * pressure**in_material * load**in_load * (2 * speed) ** -0.5


def nijenbanning_venner_moes(m: ArrayLike, material: ArrayLike = 0.0, ratio: float = 1.0) -> Array:
    """Centre film in Moes' parameters, H = (h/R)(2U)^(−1/2), Nijenbanning, Venner & Moes 1994.

    Parameters
    ----------
    m, material : array_like
        Moes' load M and material parameter L; L = 0 is the iso-viscous liquid.
    ratio : float
        Ratio of the radii of curvature, R_x/R_y; 1 for a sphere.
    """
    m, material = np.broadcast_arrays(np.asarray(m, dtype=float), np.asarray(material, dtype=float))
    bracket = 1 + 0.006 * np.log(ratio) + 0.63 * ratio ** (4 / 7)
    rigid = 145 * (1 + 0.796 * ratio ** (14 / 15)) ** (-15 / 7) / ratio / m**2
    elastic = 3.18 * bracket ** (-14 / 25) * ratio ** (-1 / 15) * m ** (-2 / 15)
    iso_viscous = rigid**1.5 + (elastic**-4 + (1.8 / ratio) ** -4) ** (-3 / 8)
    if not np.any(material):
        return iso_viscous ** (2 / 3)
    rigid_piezo = 1.29 * (1 + 0.691 * ratio) ** (-2 / 3) * material ** (2 / 3)
    elastic_piezo = 1.48 * bracket ** (-7 / 20) * ratio ** (-1 / 24) * m ** (-1 / 12) * material**0.75
    s = 1.5 * (1 + np.exp(-1.2 * elastic / np.maximum(elastic_piezo, 1e-300)))
    piezo = np.maximum(rigid_piezo, 1e-300) ** -8 + np.maximum(elastic_piezo, 1e-300) ** -8
    return (iso_viscous ** (2 * s / 3) + piezo ** (-s / 8)) ** (1 / s)


def moes_load(beta_load: ArrayLike) -> Array:
    """Moes' load parameter M of a β by the load, Eq. (30)."""
    return (np.asarray(beta_load, dtype=float) / BETA_LOAD_OF_M) ** 0.75


def alpha_of_moes(m: ArrayLike, material: ArrayLike) -> Array:
    """ᾱ of `softlube.model.liquids.BarusLaw` under a prescribed load, from Moes' M and L: (π/2)(3M/2)^(1/3) L.

    From ᾱ = 4πGα√(δ/R) with δ of Eq. (29), E′ = 8G.
    """
    return np.pi / 2 * np.cbrt(1.5 * np.asarray(m, dtype=float)) * np.asarray(material, dtype=float)


def moes_film(film: ArrayLike, beta: ArrayLike) -> Array:
    """Moes' film parameter H = (h/R)(2U)^(−1/2) of a film ū = u/|h₀| at β of Eq. (6d)."""
    return np.asarray(film, dtype=float) * np.sqrt(12 * np.asarray(beta, dtype=float) / np.pi)
