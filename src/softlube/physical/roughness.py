"""Rough surfaces: the ratio λ of the minimum film to the roughness, and what it says of lubrication."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from softlube.model.quantities import Quantity

FULL_FILM, MIXED = 3.0, 1.0
"""λ from which on the film parts the surfaces, and below which asperities carry most of the load (Hamrock, Schmid & Jacobson
2004, Fundamentals of Fluid Film Lubrication, ch. 3)."""
REGIMES = ("full film", "mixed", "boundary")


def lubrication(ratio: float) -> str:
    """Regime of lubrication for a ratio λ: "full film" from 3, "mixed" from 1, "boundary" below; empty for nan."""
    if np.isnan(ratio):
        return ""
    return REGIMES[0] if ratio >= FULL_FILM else REGIMES[1] if ratio >= MIXED else REGIMES[2]


def lambda_ratio(dimensional: Mapping[str, Quantity], roughness: float) -> Quantity:
    """λ, the minimum film over the roughness.

    Parameters
    ----------
    dimensional : mapping of str to Quantity
        Quantities in SI.  Where `film_min` is not given, the minimum on the outlet axis takes its place.
    roughness : float
        Root mean square roughness of both surfaces together [m].
    """
    film = dimensional["film_min"] if np.isfinite(dimensional["film_min"]) else dimensional["film_outlet_min"]
    return film.scaled(1 / roughness)
