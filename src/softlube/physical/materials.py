"""Sphere, substrate and liquid in SI: what a contact has whatever moves the sphere; Eqs. (4), (6d), (29).

For the paper's pair, a rigid sphere on an incompressible half-space, E* = 4G.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from softlube.errors import InputError
from softlube.model.dry import PARABOLOID, DryContact, dry_contact_at
from softlube.model.exact import HERTZ_LOAD, hertz_indentation
from softlube.model.indenters import IndenterPart, Shape
from softlube.model.liquids import DensityPart, Liquid, Lubricant
from softlube.model.liquids.newtonian import NewtonianLaw
from softlube.model.parts import Part, vocabulary
from softlube.model.substrates import HalfSpaceKernel, Substrate, SubstratePart
from softlube.model.substrates.layer import LayerKernel

LARGEST_SLOPE = 0.3
LARGEST_FILM_REYNOLDS = 0.1
LARGEST_TRACTION, NEWTONIAN_STRESS = 0.1, 1e6
"""Mean shear stress over mean pressure that no liquid exceeds under high pressure, and shear stress [Pa] below which the bound
does not matter: limiting stresses are 4 to 10 % of the pressure (Bair & Winer 1979), Eyring stresses some MPa (Johnson &
Tevaarwerk 1977)."""
SMALLEST_RISE = 0.01
LARGEST_LAYER_EFFECT = 0.05
"""Relative change by the finite thickness that is spoken of."""


@dataclass(frozen=True)
class Materials:
    """An indenter, a substrate, and a liquid, each a part of the experiment.

    Only what the equations see of two elastic bodies is left of them: the gap is that of one sphere of the reduced radius,
    1/R = 1/R₁ + 1/R₂, and the displacement is the sum of both bodies', whose compliances add.

    The inputs of the parts are attributes here, too: `radius`, `shear_modulus`, `ball_young_modulus`, `viscosity`, `density`,
    … in SI.  An input that other parts have and the chosen one has not is None, such as the `thickness` of a half-space.

    Attributes
    ----------
    indenter : IndenterPart
    substrate : SubstratePart
    liquid : Lubricant
    compressibility : DensityPart
        How the density of the liquid depends on the pressure.
    """

    indenter: IndenterPart
    substrate: SubstratePart
    liquid: Lubricant
    compressibility: DensityPart

    def __post_init__(self) -> None:
        if not self.indenter.reference_radius * self.substrate.curvature > -1:
            raise InputError(
                f"substrate_radius: a cup must be wider than the sphere, of {self.indenter.reference_radius:.4g} m; "
                f"got {self.substrate.radius:.4g} m"
            )

    if TYPE_CHECKING:  # every contact has them, whatever its parts

        @property
        def radius(self) -> float: ...
        @property
        def density(self) -> float: ...

    def __getattr__(self, name: str) -> float | str | None:
        """An input of one of the parts."""
        for part in vars(self).values():
            if isinstance(part, Part):
                try:
                    return part.value(name)
                except KeyError:
                    if name in vocabulary([part.slot]):
                        return None
        raise AttributeError(f"{type(self).__name__!r} has no attribute {name!r}")

    def inputs(self) -> dict[str, float | str | None]:
        """Every input in SI by its name, as stored in files."""
        found: dict[str, float | str | None] = {}
        for each in fields(self):
            value = getattr(self, each.name)
            found |= value.flat() if isinstance(value, Part) else {each.name: value}
        return found

    @property
    def viscosity(self) -> float:
        """Viscosity that the problem is normalised with [Pa s]: of the liquid at rest, where it has one there."""
        return self.liquid.reference_viscosity

    @property
    def reduced_radius(self) -> float:
        """R with 1/R = 1/R₁ + 1/R₂ [m], the only radius that the equations see; the sphere's own on a flat substrate."""
        return self.indenter.reference_radius / (1 + self.indenter.reference_radius * self.substrate.curvature)

    @property
    def substrate_speed(self) -> float | None:
        """Speed of the substrate's surface, seen from the contact [m/s]; None where the film changes with time."""
        return None

    @property
    def substrate_share(self) -> float:
        """What part of the compliance of both bodies, were both half-spaces, is the substrate's; 1 under a rigid ball."""
        return 1 / (1 + self.substrate.contact_modulus * self.indenter.compliance)

    @property
    def contact_modulus(self) -> float:
        """E*/4 with 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ [Pa], were both bodies half-spaces; G under a rigid ball if ν₂ = 1/2."""
        return self.substrate.contact_modulus * self.substrate_share

    def steepness(self, radius: float) -> float:
        """Slope of the indenter or of the gap at a radius [m], the larger: the radius over a paraboloid's, or the reduced one.

        Where it is small the contact is little strained.
        """
        own = float(self.indenter.shape(1.0, 1.0).slope(radius / self.indenter.reference_radius))
        return own + max(radius * self.substrate.curvature, 0.0)

    def hertz_indentation(self, load: float) -> float:
        """Indentation of two half-spaces under a load, Eq. (29) [m]."""
        return float(hertz_indentation(load, self.reduced_radius, self.contact_modulus))

    def scales(self, height: float) -> dict[str, tuple[float, str]]:
        """SI value and unit of each unit of a problem normalised with a height [m], Eqs. (4), (26); docs/how-to/squeeze.md."""
        length = math.sqrt(self.reduced_radius * height)
        pressure = 4 * math.pi * self.contact_modulus * math.sqrt(height / self.reduced_radius)
        return {
            "height": (height, "m"),
            "length": (length, "m"),
            "pressure": (pressure, "Pa"),
            "load": (pressure * length**2, "N"),
            "friction": (2 * math.pi / 3 * self.contact_modulus * height**2, "N"),
            "viscosity": (self.viscosity, "Pa s"),
            "time": (12 * self.viscosity * self.reduced_radius / (height * pressure), "s"),
            "volume": (length**2 * height, "m^3"),
        }

    def beta(self, height: float, speed: float) -> float:
        """β of Eq. (6d), formed with a height [m] and the sum of the surface speeds [m/s].

        Raises
        ------
        InputError
            If it is no number to compute with.
        """
        try:
            stiffness = (2 / 3) * (height**2 / self.reduced_radius) * math.pi * self.contact_modulus
            beta = stiffness / (self.viscosity * speed)
        except (ZeroDivisionError, OverflowError):
            beta = math.inf
        if not (math.isfinite(beta) and beta > 0):
            raise InputError(f"the inputs give beta = {beta:g}, which is no number to compute with; check their units")
        return beta

    def substrate_for(self, height: float) -> Substrate:
        """What the sphere moves over, normalised with a height [m]."""
        length, time = (self.scales(height)[name][0] for name in ("length", "time"))
        return self.substrate.kernel(length, self.substrate_share, self.substrate_speed, time)

    def shape_for(self, height: float) -> Shape:
        """The indenter's surface, with the substrate's curvature, normalised with a height [m]."""
        radius = self.indenter.reference_radius
        return self.indenter.shape(height / radius, self.reduced_radius / radius)

    def liquid_for(self, height: float) -> Liquid:
        """The laws of viscosity and density, normalised with a height [m]."""
        scales = {name: value for name, (value, _) in self.scales(height).items()}
        pressure, stress = scales["pressure"], scales["friction"] / scales["length"] ** 2
        return self.compressibility.law(self.liquid.sheared(self.liquid.law(pressure), pressure, stress), pressure)

    def thickening_doubt(self, highest_pressure: float) -> list[str]:
        """Warnings if viscosity or density depend on the pressure by their laws, and hardly do up to a pressure [Pa]."""
        height = self.reduced_radius  # any height: η(p) does not know what it is normalised with
        unit = self.scales(height)["pressure"][0]
        highest = np.array([highest_pressure / unit])
        viscosity = self.liquid.law(unit)
        liquid = self.compressibility.law(viscosity, unit)
        rises = {}
        if viscosity != NewtonianLaw():
            rises["viscosity"] = float(viscosity.viscosity(highest)[0]) - 1
        if liquid != viscosity:
            rises["density"] = float(liquid.density(highest)[0][0]) - 1
        return [
            f"the {name} rises by {100 * rise:.2g} % at most with the pressure: a constant one would do as well"
            for name, rise in rises.items()
            if abs(rise) < SMALLEST_RISE
        ]


