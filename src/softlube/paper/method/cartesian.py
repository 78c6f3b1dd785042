"""The Cartesian twin, for the paper's comparison of meshes: the same equations and iteration on a uniform grid.

Half domain |x| ≤ 2, 0 ≤ y ≤ 2, symmetric about y = 0.  Fields have shape (n_x + 1, n_y + 1), x first.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.fft import irfft2, next_fast_len, rfft2
from scipy.interpolate import RectBivariateSpline

from softlube.discretization.chart import PolarChart
from softlube.discretization.fields import Fields
from softlube.model.problem import Cavitation
from softlube.paper.method.mesh import FEWEST, OUTER, PaperMesh
from softlube.paper.method.relaxation import first_guess
from softlube.paper.method.sweep import Wavefront

Array = NDArray[np.float64]
Elasticity = Literal["fft", "dense"]


@dataclass(frozen=True)
class CartesianMesh:
    """Uniform nodes over |x| ≤ 2, 0 ≤ y ≤ 2.

    Parameters
    ----------
    n_x, n_y : int
        Numbers of spacings: the paper's "100 × 50".
    """

    n_x: int = 100
    n_y: int = 50

    def __post_init__(self) -> None:
        if self.n_x < 8 or self.n_y < 4:
            raise ValueError(f"n_x, n_y: expected at least 8 x 4, got {self.n_x!r} x {self.n_y!r}")

    @property
    def dx(self) -> float:
        """Spacing along x."""
        return 2 * OUTER / self.n_x

    @property
    def dy(self) -> float:
        """Spacing along y."""
        return OUTER / self.n_y

    @cached_property
    def x(self) -> Array:
        """Nodes along x, shape (n_x + 1,)."""
        return np.linspace(-OUTER, OUTER, self.n_x + 1)

    @cached_property
    def y(self) -> Array:
        """Nodes along y, shape (n_y + 1,)."""
        return np.linspace(0, OUTER, self.n_y + 1)

    @property
    def shape(self) -> tuple[int, int]:
        """Shape of a field on the nodes."""
        return self.n_x + 1, self.n_y + 1


def rectangle_influence(x: ArrayLike, y: ArrayLike, width: float, height: float) -> Array:
    """−w at (x, y) under unit pressure on a rectangle about the origin, in closed form.

    Love 1929; Johnson, Contact Mechanics, 1985, Eq. (3.25), whose logarithms are written as arsinh to keep their digits.

    Parameters
    ----------
    x, y : array_like
        Target point, broadcast; corners and edges of the rectangle are no exception.
    width, height : float
        Sides along x and y.
    """
    x, y = np.asarray(x, float), np.asarray(y, float)

    def term(a: Array, b: Array) -> Array:
        """The term a arsinh(b/|a|), whose limit for a → 0 is 0."""
        safe = np.where(a == 0, 1.0, np.abs(a))
        return np.where(a == 0, 0.0, a * np.arcsinh(b / safe))

    def corner(a: Array, b: Array) -> Array:
        return term(a, b) + term(b, a)

    left, right, below, above = x - width / 2, x + width / 2, y - height / 2, y + height / 2
    return corner(right, above) - corner(left, above) - corner(right, below) + corner(left, below)


@dataclass(frozen=True)
class FFTElasticity:
    """Displacement by a convolution with the rectangles' influence, in O(n log n); zero padding makes it exact to round-off."""

    mesh: CartesianMesh

    @cached_property
    def _padded(self) -> tuple[int, int]:
        return next_fast_len(2 * self.mesh.n_x + 1, real=True), next_fast_len(4 * self.mesh.n_y + 1, real=True)

    @cached_property
    def _spectrum(self) -> NDArray[np.complex128]:
        (nx, ny), mesh = self._padded, self.mesh
        i, j = np.fft.fftfreq(nx, 1 / nx), np.fft.fftfreq(ny, 1 / ny)
        return rfft2(rectangle_influence(i[:, None] * mesh.dx, j * mesh.dy, mesh.dx, mesh.dy))

    def displacement(self, pressure: Array) -> Array:
        """Displacement w on the nodes from p on the nodes, both of shape (n_x + 1, n_y + 1)."""
        n_y = self.mesh.n_y
        whole = np.concatenate([pressure[:, :0:-1], pressure], axis=1)
        convolved = irfft2(rfft2(whole, self._padded) * self._spectrum, self._padded)
        return -convolved[: self.mesh.n_x + 1, n_y : 2 * n_y + 1]


