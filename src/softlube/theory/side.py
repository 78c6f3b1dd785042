"""The side problem of the Hertz limit: where the contact's edge is parallel to the sliding, and the film is thinnest.

Near θ = 90° let φ = 90° − θ and s = 1 − r.  The entrainment normal to the edge, φ/β, vanishes with φ, and as
x = φ + …, y = 1 − s − φ²/2 + …, the Reynolds equation becomes

    ∂u/∂τ = ∂/∂s (β u³ ∂p/∂s) + τ ∂u/∂s,    τ = −φ,

a film that is carried across the edge's layer: inwards before τ = 0, outwards after, and τ is the time.  Flow along the edge is
smaller by β^(−1/2).  At each time the elastic half-plane under √s of pressure is that of `softlube.inlet`.  In the units

    s: ℓ = (βA³)^(−1/2),    τ: ℓ^(1/2),    p: A ℓ^(1/2),    u: A ℓ^(3/2) = A^(−5/4) β^(−3/4)

no parameter is left.  For τ → −∞ each time has the inlet of its own entrainment; deep inside the film is the one that entered
at the other end of the chord, u → u∞ (2s + τ²)^(3/10).  One march from τ ≪ −1 through the constriction gives the minimum film.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from softlube.discretization.differences import FOURTH
from softlube.solvers.newton import DenseEquation, newton
from softlube.theory.inlet import INLET_MESH, Part, inlet, sinc_line, smooth_edge

Array = NDArray[np.floating]

BREAKABLE = 1.0
"""Up to which s the pressure may come down to zero."""
FILM_KEPT = 0.3
"""A Newton step may lower the film to this fraction of itself at most."""


@dataclass(frozen=True)
class SideMesh:
    """Resolution of the side problem.

    Attributes
    ----------
    step, outer, inner, length : float
        s = length sinh t on a uniform mesh −outer ≤ t ≤ inner; see `softlube.inlet.Mesh`.
    start, end : float
        The march goes from τ = −start to end.
    n_times : int
        Number of steps, uniform in arsinh τ.
    """

    step: float = 0.12
    outer: float = 10.5
    inner: float = 22.0
    length: float = 0.15
    start: float = 20.0
    end: float = 1.2
    n_times: int = 400

    @property
    def times(self) -> Array:
        """Times of the march, the first being that of the initial state."""
        return np.sinh(np.linspace(-np.arcsinh(self.start), np.arcsinh(self.end), self.n_times + 1))


@dataclass(frozen=True)
class SideFilm:
    """Minimum film along the march, in the units of this module.

    Attributes
    ----------
    time, film, place : ndarray, shape (n,)
        τ, the minimum over s at that time, and its s.
    """

    time: Array
    film: Array
    place: Array

    @property
    def film_min(self) -> float:
        """Minimum over place and time."""
        return _minimum(self.time, self.film)[1]

    @property
    def time_of_min(self) -> float:
        """Time τ at which the film is thinnest, from the angle of 90°, in the units of this module."""
        return _minimum(self.time, self.film)[0]

    @property
    def place_of_min(self) -> float:
        """Distance s from the dry contact's edge at which the film is thinnest, in the units of this module."""
        return float(np.interp(self.time_of_min, self.time, self.place))


def _minimum(x: Array, values: Array) -> tuple[float, float]:
    """Place and value of the minimum, by a quartic through the five nodes about the lowest."""
    i = int(np.clip(np.argmin(values), 2, x.size - 3))
    scale = x[i + 1] - x[i - 1]
    quartic = np.polyfit((x[i - 2 : i + 3] - x[i]) / scale, values[i - 2 : i + 3], 4)
    fine = np.linspace(-0.6, 0.6, 6001)
    k = int(np.argmin(np.polyval(quartic, fine)))
    return float(x[i] + scale * fine[k]), float(np.polyval(quartic, fine[k]))


