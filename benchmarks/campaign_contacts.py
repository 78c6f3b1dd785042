"""Sound contacts at random over all models: each converges to its accuracy and passes independent checks, or says why not.

Indenters: paraboloids, true spheres, rⁿ, rounded punches and cones, measured profiles; rigid and elastic.  Substrates:
half-spaces and layers, elastic and viscoelastic, flat, balls and cups.  Liquids: constant viscosity, Barus, Roelands, power
law, Carreau, Carreau & Yasuda, Cross, Eyring, each of these alone or on top of Barus or Roelands; a limiting shear stress;
constant density and Dowson & Higginson.  Sliding and rolling; load, indentation, touch and gap; both cavitation conditions.

A refusal that names an accuracy is held to it: the contact is solved again with that, and is wrong if that is refused, too.
One contact in ten is solved on much finer grids (`fine_grid.reference`), and every quantity that has an error is compared.
"""

from __future__ import annotations

import re
from collections import Counter
from math import atan, degrees, log
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
from fine_grid import reference

import softlube
from softlube import curve
from softlube.errors import InputError, NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.liquids.roelands import ROELANDS_PRESSURE, ROELANDS_VISCOSITY
from softlube.model.quantities import QUANTITIES
from softlube.physical.inputs import BODIES
from softlube.steady.error_estimate import looser, yardstick
from softlube.steady.ladder import ladder_of
from softlube.steady.mesh import angles_for
from softlube.steady.regime import Regime

ACCURACIES = 1e-3, 3e-3, 1e-2
"""Accuracies that are asked for, as often each; the first is the default."""
BUDGET = 20.0
"""Seconds of processor time that a solve may take, a third of the package's own: hundreds of hard contacts would take hours."""
COMPARED, FINER, MOST_ANGLES = 10, 1.6, 39
"""One contact of so many is compared with finer grids, of so many times the angles, if it took no more angles itself."""
TOLERANCE = 0.1
"""Relative difference from the trapezoids that a load may have: they are rough."""
NAMED = re.compile(r"accuracy=([0-9.e+-]*[0-9])")
"""The accuracy that a refusal names."""
Told = tuple[str, str, None, Counter[str]]


def contact(seed: int, number: int, folder: Path) -> Told:
    """One contact, solved and checked: a verdict, a line, and how often each thing was seen."""
    rng = Random(f"{seed} contacts {number}")
    given = inputs(rng, folder)
    accuracy = rng.choice(ACCURACIES)
    seen = Counter([f"accuracy {accuracy:g}"])
    case, refusal = f"accuracy={accuracy:g}, {given}", ""
    try:
        asked = softlube.Contact(**given)
        problem = asked.problem()
    except InputError as error:
        return "refused", f"{case}: {error}", None, seen + Counter([f"refused, input: {without_numbers(error)}"])
    seen.update(f"{slot}: {getattr(asked, slot).kind}" for slot in BODIES)
    try:
        solution = asked.solve(accuracy=accuracy, budget=BUDGET)
    except NotConvergedError as error:
        refusal, named = str(error), NAMED.search(str(error))
        if named is None:
            return "refused", f"{case}: {refusal}", None, seen + Counter([f"refused: {without_numbers(error)}"])
        try:
            solution = asked.solve(accuracy=float(named[1]), budget=BUDGET)
        except NotConvergedError as error:
            return "WRONG", f"{case}: {refusal} And then: {error}", None, seen
        seen["refused, the accuracy that is named works"] += 1
    wrong = disagreement(given, problem, solution)
    if not wrong and number % COMPARED == 0:
        wrong, found = beside_finer_grids(problem, solution)
        seen += found
    if wrong:
        return "WRONG", f"{case}: {wrong}", None, seen
    return ("refused", f"{case}: {refusal}", None, seen) if refusal else ("taken", "", None, seen)


def without_numbers(error: Exception) -> str:
    """The first sentence of a message, so that alike ones are counted together."""
    return re.sub(r"[-+]?\b[\d.]+(e[-+]?\d+)?\b", "…", str(error).partition(". ")[0])


