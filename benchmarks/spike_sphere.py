r"""How high is the spike under Barus's law?  A sphere on a mesh that is laid about the spike, not about the contact.

    OPENBLAS_NUM_THREADS=1 python benchmarks/spike_sphere.py
    OPENBLAS_NUM_THREADS=1 python benchmarks/spike_sphere.py --moes 200 --shift 0.055 --crest 0.8775 \
        --edge-layer 0.03 --side-layer 0.3 --angles 26 --layers 5e-4 1e-4 5e-5

The ridge of a steep spike runs askew to circles about the contact's centre, and a polar mesh there resolves it on the outlet
axis at best.  About a point nearer to the outlet it is a circle, to 0.002 contact radii over 60 degrees on either side, so that
fine rings alone resolve it.  The equations do not know where their mesh has its centre; only the parabola of the sphere moves.
Liquid: Barus's law with Dowson & Higginson's density, 20/GPa.

Ahead of the fall, which is narrower than any of these cells, the pressures of the last nodes alternate about their trend, an
artefact of interpolating across it.  So the height is taken two nodes ahead, smoothed over three.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import softlube
from softlube.engineering import BETA_LOAD_OF_M, alpha_of_moes, moes_film
from softlube.fluids import Barus, DowsonHigginson
from softlube.grid import PolarGrid
from softlube.limits import HERTZ_PRESSURE
from softlube.newton import newton
from softlube.problem import Problem
from softlube.system import ContactSystem

Array = NDArray[np.floating]

COEFFICIENT = 20e-9
"""α [1/Pa]."""
SMALLEST_STEP = 5e-5
"""Share of the viscosity's rise in a step, with which the march gives up."""
RADIAL_STEP = 4.5
"""Spacing of ξ times the number of angles."""


class ShiftedSystem(ContactSystem):
    """The equations of a contact on a mesh whose centre lies a shift downstream of the sphere's.

    The far field is left about the mesh's centre: at 20 contact radii it is 10⁻⁵ of the pressure.
    """

    def __init__(self, problem: Problem, grid: PolarGrid, shift: float) -> None:
        super().__init__(problem, grid)
        x = np.outer(grid.r, np.cos(grid.theta)).ravel()
        self.film_offset[0] += shift**2 / 2 - shift * x  # |x − shift|²/2 in place of |x|²/2


def about_contact(r: Array, theta: Array, shift: float) -> tuple[Array, Array]:
    """From polar coordinates about the mesh's centre to those about the contact's."""
    x, y = r * np.cos(theta) - shift, r * np.sin(theta)
    return np.hypot(x, y), np.arctan2(y, x)


def march(problem: Problem, grid: PolarGrid, shift: float, plain: Array) -> tuple[ShiftedSystem, Array] | None:
    """From constant viscosity up to the problem's own, in steps that adapt, along the secant."""
    here, state, before, behind, step = 0.0, plain, 0.0, plain, 0.1
    while step > SMALLEST_STEP:
        there = min(here + step, 1.0)
        guess = state.copy()
        if here > before:
            guess += (there - here) / (here - before) * (state - behind)
            guess[:-1] = np.where(state[:-1] > 0, np.maximum(guess[:-1], 0), 0)
        system = ShiftedSystem(replace(problem, fluid=problem.fluid.weakened(there)), grid, shift)
        result = newton(system, guess, max_iterations=25)
        if not result.converged:
            step = (there - here) / 2.5
            continue
        before, behind, here, state = here, state, there, result.x
        if here == 1:
            return system, state
        step *= 1.5 if len(result.history) <= 6 else 1.0
    return None


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--moes", type=float, default=20.0, help="M")
    parser.add_argument("--material", type=float, default=10.0, help="L")
    parser.add_argument("--shift", type=float, default=0.32, help="of the mesh's centre towards the outlet, over a")
    parser.add_argument("--crest", type=float, default=0.4265, help="radius of the ridge about it, over a")
    parser.add_argument(
        "--layers", type=float, nargs="+", default=[2e-3, 5e-4, 2e-4, 1e-4], help="widths of the refined zone there"
    )
    parser.add_argument("--edge-layer", type=float, default=0.3, help="width of the refined zone at the contact's edge")
    parser.add_argument("--side-layer", type=float, default=1.0, help="angle of the refined zone at the sides")
    parser.add_argument("--angles", type=int, default=39)
    arguments = parser.parse_args()

    alpha = float(alpha_of_moes(arguments.moes, arguments.material))
    liquid = DowsonHigginson.of(Barus(alpha), alpha / COEFFICIENT)
    problem = Problem(beta_load=BETA_LOAD_OF_M * arguments.moes ** (4 / 3), fluid=liquid)
    plain = softlube.solve(beta_load=problem.beta_load, fluid=liquid.weakened(0.0), accuracy=1e-2)
    unit = float(moes_film(1.0, plain.beta_load))
    print("rings      cell      place   height/p_H   highest node   pressures ahead of the fall, over p_H")
    for layer in arguments.layers:
        began = time.perf_counter()
        grid = PolarGrid(
            8,
            arguments.angles,
            layer=arguments.edge_layer,
            side_layer=arguments.side_layer,
            crowding=0.7,
            crest=arguments.crest,
            crest_layer=layer,
        )
        grid = grid.resized(int(np.ceil(grid.xi_of(grid.reach) * arguments.angles / RADIAL_STEP)), arguments.angles)
        r, theta = np.meshgrid(grid.r[: grid.n_r], grid.theta, indexing="ij")
        place, angle = about_contact(r, theta, arguments.shift)
        start = plain.fields.pressure_at(np.minimum(place, plain.fields.r[-1]), angle)
        start = np.append(start.ravel(), plain.fields.height)
        plain_system = ShiftedSystem(replace(problem, fluid=liquid.weakened(0.0)), grid, arguments.shift)
        found = march(problem, grid, arguments.shift, newton(plain_system, start).x)
        if found is None:
            print(f"{grid.n_r:5d}  failed", flush=True)
            continue
        pressure, film = (values(found[1]).reshape(grid.shape) for values in (found[0].pressure, found[0].film))
        axis = pressure[:, -1] / HERTZ_PRESSURE
        falls = np.flatnonzero((grid.r > 0.8 * arguments.crest) & (grid.r < 1.2 * arguments.crest))
        k = int(falls[np.argmin(np.diff(axis[falls]))])  # the last node ahead of the fall
        smooth = np.convolve(axis, [0.25, 0.5, 0.25], mode="same")
        ahead = " ".join(f"{value:.3f}" for value in axis[k - 7 : k + 3])
        print(
            f"{grid.n_r:5d} {np.diff(grid.r)[k]:9.1e} {arguments.shift + grid.r[k]:10.5f} {smooth[k - 2]:12.4f} "
            f"{axis[k]:14.4f}   {ahead}   minimum film {unit * film.min():.5f}, {time.perf_counter() - began:.0f} s",
            flush=True,
        )


if __name__ == "__main__":
    main()