def _far_interior(s: Array) -> Part:
    """Pressure that vanishes outside and has the film u∞ (2s)^(3/10) inside, but for a distance of order 1 from the edge."""
    z = s + 1j
    strength = inlet().film_inside * 2**0.3 / (2 * np.pi * np.sin(0.2 * np.pi)) * np.exp(1.2j * np.pi)
    return Part(
        pressure=np.real(0.3 * strength * z**-0.7),
        film=-2 * np.pi * np.imag(strength * z**0.3),
        gradient=np.real(-0.21 * strength * z**-1.7),
    )


class Strip:
    """The mesh across the edge's layer: nodes, the faces half-way between them, elasticity and differences.

    Pressures are known parts (√s and the far interior) and an excess that decays on both sides.
    """

    def __init__(self, mesh: SideMesh) -> None:
        t = np.arange(-round(mesh.outer / mesh.step), round(mesh.inner / mesh.step) + 1) * mesh.step
        n = self.n = t.size
        points = np.append(t, t[0] + (np.arange(n + 3) - 1.5) * mesh.step)
        line = sinc_line(t, points, mesh.length * np.sinh(points), mesh.length * np.cosh(points))
        edge, interior = smooth_edge(line.s, 0.5), _far_interior(line.s)
        film, gradient = edge.film + interior.film, edge.gradient + interior.gradient
        self.t, self.s, self.ds = t, line.s[:n], line.ds[:n]
        self.pressure = (edge.pressure + interior.pressure)[:n]
        self.film, self.face_film = film[:n], film[n:]
        self.potential, self.face_potential = line.potential[:n], line.potential[n:]
        self.face_gradient = gradient[n:]
        # Differences of fourth order on the staggered mesh; face k lies between the nodes k − 2 and k − 1.
        self.slope = np.zeros((n + 3, n))
        self.divergence = np.zeros((n, n + 3))
        for offset, weight in FOURTH.slope.items():
            for i in range(n):
                self.divergence[i, i + 2 + offset] = weight / mesh.step
                self.slope[i + 1 - offset, i] = weight / (mesh.step * line.ds[n + i + 1 - offset])

        # Unknowns: pressure times ds/dt where the liquid may break; elsewhere, where the pressure is a large known part and a
        # tiny excess, excess times ds/dt.
        self.unit = 1 / self.ds
        self.breakable = self.s < BREAKABLE
        self.offset = np.where(self.breakable, self.pressure, 0.0)  # known pressure, taken off to get the excess

    def excess(self, x: Array) -> Array:
        """Pressure less the known parts, from the unknowns."""
        return x * self.unit - self.offset

    def film_under(self, x: Array) -> Array:
        """Film at the nodes."""
        return self.film + self.potential @ self.excess(x)

    def initial_state(self, start: float) -> Array:
        """Unknowns at τ = −start ≪ −1: the inlet at that entrainment, and inside the film that came in before.

        The film is prescribed inside and the pressure outside; the elastic equation gives the pressure inside.
        """
        edge, width = inlet(), start**0.4
        at = np.clip(np.arcsinh(self.s / width / INLET_MESH.length), edge.t[0], edge.t[-1])
        inside = self.s >= 0
        film = np.where(at < 20, CubicSpline(edge.t, edge.film)(at), edge.film_inside) * width**1.5
        film += edge.film_inside * (np.abs(2 * self.s + start**2) ** 0.3 - start**0.6)
        excess = np.where(inside, 0, CubicSpline(edge.t, edge.pressure)(at) * width**0.5 - self.pressure)
        wanted = (film - self.film - self.potential @ excess)[inside]
        excess[inside] = np.linalg.solve(self.potential[np.ix_(inside, inside)] * self.unit[inside], wanted) * self.unit[inside]
        return (excess + self.offset) / self.unit


@dataclass
class Implicit:
    """One implicit time step for the unknowns of a `Strip`; see `softlube.solvers.newton.System`.

    ∂u/∂τ at the new time is rate·u + history.
    """

    strip: Strip
    time: float
    rate: float
    history: Array
    constrained: NDArray[np.bool_]

    def linearise(self, x: Array) -> LinearisedStep:
        """Residual and Jacobian of one step of the march at x."""
        return LinearisedStep(self, x)


