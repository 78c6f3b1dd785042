"""The physical contact, in SI units: sphere, substrate, lubricant and motion; Eqs. (4), (5), (6d), (29), (30).

Text with units goes in, floats in SI come out; `softlube.model.inputs` reads it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from softlube.errors import InputError, warn
from softlube.model.dry import PARABOLOID
from softlube.model.indenters import Sphere
from softlube.model.inputs import exactly_one, read
from softlube.model.motions import FIXED_BALL, SteadyMotion
from softlube.model.parts import resolve
from softlube.model.problem import Cavitation, Problem
from softlube.model.quantities import QUANTITIES, Quantity
from softlube.model.substrates.layer import LayerKernel
from softlube.physical.described import Described
from softlube.physical.effects import thickness_effect, thinning_effect
from softlube.physical.inputs import BODIES, SLIDING_BODIES, Loading, Taking, check_names, documented
from softlube.physical.materials import (
    LARGEST_FILM_REYNOLDS,
    LARGEST_SLOPE,
    LARGEST_TRACTION,
    NEWTONIAN_STRESS,
)
from softlube.physical.rolling import at_slide_to_roll
from softlube.physical.roughness import FULL_FILM, lambda_ratio, lubrication
from softlube.solvers.budget import DEFAULT_BUDGET
from softlube.solvers.notebook import watched
from softlube.solvers.progress import Listener
from softlube.steady.regime import Regime
from softlube.steady.solution import Solution

TOO_WIDE = (
    "{name}: makes a contact of radius {share:.2g} R, wider than the sphere; the model is for contacts up to about {largest:g} "
    "R. Check the units of radius, modulus and {name}"
)
WIDE = "the {what} {share:.2g} R: beyond {largest:g} R linear elasticity and the parabolic sphere are in doubt"
BEYOND = (
    "{name}: makes a contact of radius {radius:.3g} m, beyond the indenter's surface, which is given up to {edge:.3g} m. "
    "Check the units of the indenter, modulus and {name}"
)
TOO_STEEP = (
    "{name}: the indenter's slope at the contact's edge is {share:.2g}; the model is for slopes up to about {largest:g}. "
    "Check the units of the indenter, modulus and {name}"
)
STEEP = "the indenter's slope at the edge of the contact is {share:.2g}: beyond {largest:g} linear elasticity is in doubt"
ROUGH = (
    "the minimum film is {ratio:.2g} times the roughness ({lubrication} lubrication, full film from {full:g} on): asperities "
    "touch, which the model leaves out"
)
INERTIA = "the film's Reynolds number rho v u^2/(eta a) is {reynolds:.2g}, not small: inertia is neglected here"
LIMITING_STRESS = (
    "the mean shear stress, {stress:.2g} Pa, is {share:.2g} times the mean pressure: above {largest:g} no liquid stays "
    "Newtonian, it shears at a limiting stress instead; do not trust the friction"
)
"""What is said of a contact that is refused, and of doubts; the calculator's page says it, too."""


