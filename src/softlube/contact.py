"""The physical contact, in SI units: sphere, substrate, lubricant and motion; Eqs. (4), (5), (6d), (29), (30).

Units exist here and nowhere below: strings go in, floats in SI come out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from functools import cache
from typing import Any, Literal, SupportsFloat, get_args

import numpy as np

from softlube.dry import dry_contact_at
from softlube.errors import InputError
from softlube.fluids import Barus, Fluid, Newtonian, Roelands
from softlube.limits import HERTZ_LOAD
from softlube.problem import Cavitation, Problem
from softlube.solution import Quantity, Solution
from softlube.substrates import Base, HalfSpace, Layer, Substrate, check_poisson_ratio

KINDS = {
    "radius": ("m", "a length such as '2 mm'"),
    "young_modulus": ("Pa", "a pressure such as '3 MPa'"),
    "shear_modulus": ("Pa", "a pressure such as '1 MPa'"),
    "viscosity": ("Pa s", "a dynamic viscosity such as '2 Pa s'"),
    "speed": ("m/s", "a speed such as '0.1 mm/s'"),
    "entrainment_speed": ("m/s", "a speed such as '0.05 mm/s'"),
    "load": ("N", "a force such as '100 mN'"),
    "friction": ("N", "a force such as '5 mN'"),
    "indentation": ("m", "a length such as '50 um', or '-1 um' for a gap"),
    "roughness": ("m", "a length such as '20 nm'"),
    "thickness": ("m", "a length such as '2 mm'"),
    "density": ("kg/m^3", "a density such as '970 kg/m^3'"),
    "poisson_ratio": ("", "a number such as '0.45'"),
    "pressure_viscosity": ("1/Pa", "an inverse pressure such as '20 GPa^-1'"),
}
"""Unit and example of every physical input."""

SIGNED = ("indentation",)
"""Inputs that may be zero or negative."""

UNITS = {
    "load": "N",
    "load_contact": "N",
    "film_center": "m",
    "film_min": "m",
    "film_min_radius": "m",
    "film_inlet": "m",
    "film_outlet_min": "m",
    "pressure_center": "Pa",
    "pressure_max": "Pa",
    "pressure_gradient_inlet": "Pa/m",
    "boundary_layer": "m",
    "friction_contact": "N",
    "friction_domain": "N",
    "shear_rate_max": "1/s",
    "indentation": "m",
    "contact_radius": "m",
    "friction_coefficient": "",
}
"""SI unit of every dimensional quantity."""

LARGEST_SLOPE = 0.3
LARGEST_FILM_REYNOLDS = 0.1
SMALLEST_RISE = 0.01
LARGEST_LAYER_EFFECT = 0.05
"""Relative change by the finite thickness that is spoken of."""

ViscosityLaw = Literal["barus", "roelands"]


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


def to_si(name: str, value: object) -> float:
    """One physical input in SI.

    Parameters
    ----------
    name : str
        A key of `KINDS`.
    value : str, float or pint.Quantity
        Text with a unit, a number already in SI, or a quantity.

    Raises
    ------
    InputError
        If the value is not a positive (an indentation: not a), finite quantity of the right dimension; the message names the
        parameter.
    """
    unit, expected = KINDS[name]
    if not unit:
        return _number(name, value)
    quantity: Any
    if isinstance(value, str):
        import pint

        text = value.strip()
        try:
            quantity = _registry().Quantity(text)
        except pint.UndefinedUnitError as error:
            raise InputError(f"{name}: {text!r} has an unknown unit ({error.args[0]!r}); expected {expected}") from None
        except Exception:  # pint's parser raises whatever the text provokes: SyntaxError, TypeError, DefinitionSyntaxError, …
            raise InputError(f"{name}: cannot read {text!r}; expected {expected}") from None
        if quantity.unitless:
            raise InputError(f"{name}: {text!r} has no unit; expected {expected}")
    elif hasattr(value, "to") and hasattr(value, "magnitude"):
        quantity = value
    elif isinstance(value, SupportsFloat) and not isinstance(value, bool):
        return _checked(name, float(value), value)
    else:
        raise InputError(f"{name}: cannot read {value!r}; expected {expected}")
    try:
        number = float(quantity.to(unit).magnitude)
    except Exception as error:
        if type(error).__name__ == "DimensionalityError":
            raise InputError(f"{name}: {value!s} has the wrong dimension; expected {expected}") from None
        raise InputError(f"{name}: cannot read {value!r}; expected {expected}") from None
    return _checked(name, number, value)


def unit_factor(name: str, unit: str) -> float:
    """What a number in `unit` is multiplied by to be in SI.

    Parameters
    ----------
    name : str
        A key of `KINDS`.
    unit : str
        In any spelling pint knows, such as "mN" or "mm/s".

    Raises
    ------
    InputError
        If the unit is unknown or of the wrong dimension.
    """
    return to_si(name, f"1 {unit}") if unit.strip() else to_si(name, "1")


def _checked(name: str, number: float, given: object) -> float:
    signed = name in SIGNED
    if not math.isfinite(number) or (number <= 0 and not signed):
        raise InputError(f"{name}: expected a {'' if signed else 'positive, '}finite quantity, {KINDS[name][1]}; got {given!s}")
    return number


def _number(name: str, value: object) -> float:
    """A plain number, given as one or as text."""
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise InputError(f"{name}: expected a number without unit, got {value!r}") from None


def replace_substrate(contact: Contact, thickness: float | None) -> Contact:
    """The same contact with another thickness of the substrate; None for a half-space."""
    inputs = contact.inputs() | {"thickness": thickness}
    return Contact.from_inputs(inputs | ({"base": "bonded"} if thickness is None else {}))


@dataclass(frozen=True, init=False)
class Contact:
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
        The law that α is of; see `softlube.fluids`.
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

    radius: float
    viscosity: float
    speed: float
    shear_modulus: float
    load: float | None
    indentation: float | None
    cavitation: Cavitation
    roughness: float | None
    thickness: float | None
    density: float
    poisson_ratio: float
    base: Base
    pressure_viscosity: float | None
    viscosity_law: ViscosityLaw

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
    ) -> None:
        given = {"radius": radius, "viscosity": viscosity, "speed": speed}
        for name, value in given.items():
            if value is None:
                raise InputError(f"{name}: missing; expected {KINDS[name][1]}")
        for pair in (
            {"young_modulus": young_modulus, "shear_modulus": shear_modulus},
            {"load": load, "indentation": indentation},
        ):
            chosen = [name for name, value in pair.items() if value is not None]
            if len(chosen) != 1:
                verb = "are both given" if chosen else "are both missing"
                raise InputError(f"{', '.join(pair)}: {verb}; give exactly one, {' or '.join(KINDS[name][1] for name in pair)}")
        given |= {"load": load, "indentation": indentation, "roughness": roughness, "thickness": thickness, "density": density}
        given |= {"pressure_viscosity": pressure_viscosity}
        ratio = to_si("poisson_ratio", poisson_ratio)
        check_poisson_ratio(ratio)
        values = {name: None if value is None else to_si(name, value) for name, value in given.items()}
        if young_modulus is not None:
            values["shear_modulus"] = to_si("young_modulus", young_modulus) / (2 * (1 + ratio))
        else:
            values["shear_modulus"] = to_si("shear_modulus", shear_modulus)
        if cavitation not in ("reynolds", "none"):
            raise InputError(f"cavitation: expected 'reynolds' or 'none', got {cavitation!r}")
        for name, choice, known in (("base", base, Base), ("viscosity_law", viscosity_law, ViscosityLaw)):
            if choice not in get_args(known):
                raise InputError(f"{name}: expected {' or '.join(map(repr, get_args(known)))}, got {choice!r}")
        for name, needed, unused in (
            ("base", thickness, base == "bonded"),
            ("viscosity_law", pressure_viscosity, viscosity_law == "barus"),
        ):
            if needed is None and not unused:
                other = "thickness" if name == "base" else "pressure_viscosity"
                raise InputError(f"{name}, {other}: the first means nothing without the second; give both or neither")
        choices = {"poisson_ratio": ratio, "base": base, "viscosity_law": viscosity_law, "cavitation": cavitation}
        for name, value in (values | choices).items():
            object.__setattr__(self, name, value)

    # --- from SI to the dimensionless problem -----------------------------------------------------------------------

    @property
    def contact_modulus(self) -> float:
        """G/(2(1 − ν)) [Pa]: a quarter of the effective modulus E*, and G itself at ν = 1/2, as in the paper."""
        return self.shear_modulus / (2 * (1 - self.poisson_ratio))

    @property
    def unit_height(self) -> float:
        """Height that lengths are normalised with [m].

        The indentation of a half-space under the load, Eq. (29), or |h₀| where that is prescribed; for h₀ = 0 the height that
        makes β = 1, where the film is about as thick.
        """
        if self.load is not None:
            return (3 * self.load / (16 * self.contact_modulus * math.sqrt(self.radius))) ** (2 / 3)
        assert self.indentation is not None
        if self.indentation == 0:
            return math.sqrt(1.5 * self.radius * self.viscosity * self.speed / (math.pi * self.contact_modulus))
        return abs(self.indentation)

    @property
    def unit_length(self) -> float:
        """√(R × `unit_height`) [m]: the radius of the Hertz contact."""
        return math.sqrt(self.radius * self.unit_height)

    @property
    def unit_pressure(self) -> float:
        """4πG√(`unit_height`/R) [Pa], Eq. (4)."""
        return 4 * math.pi * self.contact_modulus * math.sqrt(self.unit_height / self.radius)

    def substrate(self) -> Substrate:
        """What the sphere slides over, dimensionless."""
        if self.thickness is None:
            return HalfSpace()
        return Layer(self.thickness / self.unit_length, self.poisson_ratio, self.base)

    def fluid(self) -> Fluid:
        """The law of the viscosity, dimensionless."""
        if self.pressure_viscosity is None:
            return Newtonian()
        if self.viscosity_law == "barus":
            return Barus(self.pressure_viscosity * self.unit_pressure)
        return Roelands.of(self.pressure_viscosity, self.viscosity, self.unit_pressure)

    def problem(self) -> Problem:
        """The dimensionless problem, Eq. (6d) or (30)."""
        try:
            stiffness = (2 / 3) * (self.unit_height**2 / self.radius) * math.pi * self.contact_modulus
            beta = stiffness / (self.viscosity * self.speed)
        except (ZeroDivisionError, OverflowError):
            beta = math.inf
        if not (math.isfinite(beta) and beta > 0):
            raise InputError(f"the inputs give beta = {beta:g}, which is no number to compute with; check their units")
        models: dict[str, Any] = {"substrate": self.substrate(), "fluid": self.fluid()}
        if self.load is not None:
            return Problem(beta_load=beta, cavitation=self.cavitation, **models)
        assert self.indentation is not None
        height = 0 if self.indentation == 0 else -1 if self.indentation > 0 else 1
        return Problem(beta=beta, cavitation=self.cavitation, height=height, **models)

    def solve(
        self, *, accuracy: float = 1e-3, method: str = "newton", progress: Callable[[str], None] | None = None
    ) -> Solution:
        """Solve the contact.

        Parameters
        ----------
        accuracy : float
            Relative error aimed at; see `softlube.solve`.
        method : {"newton", "relaxation", "cartesian"}
            See `softlube.solve`.
        progress : callable, optional
            Called with a line of text after each grid.

        Returns
        -------
        Solution
            With `dimensional` quantities in SI and `warnings` about the physics.

        Raises
        ------
        NotConvergedError
            If the problem cannot be solved to the accuracy.
        """
        from softlube.solver import solve_problem

        return self.interpret(solve_problem(self.problem(), accuracy=accuracy, method=method, progress=progress))

    # --- and back ---------------------------------------------------------------------------------------------------

    def interpret(self, solution: Solution) -> Solution:
        """A dimensionless solution of `problem` with SI quantities and warnings added."""
        dimensional = self.dimensional(solution.quantities)
        return replace(solution, contact=self, dimensional=dimensional, warnings=solution.warnings + self.doubts(dimensional))

    def dimensional(self, quantities: Mapping[str, Quantity]) -> dict[str, Quantity]:
        """Quantities of `problem` in SI, Eqs. (4) and (26)."""
        height, length = self.unit_height, self.unit_length
        pressure = self.unit_pressure
        scales = {
            "load": pressure * length**2,
            "film": height,
            "pressure": pressure,
            "pressure_gradient_inlet": pressure / length,
            "friction": 2 * math.pi / 3 * self.contact_modulus * height**2,
            "length": length,
            "shear_rate_max": self.speed / height,
        }
        group = {"film_min_radius": "length", "boundary_layer": "length"}
        result = {}
        for name, quantity in quantities.items():
            if name not in UNITS:
                continue
            scale = scales[group.get(name) or (name if name in scales else name.split("_")[0])]
            result[name] = Quantity(scale * float(quantity), scale * quantity.error, UNITS[name])
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
        film = float(dimensional["film_min"])
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
        if self.pressure_viscosity is not None:
            highest = np.array([float(dimensional["pressure_max"]) / self.unit_pressure])
            rise = float(self.fluid().viscosity(highest)[0]) - 1
            if rise < SMALLEST_RISE:
                doubts.append(
                    f"the viscosity rises by {100 * rise:.2g} % at most with the pressure: a constant one would do as well"
                )
        if self.thickness is not None and not lifted:
            doubts += self._thickness_effect(dimensional)
        return tuple(doubts)

    def _thickness_effect(self, dimensional: Mapping[str, Quantity]) -> list[str]:
        """What the finite thickness of the substrate changes, computed."""
        by_load = self.load is not None
        if by_load:
            dry = dry_contact_at(self.substrate(), load=HERTZ_LOAD)
            changes = {"indentation of a dry contact": dry.indentation - 1}
        else:
            dry = dry_contact_at(self.substrate(), indentation=1.0)
            changes = {"load of a dry contact": dry.load / HERTZ_LOAD - 1}
        if self.pressure_viscosity is None:
            from softlube import curve

            half_space = replace_substrate(self, None)
            thick = half_space.dimensional(curve.quantities(half_space.problem()))
            names = {"film_center": "film at the centre", "film_min": "minimum film", "friction_domain": "friction"}
            changes |= {text: dimensional[name] / thick[name] - 1 for name, text in names.items()}
        if max(abs(change) for change in changes.values()) <= LARGEST_LAYER_EFFECT:
            return []
        effects = ", ".join(f"{text} {100 * change:+.2g} %" for text, change in changes.items())
        thickness = self.thickness / (dry.radius * self.unit_length)  # type: ignore[operator]
        return [f"the layer is {thickness:.2g} contact radii thick; compared with a half-space that changes: {effects}"]

    def inputs(self) -> dict[str, float | str | None]:
        """The inputs in SI, as stored with a solution."""
        return asdict(self)

    @classmethod
    def from_inputs(cls, inputs: Mapping[str, Any]) -> Contact:
        """Inverse of `inputs`."""
        return cls(**inputs)
