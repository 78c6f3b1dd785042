"""Cases whose numbers two versions of softlube are compared by; `compare_versions.py` runs this file in both.

    python benchmarks/version_cases.py numbers.npz [--quick]

The file written holds one array for each quantity and each error, named "group | case | quantity".  Versions before 0.2.0
had other names for a few things: they are found by `first`, everything else is public and the same in every version.
"""

from __future__ import annotations

import argparse
import inspect
import tempfile
import time
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

import softlube

Numbers = dict[str, Any]
Case = tuple[str, str, bool, Callable[[], Numbers]]
"""Group, name, whether it is one of the quick ones, and what computes its numbers."""

DATA = Path(__file__).parents[1] / "examples" / "data" / "synthetic_friction.csv"
BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}
SLIDING = BALL | {"speed": "0.1 mm/s", "load": "100 mN"}
FALL = BALL | {"load": "100 mN", "initial_height": "100 um", "duration": "10 s"}
STEEL = {"radius": "10 mm", "young_modulus": "150 GPa", "viscosity": "0.04 Pa s", "poisson_ratio": 0.3}

CURVES = (
    *("load_contact", "film_center", "film_min", "film_min_radius", "film_min_angle_deg", "film_inlet", "film_outlet_min"),
    *("pressure_center", "pressure_max", "pressure_gradient_inlet", "boundary_layer"),
    *("friction_contact", "friction_domain", "shear_rate_max"),
)


def first(*names: str) -> Any:
    """The first of several dotted names that this version has."""
    for name in names:
        module, _, attribute = name.rpartition(".")
        try:
            return import_module(name)
        except ImportError:
            pass
        try:
            return getattr(import_module(module), attribute)
        except (ImportError, AttributeError):
            continue
    raise ImportError(f"this version has none of {', '.join(names)}")


solve_problem = first(
    "softlube.steady.solve.solve_problem", "softlube.steady.ladder.solve_problem", "softlube.solver.solve_problem"
)
start_of_sliding = first("softlube.slide", "softlube.physical.sliding.slide", "softlube.approach.start.slide")
split = first("softlube.readout.friction.split", "softlube.friction.split")
velocity = first("softlube.readout.flow.velocity", "softlube.flow.velocity")
flux = first("softlube.readout.flow.flux", "softlube.flow.flux")
net_flux = first("softlube.readout.flow.net_flux", "softlube.flow.net_flux")
filling = first("softlube.readout.free_boundary.filling", "softlube.free_boundary.filling")
evaluate = first("softlube.theory.master_curve.evaluate", "softlube.curve.evaluate")
limits = first("softlube.theory.limits", "softlube.limits")
LIQUID = "liquid" if "liquid" in inspect.signature(softlube.Problem).parameters else "fluid"
"""What the liquid is called in `Problem`, and in the plain values that files keep of it."""


# --- the numbers of a result ------------------------------------------------------------------------------------------


def with_errors(prefix: str, quantities: Mapping[str, Any]) -> Numbers:
    """Values and errors of quantities."""
    values = {f"{prefix}{name}": float(quantity) for name, quantity in quantities.items()}
    return values | {f"{prefix}{name} error": quantity.error for name, quantity in quantities.items()}


def of_solution(solution: Any) -> Numbers:
    """Quantities in every normalisation, fields, and friction over another region."""
    numbers = with_errors("", solution.quantities) | with_errors("SI ", solution.dimensional)
    numbers |= with_errors("other ", solution.other_quantities)
    numbers |= {"beta": solution.beta, "beta_load": solution.beta_load, "grids": len(solution.levels)}
    numbers |= {f"field {name}": getattr(solution.fields, name) for name in ("r", "theta", "film", "pressure")}
    return numbers | {"friction within 1.5": solution.friction_within(1.5)}


def of_history(result: Any) -> Numbers:
    """Everything that a squeeze film or a start of sliding writes to a file."""
    numbers = {name: variable.values for name, variable in result.dataset.variables.items()}
    return numbers | with_errors("final ", result.final) | {"time error": result.to_dict()["time"]["error"]}


