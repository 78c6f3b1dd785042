"""How far a substrate that creeps has yielded under a pressure or a load whose course is known beforehand."""

from __future__ import annotations

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from softlube.model.creep import Creep
from softlube.transient.squeeze.rings import Control

Array = NDArray[np.floating]

FROM = 10.0
"""Height over that at the start from which a sphere has come down: its pressure then was spread within the grid's reach."""
POINTS, LONGEST = 64, 40.0
"""Points of Gauss's quadrature over the past, and how many times τ it goes back at most; good to 10⁻¹²."""


def taken_up(creep: Creep, control: Control, speed: float, height: float, shape: Array) -> Array:
    """Share of the pressure at the start that each term of the creep has taken up, shape (m, N).

    A sphere has come down from ten times its height at the speed, or under the load, of the start.  Its pressure has grown as
    under a rigid sphere, p ∝ V/u² at a speed V and p ∝ N h₀/u² under a load N, over the film u = h₀ + f.  A term of time τ has
    taken up

        ∫ e^(−s) p(−τs)/p(0) ds     from s = 0 to that height.

    Parameters
    ----------
    creep : Creep
        The substrate's.
    control : {"load", "height"}
        Whether h₀ has fallen exponentially, under a load, or at a constant speed.
    speed : float
        Speed of approach at the start; a sphere that does not come down has left nothing.
    height : float
        h₀ at the start.
    shape : ndarray, shape (N,)
        Height f of the indenter's surface over its lowest point.
    """
    shares = np.zeros((len(creep.terms), shape.size))
    if speed <= 0 or not creep.terms:
        return shares
    x, weight = leggauss(POINTS)
    by_load = control == "load"
    for term, share in zip(creep.terms, shares, strict=True):
        sunk = term.time * speed / height
        length = min((np.log(FROM) if by_load else FROM - 1) / sunk, LONGEST)
        s = length * (1 + x[:, None]) / 2
        before = height * (np.exp(sunk * s) if by_load else 1 + sunk * s)
        grown = (before if by_load else height) * ((height + shape) / (before + shape)) ** 2 / height
        share[:] = length / 2 * weight @ (np.exp(-s) * grown)
    return shares


def relaxed_loads(creep: Creep, first: Array, loads: Array, step: float) -> Array:
    """Loads that press the relaxed substrate as far as the given ones have pressed the one that creeps, shape (k,).

    They are ∫J(t − s) dN(s), which is true of a dry contact as long as it grows (Lee & Radok 1960).

    Parameters
    ----------
    creep : Creep
        The substrate's.
    first : ndarray, shape (m,)
        Share of the first load that each term has taken up at first.
    loads : ndarray, shape (k,)
        At even times.
    step : float
        Between these times.
    """
    if not creep.terms:
        return loads
    shares, times = (np.array([getattr(term, name) for term in creep.terms]) for name in ("weight", "time"))
    kept = np.exp(-step / times)
    taken = [first * loads[0]]
    for load in (loads[:-1] + loads[1:]) / 2:
        taken.append(kept * taken[-1] + (1 - kept) * load)
    return creep.instantaneous * loads + np.array(taken) @ shares