def inputs(rng: Random, folder: Path) -> dict[str, Any]:
    """A contact of a small slope, with β′ of the liquid at rest and the relaxed substrate between 10⁻² and 10⁶, or nearly so.

    Parameters
    ----------
    rng : Random
        What decides.
    folder : Path
        Where a measured profile is written.
    """
    hard = rng.random() < 0.08
    radius, slope = 10 ** rng.uniform(-6, -2), 10 ** rng.uniform(-2, -0.85)  # of the contact, and at its edge
    modulus, viscosity = 10 ** (rng.uniform(9.5, 11.3) if hard else rng.uniform(4, 8)), 10 ** rng.uniform(-3, 2)
    given: dict[str, Any] = indenter(rng, radius, slope, folder) | {"young_modulus": modulus}
    # Roelands' law ends at a suction of 0.2 GPa, which hard bodies make.
    given["cavitation"] = "reynolds" if hard else rng.choice(["reynolds", "reynolds", "none"])
    thickness = radius * 10 ** rng.uniform(-0.3, 1.3)
    if rng.random() < 0.3:
        given |= {"thickness": thickness, "poisson_ratio": rng.choice([0.3, 0.45, 0.49, 0.5])}
        given["base"] = rng.choice(["bonded", "frictionless"])
    if rng.random() < 0.2:
        given |= {"ball_young_modulus": modulus * 10 ** rng.uniform(-0.5, 2), "ball_poisson_ratio": rng.choice([0.3, 0.5])}
    if rng.random() < 0.1:
        # Blunt and flat indenters would touch the rim of a cup, not its ground.
        given["substrate_radius"] = rng.choice([3.0, -3.0] if "radius" in given else [3.0]) * radius / slope
    depth, height = radius * slope, rng.choices([-1, 1, 0], [9, 1, 0.5])[0]
    dry = softlube.Contact(**given, indentation=depth, viscosity=viscosity, speed=1.0)
    contact = Regime.of(dry.problem()).dry
    # Under a thick film the pressure exceeds the dry one, at which an oil between hard bodies is next to solid.
    # What remembers is slow beyond 10⁴ (docs/theory/viscoelastic.md); the compliance of a ball does not relax with a layer's.
    remembers = rng.random() < 0.09 and not given.keys() >= {"thickness", "ball_young_modulus"}
    beta = 10 ** rng.uniform(1 if hard else -2, 4 if remembers else 6)
    speed = contact.like_hertz(dry.beta(depth, 1.0)) / beta
    if height == -1 and rng.random() < 0.67:
        given["load"] = contact.load * dry.scales(depth)["load"][0]
    else:
        given["indentation"] = -height * depth
    given |= liquid(rng, viscosity, speed / (2.6 * depth * beta**-0.6), modulus * slope, hard)
    if rng.random() < 0.25:
        given["density_law"] = "dowson-higginson"
    slide_to_roll = rng.choice([-1.0, 0.0, 0.5, 2.0])
    rolls = rng.random() < 0.3
    given |= {"entrainment_speed": speed / 2, "slide_to_roll": slide_to_roll} if rolls else {"speed": speed}
    if remembers:
        given |= memory(rng, modulus, radius / (speed * (2 + (slide_to_roll if rolls else 2.0)) / 4))
    return given


def indenter(rng: Random, radius: float, slope: float, folder: Path) -> dict[str, Any]:
    """An indenter with a slope, about, at a radius [m], where the contact has its edge."""
    kind = rng.choices(["paraboloid", "sphere", "power", "punch", "cone", "profile"], [10, 2, 2, 2, 2, 1])[0]
    if kind == "sphere":
        return {"radius": radius / slope, "true_shape": True}
    if kind == "power":
        exponent = rng.uniform(2.2, 6)
        return {"profile_exponent": exponent, "profile_coefficient": slope / (exponent * radius ** (exponent - 1))}
    if kind == "punch":
        face = radius * rng.uniform(0.3, 0.8)
        return {"face_radius": face, "edge_radius": (radius - face) / slope}
    if kind == "cone":
        tip = radius / slope * 10 ** rng.uniform(-0.8, 0)
        return {"tip_radius": tip, "flank_angle": degrees(atan(slope)), "base_radius": radius * rng.uniform(1.5, 4)}
    if kind == "profile":
        share, r = rng.uniform(0, 0.5), np.linspace(0, 3 * radius, 80)
        z = slope * radius / 2 * ((1 - share) * (r / radius) ** 2 + share / 2 * (r / radius) ** 4)
        np.savetxt(folder / "profile.csv", np.c_[r, z], "%.8e", ",", header="r [m], z [m]", comments="")
        return {"profile": str(folder / "profile.csv")}
    return {"radius": radius / slope}


