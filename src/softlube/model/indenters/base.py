"""What the solver asks of an indenter's shape, what every shape has, and the parts of an experiment that have a shape."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

from softlube.errors import InputError
from softlube.model.inputs import NUMBER, PRESSURE, Declaring, given
from softlube.model.lazy import numpy as np
from softlube.model.named import Named
from softlube.model.parts import Part

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Array: TypeAlias = "NDArray[np.floating]"

POINTS = 40
"""Points of Gauss's quadrature between two corners in the transform of a shape; round-off for the shapes of this folder."""


class Shape(Named):
    """The height f(r) of an indenter's surface over its lowest point, f(0) = 0; files know it by its `kind`.

    The dry contact needs Galin's and Sneddon's transform of it, g(x) = x ∫₀ˣ f′(r)/√(x² − r²) dr: on a half-space the depth of
    the contact of radius a is g(a).
    """

    kinds: ClassVar[dict[str, type[Any]]] = {}
    usual: ClassVar[str] = "paraboloid"
    unknown: ClassVar[str] = "indenter: no"
    words: ClassVar[str] = "a rigid indenter"

    @property
    def corners(self) -> tuple[float, ...]:
        """Radii at which a derivative of f jumps or changes fast, ascending."""
        return ()

    @property
    def edge(self) -> float:
        """Radius up to which the surface is the indenter's own; beyond it the surface is continued."""
        return math.inf

    @property
    def flat(self) -> float:
        """Radius up to which the surface is flat: no contact is narrower."""
        return 0.0

    def in_units(self, unit: float) -> Shape:
        """The shape with another unit of height, given over the present one; lengths scale with its root."""
        raise NotImplementedError

    def height(self, r: ArrayLike) -> Array:
        """f(r)."""
        raise NotImplementedError

    def slope(self, r: ArrayLike) -> Array:
        """f′(r)."""
        raise NotImplementedError

    def depth(self, x: ArrayLike) -> Array:
        """Galin's and Sneddon's g(x)."""
        raise NotImplementedError

    def depth_slope(self, x: ArrayLike) -> Array:
        """g′(x)."""
        raise NotImplementedError

    def far_field(self, r: float) -> tuple[float, float]:
        """The far pressure under the shape over that under the paraboloid, at a radius: its value and its change with h₀.

        Where u = f ~ rⁿ the far pressure without cavitation is p = r cos θ/((2n + 1) β f²), Eq. (9) at n = 2; n = r f′/f.
        """
        height = float(self.height(r))
        exponent, flatter = r * float(self.slope(r)) / height, r**2 / 2 / height
        return 5 / (2 * exponent + 1) * flatter**2, 5 / (2 * exponent + 1) * flatter**3


