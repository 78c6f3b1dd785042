"""The discrete Reynolds equation on the polar mesh: differences (10), (11), the stencil (13) with (A4), the centre node (16).

Fields have shape (n_r + 1, n_theta + 1): f[j, i] is the paper's f_{i,j}.  Coefficients live on the inner circles
j = 1 … n_r − 1 and have shape (n_r − 1, n_theta + 1).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from softlube.paper.method.mesh import PaperMesh

Array = NDArray[np.float64]


def mirrored(f: Array) -> Array:
    """Field with the ghost angles i = −1 and i = m + 1 that reflective symmetry asks for, Eq. (17a); two columns wider."""
    return np.concatenate([f[:, 1:2], f, f[:, -2:-1]], axis=1)


def d_dtheta(f: Array, mesh: PaperMesh) -> Array:
    """∂f/∂θ on the inner circles, Eq. (10a)."""
    g = mirrored(f[1:-1])
    return (g[:, 2:] - g[:, :-2]) / (2 * mesh.d_theta)


def d2_dtheta2(f: Array, mesh: PaperMesh) -> Array:
    """∂²f/∂θ² on the inner circles, Eq. (10b)."""
    g = mirrored(f[1:-1])
    return (g[:, 2:] - 2 * g[:, 1:-1] + g[:, :-2]) / mesh.d_theta**2


def d_dr(f: Array, mesh: PaperMesh) -> Array:
    """∂f/∂r on the inner circles, Eq. (11a)."""
    lam, d = mesh.ratio[:, None], mesh.d[1:, None]
    return (f[2:] - lam**2 * f[:-2] - (1 - lam**2) * f[1:-1]) / (d * (1 + lam))


def d2_dr2(f: Array, mesh: PaperMesh) -> Array:
    """∂²f/∂r² on the inner circles, Eq. (11b)."""
    lam, d, d_before = mesh.ratio[:, None], mesh.d[1:, None], mesh.d[:-1, None]
    return 2 * (f[2:] + lam * f[:-2] - (1 + lam) * f[1:-1]) / (d * d_before * (1 + lam))


@dataclass(frozen=True)
class Stencil:
    """Coefficients of A p_{i−1,j} + B p_{i,j−1} + C p_{i,j} + D p_{i,j+1} + E p_{i+1,j} = F, Eq. (13).

    Each has shape (n_r − 1, n_theta + 1), on the inner circles.
    """

    A: Array
    B: Array
    C: Array
    D: Array
    E: Array
    F: Array

    def residual(self, pressure: Array) -> Array:
        """F minus the left-hand side of (13) on the inner circles, with the mirror angles of (17a)."""
        p = mirrored(pressure[1:-1])
        left = self.A * p[:, :-2] + self.B * pressure[:-2] + self.C * p[:, 1:-1] + self.D * pressure[2:] + self.E * p[:, 2:]
        return self.F - left


def reynolds_stencil(film: Array, mesh: PaperMesh, beta: float) -> Stencil:
    """Coefficients (A4a-f) of the Reynolds equation (6a), written out as printed.

    Parameters
    ----------
    film : ndarray, shape (n_r + 1, n_theta + 1)
        Film thickness u on the nodes.
    mesh : PaperMesh
        The nodes.
    beta : float
        Eq. (6d).
    """
    u, r = film[1:-1], mesh.r[1:-1, None]
    lam, d, d_before = mesh.ratio[:, None], mesh.d[1:, None], mesh.d[:-1, None]
    across = mirrored(u)
    u_next, u_previous = across[:, 2:], across[:, :-2]
    bracket = film[2:] - lam**2 * film[:-2] - (1 - lam**2) * u
    u2, u3 = u**2, u**3
    around = u2 / (r**2 * mesh.d_theta**2)
    return Stencil(
        A=around * (u - 0.75 * (u_next - u_previous)),
        B=-u3 / r * lam**2 / (d * (1 + lam))
        + 2 * lam * u3 / (d * d_before * (1 + lam))
        - 3 * lam**2 * u2 / (d**2 * (1 + lam) ** 2) * bracket,
        C=-(1 - lam) * u3 / (r * d)
        - 2 * u3 / (d * d_before)
        - 3 * u2 * (1 - lam) / (d**2 * (1 + lam)) * bracket
        - 2 * u3 / (r**2 * mesh.d_theta**2),
        D=u3 / (r * d * (1 + lam)) + 2 * u3 / (d * d_before * (1 + lam)) + 3 * u2 / (d**2 * (1 + lam) ** 2) * bracket,
        E=around * (u + 0.75 * (u_next - u_previous)),
        F=-(
            np.cos(mesh.theta) * bracket / (d * (1 + lam)) - np.sin(mesh.theta) / r * (u_next - u_previous) / (2 * mesh.d_theta)
        )
        / beta,
    )


def centre_pressure(pressure: Array, film: Array, mesh: PaperMesh, beta: float) -> float:
    """Pressure at r = 0 from its neighbours: the balance (15) over the disc r ≤ r₁/2, Eq. (16).

    Two corrections of the printed formula, both from (15); see docs/theory/paper-method.md.  The sums over the half circle are
    trapezoidal, their ends counting half.  And the film's derivative ∂u/∂θ vanishes in proportion to r towards the
    centre, which makes its sum half the printed one; as printed, a film u = u₀ + g x would drive 3/2 of its flux.

    Parameters
    ----------
    pressure, film : ndarray, shape (n_r + 1, n_theta + 1)
        Fields on the nodes; only the first circle of p and the first two rows of u are read.
    mesh : PaperMesh
        The nodes.
    beta : float
        Eq. (6d).
    """
    weight = np.ones(mesh.n_theta + 1)
    weight[[0, -1]] = 0.5
    u0, u1 = film[0, 0], film[1]
    conductance = weight * (u0**3 + u1**3)
    swirl = np.sin(mesh.theta[1:-1]) @ (u1[2:] - u1[:-2]) / (2 * mesh.d_theta)
    drive = (weight * np.cos(mesh.theta)) @ (u1 - u0) - swirl
    return float((conductance @ pressure[1] + mesh.r[1] / (2 * beta) * drive) / conductance.sum())
