"""A tribometer's contact: two elastic bodies, both surfaces moving, brought to the sphere on a half-space that is solved.

Only what the equations see of the two bodies is left of them.  The gap is that of one sphere of the reduced radius, the
deformation that of one half-space of the reduced modulus, 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂; for the paper's pair E* = 4G.
Reynolds' equation sees the sum of the surface speeds in place of v, and the Couette shear their difference.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from softlube.errors import InputError
from softlube.model.problem import Cavitation
from softlube.physical.contact import Contact
from softlube.physical.inputs import declared
from softlube.physical.units import to_si


@dataclass(frozen=True, init=False)
class Rig:
    """A ball against a substrate with liquid between; lengths and moduli as text with units, pint quantities or SI numbers.

    Parameters
    ----------
    radius : str, float or pint.Quantity
        Radius R₁ of the ball.
    young_modulus : str, float or pint.Quantity
        E₂ of the substrate.
    viscosity : str, float or pint.Quantity
        Dynamic viscosity of the liquid.
    poisson_ratio : float
        ν₂ of the substrate; 1/2, incompressible, as in the paper.
    ball_young_modulus : str, float or pint.Quantity, optional
        E₁ of the ball; rigid if not given.
    ball_poisson_ratio : float
        ν₁ of the ball.
    substrate_radius : str, float or pint.Quantity, optional
        Radius R₂ of a substrate that is a ball, too; flat if not given.
    cavitation : {"reynolds", "none"}
        See `softlube.Contact`.

    Attributes
    ----------
    reduced_radius : float
        R with 1/R = 1/R₁ + 1/R₂ [m].
    reduced_modulus : float
        E* [Pa].

    Raises
    ------
    InputError
        If an input is not positive and finite or of the wrong dimension, or a Poisson ratio not between −1 and 1/2.

    Examples
    --------
    >>> rig = Rig(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s")
    >>> contact = rig.contact(load="100 mN", entrainment_speed="0.05 mm/s")
    >>> round(contact.problem().beta_load)  # the substrate at rest and the ball at 0.1 mm/s
    16430
    """

    reduced_radius: float
    reduced_modulus: float
    viscosity: float
    cavitation: Cavitation

    def __init__(
        self,
        *,
        radius: object,
        young_modulus: object,
        viscosity: object,
        poisson_ratio: float = 0.5,
        ball_young_modulus: object = None,
        ball_poisson_ratio: float = 0.5,
        substrate_radius: object = None,
        cavitation: Cavitation = "reynolds",
    ) -> None:
        for name, value in (("poisson_ratio", poisson_ratio), ("ball_poisson_ratio", ball_poisson_ratio)):
            if isinstance(value, (bool, str)) or not -1 < value <= 0.5:
                raise InputError(f"{name}: expected a number above -1 and up to 0.5, got {value!r}")
        for name, value in (("radius", radius), ("young_modulus", young_modulus), ("viscosity", viscosity)):
            if value is None:
                raise InputError(f"{name}: missing")
        curvature = 1 / to_si("radius", radius)
        if substrate_radius is not None:
            curvature += 1 / declared()["radius"].read(substrate_radius, "substrate_radius")
        compliance = (1 - poisson_ratio**2) / to_si("young_modulus", young_modulus)
        if ball_young_modulus is not None:
            ball = declared()["young_modulus"].read(ball_young_modulus, "ball_young_modulus")
            compliance += (1 - ball_poisson_ratio**2) / ball
        object.__setattr__(self, "reduced_radius", 1 / curvature)
        object.__setattr__(self, "reduced_modulus", 1 / compliance)
        object.__setattr__(self, "viscosity", to_si("viscosity", viscosity))
        object.__setattr__(self, "cavitation", cavitation)

    @property
    def shear_modulus(self) -> float:
        """G of the incompressible half-space that yields as both bodies together, E*/4 [Pa]."""
        return self.reduced_modulus / 4

    def contact(self, *, load: object, entrainment_speed: object) -> Contact:
        """The sphere on a half-space with the same film.

        Parameters
        ----------
        load : str, float or pint.Quantity
            Normal load.
        entrainment_speed : str, float or pint.Quantity
            Mean of the surface speeds, (v₁ + v₂)/2.  The film does not depend on which surface moves.
        """
        return Contact(
            radius=self.reduced_radius,
            shear_modulus=self.shear_modulus,
            viscosity=self.viscosity,
            speed=2 * to_si("entrainment_speed", entrainment_speed),
            load=to_si("load", load),
            cavitation=self.cavitation,
        )

    def hersey(self, load: float, entrainment_speed: float) -> float:
        """Hersey number η U R/N, dimensionless, with the entrainment speed U and the reduced radius R."""
        return self.viscosity * entrainment_speed * self.reduced_radius / load


def hertz_force(contact: Contact) -> float:
    """Unit of a friction under load control, (2π/3) G δ² with the Hertz indentation δ of the load, Eq. (26) [N]."""
    return 2 * math.pi / 3 * contact.contact_modulus * contact.unit_height**2
