"""The physical contact, in SI units: sphere, substrate, lubricant and motion; Eqs. (4), (5), (6d), (29), (30).

Units exist here and nowhere below: strings go in, floats in SI come out.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from softlube.errors import InputError
from softlube.model.liquids import Liquid
from softlube.model.problem import Cavitation, Problem
from softlube.model.quantities import QUANTITIES, Quantity
from softlube.model.substrates import LayerKernel, Substrate
from softlube.physical.materials import (
    LARGEST_FILM_REYNOLDS,
    LARGEST_SLOPE,
    Materials,
    check_choice,
    dry_effect,
    layer_doubt,
    read_materials,
)
from softlube.physical.units import KINDS, to_si
from softlube.solvers.progress import Listener
from softlube.steady.solution import Solution


def replace_substrate(contact: Contact, thickness: float | None) -> Contact:
    """The same contact with another thickness of the substrate; None for a half-space."""
    inputs = contact.inputs() | {"thickness": thickness}
    return Contact.from_inputs(inputs | ({"base": "bonded"} if thickness is None else {}))


@dataclass(frozen=True, init=False)
class Contact(Materials):
    """A rigid sphere sliding over a soft half-space or layer with a viscous film between.

    Every argument takes text with a unit in any spelling pint knows ("2 mm", "3 MPa", "2 Pa s"), a pint quantity, or a number
    in SI.  Give exactly one of `young_modulus` and `shear_modulus`, and exactly one of `load` and `indentation`.

    Parameters
    ----------
    radius : str, float or pint.Quantity
        Radius R of the sphere.
    viscosity : str, float or pint.Quantity
        Dynamic viscosity η of the liquid.
    speed : str, float or pint.Quantity
        Sliding speed v.
    young_modulus, shear_modulus : str, float or pint.Quantity, optional
        E or G = E/(2(1 + ν)) of the substrate.
    load : str, float or pint.Quantity, optional
        Normal load N.
    indentation : str, float or pint.Quantity, optional
        Depth −h₀ of the sphere's lowest point below the undeformed surface; zero or negative where it stays above, by a gap.
    cavitation : {"reynolds", "none"}
        Reynolds condition, or negative pressures allowed.
    thickness : str, float or pint.Quantity, optional
        Thickness of the substrate, a layer on a rigid base; a half-space where not given.
    poisson_ratio : float
        Of the substrate, 0 ≤ ν ≤ 1/2.
    base : {"bonded", "frictionless"}
        How a layer lies on its base.
    pressure_viscosity : str, float or pint.Quantity, optional
        Pressure-viscosity coefficient α; constant viscosity where not given.
    viscosity_law : {"barus", "roelands"}
        The law that α is of; see `softlube.model.liquids`.
    density_law : {"constant", "dowson-higginson"}
        How the density rises with the pressure; see `softlube.model.liquids.DowsonHigginsonLaw`.
    roughness : str, float or pint.Quantity, optional
        Roughness height; used for a warning only.
    density : str, float or pint.Quantity
        Density of the liquid; used for a warning only.

    Attributes
    ----------
    radius, viscosity, speed, shear_modulus, density : float
        In SI.
    load, indentation, roughness, thickness, pressure_viscosity : float or None
        In SI, None where not given.

    Raises
    ------
    InputError
        If an input is missing, contradictory, not positive and finite, or of the wrong dimension.

    Examples
    --------
    >>> from softlube import Contact
    >>> contact = Contact(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", speed="0.1 mm/s", load="100 mN")
    >>> round(contact.problem().beta_load)
    16430
    """

    speed: float
    load: float | None
    indentation: float | None
    cavitation: Cavitation
    roughness: float | None

    def __init__(
        self,
        *,
        radius: object = None,
        viscosity: object = None,
        speed: object = None,
        young_modulus: object = None,
        shear_modulus: object = None,
        load: object = None,
        indentation: object = None,
        cavitation: str = "reynolds",
        roughness: object = None,
        thickness: object = None,
        density: object = 1000.0,
        poisson_ratio: object = 0.5,
        base: str = "bonded",
        pressure_viscosity: object = None,
        viscosity_law: str = "barus",
        density_law: str = "constant",
    ) -> None:
        values = read_materials(
            radius=radius,
            viscosity=viscosity,
            young_modulus=young_modulus,
            shear_modulus=shear_modulus,
            density=density,
            thickness=thickness,
            poisson_ratio=poisson_ratio,
            base=base,
            pressure_viscosity=pressure_viscosity,
            viscosity_law=viscosity_law,
            density_law=density_law,
        )
        if speed is None:
            raise InputError(f"speed: missing; expected {KINDS['speed'][1]}")
        check_choice({"load": load, "indentation": indentation})
        given = {"speed": speed, "load": load, "indentation": indentation, "roughness": roughness}
        values |= {name: None if value is None else to_si(name, value) for name, value in given.items()}
        if cavitation not in ("reynolds", "none"):
            raise InputError(f"cavitation: expected 'reynolds' or 'none', got {cavitation!r}")
        for name, value in (values | {"cavitation": cavitation}).items():
            object.__setattr__(self, name, value)

    # --- from SI to the dimensionless problem -----------------------------------------------------------------------

    @property
    def unit_height(self) -> float:
        """Height that lengths are normalised with [m].

        The indentation of a half-space under the load, Eq. (29), or |h₀| where that is prescribed; for h₀ = 0 the height that
        makes β = 1, where the film is about as thick.
        """
        if self.load is not None:
            return self.hertz_indentation(self.load)
        assert self.indentation is not None
        if self.indentation == 0:
            return math.sqrt(1.5 * self.radius * self.viscosity * self.speed / (math.pi * self.contact_modulus))
        return abs(self.indentation)

    @property
    def unit_length(self) -> float:
        """√(R × `unit_height`) [m]: the radius of the Hertz contact."""
        return math.sqrt(self.radius * self.unit_height)

    def substrate(self) -> Substrate:
        """What the sphere slides over, dimensionless."""
        return self.substrate_for(self.unit_height)

    def liquid(self) -> Liquid:
        """The laws of viscosity and density, dimensionless."""
        return self.liquid_for(self.unit_height)

    def problem(self) -> Problem:
        """The dimensionless problem, Eq. (6d) or (30)."""
        beta = self.beta(self.unit_height, self.speed)
        models: dict[str, Any] = {"substrate": self.substrate(), "liquid": self.liquid()}
        if self.load is not None:
            return Problem(beta_load=beta, cavitation=self.cavitation, **models)
        assert self.indentation is not None
        height = 0 if self.indentation == 0 else -1 if self.indentation > 0 else 1
        return Problem(beta=beta, cavitation=self.cavitation, height=height, **models)

    def solve(self, *, accuracy: float = 1e-3, method: str = "newton", progress: Listener | None = None) -> Solution:
        """Solve the contact.

        Parameters
        ----------
        accuracy : float
            Relative error aimed at; see `softlube.solve`.
        method : {"newton", "relaxation", "cartesian"}
            See `softlube.solve`.
        progress : callable, optional
            Called with a `softlube.solvers.progress.Progress` after each grid, for instance ``print``.

        Returns
        -------
        Solution
            With `dimensional` quantities in SI and `warnings` about the physics.

        Raises
        ------
        NotConvergedError
            If the problem cannot be solved to the accuracy.
        """
        from softlube.steady.ladder import solve_problem

        return self.interpret(solve_problem(self.problem(), accuracy=accuracy, method=method, progress=progress))

    # --- and back ---------------------------------------------------------------------------------------------------

    def interpret(self, solution: Solution) -> Solution:
        """A dimensionless solution of `problem` with SI quantities and warnings added."""
        dimensional = self.dimensional(solution.quantities)
        return replace(solution, contact=self, dimensional=dimensional, warnings=solution.warnings + self.doubts(dimensional))

    def dimensional(self, quantities: Mapping[str, Quantity]) -> dict[str, Quantity]:
        """Quantities of `problem` in SI, Eqs. (4) and (26)."""
        units = {dimension: value for dimension, (value, _) in self.scales(self.unit_height).items()}
        height, length = units["height"], units["length"]
        units |= {"pressure_gradient": units["pressure"] / length, "shear_rate": self.speed / height}
        result = {}
        for name, quantity in quantities.items():
            row = QUANTITIES[name]
            if name != "height" and row.dimension in units:  # the height is given as an indentation, the angle is no SI value
                result[name] = quantity.scaled(units[row.dimension], row.unit.si)
        if self.load is not None:
            result["load"] = Quantity(self.load, 0.0, "N")
        friction, load = result["friction_domain"], result["load"]
        coefficient = friction / load
        result["indentation"] = Quantity(-height * float(quantities["height"]), height * quantities["height"].error, "m")
        result["contact_radius"] = Quantity(length, 0.0, "m")
        result["friction_coefficient"] = Quantity(
            coefficient, abs(coefficient) * (friction.error / abs(friction) + load.error / abs(load))
        )
        return result

    def doubts(self, dimensional: Mapping[str, Quantity]) -> tuple[str, ...]:
        """Warnings where the model may not describe the experiment."""
        doubts = []
        gap = max(-float(dimensional["indentation"]), 0.0)
        lifted = gap > 0
        # Over a gap the pressure is as wide as the parabola stays close.
        radius = math.sqrt(2 * self.radius * gap) if lifted else float(dimensional["contact_radius"])
        if radius > LARGEST_SLOPE * self.radius:
            doubts.append(
                f"the {'pressure reaches' if lifted else 'contact radius is'} {radius / self.radius:.2g} R: beyond "
                f"{LARGEST_SLOPE} R linear elasticity and the parabolic sphere are in doubt"
            )
        # The minimum may be missing, where it is much below the outlet's.
        film = float(np.nanmin([dimensional["film_min"], dimensional["film_outlet_min"]]))
        if self.roughness is not None and film < self.roughness:
            doubts.append(
                f"the minimum film, {film:.2g} m, is below the roughness, {self.roughness:.2g} m: the surfaces may touch"
            )
        center = float(dimensional["film_center"])
        reynolds = self.density * self.speed * center**2 / (self.viscosity * radius)
        if reynolds > LARGEST_FILM_REYNOLDS:
            doubts.append(
                f"the film's Reynolds number rho v u^2/(eta a) is {reynolds:.2g}, not small: inertia is neglected here"
            )
        doubts += self.thickening_doubt(float(dimensional["pressure_max"]))
        if self.thickness is not None and not lifted:
            doubts += self._thickness_effect(dimensional)
        return tuple(doubts)

    def _thickness_effect(self, dimensional: Mapping[str, Quantity]) -> list[str]:
        """What the finite thickness of the substrate changes, computed."""
        substrate = self.substrate()
        assert isinstance(substrate, LayerKernel)
        dry, changes = dry_effect(substrate, by_load=self.load is not None)
        if self.pressure_viscosity is None:
            from softlube.theory import master_curve as curve

            half_space = replace_substrate(self, None)
            thick = half_space.dimensional(curve.quantities(half_space.problem()))
            names = {"film_center": "film at the centre", "film_min": "minimum film", "friction_domain": "friction"}
            for name, text in names.items():
                ours, theirs = dimensional[name], thick[name]
                if np.isfinite(ours):
                    changes[text] = ours / theirs - 1, ours.error / abs(ours) + theirs.error / abs(theirs)
        return layer_doubt(dry, substrate, changes)

    def inputs(self) -> dict[str, float | str | None]:
        """The inputs in SI, as stored with a solution."""
        return asdict(self)

    @classmethod
    def from_inputs(cls, inputs: Mapping[str, Any]) -> Contact:
        """Inverse of `inputs`."""
        return cls(**inputs)