def of_table(table: Any) -> Numbers:
    """The columns of numbers of a data frame."""
    return {name: table[name].to_numpy() for name in table.columns if table[name].dtype.kind == "f"}


def of_plain(values: Any, prefix: str = "") -> Numbers:
    """All numbers in nested mappings and sequences."""
    items = values.items() if isinstance(values, Mapping) else enumerate(values)
    numbers: Numbers = {}
    for name, value in items:
        if isinstance(value, (Mapping, list, tuple)):
            numbers |= of_plain(value, f"{prefix}{name} ")
        elif isinstance(value, (int, float)):
            numbers[f"{prefix}{name}"] = float(value)
    return numbers


# --- the cases ---------------------------------------------------------------------------------------------------------


def problem(liquid: dict[str, Any] | None = None, accuracy: float = 1e-3, method: str = "newton", **plain: Any) -> Numbers:
    """A dimensionless problem, given in the plain values that files keep of it."""
    given = plain if liquid is None else plain | {LIQUID: liquid}
    return of_solution(solve_problem(softlube.Problem.from_plain(given), accuracy=accuracy, method=method))


def layer(thickness: float, poisson_ratio: float = 0.5, base: str = "bonded") -> dict[str, Any]:
    """A layer in plain values."""
    return {"kind": "layer", "thickness": thickness, "poisson_ratio": poisson_ratio, "base": base}


def barus(alpha: float) -> dict[str, Any]:
    """A Barus liquid in plain values."""
    return {"kind": "barus", "alpha": alpha}


def roelands(alpha: float, exponent: float, reference: float) -> dict[str, Any]:
    """A Roelands liquid in plain values."""
    return {"kind": "roelands", "alpha": alpha, "exponent": exponent, "reference": reference}


def compressible(liquid: dict[str, Any], reference: float) -> dict[str, Any]:
    """A liquid whose density is Dowson & Higginson's, in plain values."""
    return {"kind": "dowson-higginson", "liquid": liquid, "reference": reference}


def dimensionless_cases() -> list[Case]:
    """Half-spaces, gaps, layers, oils, the paper's method."""
    cases: list[Case] = []

    def add(group: str, name: str, quick: bool = False, **given: Any) -> None:
        cases.append((group, name, quick, lambda: problem(**given)))

    for beta in (1e-2, 1.0, 100.0, 1e3, 1e4, 1e5, 1e6):
        add("indentation", f"beta {beta:g}", beta == 100, beta=beta)
    for beta in (1.0, 100.0, 1e4):
        add("indentation", f"beta {beta:g}, full film", beta == 100, beta=beta, cavitation="none")
    for beta in (1e-4, 1e-2, 1.0, 10.0, 1e3, 1e4, 1e5, 1e6, 1e8):
        add("load", f"beta_load {beta:g}", beta == 10, beta_load=beta)
    for beta in (1.0, 1e3):
        add("load", f"beta_load {beta:g}, full film", beta_load=beta, cavitation="none")
    for height, beta in ((1, 1e-2), (1, 1.0), (1, 100.0), (0, 1.0), (0, 10.0)):
        add("gap", f"height {height}, beta {beta:g}", height == 0, beta=beta, height=height)
    for accuracy in (3e-4, 1e-2):
        add("accuracy", f"{accuracy:g}", accuracy == 1e-2, beta=1000.0, accuracy=accuracy)

    for thickness in (3.0, 1.0, 0.3):
        for beta in (100.0, 1000.0):
            add(
                "layer",
                f"t {thickness:g}, beta {beta:g}",
                thickness == 1 and beta == 100,
                beta=beta,
                substrate=layer(thickness),
            )
    add("layer", "frictionless base", beta=300.0, substrate=layer(0.5, base="frictionless"))
    add("layer", "Poisson ratio 0.3", beta=300.0, substrate=layer(0.5, 0.3))
    add("layer", "under a load", beta_load=300.0, substrate=layer(0.5, 0.45))
    add("layer", "light load", beta_load=10.0, substrate=layer(0.25))
    add("layer", "full film", beta=100.0, substrate=layer(0.7), cavitation="none")
    add("layer", "gap", beta=1.0, height=1, substrate=layer(0.5))
    add("layer", "very thin", beta=300.0, substrate=layer(0.2))

    add("oil", "Barus, beta 100", True, beta=100.0, liquid=barus(2.0))
    add("oil", "Barus under a load", beta_load=1e3, liquid=barus(6.0))
    add("oil", "Barus with a spike", beta_load=300.0, liquid=barus(25.0))
    add("oil", "Roelands", beta=1e3, liquid=roelands(5.0, 0.6, 2.0))
    add("oil", "Roelands under a load", beta_load=1e4, liquid=roelands(20.0, 0.6, 0.5))
    add("oil", "compressible", beta=100.0, liquid=compressible(barus(2.0), 5.0))
    add("oil", "compressible with a spike", beta_load=1e3, liquid=compressible(roelands(40.0, 0.65, 0.3), 1.0))
    add("oil", "full film", beta=100.0, cavitation="none", liquid=barus(3.0))
    add("oil", "on a layer", beta=100.0, substrate=layer(1.0), liquid=barus(2.0))
    add("oil", "gap", beta=1.0, height=1, liquid=barus(2.0))

    add("paper's method", "relaxation", beta=100.0, method="relaxation")
    add("oil", "touching", beta=1.0, height=0, liquid=barus(2.0))
    add("load", "beta_load 1e+08, full film", beta_load=1e8, cavitation="none")
    return cases