def liquid(rng: Random, viscosity: float, rate: float, pressure: float, hard: bool) -> dict[str, Any]:
    """A liquid with a viscosity [Pa s] at a shear rate [1/s], that thickens within some pressures [Pa]."""
    given: dict[str, Any] = {}
    roelands = log(viscosity / ROELANDS_VISCOSITY) / ROELANDS_PRESSURE  # with the exponent 1
    if hard:
        given = {"viscosity_law": "roelands", "pressure_viscosity": min(rng.uniform(0.2, 0.9), 8e8 / pressure) * roelands}
    elif rng.random() < 0.25:
        given = {"pressure_viscosity": 10 ** rng.uniform(-1, 1) / pressure}
    kind = rng.choice(["power-law", "carreau", "carreau-yasuda", "cross", "eyring"]) if rng.random() < 0.4 else "newtonian"
    if kind == "newtonian":
        given["viscosity"] = viscosity
    else:
        if given:
            given["pressure_law"] = given.pop("viscosity_law", "barus")
        given |= {"viscosity_law": kind} | thinning(rng, kind, viscosity, rate)
    if rng.random() < 0.15:
        stress = viscosity * rate * 10 ** rng.uniform(-1, 2)
        given |= {"limiting_stress": stress, "limiting_coefficient": rng.choice([0.0, 0.05])}
    return given


def thinning(rng: Random, kind: str, viscosity: float, rate: float) -> dict[str, Any]:
    """A liquid that has thinned a little or much at a shear rate [1/s]."""
    index = rng.uniform(0.35, 0.95)
    if kind == "power-law":
        return {"consistency": viscosity * rate ** (1 - index), "index": index}
    given = {"viscosity": viscosity}
    if kind == "eyring":
        return given | {"eyring_stress": viscosity * rate / 10 ** rng.uniform(-1, 1.5)}
    given |= {"relaxation_time": 10 ** rng.uniform(-1, 2) / rate, "index": index}
    if kind == "carreau-yasuda":
        given["transition"] = rng.uniform(0.5, 4)
    if rng.random() < 0.5:
        given["infinite_viscosity"] = viscosity * 10 ** rng.uniform(-3, -0.3)
    return given


def memory(rng: Random, modulus: float, time: float) -> dict[str, Any]:
    """A substrate whose modulus falls by a factor of 1.2 to 10, within times near the one [s] in which the contact passes."""
    rise = 10 ** rng.uniform(0.08, 1) - 1
    if rng.random() < 0.3:
        return {"stiffening": 1 + rise, "substrate_relaxation_time": time * 10 ** rng.uniform(-1.5, 1.5)}
    parts = [rng.random() for _ in range(rng.randint(1, 4))]
    return {"prony": [(rise * modulus * part / sum(parts), time * 10 ** rng.uniform(-1.5, 1.5)) for part in parts]}