@dataclass(frozen=True)
class LinearisedStep:
    """Residual and Jacobian of `Implicit` at x; see `softlube.solvers.newton.Linearised`."""

    system: Implicit
    x: Array

    @cached_property
    def _films(self) -> tuple[Array, Array]:
        """Film thickness at the nodes and at the faces between them."""
        strip = self.system.strip
        excess = strip.excess(self.x)
        return strip.film + strip.potential @ excess, strip.face_film + strip.face_potential @ excess

    @cached_property
    def _gradient(self) -> Array:
        strip = self.system.strip
        return strip.face_gradient + strip.slope @ strip.excess(self.x)

    @cached_property
    def residual(self) -> Array:
        """∂u/∂τ − ∂/∂s (u³ ∂p/∂s + τu), which is not negative where the liquid has broken."""
        system, strip = self.system, self.system.strip
        film, face_film = self._films
        flux = face_film**3 * self._gradient + system.time * face_film
        return system.rate * film + system.history - strip.divergence @ flux / strip.ds

    @cached_property
    def _jacobian(self) -> Array:
        system, strip = self.system, self.system.strip
        film = self._films[1]
        by_film = (3 * film**2 * self._gradient + system.time)[:, None]
        flux = by_film * strip.face_potential + (film**3)[:, None] * strip.slope
        return (system.rate * strip.potential - strip.divergence @ flux / strip.ds[:, None]) * strip.unit

    @property
    def scale(self) -> Array:
        """Diagonal of the Jacobian."""
        return np.abs(np.diag(self._jacobian))

    def times(self, step: Array) -> Array:
        """Jacobian times a vector."""
        return self._jacobian @ step

    def equation(self, free: NDArray[np.bool_]) -> DenseEquation:
        """Newton's equation on the unknowns `free`."""
        return DenseEquation.of(self._jacobian, free)

    def reach(self, step: Array) -> tuple[float, float]:
        """Largest relative change of the film, and the fraction of the step that leaves `FILM_KEPT` of it everywhere."""
        strip = self.system.strip
        change = np.concatenate([strip.potential, strip.face_potential]) @ (step * strip.unit) / np.concatenate(self._films)
        return float(np.max(np.abs(change))), min(1.0, (1 - FILM_KEPT) / max(-float(np.min(change)), 1e-300))


@cache
def side_film(cavitation: str = "reynolds", mesh: SideMesh = SideMesh()) -> SideFilm:
    """March along the edge from the inlet's side to the outlet's.

    Second order in time (backward differences, implicit), fourth in space but for the free boundary.

    Parameters
    ----------
    cavitation : {"reynolds", "none"}
        The Reynolds condition holds from τ = 0 on, when the far film begins to open; before, the pressure is positive.
    mesh : SideMesh
        Resolution.

    Raises
    ------
    RuntimeError
        If a step does not converge.
    """
    if cavitation not in ("reynolds", "none"):
        raise ValueError(f'cavitation: expected "reynolds" or "none", got {cavitation!r}')
    strip, times = Strip(mesh), mesh.times
    x = strip.initial_state(mesh.start)
    before, film = np.empty(0), strip.film_under(x)
    found = []
    for k, time in enumerate(times[1:], 1):
        step = time - times[k - 1]
        if k == 1:
            rate, history = 1 / step, -film / step
        else:
            ratio = step / (times[k - 1] - times[k - 2])
            rate = (1 + 2 * ratio) / (1 + ratio) / step
            history = (ratio**2 / (1 + ratio) * before - (1 + ratio) * film) / step
        constrained = strip.breakable & (cavitation == "reynolds" and time > 0)
        result = newton(Implicit(strip, float(time), float(rate), history, constrained), x, tolerance=1e-11)
        if not result.converged:
            raise RuntimeError(f"side problem: the step to τ = {time:.3f} did not converge on this mesh")
        x = result.x
        before, film = film, strip.film_under(x)
        t, lowest = _minimum(strip.t, film)
        found.append((time, lowest, mesh.length * np.sinh(t)))
    return SideFilm(*np.array(found).T)