@dataclass(frozen=True)
class DenseElasticity:
    """Pressure → displacement as a full matrix over the half domain: what the paper's "conventional" method costs.

    (n_x n_y)² numbers: 0.2 GB for 100 × 50, 3 GB for 200 × 100.
    """

    mesh: CartesianMesh

    @cached_property
    def matrix(self) -> Array:
        """Displacement w at all nodes per pressure at the nodes with x inside the border and y < 2; (targets, sources)."""
        mesh = self.mesh
        x, y = np.arange(mesh.n_x + 1)[:, None] * mesh.dx, np.arange(2 * mesh.n_y) * mesh.dy
        table = rectangle_influence(x, y, mesh.dx, mesh.dy)
        target, source = np.arange(mesh.n_y + 1)[:, None], np.arange(mesh.n_y)
        # The nodes on the axis are their own mirror images.
        both = table[:, np.abs(target - source)] + np.where(source == 0, 0.0, 1.0) * table[:, target + source]
        apart = np.abs(np.arange(mesh.n_x + 1)[:, None] - np.arange(1, mesh.n_x))
        matrix = np.empty((mesh.n_x + 1, mesh.n_y + 1, mesh.n_x - 1, mesh.n_y))
        for i, row in enumerate(apart):
            matrix[i] = -both[row].transpose(1, 0, 2)
        return matrix.reshape((mesh.n_x + 1) * (mesh.n_y + 1), -1)

    def displacement(self, pressure: Array) -> Array:
        """Displacement w on the nodes from p on the nodes, zero on the border."""
        return (self.matrix @ pressure[1:-1, :-1].ravel()).reshape(self.mesh.shape)


@dataclass(frozen=True)
class CartesianScheme:
    """Equation (6a) by central differences on the uniform grid; a `softlube.paper.method.relaxation.Scheme`."""

    mesh: CartesianMesh
    kind: Elasticity = "fft"

    def __post_init__(self) -> None:
        if self.kind not in get_args(Elasticity):
            raise ValueError(f"elasticity: expected 'fft' or 'dense', got {self.kind!r}")

    @cached_property
    def elasticity(self) -> FFTElasticity | DenseElasticity:
        """Pressure → displacement."""
        return FFTElasticity(self.mesh) if self.kind == "fft" else DenseElasticity(self.mesh)

    @cached_property
    def _wavefront(self) -> Wavefront:
        return Wavefront((self.mesh.n_x - 1, self.mesh.n_y))

    @cached_property
    def _height(self) -> Array:
        return -1 + (self.mesh.x[:, None] ** 2 + self.mesh.y**2) / 2

    def guess(self) -> Array:
        """First guess of the pressure, shape (n_x + 1, n_y + 1)."""
        return first_guess(np.hypot(self.mesh.x[:, None], self.mesh.y))

    def film(self, pressure: Array) -> Array:
        """Film thickness u = −1 + r²/2 − w, Eq. (6c)."""
        return self._height - self.elasticity.displacement(pressure)

    def sweep(self, pressure: Array, film: Array, beta: float, factor: float, *, floor: float) -> Array:
        """One sweep (19) towards +x and away from the axis, (A4) with equal spacings along x and y; p = 0 on the border."""
        mesh = self.mesh
        p, u = pressure[1:-1, :-1], film[1:-1, :-1]
        u_x = film[2:, :-1] - film[:-2, :-1]
        u_y = np.zeros_like(u)
        u_y[:, 1:] = film[1:-1, 2:] - film[1:-1, :-2]
        along, across = u**2 / mesh.dx**2, u**2 / mesh.dy**2
        before_x, after_x = along * (u - 0.75 * u_x), along * (u + 0.75 * u_x)
        before_y, after_y = across * (u - 0.75 * u_y), across * (u + 0.75 * u_y)
        # On the axis the node before is the mirror image of the node after.
        after_y[:, 0] += before_y[:, 0]
        before_y[:, 0] = 0
        centre = -2 * u * (along + across)
        known = -u_x / (2 * mesh.dx * beta) - centre * p - after_x * pressure[2:, :-1] - after_y * pressure[1:-1, 1:]
        scale = factor / centre
        new = np.zeros_like(pressure)
        new[1:-1, :-1] = self._wavefront.solve(p + scale * known, scale * before_y, scale * before_x, floor=floor)
        return new

    def load(self, pressure: Array) -> float:
        """∫p dA over the square, uniform pressure on the rectangles."""
        return float((2 * pressure[:, 1:].sum() + pressure[:, 0].sum()) * self.mesh.dx * self.mesh.dy)

    def fields(self, pressure: Array, beta: float, cavitation: Cavitation) -> Fields:
        """The solution as functions of position, interpolated to polar nodes; truncated pressure stays non-negative."""
        mesh = self.mesh
        polar = PaperMesh(max(mesh.n_x, FEWEST), mesh.n_y)
        x, y = polar.r[:, None] * np.cos(polar.theta), polar.r[:, None] * np.sin(polar.theta)

        def interpolate(values: Array) -> Array:
            whole = np.concatenate([values[:, :0:-1], values], axis=1)
            spline = RectBivariateSpline(mesh.x, np.concatenate([-mesh.y[:0:-1], mesh.y]), whole, kx=3, ky=3, s=0)
            return spline(x, y, grid=False)

        p = interpolate(pressure)
        if cavitation == "reynolds":
            p = np.maximum(p, 0)
        film, load = interpolate(self.film(pressure)), self.load(pressure)
        return Fields(PolarChart(), polar.r, polar.theta, p, film, beta, cavitation, load)
