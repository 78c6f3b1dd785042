"""The Reynolds equation (1b), (6a) on the polar grid, conservative; of fourth order along r, of sixth along θ.

    ∇·(ρφu³∇p) + (1/β) ∂(ρu)/∂x = 0,

ρ the density and φ = η₀/η(p) the liquid's fluidity, 1 in the paper, and φ∇p = ∇q with the reduced pressure q of
`softlube.model.liquids`.  In the uniform coordinates (ξ, s) the flux f = ρu³∇q + (ρu/β) e_x balances as
∂_ξ(θ′ r f_r) + ∂_s(r′ f_θ) = 0 with r′ = dr/dξ and θ′ = dθ/ds.  Fluxes live on the faces of the cells: gradient and film come
from the four nearest nodes along r and the six nearest along θ, the divergence from as many faces.  The metric factors of the
Couette flux are differences of sin θ and r themselves, so that a uniform film carries no pressure, exactly.

A liquid that thins with shear has φu²m/6 in place of u³∇q, m(6u∇p, ΔU/u) the law of its flux (`softlube.model.film_section`).
There the component of the flux across a face depends on both components of the gradient: the one along the face is a difference
of fourth order, too.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.differences import FOURTH, SECOND, SIXTH, Differences, Faces, Sparse, sloping
from softlube.discretization.grid import PolarGrid
from softlube.model.film_section import film_section
from softlube.model.liquids import Liquid, NewtonianLaw
from softlube.model.motions import FIXED_BALL

Array = NDArray[np.floating]

CONSTANT = NewtonianLaw()


@dataclass(frozen=True)
class ReynoldsOperator:
    """The Reynolds equation on one grid.

    Attributes
    ----------
    grid : PolarGrid
    differences : Differences
        Those of the equation.
    nearest : Differences
        Those of second order, for a preconditioner with a narrow band.
    conductance, drag : ndarray, shape (faces,)
        Metric factors of u³∂p and of u/β on the faces.
    """

    grid: PolarGrid
    differences: Differences
    nearest: Differences
    conductance: Array
    drag: Array

    @cached_property
    def faces(self) -> Faces:
        """The faces for liquids that thin with shear, which alone need them."""
        return Faces.on(self.grid)

    @classmethod
    def on(cls, grid: PolarGrid) -> ReynoldsOperator:
        """Build the operator of a grid."""
        n_r, n_faces = grid.n_r, grid.n_r + 2  # from the centre (no area) to the one beyond the last cell, for fourth order
        r, r_face = grid.r[:n_r], grid.r_face[:n_faces]
        theta_face = grid.theta_of(grid.s_face)
        # Metric factors are differences themselves, of functions that are odd: of sin θ, θ′ cos θ, and of r, r′.
        sine = np.sin(theta_face)
        cosine = sloping(np.concatenate([-sine[2::-1], sine, -sine[:-4:-1]]), SIXTH) / grid.d_s
        stretch = sloping(np.concatenate([-r_face[1:2], r_face]), FOURTH) / grid.d_xi
        radial = np.outer(r_face / grid.dr_dxi(r_face), grid.dtheta_ds(grid.s))
        angular = np.outer(grid.dr_dxi(r) / r, 1 / grid.dtheta_ds(grid.s_face))
        return cls(
            grid=grid,
            differences=Differences.on(grid, FOURTH, SIXTH),
            nearest=Differences.on(grid, SECOND, SECOND),
            conductance=np.concatenate([radial.ravel(), angular.ravel()]),
            drag=np.concatenate([np.outer(r_face, cosine).ravel(), -np.outer(stretch, np.sin(theta_face)).ravel()]),
        )

    def at(
        self,
        pressure: Array,
        film: Array,
        speed: float,
        liquid: Liquid = CONSTANT,
        slide_to_roll: float = FIXED_BALL,
        mean_stress: Array | None = None,
    ) -> Flow:
        """The flow between the nodes.

        Parameters
        ----------
        pressure, film : ndarray, shape (n,)
            On all nodes, rim included.
        speed : float
            1/β, the normalised speed.
        liquid : Liquid
            Of its reduced pressure q and its density ρ the flux is ρu³∇q.
        slide_to_roll : float
            S, by which the walls' speeds differ by S/2 of their sum; only a liquid that thins with shear knows it.
        mean_stress : ndarray, shape (2, faces), optional
            `Flow.mean_stress` of a state close by, for a quick start.
        """
        return Flow(self, pressure, film, speed, liquid, slide_to_roll, mean_stress)

    def residual(
        self, pressure: Array, film: Array, speed: float, liquid: Liquid = CONSTANT, slide_to_roll: float = FIXED_BALL
    ) -> Array:
        """Minus the balance of (6a) at the unknown nodes, see `Flow.residual`; the parameters are those of `at`."""
        return self.at(pressure, film, speed, liquid, slide_to_roll).residual


class Driven(NamedTuple):
    """What the pressure drives through the faces, over the density there, and its derivatives.

    Attributes
    ----------
    flux : ndarray, shape (faces,)
        The flux.
    by_gradient : ndarray, shape (faces,)
        Derivative by the difference of the reduced pressure across the face.
    by_film : ndarray, shape (faces,)
        Derivative by the film on the face.
    by_tangent : ndarray or None, shape (faces,)
        Derivative by the gradient of the reduced pressure along the face; None for zero.
    by_pressure : ndarray or None, shape (faces,)
        Derivative by the pressure on the face, the reduced pressure held; None for zero.
    mean_stress : ndarray or None, shape (2, faces)
        Mean stress across the film; None where nothing depends on it.
    """

    flux: Array
    by_gradient: Array
    by_film: Array
    by_tangent: Array | None
    by_pressure: Array | None
    mean_stress: Array | None = None


def _thinning(
    operator: ReynoldsOperator,
    gradient: Array,
    reduced: Array,
    pressure: Array,
    film: Array,
    slip: float,
    liquid: Liquid,
    guess: Array | None,
) -> Driven:
    """The flux φu²m/6 of a liquid that thins with shear; slip is the walls' difference of speed, over β."""
    faces = operator.faces
    fluidity, steepness = liquid.fluidity(operator.differences.midpoint @ pressure)
    across, along = faces.across * gradient, faces.along @ reduced
    to_stress = 6 * film / fluidity
    difference = to_stress * (across * faces.normal + along * faces.tangent)
    drag = slip / (film * fluidity)
    section = film_section(liquid, difference, drag, guess=guess)
    normal = faces.normal
    moment = np.sum(normal * section.moment, axis=0)
    turned = np.einsum("ik,ijk->jk", normal, section.by_difference)
    by_difference, by_drag = np.sum(turned * difference, axis=0), np.sum(normal * section.by_drag, axis=0) * drag
    size = operator.conductance / faces.across
    return Driven(
        flux=size * film**2 * fluidity * moment / 6,
        by_gradient=operator.conductance * film**3 * np.sum(turned * normal, axis=0),
        by_film=size * film * fluidity / 6 * (2 * moment + by_difference - by_drag),
        by_tangent=size * film**3 * np.sum(turned * faces.tangent, axis=0),
        by_pressure=size * film**2 / 6 * (moment - by_difference - by_drag) * steepness,
        mean_stress=section.mean,
    )