def layer_doubt(dry: DryContact, substrate: LayerKernel, changes: Mapping[str, tuple[float, float]]) -> list[str]:
    """A warning if the finite thickness changes something by more than `LARGEST_LAYER_EFFECT`.

    Parameters
    ----------
    dry : DryContact
        The dry contact, for the thickness over its radius.
    substrate : LayerKernel
        In the same units.
    changes : mapping of str to pair of float
        What is changed, in words, by what share of the half-space's value, and the error of that.
    """
    if max(abs(change) for change, _ in changes.values()) <= LARGEST_LAYER_EFFECT:
        return []
    thickness, effects = substrate.thickness / dry.radius, effects_of(changes)
    return [f"the layer is {thickness:.2g} radii of its dry contact thick; compared with a half-space that changes: {effects}"]


def effects_of(changes: Mapping[str, tuple[float, float]]) -> str:
    """Relative changes with their errors in words."""
    return ", ".join(f"{text} {_in_per_cent(*change)}" for text, change in changes.items())


def _in_per_cent(change: float, error: float) -> str:
    """A relative change with its error; no digits of it where it is smaller than that."""
    if abs(change) <= error:
        return f"less than {100 * error:.1g} %"
    return f"{100 * change:+.2g} %" + (f" (± {100 * error:.1g} %)" if error else "")


def dry_effect(
    substrate: Substrate, *, by_load: bool, depth: float = 1.0, indenter: Shape = PARABOLOID
) -> tuple[DryContact, dict[str, tuple[float, float]]]:
    """The dry contact at the unit's load or at a depth, and by what share it differs from the half-space's, exactly.

    Parameters
    ----------
    substrate : Substrate
        Normalised with the unit of height.
    by_load : bool
        Whether the load is given, 4/(3π), or the depth.
    depth : float
        Over the unit of height.
    indenter : Shape
        Normalised with the unit of height.
    """
    prescribed = {"load": HERTZ_LOAD} if by_load else {"indentation": depth}
    dry, solid = (dry_contact_at(each, **prescribed, indenter=indenter) for each in (substrate, HalfSpaceKernel()))
    if by_load:
        return dry, {"indentation of a dry contact": (dry.indentation / solid.indentation - 1, 0.0)}
    return dry, {"load of a dry contact": (dry.load / solid.load - 1, 0.0)}
