"""Piecewise polynomials on a line: panels with Gauss points, integrals, interpolation.

A function is known by its values at the m Gauss points of every panel, which are the values of a polynomial of degree m − 1
there.  The pressure is the integral of such a function, dp/dx, so that it is continuous and of degree m on each panel.
Places s are counted towards the inlet, from the free boundary or from another place near the contact.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.floating]


@lru_cache(maxsize=32)
def reference(points: int) -> tuple[Array, Array, Array, Array]:
    """Gauss points and weights on −1 … 1, and matrices from values at the points to Legendre coefficients.

    Returns
    -------
    t, weight : ndarray, shape (points,)
    coefficients : ndarray, shape (points, points)
        Of the polynomial through the values.
    integral : ndarray, shape (points + 1, points)
        Of its integral from t to 1.
    """
    t, weight = legendre.leggauss(points)
    coefficients = np.linalg.inv(legendre.legvander(t, points - 1))
    integral = -legendre.legint(coefficients, axis=0)
    integral[0] -= integral.sum(axis=0)  # every P_k(1) is 1
    return t, weight, coefficients, integral


@dataclass(frozen=True, eq=False)
class Panels:
    """Panels on a line, each with the same number of Gauss points.

    Parameters
    ----------
    edges : ndarray, shape (panels + 1,)
        Ends of the panels, ascending.
    points : int
        Gauss points m on each panel.
    """

    edges: Array
    points: int

    @property
    def number(self) -> int:
        """How many panels there are."""
        return self.edges.size - 1

    @property
    def size(self) -> int:
        """How many points there are."""
        return self.number * self.points

    @cached_property
    def half(self) -> Array:
        """Half of each panel's length."""
        return np.diff(self.edges) / 2

    @cached_property
    def middle(self) -> Array:
        """Middle of each panel."""
        return (self.edges[1:] + self.edges[:-1]) / 2

    @cached_property
    def nodes(self) -> Array:
        """Places of the points, shape (size,)."""
        return (self.middle[:, None] + self.half[:, None] * reference(self.points)[0]).ravel()

    @cached_property
    def weights(self) -> Array:
        """Weights of Gauss's rule at the points, shape (size,)."""
        return (self.half[:, None] * reference(self.points)[1]).ravel()

    def coefficients(self, values: Array) -> Array:
        """Legendre coefficients on each panel of the function with some values at the points, shape (number, points)."""
        return values.reshape(self.number, self.points) @ reference(self.points)[2].T

    @cached_property
    def turn(self) -> int:
        """Panels downstream of s = 0: on them integrals are counted from the downstream end, so that round-off decays, too."""
        return int(np.count_nonzero(self.edges[1:] <= 0))

    def integral_coefficients(self, values: Array, ends: Array) -> Array:
        """Legendre coefficients on each panel of a function f.

        Parameters
        ----------
        values : ndarray, shape (size,)
            f′ at the points.
        ends : ndarray, shape (2,)
            f at the downstream and at the upstream end.

        Returns
        -------
        ndarray, shape (number, points + 1)
        """
        parts = values.reshape(self.number, self.points)
        own = -self.half[:, None] * (parts @ reference(self.points)[3].T)
        whole = (self.weights * values).reshape(self.number, self.points).sum(axis=1)
        up_to = np.cumsum(whole)
        beyond = np.cumsum(whole[::-1])[::-1] - whole
        downstream = np.arange(self.number) < self.turn
        own[:, 0] += np.where(downstream, ends[0] + up_to, ends[1] - beyond)
        return own

    def through_integration(self, rows: Array) -> Array:
        """Functionals of f as functionals of f′, where f vanishes at both ends.

        Parameters
        ----------
        rows : ndarray, shape (n, number, points + 1)
            Functionals on the Legendre coefficients of f on each panel.

        Returns
        -------
        ndarray, shape (n, size)
            The functionals on the values of f′ at the points.
        """
        constants = rows[:, :, 0].copy()
        from_downstream = constants.copy()
        constants[:, : self.turn] = 0
        from_downstream[:, self.turn :] = 0
        whole = np.cumsum(constants, axis=1) - constants - np.cumsum(from_downstream[:, ::-1], axis=1)[:, ::-1]
        own = rows @ reference(self.points)[3] * self.half[:, None]
        own += whole[:, :, None] * self.weights.reshape(self.number, -1)
        return -own.reshape(len(rows), self.size)

    @cached_property
    def values_at_nodes(self) -> Array:
        """Rows of `through_integration` that give f at the points, shape (size, number, points + 1)."""
        rows = np.zeros((self.number, self.points, self.number, self.points + 1))
        each = np.arange(self.number)
        rows[each, :, each, :] = legendre.legvander(reference(self.points)[0], self.points)
        return rows.reshape(self.size, self.number, -1)

    @cached_property
    def integral_at_nodes(self) -> Array:
        """Matrix from f′ at the points to f at the points, where f vanishes at both ends, shape (size, size)."""
        return self.through_integration(self.values_at_nodes)

    def of_ends(self, rows: Array) -> Array:
        """What `through_integration` leaves out: functionals of the part of f that the values at the two ends make.

        Returns
        -------
        ndarray, shape (n, 2)
            For f = 1 at the downstream and at the upstream end.
        """
        constants = rows[:, :, 0]
        return np.stack([constants[:, : self.turn].sum(axis=1), constants[:, self.turn :].sum(axis=1)], axis=1)

    def panel_of(self, places: Array) -> NDArray[np.integer]:
        """Number of the panel on which each place lies."""
        return np.clip(np.searchsorted(self.edges, places, side="right") - 1, 0, self.number - 1)

    def evaluate(self, coefficients: Array, places: Array) -> Array:
        """Values at some places of the function with some Legendre coefficients on each panel."""
        panel = self.panel_of(places)
        t = (places - self.middle[panel]) / self.half[panel]
        return np.einsum("ij,ij->i", legendre.legvander(t, coefficients.shape[1] - 1), coefficients[panel])

    def split(self, which: NDArray[np.bool_]) -> Panels:
        """Panels of which some are cut in two.

        A panel far from s = 0 and long is cut where both parts have the same ratio of their ends.
        """
        left, right = self.edges[:-1][which], self.edges[1:][which]
        near, far = np.minimum(np.abs(left), np.abs(right)), np.maximum(np.abs(left), np.abs(right))
        ratio = (left * right > 0) & (far > 4 * near)
        cut = np.where(ratio, np.sign(right) * np.sqrt(near * far), (left + right) / 2)
        return Panels(np.sort(np.append(self.edges, cut)), self.points)

    def joined(self, which: NDArray[np.bool_]) -> Panels:
        """Panels of which those are joined with their next neighbour that are marked, as far as the neighbour is too."""
        keep = np.ones(self.edges.size, dtype=bool)
        last = False
        for k in range(self.number - 1):
            last = bool(not last and which[k] and which[k + 1])
            keep[k + 1] = not last
        return Panels(self.edges[keep], self.points)

    def with_points(self, points: int) -> Panels:
        """The panels with another number of points on each."""
        return Panels(self.edges, points)
