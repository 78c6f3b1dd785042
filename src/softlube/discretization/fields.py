"""Pressure and film as smooth functions of position: all that a read-out, a picture or a file knows of a discretisation."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softlube.discretization.splines import Spline, Weights
from softlube.errors import InputError
from softlube.model.dry import PARABOLOID
from softlube.model.film_section import film_section
from softlube.model.indenters import Shape
from softlube.model.liquids import Liquid, NewtonianLaw
from softlube.model.motions import FIXED_BALL
from softlube.model.problem import Cavitation

Array = NDArray[np.floating]

SHARP = 0.3
"""Change of ln η from a node to the next along r, in the outlet half, up to which the pressure counts as smooth on the grid.

Beyond it a cubic interpolant overshoots between the flanks of a spike (docs/notes/viscosity.md; measured with
benchmarks/spike_sphere.py)."""


FAR = 0.5
"""Difference of the film from the indenter's height, over the height, up to which the film has the height's slopes,
from outside."""
MARGIN = 5
"""Nodes beyond θ = 0 and π in a spline: what its end does has died out before them."""


class Chart(Protocol):
    """Coordinates (ξ, s) in which fields are interpolated: ξ odd in r, θ(s) mapping [0, π] onto itself."""

    def xi_of(self, r: ArrayLike) -> Array: ...
    def r_of(self, xi: ArrayLike) -> Array: ...
    def dr_dxi(self, r: ArrayLike) -> Array: ...
    def s_of(self, theta: ArrayLike) -> Array: ...
    def theta_of(self, s: ArrayLike) -> Array: ...
    def dtheta_ds(self, s: ArrayLike) -> Array: ...
    def scaled(self, factor: float) -> Chart: ...


class Mesh:
    """Nodes in polar coordinates, and in those of a chart with their images across the centre and across θ = 0 and π.

    Parameters
    ----------
    chart : Chart
        The coordinates.
    r, theta : ndarray, shape (n_r,) and (n_theta,)
        See `Fields`.
    """

    def __init__(self, chart: Chart, r: Array, theta: Array) -> None:
        self.chart, self.r, self.theta = chart, r, theta
        self.xi, self.s = chart.xi_of(r), chart.s_of(theta)
        self.centre = int(r[0] == 0)  # whether there is a ring at the centre, which is its own image
        self.xi_nodes = np.concatenate([-self.xi[self.centre :][::-1], self.xi])
        self.s_nodes = _folded_out(self.s)
        self.s_film = _folded_out(np.linspace(0, np.pi, 2 * self.s.size - 1))

    @cached_property
    def waves(self) -> Array:
        """Matrix from values on the nodes of a ring to those on twice as many, on the trigonometric polynomial through them.

        It is the polynomial of which the displacement is computed (`softlube.discretization.elasticity.angular_transform`).
        """
        m = np.arange(self.s.size)
        ends = np.where((m == 0) | (m == m[-1]), 0.5, 1.0)
        coefficients = np.cos(np.outer(m, self.s)) * ends * ends[:, None] * 2 / m[-1]
        return np.cos(np.outer(np.linspace(0, np.pi, 2 * self.s.size - 1), m)) @ coefficients

    @cached_property
    def nodes(self) -> Places:
        """The nodes, without the innermost ring."""
        return self.places(self.xi[1:], self.s)

    def places(self, xi: Array, s: Array) -> Places:
        """The product of chart coordinates ξ and s."""
        return Places(self, xi, s)


def _folded_out(s: Array) -> Array:
    """Nodes from 0 to π with `MARGIN` of their images on either side."""
    return np.concatenate([-s[MARGIN:0:-1], s, 2 * np.pi - s[-2 : -2 - MARGIN : -1]])


@lru_cache(maxsize=16)
def _mesh(chart: Chart, r: bytes, theta: bytes) -> Mesh:
    """The mesh of some nodes; meshes come again, and much is known of their places then."""
    return Mesh(chart, np.frombuffer(r), np.frombuffer(theta))


class Sheared(NamedTuple):
    """A liquid that thins with shear at some places.

    Attributes
    ----------
    mean : ndarray
        Mean shear stress across the film along x, in units of (2π/3) G (unit of height)/R.
    rest : ndarray
        What it would be at rest: (η/η₀)/(βū) times S/2.
    stress : ndarray, shape (2, …)
        Size of the shear stress on the substrate and on the sphere.
    rate : ndarray, shape (2, …)
        Shear rate there, in units of v over the unit of height.
    """

    mean: Array
    rest: Array
    stress: Array
    rate: Array


@dataclass(frozen=True)
class Fields:
    """Pressure and film on the nodes of a polar mesh, normalised as in the paper, Eq. (4), with |h₀| or another unit of height.

    Parameters
    ----------
    chart : Chart
        Smooth coordinates of the mesh.
    r : ndarray, shape (n_r,)
        Radii of the nodes, increasing; 0 may be among them.
    theta : ndarray, shape (n_theta,)
        Angles of the nodes from the inlet, 0 … π.
    pressure, film : ndarray, shape (n_r, n_theta)
        p̄ and ū.
    beta : float
        β, Eq. (6d), with the unit of height in place of |h₀|.
    cavitation : {"reynolds", "none"}
    load : float
        ∫p dA over the whole plane, taken by the discretisation's own quadrature.
    height : float
        h₀ over the unit of height: −1 in the paper's normalisation.
    liquid : Liquid
        The law of the viscosity.
    indenter : Shape
        The indenter's surface.
    slide_to_roll : float
        See `softlube.Problem`.
    recovery : ndarray, shape (n_r, n_theta), optional
        Slope of the surface by what the substrate remembers, see `softlube.discretization.memory.MemoryOperator.slope`.
    """

    chart: Chart
    r: Array
    theta: Array
    pressure: Array
    film: Array
    beta: float
    cavitation: Cavitation
    load: float
    height: float = -1.0
    liquid: Liquid = field(default_factory=NewtonianLaw)
    indenter: Shape = PARABOLOID
    slide_to_roll: float = FIXED_BALL
    recovery: Array | None = None

    def in_units(self, unit: float) -> Fields:
        """The same fields normalised with another unit of height, given over the present one; Eq. (4)."""
        return Fields(
            chart=self.chart.scaled(unit**-0.5),
            r=self.r * unit**-0.5,
            theta=self.theta,
            pressure=self.pressure * unit**-0.5,
            film=self.film / unit,
            beta=self.beta * unit**2,
            cavitation=self.cavitation,
            load=self.load * unit**-1.5,
            height=self.height / unit,
            liquid=self.liquid.in_units(unit),
            indenter=self.indenter.in_units(unit),
            slide_to_roll=self.slide_to_roll,
            recovery=None if self.recovery is None else self.recovery * unit**-0.5,
        )

    @cached_property
    def steepest_fall(self) -> float:
        """Largest change of ln η from a node to the next along r, in the outlet half: 0 for constant viscosity."""
        outlet = self.pressure[:, self.theta > np.pi / 2]
        return float(np.max(np.abs(np.diff(np.log(self.liquid.viscosity(outlet)), axis=0))))

    @property
    def is_sharp(self) -> bool:
        """Whether the pressure is not smooth on its grid, because of a spike, whose height converges like the spacing only."""
        return self.steepest_fall > SHARP

    @cached_property
    def mesh(self) -> Mesh:
        """The nodes."""
        return _mesh(self.chart, self.r.tobytes(), self.theta.tobytes())

    def _spline(self, values: Array) -> Spline:
        """Cubic spline through nodal values, or values on twice as many angles, even across θ = 0 and π and the centre."""
        mesh = self.mesh
        nodes = mesh.s_nodes if values.shape[1] == mesh.s.size else mesh.s_film
        values = np.concatenate([values[mesh.centre :][::-1, ::-1], values])
        values = np.concatenate([values[:, MARGIN:0:-1], values, values[:, -2 : -2 - MARGIN : -1]], axis=1)
        return Spline.through(mesh.xi_nodes, nodes, values)

    @cached_property
    def pressure_spline(self) -> Spline:
        """p̄(ξ, s)."""
        return self._spline(self.pressure)

    @cached_property
    def reduced_spline(self) -> Spline:
        """Reduced pressure q = ∫ η₀/η dp (ξ, s): its gradient drives the flow, and it is smooth at a spike of p̄."""
        reduced = self.liquid.reduced_pressure(self.pressure)
        return self.pressure_spline if reduced is self.pressure else self._spline(reduced)

    @cached_property
    def film_spline(self) -> Spline:
        """ū(ξ, s).

        Along θ a film is smooth, also where the pressure is not, and narrow at the sides.  So the spline runs through the
        trigonometric polynomial through its nodes, on twice as many.

        Far outside a film is nearly the indenter's height, which may grow so fast that a spline through a few nodes swings.
        There the slopes are the height's own, and a spline's only of what the film differs from it.
        """
        spline = self._spline(self.film @ self.mesh.waves.T)
        if self.indenter == PARABOLOID:
            return spline
        height, slope = self.indenter.height(self.r), self.indenter.slope(self.r) * self.chart.dr_dxi(self.r)
        difference = self.film - height[:, None]
        near = np.flatnonzero(np.any(np.abs(difference) > FAR * height[:, None], axis=1))
        far = self.r.size - 1 - (int(near[-1]) if near.size else 0)  # rings on either end of the nodes
        slopes = self._spline(difference @ self.mesh.waves.T).table[1]
        slopes[:, 0] += np.concatenate([-slope[self.mesh.centre :][::-1], slope])[:, None]
        for end in (slice(far), slice(self.mesh.xi_nodes.size - far, None)):
            spline.table[1, end] = slopes[end]
        return spline

    @cached_property
    def recovery_spline(self) -> Spline:
        """Slope of the surface by what the substrate remembers (ξ, s).

        Raises
        ------
        InputError
            If it remembers nothing.
        """
        if self.recovery is None:
            raise InputError("solution: its substrate is elastic and remembers nothing")
        return self._spline(self.recovery)

    def _place(self, r: ArrayLike, theta: ArrayLike) -> tuple[Array, Array]:
        r, theta = np.broadcast_arrays(np.asarray(r, dtype=float), np.asarray(theta, dtype=float))
        if np.any(r < 0) or np.any(r > self.r[-1]):
            raise ValueError(f"r: the solution reaches from 0 to {self.r[-1]:.4g}, got {np.min(r):.4g} to {np.max(r):.4g}")
        folded = np.abs(np.remainder(theta + np.pi, 2 * np.pi) - np.pi)
        return self.chart.xi_of(r), self.chart.s_of(folded)

    def pressure_at(self, r: ArrayLike, theta: ArrayLike) -> Array:
        """p̄ at polar coordinates (broadcast); any θ, the field being even.

        Under the Reynolds condition the interpolant's tiny undershoot at the free boundary is cut off.
        """
        xi, s = self._place(r, theta)
        pressure = self.pressure_spline(xi, s, grid=False)
        return np.maximum(pressure, 0) if self.cavitation == "reynolds" else pressure

    def film_at(self, r: ArrayLike, theta: ArrayLike) -> Array:
        """ū at polar coordinates (broadcast)."""
        xi, s = self._place(r, theta)
        return self.film_spline(xi, s, grid=False)

    def recovery_at(self, r: ArrayLike, theta: ArrayLike) -> Array:
        """Slope of the surface by what the substrate remembers at polar coordinates (broadcast); see `recovery_spline`."""
        xi, s = self._place(r, theta)
        return self.recovery_spline(xi, s, grid=False)

    def film_on(self, at: Places) -> Array:
        """ū at places."""
        return at.on(self.film_spline)

    def pressure_on(self, at: Places) -> Array:
        """p̄ at places."""
        return at.on(self.pressure_spline)

    @property
    def slip(self) -> float:
        """What the walls' speeds differ by, S/2 of their sum, over β: the shear stress times the film at constant viscosity."""
        return self.slide_to_roll / 2 / self.beta

    def sheared_on(self, at: Places) -> Sheared:
        """Stresses and shear rates of a liquid that thins with shear at places with ξ > 0."""
        film, (fluidity, _) = self.film_on(at), self.liquid.fluidity(self.pressure_on(at))
        half = 3 * film / fluidity * np.stack(self.gradient_on(at, self.reduced_spline))
        rest = self.slip / (film * fluidity)
        section = film_section(self.liquid, 2 * half.reshape(2, -1), rest.ravel())
        mean = section.mean.reshape(half.shape)
        stress = np.stack([np.hypot(*(mean - half)), np.hypot(*(mean + half))])
        rate = self.beta * fluidity * stress * np.exp(self.liquid.fluidity_at(np.maximum(stress, 1e-150))[0])
        return Sheared(mean[0], rest, stress, rate)

    @cached_property
    def sheared(self) -> Sheared:
        """Stresses and shear rates on the nodes, without a ring at the centre, of a liquid that thins with shear."""
        return self.sheared_on(self.mesh.places(self.mesh.xi[self.mesh.centre :], self.mesh.s))

    def nodal_spline(self, values: Array) -> Spline:
        """Spline through values on the nodes of `sheared`."""
        centre = np.full((self.mesh.centre, values.shape[1]), np.mean(values[0]))
        return self._spline(np.concatenate([centre, values]))

    @cached_property
    def _ln_drag(self) -> Spline:
        """Logarithm of the mean shear stress along x over that of the liquid at rest, for a liquid that thins with shear."""
        return self.nodal_spline(np.log(self.thinned))

    @property
    def thinned(self) -> Array:
        """Mean shear stress along x over that of the liquid at rest, on the nodes of `sheared`."""
        return self.sheared.mean / self.sheared.rest

    def viscosity_on(self, at: Places) -> Array:
        """η(p)/η₀ at places, of the liquid at rest."""
        return self.liquid.viscosity(self.pressure_on(at))

    def drag_on(self, at: Places) -> Array:
        """Mean shear stress across the film along x, in units of (2π/3) G (unit of height)/R; (η/η₀)/(βū) if nothing thins.

        On the sphere the shear stress is this plus 3ū ∂p̄/∂x, on the substrate less.
        """
        thinned = np.exp(at.on(self._ln_drag)) if self.liquid.thins and self.slip else 1.0
        return self.drag_under(self.pressure_on(at), self.film_on(at), thinned)

    def drag_under(self, pressure: Array, film: Array, thinned: Array | float = 1.0) -> Array:
        """What `drag_on` gives, from pressure, film, and the mean shear stress over that of the liquid at rest."""
        return self.liquid.limited(self.liquid.viscosity(pressure) * self.slip / film * thinned, pressure)

    def gradient_on(self, at: Places, spline: Spline | None = None) -> tuple[Array, Array]:
        """Cartesian gradient of the pressure, or of another spline, at places with ξ > 0."""
        spline = self.pressure_spline if spline is None else spline
        by_r = at.on(spline, dx=1) / at.dr_dxi[:, None]
        by_theta = at.on(spline, dy=1) / at.dtheta_ds / at.r[:, None]
        return at.cosine * by_r - at.sine * by_theta, at.sine * by_r + at.cosine * by_theta


