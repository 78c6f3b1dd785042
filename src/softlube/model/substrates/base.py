"""What the solver asks of a substrate, what every kernel has, and the parts of an experiment that have a kernel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Protocol, TypeAlias

from softlube.errors import InputError
from softlube.model.creep import ELASTIC, Creep
from softlube.model.inputs import LENGTH, NUMBER, PRESSURE, exactly_one, given
from softlube.model.named import Named
from softlube.model.parts import Part

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Array: TypeAlias = "NDArray[np.floating]"
Orders: TypeAlias = "NDArray[np.intp]"


class Remainder(Protocol):
    """What a substrate's kernel has beyond the half-space's."""

    @property
    def smooth_over(self) -> float:
        """Length over which it is smooth: the distance from the real plane up to which it is analytic."""
        ...

    def ring_remainder(self, orders: Orders, r: Array, r_source: Array) -> Array:
        """Its harmonics, see `softlube.discretization.potentials.ring_kernels`."""
        ...


class Memory(Protocol):
    """What a viscoelastic substrate remembers while it passes under a contact, see `softlube.model.substrates.viscoelastic`."""

    @property
    def shares(self) -> tuple[float, ...]:
        """Compliances Jᵢ over the relaxed one."""
        ...

    @property
    def lengths(self) -> tuple[float, ...]:
        """How far the surface moves in each of its times."""
        ...

    @property
    def instantaneous(self) -> float:
        """J₀ over the relaxed compliance."""
        ...


class Substrate(Protocol):
    """What the solver asks of a substrate."""

    kind: ClassVar[str]
    words: ClassVar[str]

    def in_units(self, unit: float) -> Substrate:
        """The same substrate with another unit of height, given over the present one; lengths scale with its root."""
        ...

    @property
    def remainder(self) -> Remainder | None:
        """What its kernel has beyond the half-space's, if anything."""
        ...

    def spectrum(self, reach: float = 0.0) -> tuple[Array, Array]:
        """Wavenumbers k and weights (C(k) − 1) dk of a quadrature of the remainder, good for waves seen as far as `reach`."""
        ...

    @property
    def elastic(self) -> Substrate:
        """What it is without its memory."""
        ...

    @property
    def memory(self) -> Memory | None:
        """What it remembers under steady sliding, if anything."""
        ...

    @property
    def creep(self) -> Creep:
        """How it yields in time under a film that changes with time, over its relaxed compliance."""
        ...

    def hastened(self, factor: float) -> Substrate:
        """The same substrate passing so many times as fast."""
        ...

    def compliance(self, radius: float) -> float:
        """About what a contact of some radius sees of its relaxed compliance."""
        ...


class Kernel(Named):
    """A kernel that files know by its `kind`."""

    kinds: ClassVar[dict[str, type[Any]]] = {}
    usual: ClassVar[str] = "half-space"
    unknown: ClassVar[str] = "substrate: no"
    words: ClassVar[str] = "an elastic substrate"

    @property
    def elastic(self) -> Any:
        """Itself."""
        return self

    @property
    def memory(self) -> Memory | None:
        """None."""
        return None

    @property
    def creep(self) -> Creep:
        """It yields at once."""
        return ELASTIC

    def hastened(self, factor: float) -> Any:
        """Itself, however fast it passes."""
        return self

    def compliance(self, radius: float) -> float:
        """1: no other than the relaxed one."""
        return 1.0


class SubstratePart(Part):
    """A linear, isotropic substrate as a part of an experiment, in SI.

    Give exactly one of `young_modulus` and `shear_modulus`; it keeps the latter, G = E/(2(1 + ν)).
    """

    slot: ClassVar[str] = "substrate"
    young_modulus: float = given(
        "Young's modulus of the substrate",
        PRESSURE,
        "3 MPa",
        default=None,
        derived=lambda part: 2 * (1 + part.poisson_ratio) * part.shear_modulus,
    )
    shear_modulus: float = given("Shear modulus instead", PRESSURE, "1 MPa", default=None)
    poisson_ratio: float = given("Poisson's ratio of the substrate, 0 to 0.5", NUMBER, "0.45", default=0.5, between=(0, 0.5))
    radius: float | None = given(
        "Radius of a substrate that is a ball; negative for a cup",
        LENGTH,
        "5 mm",
        default=None,
        signed=True,
        absent="flat",
        remark="or '-5 mm' for a cup",
        flat="substrate_radius",
    )

    def checked(self, values: dict[str, Any]) -> dict[str, Any]:
        """The values with G alone of the two moduli."""
        if values["radius"] == 0:
            raise InputError(f"substrate_radius: zero; expected {self.inputs['radius'].expected}")
        pair = {name: values[name] for name in ("young_modulus", "shear_modulus")}
        exactly_one(pair, self.inputs)
        young = values.pop("young_modulus")
        if young is not None:
            values["shear_modulus"] = young / (2 * (1 + values["poisson_ratio"]))
        return values

    @property
    def contact_modulus(self) -> float:
        """G/(2(1 − ν)) [Pa]: a quarter of the effective modulus E*, and G itself at ν = 1/2, as in the paper."""
        return self.shear_modulus / (2 * (1 - self.poisson_ratio))

    @property
    def curvature(self) -> float:
        """1/R of its surface [1/m]; 0 if it is flat, negative for a cup."""
        return 0.0 if self.radius is None else 1 / self.radius

    def kernel(self, length_unit: float, share: float = 1.0, speed: float | None = None, time_unit: float = 1.0) -> Substrate:
        """What the solver sees of it and of an elastic ball on it, whose compliances add.

        Parameters
        ----------
        length_unit : float
            Length in the plane that it is normalised with [m].
        share : float
            What part of the compliance of both bodies, were both half-spaces, is the substrate's; 1 under a rigid ball.
        speed : float, optional
            Speed of the substrate's surface, seen from the contact [m/s]; None where the film changes with time.
        time_unit : float
            Time that a film that changes with time is normalised with [s].
        """
        raise NotImplementedError
