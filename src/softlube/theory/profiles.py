"""Laws of the Hertz limit β → ∞ for any axisymmetric indenter, on any substrate.

Inside the contact the pressure is the dry contact's, and close to its edge p = A√s at a distance s from it.  The inlet's
similarity problem has no other number of the contact than A and β, the side problem has A, β and the radius a of the edge.
So the constants of the paraboloid hold for every indenter, with A = (2/π²) √(2a) `DryContact.edge_rise`:

    film at the centre   u₀ = i A^(−4/5) β^(−3/5)         i = film inside in `softlube.inlet`
    minimum film         s A^(−5/4) a^(−3/8) β^(−3/4)    s from the side problem, `softlube.side`

and the film inside goes like (1 − (y/a)²)^(3/10).  The second term of the film at the centre is the flux that the dry pressure
drives, u₀ [1 + β u₀² ∫₀^a p′(r)/r dr].  Everything is normalised like the dry contact (`softlube.dry`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.model.dry import DryContact
from softlube.theory import limits

Array = NDArray[np.floating]

NEAR_AXIS = 1e-4
"""Distance from the axis over the contact's radius at which φ′(s)/s is read as its limit: it is even in s there."""


def film_center(dry: DryContact, beta: ArrayLike, terms: int = 2) -> Array:
    """Film at the centre as β → ∞, with the term that the dry pressure's gradient adds or without.

    Parameters
    ----------
    dry : DryContact
        The contact without the film; its profile must be smooth, or the second term has no meaning.
    beta : array_like
        Eq. (6d).
    terms : {1, 2}
        Number of terms.  What is left out of two is O(β^(−2/5) ln β) of the first.
    """
    beta = np.asarray(beta, dtype=float)
    film = height_unit(dry) * limits.film_constant() * dry.like_hertz(1.0) ** -0.6 * beta**-0.6
    if terms == 1:
        return film
    return film * (1 + beta * film**2 * _driven(dry))


def film_contact(dry: DryContact, y: ArrayLike, beta: ArrayLike) -> Array:
    """Film inside the contact as β → ∞, u₀ (1 − (y/a)²)^(3/10), the same all along x: one term.

    Parameters
    ----------
    dry : DryContact
        The contact without the film.
    y : array_like
        Distance from the plane of symmetry, less than a.
    beta : array_like
        Eq. (6d).
    """
    return film_center(dry, beta, 1) * (1 - (np.asarray(y, dtype=float) / dry.radius) ** 2) ** 0.3


def film_min(dry: DryContact, beta: ArrayLike, cavitation: str = "reynolds") -> Array:
    """Minimum film as β → ∞, in the side lobes.

    Parameters
    ----------
    dry : DryContact
        The contact without the film.
    beta : array_like
        Eq. (6d).
    cavitation : {"reynolds", "none"}
        Behind the contact.
    """
    return height_unit(dry) * limits.film_min_asymptote(dry.like_hertz(1.0) * np.asarray(beta, dtype=float), cavitation)


def friction_contact(dry: DryContact, beta: ArrayLike) -> Array:
    """Friction force over r ≤ a as β → ∞, (2a²/(β u₀)) B(1/2, 6/5), in units of (2π/3) G h₀²: one term.

    Parameters
    ----------
    dry : DryContact
        The contact without the film.
    beta : array_like
        Eq. (6d).
    """
    from scipy.special import beta as euler_beta

    beta = np.asarray(beta, dtype=float)
    return 2 * dry.radius**2 * euler_beta(0.5, 1.2) / (beta * film_center(dry, beta, 1))


def height_unit(dry: DryContact) -> float:
    """Height that a film is compared with, A a^(3/2) over that of the unit Hertz contact: films over it are functions of β′."""
    return dry.edge_rise * dry.radius**2


def _driven(dry: DryContact) -> float:
    """∫₀^a p′(r)/r dr, which is π/2 times the limit of φ′(s)/s on the axis; −(π/2) p_max/a of the Hertz pressure.

    With ψ = φ′(s)/s and s² = r² + τ² the pressure is −∫ ψ(s) dτ over 0 ≤ τ ≤ √(a² − r²).  So the integral is ψ(a) π/2 less
    that of ψ′(s)/s over a quarter of the circle, (ψ(a) − ψ(0)) π/2.
    """
    s = NEAR_AXIS * dry.radius
    return float(np.pi / 2 * dry.slope(np.array([s]))[0] / s)
