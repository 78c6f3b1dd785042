"""The sphere: as the paraboloid that it is close to its lowest point, as in the paper, or in its true shape."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from softlube.model.indenters.base import Array, Curved, IndenterPart, Shape
from softlube.model.inputs import LENGTH, Switch, given
from softlube.model.lazy import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

END = 0.8
"""Radius over the sphere's up to which its true shape is kept; its slope is 53° there.  A sphere has no surface beyond R."""


@dataclass(frozen=True)
class Paraboloid(Shape):
    """The paraboloid f = r²/2, Eq. (1a): a sphere of the reduced radius close to its lowest point."""

    kind: ClassVar[str] = "paraboloid"
    words: ClassVar[str] = "a rigid sphere"

    def in_units(self, unit: float) -> Paraboloid:
        """Itself: it has no length."""
        return self

    def height(self, r: ArrayLike) -> Array:
        """r²/2."""
        return np.asarray(r, dtype=float) ** 2 / 2

    def slope(self, r: ArrayLike) -> Array:
        """R."""
        return np.asarray(r, dtype=float)

    def depth(self, x: ArrayLike) -> Array:
        """x²."""
        return np.asarray(x, dtype=float) ** 2

    def depth_slope(self, x: ArrayLike) -> Array:
        """2x."""
        return 2 * np.asarray(x, dtype=float)

    def far_field(self, r: float) -> tuple[float, float]:
        """Its own."""
        return 1.0, 1.0


@dataclass(frozen=True)
class SphereShape(Curved):
    """The true sphere R − √(R² − r²) up to 0.8 R, then the paraboloid that touches it there."""

    kind: ClassVar[str] = "sphere"
    words: ClassVar[str] = "a rigid sphere of its true shape"

    @property
    def end(self) -> float:
        """0.8."""
        return END

    def outline(self, x: Array) -> tuple[Array, Array, Array]:
        """1 − √(1 − x²) without cancellation, and its derivatives."""
        root = np.sqrt((1 - x) * (1 + x))
        return x**2 / (1 + root), x / root, root**-3


class Sphere(IndenterPart):
    """A ball, rigid or elastic: its paraboloid, as in the paper, or its true shape."""

    kind: ClassVar[str] = "sphere"
    usual: ClassVar[bool] = True
    radius: float = given("Radius of the sphere", LENGTH, "2 mm")
    true_shape: Any = Switch("Whether the sphere keeps its true shape, or is the paraboloid that it is close to the axis")

    def flat(self) -> dict[str, Any]:
        """Its inputs; the paraboloid's file looks as it did before there were other shapes."""
        return {name: value for name, value in super().flat().items() if value is not False}

    @property
    def reference_radius(self) -> float:
        """Its radius [m]."""
        return self.radius

    def shape(self, unit: float, share: float) -> Shape:
        """The paraboloid, or the true sphere."""
        return SphereShape(unit, share) if self.true_shape else Paraboloid()
