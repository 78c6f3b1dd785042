"""The polar scheme: mesh, elasticity and Reynolds stencil put together into one sweep (19)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.chart import PolarChart
from softlube.discretization.fields import Fields
from softlube.model.problem import Cavitation
from softlube.paper.method.cells import RingElasticity, cell_corners
from softlube.paper.method.mesh import PaperMesh
from softlube.paper.method.relaxation import first_guess
from softlube.paper.method.stencil import centre_pressure, reynolds_stencil
from softlube.paper.method.sweep import Wavefront

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PolarScheme:
    """The paper's discretisation on one mesh; a `softlube.paper.method.relaxation.Scheme`."""

    mesh: PaperMesh

    @cached_property
    def elasticity(self) -> RingElasticity:
        """Pressure → displacement."""
        return RingElasticity(self.mesh)

    @cached_property
    def _wavefront(self) -> Wavefront:
        return Wavefront((self.mesh.n_r - 1, self.mesh.n_theta + 1))

    def guess(self) -> Array:
        """First guess of the pressure, shape (n_r + 1, n_theta + 1)."""
        return np.repeat(first_guess(self.mesh.r)[:, None], self.mesh.n_theta + 1, axis=1)

    def film(self, pressure: Array) -> Array:
        """Film thickness u = −1 + r²/2 − w, Eq. (6c)."""
        return -1 + self.mesh.r[:, None] ** 2 / 2 - self.elasticity.displacement(pressure)

    def sweep(self, pressure: Array, film: Array, beta: float, factor: float, *, floor: float) -> Array:
        """One sweep (19): the centre by (16), then outwards along j and from the inlet along i, p = 0 at r = 2."""
        new = np.zeros_like(pressure)
        p0 = pressure[0, 0] + factor * (centre_pressure(pressure, film, self.mesh, beta) - pressure[0, 0])
        new[0] = max(p0, floor)
        at = reynolds_stencil(film, self.mesh, beta)
        p = pressure[1:-1]
        # The part of (19) with old values: those of the nodes after this one, and the mirror angle i = −1 of (17a).
        known = at.F - at.C * p - at.D * pressure[2:]
        known[:, :-1] -= at.E[:, :-1] * p[:, 1:]
        known[:, -1] -= at.E[:, -1] * p[:, -2]
        known[:, 0] -= at.A[:, 0] * p[:, 1]
        known[0] -= at.B[0] * new[0]
        scale = factor / at.C
        new[1:-1] = self._wavefront.solve(p + scale * known, scale * at.A, scale * at.B, floor=floor)
        return new

    def load(self, pressure: Array) -> float:
        """∫p dA over r ≤ 2, uniform pressure on the cells."""
        corners = cell_corners(self.mesh)
        x, y = corners[..., 0], corners[..., 1]
        area = ((x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum(axis=1)) / 2
        share = np.full(self.mesh.n_theta + 1, 2.0)
        share[[0, -1]] = 1.0
        return float(area @ pressure[:-1] @ share)

    def fields(self, pressure: Array, beta: float, cavitation: Cavitation) -> Fields:
        """The solution as functions of position."""
        film, load = self.film(pressure), self.load(pressure)
        return Fields(PolarChart(), self.mesh.r, self.mesh.theta, pressure, film, beta, cavitation, load)
