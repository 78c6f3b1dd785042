"""What is solved, in dimensionless numbers only."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, get_args

from softlube.errors import InputError, shown
from softlube.model import indenters, substrates
from softlube.model import liquids as liquids
from softlube.model.indenters import Paraboloid, Shape
from softlube.model.liquids import Liquid, NewtonianLaw
from softlube.model.motions import FIXED_BALL
from softlube.model.substrates import HalfSpaceKernel, Substrate

Cavitation = Literal["reynolds", "none"]


@dataclass(frozen=True)
class Problem:
    """A sphere sliding over an elastic substrate, normalised as in the paper.

    Exactly one of `beta` and `beta_load` is given.

    Parameters
    ----------
    beta : float, optional
        β = (2/3)(h₀²/R) πG/(ηv), Eq. (6d): the height h₀ is prescribed, see `height`.
    beta_load : float, optional
        The same with the Hertz indentation δ of the load in place of |h₀|, Eq. (30): the load is prescribed, h₀ is unknown.
    cavitation : {"reynolds", "none"}
        Reynolds condition (p ≥ 0, Eq. 17 ff.), or negative pressures allowed.
    height : {-1, 0, 1}
        Sign of the prescribed height of the sphere's lowest point over the undeformed surface: −1, the paper's indentation;
        1, a gap |h₀|; 0, a sphere just touching the undeformed surface, where the height that β is formed with is any other
        unit of height.
    substrate : Substrate
        What the sphere slides over, see `softlube.substrates`; lengths over √(R × unit of height), where the unit is what β is
        formed with: |h₀|, or the Hertz indentation that the load would make in a half-space.
    liquid : Liquid
        The laws of viscosity and density, see `softlube.model.liquids`; pressures over 4πG√(unit of height/R).
    indenter : Shape
        The indenter's surface, see `softlube.model.indenters`; the paraboloid r²/2 of the paper if not given.
    slide_to_roll : float
        S, see `softlube.Rolling`.  Films of liquids whose shear stress is not in proportion to the shear rate depend on it; for
        other liquids it is `softlube.model.motions.FIXED_BALL` whatever is given, and frictions at other S follow.

    Raises
    ------
    InputError
        If not exactly one of β and β_load is given, or one is not positive and finite, or the cavitation model is unknown, or a
        height is given with a load, or the slide-to-roll ratio is not finite.
    """

    beta: float | None = None
    beta_load: float | None = None
    cavitation: Cavitation = "reynolds"
    height: int = -1
    substrate: Substrate = field(default_factory=HalfSpaceKernel)
    liquid: Liquid = field(default_factory=NewtonianLaw)
    indenter: Shape = field(default_factory=Paraboloid)
    slide_to_roll: float = FIXED_BALL

    def __post_init__(self) -> None:
        if (self.beta is None) == (self.beta_load is None):
            raise InputError("beta, beta_load: give exactly one of them")
        name = "beta" if self.beta is not None else "beta_load"
        value = getattr(self, name)
        try:
            number = float(value)
        except (TypeError, ValueError, OverflowError):
            number = math.nan
        if isinstance(value, (bool, str)) or not (math.isfinite(number) and number > 0):
            raise InputError(f"{name}: expected a positive, finite number, got {shown(value)}")
        object.__setattr__(self, name, number)
        if self.cavitation not in get_args(Cavitation):
            raise InputError(f"cavitation: expected 'reynolds' or 'none', got {self.cavitation!r}")
        if self.height not in (-1, 0, 1):
            raise InputError(f"height: expected -1 (indentation), 0 or 1 (gap), got {self.height!r}")
        if self.beta_load is not None and self.height != -1:
            raise InputError("height, beta_load: under a prescribed load the height is an unknown; leave it out")
        if not math.isfinite(self.slide_to_roll):
            raise InputError(f"slide_to_roll: expected a finite number, got {shown(self.slide_to_roll)}")
        object.__setattr__(self, "slide_to_roll", FIXED_BALL if self.liquid.linear else float(self.slide_to_roll))

    def to_plain(self) -> dict[str, Any]:
        """The problem in plain values, for files; one of the paper's model looks as it did before there were others."""
        values: dict[str, Any] = {name: getattr(self, name) for name in ("beta", "beta_load", "cavitation", "height")}
        models = {
            "substrate": substrates.to_plain(self.substrate),
            "liquid": liquids.to_plain(self.liquid),
            "indenter": indenters.to_plain(self.indenter),
        }
        values |= {name: model for name, model in models.items() if len(model) > 1}
        return values if self.liquid.linear else values | {"slide_to_roll": self.slide_to_roll}

    @classmethod
    def from_plain(cls, values: Mapping[str, Any]) -> Problem:
        """Inverse of `to_plain`."""
        models: dict[str, Any] = {
            "substrate": substrates.from_plain(values.get("substrate")),
            "liquid": liquids.from_plain(values.get("liquid")),
            "indenter": indenters.from_plain(values.get("indenter")),
        }
        return cls(**(dict(values) | models))

    @property
    def load_controlled(self) -> bool:
        """Whether the load is prescribed and h₀ unknown."""
        return self.beta_load is not None

    @property
    def parameter(self) -> float:
        """β, or β_load under load control."""
        return float(self.beta if self.beta is not None else self.beta_load)  # type: ignore[arg-type]