def disagreement(given: dict[str, Any], problem: softlube.Problem, solution: softlube.Solution) -> str:
    """What is wrong with a solution; empty if nothing is found."""
    fields, quantities = solution.fields, solution.quantities
    if not fields.film.min() > 0:
        return f"a film of {fields.film.min():g}"
    if problem.cavitation == "reynolds" and fields.pressure.min() < 0:
        return f"a pressure of {fields.pressure.min():g}"
    if "load" in given:
        if abs(fields.load / HERTZ_LOAD - 1) > 1e-4:
            return f"the load is {fields.load / HERTZ_LOAD:g} of what was asked for"
        if solution.dimensional["load"] != given["load"]:
            return f"the load in SI is {solution.dimensional['load']}"
    elif abs(float(solution.dimensional["indentation"]) - given["indentation"]) > 1e-9 * abs(given["indentation"]):
        return f"the indentation is {solution.dimensional['indentation']}"
    # The load once more, by trapezoids over the nodes and r⁻³ beyond them, which holds where the viscosity rises no more;
    # without the condition the pressures nearly cancel.
    rings = np.trapezoid(fields.pressure, fields.theta, axis=1) * 2 * fields.r
    load = float(np.trapezoid(rings, fields.r) + fields.r[0] * rings[0] / 2 + rings[-1] * fields.r[-1])
    size = float(np.trapezoid(np.abs(rings), fields.r))
    if abs(load - fields.load) > TOLERANCE * max(size, abs(fields.load)) and not Regime.of(problem).thickens_outwards:
        return f"the pressures carry {load:.4g} and the load is {fields.load:.4g}"
    if float(quantities["film_min"]) > float(quantities["film_center"]) + quantities["film_min"].error:
        return "the minimum film is more than the film at the centre"
    if float(quantities["pressure_center"]) > float(quantities["pressure_max"]) + quantities["pressure_max"].error:
        return "the pressure at the centre is more than the largest"
    papers = not any(isinstance(part, dict) for part in problem.to_plain().values())
    return _curve(given, problem, solution) if papers and problem.height < 0 else ""


def _curve(given: dict[str, Any], problem: softlube.Problem, solution: softlube.Solution) -> str:
    """The master curve of the paper's model, which was made at a tenth of the default accuracy."""
    by = {"beta_load": problem.beta_load} if problem.load_controlled else {"beta": problem.beta}
    for name in ("film_center", "film_min", "pressure_max"):
        expected, error = curve.evaluate(name, **by, cavitation=given["cavitation"])
        found = solution.quantities[name]
        if abs(found - expected) > 2 * (found.error + error):
            return f"{name} is {found}, on the master curve {float(expected):.6g}"
    return ""


def beside_finer_grids(problem: softlube.Problem, solution: softlube.Solution) -> tuple[str, Counter[str]]:
    """What lies outside twice its error, in words; and how many values there are, and lie within their error."""
    seen: Counter[str] = Counter()
    regime = Regime.of(problem)
    angles = next(each for each in ladder_of(regime) if angles_for(regime, each) == solution.levels[-1].n_theta)
    if any("borne beyond the mesh" in each for each in solution.warnings):
        return "", Counter(["not compared: warned that a power law's far field bears a share of the load"])
    if angles > MOST_ANGLES:
        return "", Counter([f"no finer solution: took more than {MOST_ANGLES} angles itself"])
    try:
        fine = reference(problem, round(FINER * angles))
    except NotConvergedError as error:
        return "", Counter([f"no finer solution: {without_numbers(error)}"])
    seen["compared with a finer solution"] += 1
    values, factors, outside = {name: pair[0] for name, pair in fine.items()}, looser(regime), []
    for name, (value, uncertainty) in fine.items():
        found = solution.quantities[name]
        if found.error > 0 and float(found) != solution.levels[-1].values[name]:
            seen["values from close-ups, not compared"] += 1
        elif found.error > 0:
            kind = "places" if QUANTITIES[name].place else "values"
            off = max(abs(found - value) - uncertainty, 0.0)
            accurate = off <= solution.accuracy * factors.get(name, 1.0) * yardstick(name, values)
            seen.update([kind, *([f"{kind} within their error"] if off <= found.error else [])])
            seen.update([f"{kind} as accurate as asked"] if accurate and kind == "values" else [])
            if off > 2 * found.error:
                seen.update([f"{kind} outside twice their error", f"outside twice: {name}"])
                outside.append(
                    f"{name} = {float(found):.8g} ± {found.error:.1e}, on finer grids {value:.8g} ± {uncertainty:.1e}"
                )
    return "; ".join(outside), seen