@dataclass(frozen=True)
class Places:
    """The product of chart coordinates ξ and s, with all that depends on the places only.

    Attributes
    ----------
    mesh : Mesh
        On whose nodes the splines lie that are evaluated there.
    xi, s : ndarray
        Increasing, of one dimension each.
    """

    mesh: Mesh
    xi: Array
    s: Array

    @cached_property
    def across(self) -> Weights:
        """Weights of the cubics along ξ."""
        return Weights(self.mesh.xi_nodes, self.xi)

    @cached_property
    def along(self) -> Weights:
        """Weights of the cubics along s."""
        return Weights(self.mesh.s_nodes, self.s)

    @cached_property
    def along_film(self) -> Weights:
        """Weights of the cubics along s of a film."""
        return Weights(self.mesh.s_film, self.s)

    def on(self, spline: Spline, dx: int = 0, dy: int = 0) -> Array:
        """Values or derivatives of a spline through the nodes of the mesh or a film's, shape (ξ, s)."""
        return spline.on(self.across, self.along if spline.y is self.mesh.s_nodes else self.along_film, dx, dy)

    @cached_property
    def r(self) -> Array:
        """Radii."""
        return self.mesh.chart.r_of(self.xi)

    @cached_property
    def dr_dxi(self) -> Array:
        """Derivative dr/dξ."""
        return self.mesh.chart.dr_dxi(self.r)

    @cached_property
    def theta(self) -> Array:
        """Angles."""
        return self.mesh.chart.theta_of(self.s)

    @cached_property
    def dtheta_ds(self) -> Array:
        """Derivative dθ/ds."""
        return self.mesh.chart.dtheta_ds(self.s)

    @cached_property
    def cosine(self) -> Array:
        """Cosine of θ."""
        return np.cos(self.theta)

    @cached_property
    def sine(self) -> Array:
        """Sine of θ."""
        return np.sin(self.theta)
