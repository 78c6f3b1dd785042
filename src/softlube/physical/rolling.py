"""Frictions of a ball that rolls and slides, from those of a ball that slides without turning.

The film depends on the sum of the surface speeds alone, so that one solution holds for every slide-to-roll ratio S.  With the
Couette part C of the friction of a ball that does not turn, S = 2, and the Poiseuille part P, Eqs. (25) and (27a),

    total on the ball = C S/2 − P,      shear on the ball = C S/2 + P.

P is the same on both surfaces but for the sign, and does not depend on which of them slides.  The friction that a substrate
with a memory makes itself is added to the total as it is: it depends on how fast the substrate passes, not on the ball.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from softlube.model.motions import FIXED_BALL
from softlube.model.quantities import Quantity

OF_A_FIXED_BALL = ("friction_contact", "shear_rate_max")
"""Quantities that are not given at other ratios: a solution has not their two parts, but their sum."""


def at_slide_to_roll(quantities: Mapping[str, Quantity], slide_to_roll: float) -> dict[str, Quantity]:
    """Quantities at a slide-to-roll ratio.

    Parameters
    ----------
    quantities : mapping of str to Quantity
        Those of a ball that does not turn, S = 2.
    slide_to_roll : float
        S, see `softlube.Rolling`.

    Returns
    -------
    dict of str to Quantity
        `friction_total` and `friction_domain` at S, counted positive in the direction in which the liquid is carried; nan for
        `friction_contact` and `shear_rate_max`, whose Couette and Poiseuille parts a solution does not keep apart; the others
        as they are.
    """
    if slide_to_roll == FIXED_BALL:
        return dict(quantities)
    shear, by_substrate = quantities["friction_domain"], quantities.get("friction_hysteresis", Quantity(0.0, 0.0))
    viscous = quantities.get("friction_viscous", quantities["friction_total"])
    own, other = (slide_to_roll + FIXED_BALL) / (2 * FIXED_BALL), (slide_to_roll - FIXED_BALL) / (2 * FIXED_BALL)

    def mixed(one: Quantity, two: Quantity) -> Quantity:
        return Quantity(own * one + other * two, abs(own) * one.error + abs(other) * two.error, one.unit)

    missing = {name: Quantity(np.nan, np.nan, quantities[name].unit) for name in OF_A_FIXED_BALL if name in quantities}
    rolling = mixed(viscous, shear)
    total = Quantity(rolling + by_substrate, rolling.error + by_substrate.error, shear.unit)
    found = dict(quantities) | missing | {"friction_total": total, "friction_domain": mixed(shear, viscous)}
    return found | ({"friction_viscous": rolling} if "friction_viscous" in quantities else {})
