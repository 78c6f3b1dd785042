"""Exact solutions and limits, normalised as in the paper: the tests and the solver's first guess rest on them."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.floating]

HERTZ_LOAD = 4 / (3 * np.pi)
"""Load of the Hertz contact, ∫p dA in units of 4πG|h₀|√(R|h₀|); Eq. (5b) with (4)."""

HERTZ_PRESSURE = 2 / np.pi**2
"""Maximum pressure of the Hertz contact in units of 4πG√(|h₀|/R); Eq. (7a)."""


def hertz_indentation(load: Any, radius: Any, shear_modulus: Any, *, power: float = 1.0) -> Any:
    """Indentation of a dry Hertz contact in SI, δ = (3N/(16G√R))^(2/3), Eq. (29).

    Parameters
    ----------
    load : float or ndarray
        Normal load N [N].
    radius : float or ndarray
        Radius R of the sphere [m].
    shear_modulus : float or ndarray
        G of an incompressible half-space; E*/4 of any other [Pa].
    power : float
        Power of δ that is returned: 2 for the unit of friction, (2π/3) G δ².
    """
    return (3 * load / (16 * shear_modulus * np.sqrt(radius))) ** (2 * power / 3)


def hertz_pressure(r: ArrayLike, radius: ArrayLike = 1.0) -> Array:
    """Pressure of a dry Hertz contact of the given contact radius, Eq. (7).

    Parameters
    ----------
    r : array_like
        Distance from the axis.
    radius : array_like
        Contact radius, broadcast with r; 1 is the contact of unit indentation.
    """
    r = np.asarray(r, dtype=float)
    return HERTZ_PRESSURE * np.sqrt(np.maximum(np.square(radius) - r**2, 0))


def hertz_displacement(r: ArrayLike, radius: float = 1.0) -> Array:
    """Surface displacement w under `hertz_pressure`, inside and outside the contact (Johnson 1985, §3.4)."""
    r = np.asarray(r, dtype=float) / radius
    outside = np.maximum(r, 1)
    tail = -((2 - outside**2) * np.arcsin(1 / outside) + np.sqrt(outside**2 - 1)) / np.pi
    return radius**2 * np.where(r <= 1, -1 + r**2 / 2, tail)


def disc_displacement(r: ArrayLike, radius: float = 1.0) -> Array:
    """Surface displacement under unit pressure on a disc, by complete elliptic integrals (Johnson 1985, §3.4)."""
    from scipy.special import ellipe, ellipk

    r = np.asarray(r, dtype=float) / radius
    inside = 4 * ellipe(np.minimum(r, 1) ** 2)
    far = np.maximum(r, 1)
    outside = 4 * far * (ellipe(1 / far**2) - (1 - 1 / far**2) * ellipk(np.minimum(1 / far**2, 1 - 1e-16)))
    return -radius * np.where(r <= 1, inside, outside)


def kapitza_pressure(r: ArrayLike, theta: ArrayLike, beta: float, gap: float) -> Array:
    """Pressure under a rigid sphere (w = 0) without cavitation, p = x/(5βu²) with u = gap + r²/2, exactly (Kapitza 1955).

    Parameters
    ----------
    r, theta : array_like
        Polar coordinates, θ = 0 at the inlet.
    beta : float
        Eq. (6d).
    gap : float
        Film thickness on the axis, positive.
    """
    r = np.asarray(r, dtype=float)
    return r * np.cos(theta) / (5 * beta * (gap + r**2 / 2) ** 2)


def half_sommerfeld_load(beta: float, gap: float) -> float:
    """Load of `kapitza_pressure` over x > 0, its positive half: 2π/(5β√(2 gap))."""
    return 2 * np.pi / (5 * beta * np.sqrt(2 * gap))


@cache
def far_front_angle() -> float:
    """Angle of the far free boundary, in radians from the inlet.

    Far from the contact u → r²/2 and Eq. (A2) has the solutions p = f(θ)/(βr³) with f″ − 9f = −8 cos θ.  Under the Reynolds
    condition f and f′ vanish at a ray, where tan θ = −3 tanh 3θ: 108.4° from the inlet.
    """
    low, high = np.pi / 2 + 0.1, np.pi - 0.1
    for _ in range(60):
        middle = (low + high) / 2
        if np.tan(middle) + 3 * np.tanh(3 * middle) < 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def far_field_profile(theta: ArrayLike, cavitation: str = "reynolds") -> Array:
    """Angular profile f of the far pressure p = f(θ)/(βr³).

    Without cavitation f = (4/5) cos θ, Eqs. (9) and (A3).  With the Reynolds condition the same equation (A2) holds only up
    to the free boundary `far_front_angle`, beyond which f = 0.
    """
    theta = np.asarray(theta, dtype=float)
    if cavitation == "none":
        return 0.8 * np.cos(theta)
    front = far_front_angle()
    reflected = np.abs(theta)
    wet = np.minimum(reflected, front)
    return 0.8 * (np.cos(wet) - np.cos(front) * np.cosh(3 * wet) / np.cosh(3 * front))


LINE_LOAD = 1 / 4
"""Load over the length of a cylinder's Hertz contact, over 4πG b²/R, with b half its width."""
