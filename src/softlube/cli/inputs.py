"""The options that several commands share: the physical contact, and which contact to read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from cyclopts import Group, Parameter

if TYPE_CHECKING:
    from softlube.solvers.progress import Listener
    from softlube.steady.solution import Solution

PHYSICAL = Group("Physical contact (text with units, such as '2 mm')", sort_key=1)
GIVEN = Group("Solved or dimensionless contact", sort_key=0)
# A negative number is a value, to be refused with the reason, and not an option.
Physical = Annotated[str | None, Parameter(group=PHYSICAL, allow_leading_hyphen=True)]


@Parameter(name="*")
@dataclass(frozen=True)
class Bodies:
    """Sphere, substrate and liquid.

    Parameters
    ----------
    radius
        Radius of the sphere, such as "2 mm".
    young_modulus
        Young's modulus of the substrate, such as "3 MPa".
    shear_modulus
        Shear modulus instead, such as "1 MPa".
    viscosity
        Dynamic viscosity of the liquid, such as "2 Pa s".
    thickness
        Thickness of the substrate, a layer on a rigid base, such as "2 mm" [default: a half-space].
    poisson_ratio
        Poisson's ratio of the substrate, 0 to 0.5 [default: 0.5].
    base
        How a layer lies on its base, "bonded" or "frictionless" [default: bonded].
    pressure_viscosity
        Pressure-viscosity coefficient, such as "20 GPa^-1" [default: constant viscosity].
    viscosity_law
        "barus" or "roelands" [default: barus].
    density_law
        "constant" or "dowson-higginson" [default: constant].
    """

    radius: Physical = None
    young_modulus: Physical = None
    shear_modulus: Physical = None
    viscosity: Physical = None
    thickness: Physical = None
    poisson_ratio: Physical = None
    base: Physical = None
    pressure_viscosity: Physical = None
    viscosity_law: Physical = None
    density_law: Physical = None

    def given(self) -> dict[str, str]:
        """The options that were given, by the names of `softlube.Contact`."""
        return {name: value for name, value in vars(self).items() if value is not None}


@Parameter(name="*")
@dataclass(frozen=True)
class Sliding(Bodies):
    """A sphere that slides steadily.

    Parameters
    ----------
    speed
        Sliding speed, such as "0.1 mm/s".
    load
        Normal load, such as "100 mN".
    indentation
        Depth of the sphere's lowest point below the undeformed surface instead, such as "50 um"; "-1 um" is a gap.
    """

    speed: Physical = None
    load: Physical = None
    indentation: Physical = None


@Parameter(name="*")
@dataclass(frozen=True)
class Which:
    """One contact, to be solved or read.

    Parameters
    ----------
    solution
        NetCDF file written by `softlube solve --output`.
    beta
        β = (2/3)(h0²/R) πG/(ηv) of a dimensionless contact.
    contact
        A physical contact.
    cavitation
        "reynolds" (no negative pressure) or "none".
    """

    solution: Annotated[str | None, Parameter(group=GIVEN)] = None
    beta: Annotated[float | None, Parameter(group=GIVEN)] = None
    contact: Sliding | None = None
    cavitation: Annotated[str | None, Parameter(group=GIVEN)] = None

    def get(self, progress: Listener | None = None) -> Solution:
        """The solution, read or solved.

        Raises
        ------
        InputError
            If not exactly one way of naming a contact is used.
        """
        from softlube.errors import InputError

        physical = (self.contact or Sliding()).given()
        ways = [name for name in ("solution", "beta") if getattr(self, name) is not None] + list(physical)[:1]
        if not ways:
            raise InputError("solution: missing; give --solution, --beta, or a physical contact (--radius, …); see --help")
        if len(ways) > 1:
            raise InputError(f"{', '.join(ways)}: give one contact, not several")
        if self.solution is not None:
            if self.cavitation is not None:
                raise InputError("cavitation: the solution has its own; leave it out")
            from softlube.files.netcdf import load

            return load(self.solution)
        cavitation = self.cavitation or "reynolds"
        if physical:
            from softlube.physical.contact import Contact

            return Contact(**physical, cavitation=cavitation).solve(progress=progress)
        from softlube.steady.ladder import solve

        return solve(self.beta, cavitation=cavitation, progress=progress)