class Flow:
    """Fluxes between the nodes under one pressure and film, and their exact derivatives.

    A difference of the pressure times a fluidity between the nodes is wrong where the fluidity falls by orders of magnitude
    from one to the next, and lets the solution hang on which node is highest; a difference of the reduced pressure q is
    bounded.

    Where the fluidity goes to zero nothing but ∂(ρu)/∂x is left of the equation, and a central formula does not see a film
    that alternates from node to node.  So the transported ρu is upwind-biased there, with the weight 1 − φ: not at all for
    constant viscosity.

    Parameters
    ----------
    operator : ReynoldsOperator
        The differences.
    pressure, film, speed, liquid, slide_to_roll, mean_stress
        See `ReynoldsOperator.at`.
    """

    def __init__(
        self,
        operator: ReynoldsOperator,
        pressure: Array,
        film: Array,
        speed: float,
        liquid: Liquid,
        slide_to_roll: float = FIXED_BALL,
        mean_stress: Array | None = None,
    ) -> None:
        differences = operator.differences
        self._operator = operator
        self._drag = speed * operator.drag
        self._film = film
        self._on_faces = carried = differences.midpoint @ film
        reduced = liquid.reduced_pressure(pressure)
        gradient = differences.slope @ reduced
        self._fluidity, self._thickening = liquid.fluidity(pressure)  # q′(p) and its change
        self._density, self._compression = liquid.density(pressure)
        self._constant = not (np.any(self._thickening) or np.any(self._compression))
        self._density_on_faces, self._weight, self._bias = np.ones(1), np.zeros(1), np.zeros(1)
        if not self._constant:
            carried = differences.midpoint @ (self._density * film)
            self._density_on_faces = differences.midpoint @ self._density
            self._weight = np.clip(1 - differences.midpoint @ self._fluidity, 0.0, 1.0)
            self._bias = differences.upstream @ (self._density * film)
        if liquid.thins:
            slip = speed * slide_to_roll / 2
            self._driven = _thinning(operator, gradient, reduced, pressure, self._on_faces, slip, liquid, mean_stress)
        else:
            mobility = operator.conductance * self._on_faces**3
            pushed = 3 * operator.conductance * self._on_faces**2 * gradient
            self._driven = Driven(mobility * gradient, mobility, pushed, None, None)
        poiseuille = self._density_on_faces * self._driven.flux
        self._flux = poiseuille + self._drag * (carried + self._weight * self._bias)

    @property
    def mean_stress(self) -> Array | None:
        """Mean stress across the film on the faces, shape (2, faces), of a liquid that thins with shear; None for another."""
        return self._driven.mean_stress

    @cached_property
    def residual(self) -> Array:
        """Minus the balance of (6a) at the unknown nodes; positive where the film would be starved (p = 0)."""
        return -(self._operator.differences.divergence @ self._flux)

    def entries(self, differences: Differences) -> tuple[Array, Array]:
        """Derivatives of the fluxes by pressure and by film, as entries of the pattern of some differences."""
        face, node = differences.face, differences.node
        slope, midpoint = differences.slope.data, differences.midpoint.data
        driven = self._driven
        pushed = self._density_on_faces * driven.by_film
        by_pressure = (self._density_on_faces * driven.by_gradient)[face] * slope
        if self._constant:
            return by_pressure, (pushed + self._drag)[face] * midpoint
        weight = self._weight
        transport = self._drag[face] * midpoint + (self._drag * weight)[face] * differences.upstream.data  # ∂/∂(ρu)
        steep = np.where((weight > 0) & (weight < 1), self._drag * self._bias, 0.0)
        pressed = driven.flux[face] * midpoint + transport * self._film[node]
        by_pressure = by_pressure * self._fluidity[node] - steep[face] * midpoint * self._thickening[node]
        by_pressure += pressed * self._compression[node]
        if driven.by_pressure is not None:
            by_pressure += (self._density_on_faces * driven.by_pressure)[face] * midpoint
        return by_pressure, pushed[face] * midpoint + transport * self._density[node]

    @cached_property
    def derivatives(self) -> tuple[Sparse, Sparse]:
        """Derivatives of the fluxes by pressure and by film, each of shape (faces, n); see `change` for the rest of them."""
        differences = self._operator.differences
        by_pressure, by_film = self.entries(differences)
        return differences.with_entries(by_pressure), differences.with_entries(by_film)

    def change(self, pressure: Array, film: Array) -> Array:
        """Change of `residual` with changes of pressure and film on all nodes."""
        by_pressure, by_film = self.derivatives
        flux = by_pressure @ pressure + by_film @ film
        if self._driven.by_tangent is not None:
            along = self._operator.faces.along @ (self._fluidity * pressure)
            flux += self._density_on_faces * self._driven.by_tangent * along
        return -(self._operator.differences.divergence @ flux)

    def diagonal(self, deflection: Array) -> Array:
        """Size of the residual's derivative by the own pressure of a node.

        Parameters
        ----------
        deflection : ndarray, shape (n,)
            What the pressure on a node does to the film there.
        """
        differences = self._operator.differences
        by_pressure, by_film = self.derivatives
        own = np.abs(differences.diagonal @ by_pressure.data)
        through = Sparse((np.abs(by_film.data), by_film.indices, by_film.indptr), by_film.shape) @ deflection
        return own + differences.span @ through