@documented(SLIDING_BODIES, Loading)
@dataclass(frozen=True, init=False, repr=False)
class Contact(Described):
    """A sphere that slides or rolls over a substrate with a viscous film between; either of them elastic, or both.

    Parts are given as objects, or by their inputs, from which they follow: a thickness makes the substrate a layer, a
    pressure-viscosity coefficient makes the liquid one of Barus, or of another law that is named, and an entrainment speed in
    place of the speed makes the motion a rolling one.  Quantities take text with a unit ("2 mm", "3 MPa", "2 Pa s"; see
    `softlube.model.units`), a pint quantity, or a number in SI.  Give exactly one of
    `young_modulus` and `shear_modulus`, and exactly one of `load` and `indentation`.

    Parameters
    ----------
    indenter, substrate, liquid, compressibility, motion : Part, optional
        Such as `Sphere`, `Layer`, `Barus`, `DowsonHigginson` and `Rolling` of `softlube`.  A part and an input of the slot that
        it fills are not given together.
    {inputs}

    Attributes
    ----------
    indenter, substrate, liquid, compressibility, motion : Part
    radius, viscosity, speed, shear_modulus, density, … : float, str or None
        Every input of the parts by its name, in SI; None where the part has no such input.
    load, indentation, roughness : float or None
        In SI, None where not given.
    cavitation : {"reynolds", "none"}

    Raises
    ------
    InputError
        If an input is missing, contradictory, not positive and finite, or of the wrong dimension, or the substrate is a cup
        and the sphere does not fit into it.

    Examples
    --------
    >>> from softlube import Barus, Contact, HalfSpace, Layer, Newtonian, Rolling, Sliding, Sphere
    >>> contact = Contact(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", speed="0.1 mm/s", load="100 mN")
    >>> round(contact.problem().beta_load)
    16430
    >>> contact = Contact(indenter=Sphere("2 mm"), substrate=Layer(young_modulus="3 MPa", thickness="2 mm"),
    ...                   liquid=Barus("2 Pa s", pressure_viscosity="20 GPa^-1"), motion=Sliding("0.1 mm/s"), load="100 mN")
    >>> contact.thickness
    0.002
    >>> steel_on_glass = Contact(indenter=Sphere("10 mm", young_modulus="210 GPa", poisson_ratio=0.3),
    ...                          substrate=HalfSpace("64 GPa", poisson_ratio=0.2), liquid=Newtonian("1 Pa s"),
    ...                          motion=Rolling("1 mm/s", slide_to_roll=0), load="1 N")
    >>> f"{4 * steel_on_glass.contact_modulus:.4g}"  # E* [Pa]
    '5.172e+10'
    """

    motion: SteadyMotion
    load: float | None
    indentation: float | None
    cavitation: Cavitation
    roughness: float | None

    __signature__ = Taking(SLIDING_BODIES, Loading)

    def __init__(self, **given: Any) -> None:
        check_names(given, SLIDING_BODIES, Loading)
        super().__init__(**resolve(BODIES, given))
        vars(self).update(resolve([SteadyMotion.slot], given))
        exactly_one({name: given.get(name) for name in ("load", "indentation")}, Loading.inputs)
        vars(self).update(read(Loading.inputs, given))

    # --- from SI to the dimensionless problem -----------------------------------------------------------------------

    @property
    def unit_height(self) -> float:
        """Height that lengths are normalised with [m].

        The indentation of two half-spaces under the load, Eq. (29), or |h₀| where that is prescribed; for h₀ = 0 the height
        that makes β = 1, where the film is about as thick.
        """
        if self.load is not None:
            return self.hertz_indentation(self.load)
        assert self.indentation is not None
        if self.indentation == 0:
            return math.sqrt(1.5 * self.reduced_radius * self.viscosity * self.speed_sum / (math.pi * self.contact_modulus))
        return abs(self.indentation)

    @property
    def unit_length(self) -> float:
        """√(R × `unit_height`) [m]: the radius of the Hertz contact."""
        return math.sqrt(self.reduced_radius * self.unit_height)

    def problem(self) -> Problem:
        """The dimensionless problem, Eq. (6d) or (30).

        Raises
        ------
        InputError
            If the contact would be wider than the sphere.
        """
        height = self.unit_height
        beta = self.beta(height, self.speed_sum)
        models: dict[str, Any] = {"substrate": self.substrate_for(height), "liquid": self.liquid_for(height)}
        models |= {"indenter": self.shape_for(height), "slide_to_roll": self.slide_to_roll}
        if self.load is not None:
            problem = Problem(beta_load=beta, cavitation=self.cavitation, **models)
        else:
            assert self.indentation is not None
            sign = 0 if self.indentation == 0 else -1 if self.indentation > 0 else 1
            problem = Problem(beta=beta, cavitation=self.cavitation, height=sign, **models)
        if (radius := self._dry_radius(problem)) > (edge := problem.indenter.edge * self.unit_length):
            raise InputError(BEYOND.format(name=self.prescribed, radius=radius, edge=edge))
        if (share := self.steepness(radius)) > 1:
            too_far = TOO_WIDE if isinstance(self.indenter, Sphere) else TOO_STEEP
            raise InputError(too_far.format(name=self.prescribed, share=share, largest=LARGEST_SLOPE))
        return problem

    @property
    def prescribed(self) -> str:
        """Name of what holds the indenter, load or indentation."""
        return "load" if self.load is not None else "indentation"

    @property
    def dry_radius(self) -> float:
        """Radius of the dry contact on the substrate [m]; 0 where a gap is prescribed."""
        return self._dry_radius(self.problem())

    def _dry_radius(self, problem: Problem) -> float:
        return 0.0 if problem.height >= 0 else Regime.of(problem).edge_radius * self.unit_length

    @watched
    def solve(
        self,
        *,
        accuracy: float = 1e-3,
        method: str = "newton",
        budget: float = DEFAULT_BUDGET,
        progress: Listener | None = None,
    ) -> Solution:
        """Solve the contact.

        Parameters
        ----------
        accuracy : float
            Relative error aimed at; see `softlube.solve`.
        method : {"newton", "relaxation", "cartesian"}
            See `softlube.solve`.
        budget : float
            Seconds of processor time after which the solver gives up, see `softlube.solve`.
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
        from softlube.steady.solve import solve_problem

        solution = solve_problem(self.problem(), accuracy=accuracy, method=method, budget=budget, progress=progress)
        return self.interpret(solution)

    # --- and back ---------------------------------------------------------------------------------------------------

    def interpret(self, solution: Solution) -> Solution:
        """A dimensionless solution of `problem` with SI quantities and warnings added."""
        dimensional = self.dimensional(solution.quantities)
        doubts = self.doubts(dimensional)
        warn(doubts)
        return replace(solution, contact=self, dimensional=dimensional, warnings=solution.warnings + doubts)

    def dimensional(self, quantities: Mapping[str, Quantity]) -> dict[str, Quantity]:
        """Quantities of `problem` in SI, Eqs. (4) and (26).

        Frictions of a problem whose liquid's shear stress is in proportion to the shear rate are those of a ball that does not
        turn; here they are those of the motion, see `softlube.physical.rolling.at_slide_to_roll`.
        """
        units = {dimension: value for dimension, (value, _) in self.scales(self.unit_height).items()}
        height, length = units["height"], units["length"]
        units |= {"pressure_gradient": units["pressure"] / length, "shear_rate": self.speed_sum / height}
        result = {}
        for name, quantity in quantities.items():
            row = QUANTITIES[name]
            if name != "height" and row.dimension in units:  # the height is given as an indentation, the angle is no SI value
                result[name] = quantity.scaled(units[row.dimension], row.unit.si)
        if self.load is not None:
            result["load"] = Quantity(self.load, 0.0, "N")
        if self.liquid_for(height).linear:  # else the problem has the motion's own
            result = at_slide_to_roll(result, self.slide_to_roll)
        friction, load = result["friction_total"], result["load"]
        coefficient = friction / load
        result["indentation"] = Quantity(-height * float(quantities["height"]), height * quantities["height"].error, "m")
        if radius := self.dry_radius:
            result["contact_radius"] = Quantity(radius, 0.0, "m")
        result["friction_coefficient"] = Quantity(
            coefficient, abs(coefficient) * (friction.error / abs(friction) + load.error / abs(load))
        )
        if self.roughness is not None:
            result["lambda_ratio"] = lambda_ratio(result, self.roughness)
        return result

    def doubts(self, dimensional: Mapping[str, Quantity]) -> tuple[str, ...]:
        """Warnings where the model may not describe the experiment."""
        gap = max(-float(dimensional["indentation"]), 0.0)
        lifted = gap > 0
        # Over a gap the pressure is as wide as the parabola stays close.
        reach = math.sqrt(2 * self.reduced_radius * gap)
        radius = reach if lifted else float(dimensional.get("contact_radius", self.unit_length))
        doubts = self.width_doubt(radius, "pressure reaches" if lifted else "contact radius is")
        if self.roughness is not None and (ratio := float(dimensional["lambda_ratio"])) < FULL_FILM:
            doubts.append(ROUGH.format(ratio=ratio, lubrication=lubrication(ratio), full=FULL_FILM))
        known = self.slide_to_roll == FIXED_BALL or not self.liquid_for(self.unit_height).linear
        shear = float(dimensional["friction_contact" if known else "friction_domain"])
        if not lifted:
            doubts += self.traction_doubt(shear, float(dimensional["load_contact"]), radius)
        center = float(dimensional["film_center"])
        reynolds = self.density * self.speed_sum * center**2 / (self.viscosity * radius)
        if reynolds > LARGEST_FILM_REYNOLDS:
            doubts.append(INERTIA.format(reynolds=reynolds))
        doubts += self.thickening_doubt(float(dimensional["pressure_max"]))
        doubts += thinning_effect(self, dimensional)
        substrate = self.substrate_for(self.unit_height)
        if isinstance(substrate, LayerKernel) and float(dimensional["indentation"]) > 0:  # else no dry contact to compare
            doubts += thickness_effect(self, substrate, dimensional)
        return tuple(doubts)

    def width_doubt(self, radius: float, what: str = "contact radius is") -> list[str]:
        """A warning if the indenter is too steep at a radius [m] for the model."""
        share = self.steepness(radius)
        if not share > LARGEST_SLOPE:
            return []
        return [(WIDE if self.paraboloid else STEEP).format(what=what, share=share, largest=LARGEST_SLOPE)]

    @property
    def paraboloid(self) -> bool:
        """Whether the indenter's surface is taken for a paraboloid, the paper's."""
        return self.shape_for(1.0) == PARABOLOID

    def traction_doubt(self, friction: float, load: float, radius: float) -> list[str]:
        """A warning if no liquid bears the shear stress of a friction and a load [N] within a radius [m]."""
        stress, share = abs(friction) / (math.pi * radius**2), abs(friction) / load
        if not (share > LARGEST_TRACTION and stress > NEWTONIAN_STRESS):
            return []
        return [LIMITING_STRESS.format(stress=stress, share=share, largest=LARGEST_TRACTION)]
