"""The line contact, in SI: a cylinder that slides or rolls over a substrate with a viscous film between, `softlube.line`.

The load is a force per length.  A half-plane yields without end under it, so that no depth can be prescribed: films are
absolute, and the height of the cylinder is not given.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from softlube.errors import InputError, warn
from softlube.model.cylinders import Cylinder
from softlube.model.dry_line import DryLine, dry_line
from softlube.model.inputs import read
from softlube.model.motions import FIXED_BALL, SteadyMotion
from softlube.model.parts import resolve
from softlube.model.problem import Cavitation, Problem
from softlube.model.quantities import LINE, Quantity
from softlube.physical.contact import INERTIA, LIMITING_STRESS, ROUGH, TOO_WIDE, WIDE
from softlube.physical.described import Described
from softlube.physical.inputs import SLIDING_LINE, LineLoading, Taking, check_names, documented
from softlube.physical.materials import LARGEST_FILM_REYNOLDS, LARGEST_SLOPE, LARGEST_TRACTION, NEWTONIAN_STRESS
from softlube.physical.roughness import FULL_FILM, lambda_ratio, lubrication
from softlube.solvers.budget import DEFAULT_BUDGET
from softlube.solvers.notebook import watched
from softlube.solvers.progress import Listener
from softlube.steady.line.solution import LineSolution
from softlube.steady.line.solve import DEFAULT_ACCURACY, solve, solve_problem

__all__ = ["Cylinder", "DryLine", "LineContact", "LineSolution", "dry_line", "solve"]


@documented(SLIDING_LINE, LineLoading)
@dataclass(frozen=True, init=False, repr=False)
class LineContact(Described):
    """A cylinder that slides or rolls over a substrate with a viscous film between; either of them elastic, or both.

    Parts are given as objects, or by their inputs, from which they follow, as in `softlube.Contact`.  A substrate that is round
    is a cylinder, too, parallel to the first.

    Parameters
    ----------
    cylinder, substrate, liquid, compressibility, motion : Part, optional
        Such as `Cylinder` of `softlube.line`, and `HalfSpace`, `Barus`, `DowsonHigginson` and `Rolling` of `softlube`.  A part
        and an input of the slot that it fills are not given together.
    {inputs}

    Attributes
    ----------
    indenter : Cylinder
    substrate, liquid, compressibility, motion : Part
    radius, viscosity, speed, shear_modulus, density, … : float, str or None
        Every input of the parts by its name, in SI; None where the part has no such input.
    load_per_length, roughness : float or None
        In SI, None where not given.
    cavitation : {"reynolds", "none"}

    Raises
    ------
    InputError
        If an input is missing, contradictory, not positive and finite, or of the wrong dimension.

    Examples
    --------
    >>> from softlube import LineContact
    >>> contact = LineContact(radius="10 mm", young_modulus="3 MPa", viscosity="1 Pa s", speed="10 mm/s",
    ...                       load_per_length="1 N/mm")
    >>> solution = contact.solve()
    >>> print(f"{solution.dimensional['film_center']:.3e} m")
    4.419e-06 m
    """

    indenter: Cylinder  # type: ignore[bad-override]
    motion: SteadyMotion
    load_per_length: float
    cavitation: Cavitation
    roughness: float | None

    __signature__ = Taking(SLIDING_LINE, LineLoading)

    def __init__(self, **given: Any) -> None:
        check_names(given, SLIDING_LINE, LineLoading)
        parts = resolve(SLIDING_LINE, given)
        vars(self).update({"indenter" if name == Cylinder.slot else name: part for name, part in parts.items()})
        self.__post_init__()
        vars(self).update(read(LineLoading.inputs, given))

    @property
    def headline(self) -> str:
        """What slides or rolls over what."""
        return f"Line {super().headline[0].lower()}{super().headline[1:]}"

    # --- from SI to the dimensionless problem -----------------------------------------------------------------------

    @property
    def unit_height(self) -> float:
        """b²/R [m], with half the width b of the dry contact of two half-spaces: b² = 4N′R/(πE*)."""
        return self.load_per_length / (math.pi * self.contact_modulus)

    @property
    def unit_length(self) -> float:
        """B [m]: half the width of the dry contact of two half-spaces under the load."""
        return math.sqrt(self.reduced_radius * self.unit_height)

    @property
    def slope(self) -> float:
        """Slope of the narrower of the two surfaces at the edge of the dry contact."""
        return self.unit_length / min(self.radius, self.reduced_radius)

    def scales(self, height: float) -> dict[str, tuple[float, str]]:
        """SI value and unit of each unit of a problem normalised with a height [m]."""
        known = super().scales(height)
        pressure, length = known["pressure"][0], known["length"][0]
        lines = {
            "line_load": (pressure * length, "N/m"),
            "line_friction": (known["friction"][0] / length, "N/m"),
            "pressure_gradient": (pressure / length, "Pa/m"),
            "shear_rate": (self.speed_sum / height, "1/s"),
        }
        return known | lines

    def problem(self) -> Problem:
        """The dimensionless problem.

        Raises
        ------
        InputError
            If the contact would be wider than the cylinder.
        """
        height = self.unit_height
        if self.slope > 1:
            raise InputError(TOO_WIDE.format(name="load_per_length", share=self.slope, largest=LARGEST_SLOPE))
        return Problem(
            beta_load=self.beta(height, self.speed_sum),
            cavitation=self.cavitation,
            substrate=self.substrate_for(height),
            liquid=self.liquid_for(height),
            slide_to_roll=self.slide_to_roll,
        )

    @watched
    def solve(
        self, *, accuracy: float = DEFAULT_ACCURACY, budget: float = DEFAULT_BUDGET, progress: Listener | None = None
    ) -> LineSolution:
        """Solve the contact.

        Parameters
        ----------
        accuracy : float
            Relative error aimed at; see `softlube.line.solve`.
        budget : float
            Seconds of processor time after which the solver gives up.
        progress : callable, optional
            Called with a `softlube.solvers.progress.Progress` after each step, for instance ``print``.

        Returns
        -------
        LineSolution
            With `dimensional` quantities in SI and `warnings` about the physics.

        Raises
        ------
        NotConvergedError
            If the problem cannot be solved to the accuracy.
        """
        solution = solve_problem(self.problem(), accuracy=accuracy, budget=budget, progress=progress)
        dimensional = self.dimensional(solution.quantities)
        doubts = self.doubts(dimensional)
        warn(doubts)
        return replace(solution, contact=self, dimensional=dimensional, warnings=solution.warnings + doubts)

    # --- and back ---------------------------------------------------------------------------------------------------

    def dimensional(self, quantities: Mapping[str, Quantity]) -> dict[str, Quantity]:
        """Quantities of `problem` in SI, with the frictions of the motion.

        With the Couette part C and the Poiseuille part P of a cylinder that does not turn, a slide-to-roll ratio S has the
        total C S/2 − P and the shear C S/2 + P on the cylinder.
        """
        units = self.scales(self.unit_height)
        found = {name: q.scaled(*units[LINE[name].dimension]) for name, q in quantities.items()}
        found["load"] = Quantity(self.load_per_length, 0.0, "N/m")
        couette, poiseuille = found["friction_couette"], found["friction_poiseuille"]
        # A problem whose liquid's shear stress is not in proportion to the shear rate has the motion's own ratio.
        share = self.slide_to_roll / FIXED_BALL if self.liquid_for(self.unit_height).linear else 1.0
        if share != 1:
            error = abs(share) * couette.error + poiseuille.error
            found["friction_couette"] = couette = Quantity(share * couette, abs(share) * couette.error, "N/m")
            found["friction_total"] = Quantity(couette - poiseuille, error, "N/m")
            found["friction_shear"] = Quantity(couette + poiseuille, error, "N/m")
            found["shear_rate_max"] = Quantity(math.nan, math.nan, "1/s")
        friction = found["friction_total"]
        found["contact_half_width"] = Quantity(self.unit_length, 0.0, "m")
        found["friction_coefficient"] = Quantity(friction / self.load_per_length, friction.error / self.load_per_length)
        if self.roughness is not None:
            found["lambda_ratio"] = lambda_ratio(found, self.roughness)
        return found

    def doubts(self, dimensional: Mapping[str, Quantity]) -> tuple[str, ...]:
        """Warnings where the model may not describe the experiment."""
        doubts = []
        width = self.unit_length
        if self.slope > LARGEST_SLOPE:
            doubts.append(WIDE.format(what="contact's half-width is", share=self.slope, largest=LARGEST_SLOPE))
        if self.roughness is not None and (ratio := float(dimensional["lambda_ratio"])) < FULL_FILM:
            doubts.append(ROUGH.format(ratio=ratio, lubrication=lubrication(ratio), full=FULL_FILM))
        friction = abs(float(dimensional["friction_couette"]))
        stress, traction = friction / (2 * width), friction / self.load_per_length
        if traction > LARGEST_TRACTION and stress > NEWTONIAN_STRESS:
            doubts.append(LIMITING_STRESS.format(stress=stress, share=traction, largest=LARGEST_TRACTION))
        reynolds = self.density * self.speed_sum * float(dimensional["film_center"]) ** 2 / (self.viscosity * width)
        if reynolds > LARGEST_FILM_REYNOLDS:
            doubts.append(INERTIA.format(reynolds=reynolds))
        return (*doubts, *self.thickening_doubt(float(dimensional["pressure_max"])))
