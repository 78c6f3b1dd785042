"""Does the spike have a height?  A line contact under Barus's liquid, on meshes fine enough to see.

    OPENBLAS_NUM_THREADS=1 python benchmarks/spike_line.py
    OPENBLAS_NUM_THREADS=1 python benchmarks/spike_line.py --hertz 0.494

In two dimensions a dense Jacobian and a few hundred cells crowded at the spike suffice: [ρ(u³∂q/∂x)β + ρu]′ = 0 with
q = (1 − e^(−αp))/α, ρ = 1 or Dowson & Higginson's 1 + 0.34 p/(0.59 GPa + p), u = h₀ + x²/2 − 2∫p ln|x − x′| dx′ and the load
of a Hertz contact of half-width 1, whose largest pressure is p₀ = 1/2π.  Nothing of the package is used, so that this is also a
check of what it says about the sphere: with constant density the spike has a height and a width that do not depend on the mesh
up to some αp₀; the width goes to zero there, and beyond the height is the mesh's.  A liquid that is denser under pressure keeps
a height.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating]

HERTZ = 1 / (2 * np.pi)
LOAD = np.pi / 2 * HERTZ


def edges(n: int, place: float, width: float) -> Array:
    """Edges of n cells from −4 to 6, dense at the contact's edges and at a place within."""
    x = np.linspace(-4, 6, 400_001)
    density = 1 + 2 / np.hypot(0.3, np.abs(x) - 1) + 4 / np.hypot(width, x - place)
    measure = np.concatenate([[0], np.cumsum((density[1:] + density[:-1]) / 2 * np.diff(x))])
    return np.interp(np.linspace(0, measure[-1], n + 1), measure, x)


@dataclass
class Line:
    """The line contact on one mesh, the inlet at positive x; β is the sphere's."""

    edge: Array
    beta: float
    hertz: float = 0.0
    """p₀ in GPa, for the density; 0 for a constant one."""

    def __post_init__(self) -> None:
        self.dx, self.x = np.diff(self.edge), (self.edge[1:] + self.edge[:-1]) / 2
        away = self.x[:, None] - self.edge
        potential = away * np.log(np.abs(away) + 1e-300) - away
        self.kernel = -2 * (potential[:, :-1] - potential[:, 1:])
        n, self.gap = self.x.size, np.diff(self.x)
        face = np.arange(n - 1)
        self.upstream = np.zeros((n - 1, n))
        beyond = np.append(self.dx[1:-1] / 2 / self.gap[1:], 0.0)
        self.upstream[face, face + 1] = 1 + beyond
        self.upstream[face[:-1], face[:-1] + 2] = -beyond[:-1]

    def film(self, p: Array, height: float) -> Array:
        """U."""
        return height + self.x**2 / 2 + self.kernel @ p

    def density(self, p: Array) -> tuple[Array, Array]:
        """ρ and dρ/dp."""
        compressed, slope = np.maximum(p, 0) * self.hertz / HERTZ / 0.59, self.hertz / HERTZ / 0.59
        return 1 + 0.34 * compressed / (1 + compressed), 0.34 * slope / (1 + compressed) ** 2

    def newton(self, alpha: float, p: Array, height: float, steps: int = 15) -> tuple[Array, float, int]:
        """Pressures, height, and the number of steps; 0 for failure."""
        n, face = self.x.size, np.arange(self.x.size - 1)
        for count in range(1, steps + 1):
            u = self.film(p, height)
            q, fluidity = (-np.expm1(-alpha * p) / alpha, np.exp(-alpha * p)) if alpha else (p, np.ones(n))
            density, compression = self.density(p)
            between = (density[1:] + density[:-1]) / 2
            middle, slope = (u[1:] + u[:-1]) / 2, np.diff(q) / self.gap * self.beta
            flux = between * middle**3 * slope + self.upstream @ (density * u)
            by_film = self.upstream * density
            by_film[face, face] += 1.5 * between * middle**2 * slope
            by_film[face, face + 1] += 1.5 * between * middle**2 * slope
            by_pressure = by_film @ self.kernel + self.upstream * (compression * u)
            for node, sign in ((face, -1), (face + 1, 1)):
                by_pressure[face, node] += sign * between * middle**3 * self.beta / self.gap * fluidity[node]
                by_pressure[face, node] += middle**3 * slope * compression[node] / 2
            jacobian, right = np.eye(n + 1), np.append(-p, LOAD - self.dx @ p)
            residual = np.concatenate([[0], -np.diff(flux), [0]])
            jacobian[n, :n], jacobian[n, n] = self.dx, 0
            free = np.arange(1, n - 1)
            size = np.abs(np.diff(by_pressure, axis=0)[free - 1, free])
            free = free[(p[free] - residual[free] / size > 0) | (alpha * p[free] > 1)]
            jacobian[free, :n] = -np.diff(by_pressure, axis=0)[free - 1]
            jacobian[free, n] = -np.diff(by_film.sum(axis=1))[free - 1]
            right[free] = -residual[free]
            step = np.linalg.solve(jacobian, right)
            change = step[n] + self.kernel @ step[:n]
            fraction = min(1.0, float(np.min(0.5 * u / np.maximum(-change, 1e-300))))
            p, height = p + fraction * step[:n], height + fraction * step[n]
            error = float(np.max(np.abs(change) / u))
            if not error < 1e6:
                return p, height, 0
            if fraction == 1 and error < 1e-8:
                return np.maximum(p, 0), height, count
        return p, height, 0

    def march(self, target: float) -> tuple[float, Array, float]:
        """αp₀ reached, pressures and height."""
        p = HERTZ * np.sqrt(np.maximum(1 - self.x**2, 0))
        p, height, _ = self.newton(0.0, p, 0.6 - float((self.kernel @ p)[np.argmin(np.abs(self.x))]), 40)
        here, step, before = 0.0, 1.0, (0.0, p, height)
        while here < target and step > 1e-3:
            there = min(here + step, target)
            ahead = (there - here) / (here - before[0]) if here > before[0] else 0.0
            guess = np.where(p > 0, np.maximum(p + ahead * (p - before[1]), 0), 0)
            new, new_height, count = self.newton(there / HERTZ, guess, height + ahead * (height - before[2]))
            if not count:
                step = (there - here) / 2.5
                continue
            before, here, p, height = (here, p, height), there, new, new_height
            step *= 1.5 if count < 6 else 1.0
        return here, p, height


