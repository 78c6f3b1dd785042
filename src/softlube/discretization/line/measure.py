"""Quantities of a line contact, and its profiles; Eqs. (25)-(27) in one dimension.

Extrema are those of the polynomials on the panels; integrals are by Gauss's rule there, and in closed form beyond the mesh.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike, NDArray

from softlube.discretization.line.displacement import surface
from softlube.discretization.line.equations import LineEquations, LineState
from softlube.discretization.line.flow import largest_shear_rate, mean_stress
from softlube.discretization.line.panels import Panels

Array = NDArray[np.floating]

SAMPLES = 5
"""Samples on a panel for each of its points, from which the search for an extremum starts."""
NEWTON_STEPS = 12
"""Steps of that search; four are usual."""


@dataclass(frozen=True, eq=False)
class LineFields:
    """Film and pressure of a solved line contact, as functions of the place x over b.

    Parameters
    ----------
    equations : LineEquations
        With the mesh.
    state : LineState
        Their solution.
    """

    equations: LineEquations
    state: LineState

    @property
    def panels(self) -> Panels:
        """The mesh, whose places are x − `front`."""
        return self.equations.panels

    @property
    def front(self) -> float:
        """Place x of the mesh's origin: the free boundary, with the Reynolds condition."""
        return self.state.front

    @cached_property
    def x(self) -> Array:
        """Places of the nodes, over b, ascending; the inlet is at large x."""
        return self.front + self.panels.nodes

    @cached_property
    def film(self) -> Array:
        """Film at the nodes, over b²/R."""
        return self.equations.film(self.state)[:-1]

    @cached_property
    def pressure(self) -> Array:
        """Pressure at the nodes, over 4πG b/R."""
        return self.equations.pressure(self.state)

    @cached_property
    def film_coefficients(self) -> Array:
        """Legendre coefficients of the film on the panels."""
        return self.panels.coefficients(self.film)

    @cached_property
    def pressure_coefficients(self) -> Array:
        """Legendre coefficients of the pressure on the panels."""
        return self.panels.integral_coefficients(self.state.gradient, self.equations.ends)

    def film_at(self, x: ArrayLike) -> Array:
        """Film at places on the mesh; nan beyond it, such as behind a free boundary."""
        return self._at(self.film_coefficients, x, np.nan)

    def pressure_at(self, x: ArrayLike) -> Array:
        """Pressure at places; 0 beyond the mesh."""
        return self._at(self.pressure_coefficients, x, 0.0)

    def _at(self, coefficients: Array, x: ArrayLike, beyond: float) -> Array:
        s = np.asarray(x, dtype=float) - self.front
        inside = (s >= self.panels.edges[0]) & (s <= self.panels.edges[-1])
        values = self.panels.evaluate(coefficients, np.where(inside, s, self.panels.edges[0]).ravel()).reshape(s.shape)
        return np.where(inside, values, beyond)

    def opening(self, places: Array) -> tuple[Array, Array]:
        """The gap behind the free boundary, which the liquid fills in part.

        Parameters
        ----------
        places : ndarray
            Ends of panels behind the free boundary, distances from it, ascending.

        Returns
        -------
        x, gap : ndarray
        """
        behind = Panels(np.append(-places[::-1], self.panels.edges), self.panels.points)
        rows = surface(self.equations.problem.substrate, self.panels, behind)[: places.size * self.panels.points]
        x = self.front + behind.nodes[: len(rows)]
        moved = self.panels.through_integration(rows) @ self.state.gradient
        moved += self.panels.of_ends(rows) @ self.equations.ends
        return x, self.state.height + x**2 / 2 - moved


def extremum(panels: Panels, coefficients: Array, sign: int, after: float = -np.inf) -> tuple[float, float]:
    """Place and value of the greatest (sign 1) or least (sign −1) value of a function that is a polynomial on each panel.

    Parameters
    ----------
    panels : Panels
        The mesh.
    coefficients : ndarray, shape (number, k)
        Legendre coefficients of the function.
    sign : {1, -1}
        Which extremum.
    after : float
        Place upstream of which it is looked for.
    """
    t = np.linspace(-1, 1, SAMPLES * panels.points)
    values = sign * coefficients @ legendre.legvander(t, coefficients.shape[1] - 1).T
    values[panels.middle[:, None] + panels.half[:, None] * t < after] = -np.inf
    panel, sample = np.unravel_index(int(np.argmax(values)), values.shape)
    own = coefficients[panel]
    slope, curvature = legendre.legder(own), legendre.legder(own, 2)
    here, best = float(t[sample]), float(values[panel, sample])
    place = here
    for _ in range(NEWTON_STEPS):
        bend = sign * legendre.legval(place, curvature)
        if not bend < 0:
            break
        place = float(np.clip(place - sign * legendre.legval(place, slope) / bend, here - t[1] + t[0], here + t[1] - t[0]))
    place = float(np.clip(place, -1, 1))
    if sign * legendre.legval(place, own) < best:
        place = here
    return float(panels.middle[panel] + panels.half[panel] * place), float(legendre.legval(place, own))


def measure(fields: LineFields) -> dict[str, float]:
    """Quantities of `softlube.model.quantities.LINE` by their names, normalised with the load.

    Frictions are those of a cylinder that does not turn (of the problem's slide-to-roll ratio, where the film of the liquid
    depends on that), over the film that bears pressure: from the free boundary, or from
    far downstream, to far upstream, where ∫ dx/u is finite.
    """
    panels, equations, state = fields.panels, fields.equations, fields.state
    film, pressure, front, problem = fields.film, fields.pressure, fields.front, equations.problem
    weights, outside = panels.weights, equations.outside
    place, film_min = extremum(panels, fields.film_coefficients, -1)
    highest, pressure_max = extremum(panels, fields.pressure_coefficients, 1)
    _, steepest = extremum(panels, panels.coefficients(state.gradient), -1, after=-front)
    stress = mean_stress(problem, film, state.gradient, pressure)
    couette = float(weights @ stress) + sum(each.couette for each in outside)
    poiseuille = float(weights @ (3 * film * state.gradient)) + sum(each.poiseuille for each in outside)
    if not math.isfinite(couette) or not math.isfinite(poiseuille):  # under a power law with an index up to 1/2
        couette = poiseuille = math.nan
    # ∫ p ∂w/∂x dx by parts, with the pressure 0 at both ends.
    displacement = fields.x**2 / 2 - film
    hysteresis = -6 * float(weights @ ((displacement - np.max(displacement)) * state.gradient))
    sheared = largest_shear_rate(problem, film, state.gradient, pressure)
    remembers = problem.substrate.memory is not None
    values = {
        "load": float(
            equations.displacement.load @ state.gradient
            + equations.displacement.load_of_ends @ equations.ends
            + equations.load_beyond
        ),
        "film_center": float(fields.film_at(0.0)),
        "film_min": film_min,
        "film_min_place": front + place,
        "film_carried": state.flux,
        "pressure_center": float(fields.pressure_at(0.0)),
        "pressure_max": pressure_max,
        "pressure_max_place": front + highest,
        "pressure_gradient_inlet": -steepest,
        "friction_total": couette - poiseuille + (hysteresis if remembers else 0.0),
        "friction_viscous": couette - poiseuille,
        "friction_shear": couette + poiseuille,
        "friction_couette": couette,
        "friction_poiseuille": poiseuille,
        "shear_rate_max": extremum(panels, panels.coefficients(sheared), 1)[1],
    }
    if remembers:
        values["friction_hysteresis"] = hysteresis
    if equations.free_boundary:
        values["free_boundary"] = front
    return values