def physical_cases() -> list[Case]:
    """Contacts in SI, a rig, squeeze films, starts of sliding."""
    cases: list[Case] = []

    def add(
        group: str, name: str, call: Callable[..., Any], read: Callable[[Any], Numbers], quick: bool = False, **given: Any
    ) -> None:
        cases.append((group, name, quick, lambda: read(call(**given))))

    def contact(**given: Any) -> Any:
        return softlube.Contact(**given).solve()

    def rig(**given: Any) -> Any:
        return softlube.Rig(**BALL, ball_young_modulus="10 MPa").contact(**given).solve()

    def deep(**changed: Any) -> dict[str, Any]:
        return {name: value for name, value in (SLIDING | changed).items() if value is not None}

    add("contact", "README", contact, of_solution, True, **SLIDING)
    add("contact", "indentation", contact, of_solution, **deep(load=None, indentation="20 um"))
    add("contact", "gap", contact, of_solution, **deep(load=None, indentation="-1 um"))
    add("contact", "touching", contact, of_solution, **deep(load=None, indentation="0 um"))
    add("contact", "layer", contact, of_solution, **deep(thickness="0.3 mm", poisson_ratio=0.45))
    add("contact", "layer without friction", contact, of_solution, **deep(thickness="0.5 mm", base="frictionless"))
    add("contact", "Barus", contact, of_solution, **deep(pressure_viscosity="1 MPa^-1"))
    add("contact", "full film", contact, of_solution, **deep(cavitation="none", roughness="200 nm", density=900.0))
    oil = {"speed": "1 m/s", "load": "10 N", "pressure_viscosity": "20 GPa^-1", "viscosity_law": "roelands"}
    add("contact", "steel, Roelands", contact, of_solution, **STEEL, **oil)
    add("contact", "steel, compressible", contact, of_solution, **STEEL, **oil, density_law="dowson-higginson")
    add("contact", "rig", rig, of_solution, load="50 mN", entrainment_speed="0.2 mm/s")

    add("squeeze", "load", softlube.squeeze, of_history, True, **FALL)
    pushed = {name: value for name, value in FALL.items() if name != "load"}
    add("squeeze", "approach", softlube.squeeze, of_history, **(pushed | {"approach_speed": "10 um/s", "duration": "8 s"}))
    pulled = {"approach_speed": "-1 um/s", "initial_height": "5 um", "duration": "3 s"}
    add("squeeze", "separation", softlube.squeeze, of_history, **(pushed | pulled))
    add("squeeze", "layer", softlube.squeeze, of_history, **FALL, thickness="0.3 mm")
    add("squeeze", "Barus", softlube.squeeze, of_history, **FALL, pressure_viscosity="1 MPa^-1")
    add("squeeze", "until a film", softlube.squeeze, of_history, **FALL, film_limit="1 um")
    add("squeeze", "history", squeeze_by_history, of_history)

    slow = SLIDING | {"initial_height": "20 um", "duration": "2 s", "accuracy": 5e-2}
    add("start of sliding", "load", start_of_sliding, of_history, **slow)
    add("start of sliding", "pressed before", start_of_sliding, of_history, **slow, pressed="1 s", cavitation="none")
    return cases