@dataclass(frozen=True)
class Spike:
    """What a mesh says of it."""

    reached: bool
    place: float
    height: float
    width: float
    cell: float
    fall: float
    film: float


def find_spike(target: float, place: float, width: float, *, beta: float = 24.0, cells: int = 500, hertz: float = 0.0) -> Spike:
    """Solve at αp₀ = `target` on a mesh that is `width` fine at the spike, looked for from a place on."""
    for _ in range(3):
        line = Line(edges(cells, place, width), beta, hertz)
        reached, p, height = line.march(target)
        k = int(np.argmax(p))
        at_home, place = abs(line.x[k] - place) < width, float(line.x[k])
        if at_home:
            break
    high = line.x[target / HERTZ * (p[k] - p) < 1]
    fall = target / HERTZ * float(np.max(np.abs(np.diff(p))))
    film = float(np.interp(0, line.x, line.film(p, height)))
    return Spike(reached == target, place, p[k] / HERTZ, high[-1] - high[0], line.dx[k], fall, film)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--beta", type=float, default=24.0)
    parser.add_argument("--cells", type=int, default=500)
    parser.add_argument("--hertz", type=float, default=0.0, help="p₀ in GPa, for a compressible liquid")
    arguments = parser.parse_args()

    def show(target: float, place: float, width: float) -> float:
        """Print a row; the place of the spike."""
        spike = find_spike(target, place, width, beta=arguments.beta, cells=arguments.cells, hertz=arguments.hertz)
        print(
            f"{target:5.2f} {spike.height:10.4f} {spike.width:10.2e} {spike.cell:9.1e} {spike.fall:9.2f} {spike.film:10.5f}  "
            f"{'' if spike.reached else 'failed'}",
            flush=True,
        )
        return spike.place

    np.seterr(all="ignore")
    print("αp₀   height/p₀      width      cell   Δ ln η   film at 0")
    if not arguments.hertz:
        place = -0.46
        for target in (4.5, 5.0, 5.25, 5.5, 5.6, 5.7, 5.75):
            place = show(target, place, 0.003)
        print("beyond, on finer and finer meshes")
    for target in (5.0, 7.0, 9.9) if arguments.hertz else (7.0,):
        place = -0.5
        for width in (0.1, 0.03, 0.01, 0.003, 0.001)[: 4 if arguments.hertz else 5]:
            place = show(target, place, width)


if __name__ == "__main__":
    main()