@dataclass(frozen=True)
class Curved(Shape):
    """A shape that has lengths of its own: F over the reference radius, as a function of the radius over it.

    Beyond its `end` the surface goes on as the coaxial paraboloid that touches it there, so that height and slope have no jump.

    Parameters
    ----------
    unit : float
        Unit of height over the indenter's reference radius.
    share : float
        Reduced radius over the reference radius; 1 over a flat substrate.  A substrate that is a ball adds r²/2R₂ to f.
    """

    unit: float
    share: float

    def __post_init__(self) -> None:
        for name in ("unit", "share"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise InputError(f"{name}: expected a positive, finite number, got {value!r}")

    @property
    def end(self) -> float:
        """Radius, over the reference radius, beyond which the paraboloid follows."""
        return math.inf

    @property
    def own_corners(self) -> tuple[float, ...]:
        """`corners` within the end, over the reference radius."""
        return ()

    def outline(self, x: Array) -> tuple[Array, Array, Array]:
        """F, F′ and F″ at radii up to the end, over the reference radius."""
        raise NotImplementedError

    @property
    def corners(self) -> tuple[float, ...]:
        """Radii at which a derivative jumps or changes fast, the end among them."""
        return tuple(each / self._length for each in (*self.own_corners, self.end) if math.isfinite(each))

    @property
    def edge(self) -> float:
        """The end."""
        return self.end / self._length

    @property
    def _length(self) -> float:
        """Unit of length over the reference radius."""
        return math.sqrt(self.share * self.unit)

    def in_units(self, unit: float) -> Curved:
        """The shape with another unit of height."""
        return replace(self, unit=self.unit * unit)

    def _continued(self, x: Array) -> tuple[Array, Array, Array]:
        """F, F′ and F″ at any radius over the reference radius."""
        value, slope, bend = self.outline(np.minimum(x, self.end))
        if math.isfinite(self.end) and np.any(x > self.end):
            beyond, bowl = x > self.end, slope / np.minimum(np.maximum(x, 1e-300), self.end)
            value = np.where(beyond, value + bowl * (x - self.end) * (x + self.end) / 2, value)
            slope, bend = np.where(beyond, bowl * x, slope), np.where(beyond, bowl, bend)
        return value, slope, bend

    def height(self, r: ArrayLike) -> Array:
        """f(r): the indenter's own, and what the substrate's curvature adds."""
        r = np.asarray(r, dtype=float)
        return self._continued(self._length * r)[0] / self.unit + (1 - self.share) * r**2 / 2

    def slope(self, r: ArrayLike) -> Array:
        """f′(r)."""
        r = np.asarray(r, dtype=float)
        return self._continued(self._length * r)[1] * (self._length / self.unit) + (1 - self.share) * r

    def depth(self, x: ArrayLike) -> Array:
        """g(x)."""
        x = np.asarray(x, dtype=float)
        return self.transform(self._length * x)[0] / self.unit + (1 - self.share) * x**2

    def depth_slope(self, x: ArrayLike) -> Array:
        """g′(x)."""
        x = np.asarray(x, dtype=float)
        return self.transform(self._length * x)[1] * (self._length / self.unit) + 2 * (1 - self.share) * x

    def transform(self, x: Array) -> tuple[Array, Array]:
        """G = x ∫ F′(x sin t) dt over 0 ≤ t ≤ π/2 and G′, over the reference radius, by Gauss's quadrature between corners."""
        sine, weight = self._nodes(x)
        place = x[..., None] * sine
        _, slope, bend = self._continued(place)
        return x * np.sum(slope * weight, axis=-1), np.sum((slope + place * bend) * weight, axis=-1)

    def _nodes(self, x: Array) -> tuple[Array, Array]:
        """Sines and weights of the quadrature in t for each x, shape (..., points)."""
        node, weight = _gauss(POINTS)
        first, last = np.zeros(x.shape), np.full(x.shape, np.pi / 2)
        corners = [*self.own_corners, *([self.end] if math.isfinite(self.end) else [])]
        inner = [np.arcsin(np.minimum(corner / np.maximum(x, 1e-300), 1)) for corner in corners]
        edges = np.stack([first, *inner, last], axis=-1)
        width = np.diff(edges, axis=-1)[..., None]
        t = edges[..., :-1, None] + width * node
        shape = (*x.shape, -1)
        return np.sin(t).reshape(shape), (width * weight).reshape(shape)


@lru_cache(maxsize=4)
def _gauss(points: int) -> tuple[Array, Array]:
    """Places and weights of Gauss's quadrature on [0, 1]."""
    x, weight = np.polynomial.legendre.leggauss(points)
    return (x + 1) / 2, weight / 2


class Elastic(Declaring):
    """The elastic constants of an indenter."""

    young_modulus: float | None = given(
        "Young's modulus of the sphere", PRESSURE, "210 GPa", default=None, absent="rigid", flat="ball_young_modulus"
    )
    poisson_ratio: float = given(
        "Poisson's ratio of the sphere, 0 to 0.5", NUMBER, "0.3", default=0.5, between=(0, 0.5), flat="ball_poisson_ratio"
    )


class IndenterPart(Part):
    """An indenter, rigid or elastic, as a part of an experiment, in SI.

    Among the inputs of an experiment its modulus and its ratio are `ball_young_modulus` and `ball_poisson_ratio`.
    """

    slot: ClassVar[str] = "indenter"
    young_modulus: float | None
    poisson_ratio: float

    def __init_subclass__(cls) -> None:
        for name, each in Elastic.inputs.items():  # after its lengths, of which the first may be positional
            setattr(cls, name, each)
        super().__init_subclass__()

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values; a Poisson's ratio means nothing for a rigid indenter."""
        if values["young_modulus"] is None and values["poisson_ratio"] != Elastic.inputs["poisson_ratio"].default:
            raise InputError(
                "ball_poisson_ratio, ball_young_modulus: the first means nothing without the second; give both or neither"
            )
        return values

    @property
    def compliance(self) -> float:
        """4(1 − ν²)/E [1/Pa], the inverse of the `contact_modulus` that a substrate of this material has; 0 if rigid."""
        return 0.0 if self.young_modulus is None else 4 * (1 - self.poisson_ratio**2) / self.young_modulus

    @property
    def reference_radius(self) -> float:
        """Radius R₁ that lengths are normalised with [m]: a paraboloid's own."""
        raise NotImplementedError

    def shape(self, unit: float, share: float) -> Shape:
        """The shape, see `Curved` for the parameters."""
        raise NotImplementedError