def squeeze_by_history() -> Any:
    """A squeeze film whose load is in a file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "history.csv"
        path.write_text("time [ms], load [mN]\n0, 50\n1000, 100\n3000, 20\n")
        return softlube.squeeze(**BALL, history=path, initial_height="50 um", accuracy=1e-2)


def derived_cases() -> list[Case]:
    """The master curve, laws, read-outs, Stribeck curves, fits."""

    def master_curve(**given: Any) -> Numbers:
        return {name: np.array(evaluate(name, **given)) for name in CURVES}

    def laws() -> Numbers:
        beta = np.geomspace(1e3, 1e9, 7)
        names = [name for name in dir(limits) if name.endswith("_asymptote") and name != "film_contact_asymptote"]
        return {name: getattr(limits, name)(beta) for name in names}

    def readouts() -> Numbers:
        solution = softlube.solve(beta=1000)
        r, theta = np.meshgrid([0.2, 0.7, 0.95, 1.3], [0.1, 1.0, 2.0, 3.0])
        numbers = of_plain(vars(split(solution)), "split ")
        numbers |= {"velocity": np.array(velocity(solution, r, theta, level=0.5))}
        numbers |= {"flux": np.array(flux(solution, r, theta)), "net": net_flux(solution, 1.0)}
        return numbers | {"filling": filling(solution, r, theta)}

    def stribeck() -> Numbers:
        rig = softlube.Rig(**BALL)
        ends = {"slowest": "1 um/s", "fastest": "10 mm/s"}
        return of_table(softlube.stribeck_curve(rig, ["10 mN", "100 mN"], points=15, roughness="50 nm", **ends))

    def fit(**given: Any) -> Numbers:
        result = softlube.fit(DATA, radius="2 mm", **given)
        return of_plain(result.to_dict()) | {"residuals": result.residuals, "betas": result.beta}

    return [
        ("curve", "by indentation", True, lambda: master_curve(beta=np.geomspace(1e-3, 1e9, 25))),
        ("curve", "by load, full film", True, lambda: master_curve(beta_load=np.geomspace(1e-5, 1e9, 25), cavitation="none")),
        ("curve", "laws", True, laws),
        ("read-outs", "friction, flow, free boundary", True, readouts),
        ("stribeck", "two loads", False, stribeck),
        ("fit", "viscosity", False, lambda: fit(young_modulus="3 MPa", compare=False)),
        ("fit", "modulus", False, lambda: fit(viscosity="1 Pa s", free=("young_modulus",), compare=False, hold_out=0.2)),
    ]


def main() -> None:
    """Compute all numbers and write them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=Path)
    parser.add_argument("--quick", action="store_true", help="a dozen fast cases only")
    arguments = parser.parse_args()
    numbers: dict[str, Any] = {}
    for group, name, quick, compute in dimensionless_cases() + physical_cases() + derived_cases():
        if arguments.quick and not quick:
            continue
        began = time.process_time()
        try:
            computed = compute()
        except softlube.NotConvergedError as error:
            print(f"refused: {group} | {name}: {error}")
            computed = {"refused": 1.0}
        print(f"{time.process_time() - began:6.2f} s  {group} | {name}", flush=True)
        numbers |= {f"{group} | {name} | {quantity}": value for quantity, value in computed.items()}
    np.savez_compressed(arguments.output, **numbers)
    print(f"softlube at {Path(softlube.__file__).parent}")


if __name__ == "__main__":
    main()
