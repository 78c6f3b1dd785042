r"""How well is the spike of a hard contact known?  The solver's close-ups of it, on more meshes than the solver takes.

    OPENBLAS_NUM_THREADS=1 python benchmarks/spike_sphere.py
    OPENBLAS_NUM_THREADS=1 python benchmarks/spike_sphere.py --moes 200 --law roelands --angles 26 39 58
    OPENBLAS_NUM_THREADS=1 python benchmarks/spike_sphere.py --material 6 --density constant

A liquid of 20/GPa and 0.05 Pa s with Dowson & Higginson's density, or a constant one: then the spike grows with every mesh
(above L = 5.4 at M = 20), and there is no height to find.  Pressures are over the Hertz maximum p_H, frictions in
(2π/3) G δ², films in Moes' H.
"""

from __future__ import annotations

import argparse

import softlube
from softlube.model.exact import HERTZ_PRESSURE
from softlube.model.liquids import BarusLaw, DowsonHigginsonLaw, Liquid, RoelandsLaw
from softlube.steady.refinements.spike.closeup import ANGLES, WIDTHS, close_ups
from softlube.steady.refinements.spike.crest import readings
from softlube.steady.regime import Regime
from softlube.theory.engineering import BETA_LOAD_OF_M, alpha_of_moes, moes_film

COEFFICIENT, VISCOSITY = 20e-9, 0.05
"""α [1/Pa] and η₀ [Pa s]."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--moes", type=float, default=20.0, help="M")
    parser.add_argument("--material", type=float, default=10.0, help="L")
    parser.add_argument("--law", choices=("barus", "roelands"), default="barus")
    parser.add_argument("--density", choices=("dowson-higginson", "constant"), default="dowson-higginson")
    parser.add_argument("--angles", type=int, nargs="+", default=[ANGLES])
    parser.add_argument("--widths", type=float, nargs="+", default=[*WIDTHS, 3e-5], help="of the refined zone, over a")
    arguments = parser.parse_args()

    alpha = float(alpha_of_moes(arguments.moes, arguments.material))
    unit = alpha / COEFFICIENT
    liquid: Liquid = BarusLaw(alpha) if arguments.law == "barus" else RoelandsLaw.of(COEFFICIENT, VISCOSITY, unit)
    if arguments.density == "dowson-higginson":
        liquid = DowsonHigginsonLaw.of(liquid, unit)
    solution = softlube.solve(beta_load=BETA_LOAD_OF_M * arguments.moes ** (4 / 3), liquid=liquid)
    film = float(moes_film(1.0, solution.beta_load))
    shown = ("spike_pressure", "spike_radius", "pressure_max", "friction_contact", "film_min")
    for name in (name for name in shown if name in solution.quantities):
        scale = HERTZ_PRESSURE if "pressure" in name else 1 / film if "film" in name else 1.0
        quantity = solution.quantities[name]
        print(f"{name:18s} {quantity / scale:12.5f} ± {quantity.error / scale:.1g}")

    regime = Regime.of(solution.problem)
    print("nodes          cell    spike    radius   largest   friction over r <= a   minimum film   time/s")
    for angles in arguments.angles:
        for seen in close_ups(regime, solution.fields, arguments.widths, angles):
            said = readings(seen, solution.fields, regime.edge_radius)
            rings, rays = seen.fields.pressure.shape
            print(
                f"{rings:4d} x {rays}  {seen.cell:9.1e} {said['spike_pressure'].value / HERTZ_PRESSURE:8.4f} "
                f"{said['spike_radius'].value:9.5f} {said['pressure_max'].value / HERTZ_PRESSURE:9.4f} "
                f"{said['friction_contact'].value:12.6g} ± {said['friction_contact'].doubt:<8.2g} "
                f"{film * seen.fields.film.min():11.5f} {seen.seconds:8.1f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
