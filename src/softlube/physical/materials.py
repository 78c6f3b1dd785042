"""Sphere, substrate and liquid in SI: what a contact has whatever moves the sphere; Eqs. (4), (6d), (29)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np

from softlube.errors import InputError
from softlube.model.dry import DryContact, dry_contact_at
from softlube.model.exact import HERTZ_LOAD
from softlube.model.liquids import BarusLaw, DowsonHigginsonLaw, Liquid, NewtonianLaw, RoelandsLaw
from softlube.model.substrates import HalfSpaceKernel, LayerKernel, Substrate
from softlube.model.substrates.base import check_poisson_ratio
from softlube.model.substrates.layer import Base
from softlube.physical.units import KINDS, to_si

LARGEST_SLOPE = 0.3
LARGEST_FILM_REYNOLDS = 0.1
SMALLEST_RISE = 0.01
LARGEST_LAYER_EFFECT = 0.05
"""Relative change by the finite thickness that is spoken of."""

ViscosityLaw = Literal["barus", "roelands"]
DensityLaw = Literal["constant", "dowson-higginson"]

MATERIALS = (
    "radius",
    "young_modulus",
    "shear_modulus",
    "viscosity",
    "density",
    "thickness",
    "poisson_ratio",
    "base",
    "pressure_viscosity",
    "viscosity_law",
    "density_law",
)
"""Inputs of `read_materials`."""


@dataclass(frozen=True)
class Materials:
    """A rigid sphere, a soft half-space or layer, and a liquid.

    Attributes
    ----------
    radius, viscosity, shear_modulus, density : float
        R, η, G, ρ in SI.
    thickness : float or None
        Of a layer on a rigid base; None for a half-space [m].
    poisson_ratio : float
    base : {"bonded", "frictionless"}
        How a layer lies on its base.
    pressure_viscosity : float or None
        α [1/Pa]; None for constant viscosity.
    viscosity_law : {"barus", "roelands"}
    density_law : {"constant", "dowson-higginson"}
    """

    radius: float
    viscosity: float
    shear_modulus: float
    density: float
    thickness: float | None
    poisson_ratio: float
    base: Base
    pressure_viscosity: float | None
    viscosity_law: ViscosityLaw
    density_law: DensityLaw

    @property
    def contact_modulus(self) -> float:
        """G/(2(1 − ν)) [Pa]: a quarter of the effective modulus E*, and G itself at ν = 1/2, as in the paper."""
        return self.shear_modulus / (2 * (1 - self.poisson_ratio))

    def hertz_indentation(self, load: float) -> float:
        """Indentation of a half-space under a load, Eq. (29) [m]."""
        return (3 * load / (16 * self.contact_modulus * math.sqrt(self.radius))) ** (2 / 3)

    def scales(self, height: float) -> dict[str, tuple[float, str]]:
        """SI value and unit of each unit of the problem normalised with a height [m], Eqs. (4) and (26); docs/squeeze.md."""
        length = math.sqrt(self.radius * height)
        pressure = 4 * math.pi * self.contact_modulus * math.sqrt(height / self.radius)
        return {
            "height": (height, "m"),
            "length": (length, "m"),
            "pressure": (pressure, "Pa"),
            "load": (pressure * length**2, "N"),
            "friction": (2 * math.pi / 3 * self.contact_modulus * height**2, "N"),
            "time": (12 * self.viscosity * self.radius / (height * pressure), "s"),
            "volume": (length**2 * height, "m^3"),
        }

    def beta(self, height: float, speed: float) -> float:
        """β of Eq. (6d), formed with a height [m].

        Raises
        ------
        InputError
            If it is no number to compute with.
        """
        try:
            stiffness = (2 / 3) * (height**2 / self.radius) * math.pi * self.contact_modulus
            beta = stiffness / (self.viscosity * speed)
        except (ZeroDivisionError, OverflowError):
            beta = math.inf
        if not (math.isfinite(beta) and beta > 0):
            raise InputError(f"the inputs give beta = {beta:g}, which is no number to compute with; check their units")
        return beta

    def substrate_for(self, height: float) -> Substrate:
        """What the sphere moves over, normalised with a height [m]."""
        if self.thickness is None:
            return HalfSpaceKernel()
        return LayerKernel(self.thickness / math.sqrt(self.radius * height), self.poisson_ratio, self.base)

    def liquid_for(self, height: float) -> Liquid:
        """The laws of viscosity and density, normalised with a height [m]."""
        pressure = self.scales(height)["pressure"][0]
        law: Liquid = NewtonianLaw()
        if self.pressure_viscosity is not None and self.viscosity_law == "barus":
            law = BarusLaw(self.pressure_viscosity * pressure)
        elif self.pressure_viscosity is not None:
            law = RoelandsLaw.of(self.pressure_viscosity, self.viscosity, pressure)
        return law if self.density_law == "constant" else DowsonHigginsonLaw.of(law, pressure)

    def thickening_doubt(self, highest_pressure: float) -> list[str]:
        """Warnings if viscosity or density are given as rising, and hardly rise up to a pressure [Pa]."""
        height = self.radius  # any height: η(p) does not know what it is normalised with
        highest = np.array([highest_pressure / self.scales(height)["pressure"][0]])
        liquid = self.liquid_for(height)
        rises = {}
        if self.pressure_viscosity is not None:
            rises["viscosity"] = float(liquid.viscosity(highest)[0]) - 1
        if self.density_law != "constant":
            rises["density"] = float(liquid.density(highest)[0][0]) - 1
        return [
            f"the {name} rises by {100 * rise:.2g} % at most with the pressure: a constant one would do as well"
            for name, rise in rises.items()
            if rise < SMALLEST_RISE
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
    effects = ", ".join(f"{text} {_in_per_cent(*change)}" for text, change in changes.items())
    thickness = substrate.thickness / dry.radius
    return [f"the layer is {thickness:.2g} contact radii thick; compared with a half-space that changes: {effects}"]


def _in_per_cent(change: float, error: float) -> str:
    """A relative change with its error; no digits of it where it is smaller than that."""
    if abs(change) <= error:
        return f"less than {100 * error:.1g} %"
    return f"{100 * change:+.2g} %" + (f" (± {100 * error:.1g} %)" if error else "")


def dry_effect(substrate: Substrate, *, by_load: bool, depth: float = 1.0) -> tuple[DryContact, dict[str, tuple[float, float]]]:
    """The dry contact at the unit's load or at a depth, and by what share it differs from the half-space's, exactly.

    Parameters
    ----------
    substrate : Substrate
        Normalised with the unit of height.
    by_load : bool
        Whether the load is given, 4/(3π), or the depth.
    depth : float
        Over the unit of height.
    """
    if by_load:
        dry = dry_contact_at(substrate, load=HERTZ_LOAD)
        return dry, {"indentation of a dry contact": (dry.indentation - 1, 0.0)}
    dry = dry_contact_at(substrate, indentation=depth)
    return dry, {"load of a dry contact": (dry.load / (HERTZ_LOAD * depth**1.5) - 1, 0.0)}


def check_choice(pair: Mapping[str, object]) -> None:
    """Refuse two ways of saying one thing if not exactly one is used."""
    chosen = [name for name, value in pair.items() if value is not None]
    if len(chosen) != 1:
        verb = "are both given" if chosen else "are both missing"
        raise InputError(f"{', '.join(pair)}: {verb}; give exactly one, {' or '.join(KINDS[name][1] for name in pair)}")


def read_materials(
    *,
    radius: object = None,
    viscosity: object = None,
    young_modulus: object = None,
    shear_modulus: object = None,
    density: object = 1000.0,
    thickness: object = None,
    poisson_ratio: object = 0.5,
    base: str = "bonded",
    pressure_viscosity: object = None,
    viscosity_law: str = "barus",
    density_law: str = "constant",
) -> dict[str, Any]:
    """Fields of `Materials` from text with units, pint quantities or numbers in SI; see `softlube.Contact`.

    Raises
    ------
    InputError
        If an input is missing, contradictory, not positive and finite, or of the wrong dimension.
    """
    for name, value in (("radius", radius), ("viscosity", viscosity)):
        if value is None:
            raise InputError(f"{name}: missing; expected {KINDS[name][1]}")
    check_choice({"young_modulus": young_modulus, "shear_modulus": shear_modulus})
    given = {"radius": radius, "viscosity": viscosity, "density": density}
    given |= {"thickness": thickness, "pressure_viscosity": pressure_viscosity}
    ratio = to_si("poisson_ratio", poisson_ratio)
    check_poisson_ratio(ratio)
    values: dict[str, Any] = {name: None if value is None else to_si(name, value) for name, value in given.items()}
    if young_modulus is not None:
        values["shear_modulus"] = to_si("young_modulus", young_modulus) / (2 * (1 + ratio))
    else:
        values["shear_modulus"] = to_si("shear_modulus", shear_modulus)
    choices = {"base": (base, Base), "viscosity_law": (viscosity_law, ViscosityLaw), "density_law": (density_law, DensityLaw)}
    for name, (choice, known) in choices.items():
        if choice not in get_args(known):
            raise InputError(f"{name}: expected {' or '.join(map(repr, get_args(known)))}, got {choice!r}")
    for name, needed, unused in (
        ("base", thickness, base == "bonded"),
        ("viscosity_law", pressure_viscosity, viscosity_law == "barus"),
    ):
        if needed is None and not unused:
            other = "thickness" if name == "base" else "pressure_viscosity"
            raise InputError(f"{name}, {other}: the first means nothing without the second; give both or neither")
    return values | {"poisson_ratio": ratio} | {name: choice for name, (choice, _) in choices.items()}
