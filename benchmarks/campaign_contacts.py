"""Sound contacts at random over all models, at a low accuracy: each converges to what independent checks find, or says why not.

Half-spaces and layers, constant viscosity, Barus and Roelands, constant density and Dowson & Higginson, rigid and elastic
balls, cups, sliding and rolling, load, indentation, touch and gap, both cavitation conditions.
"""

from __future__ import annotations

from pathlib import Path
from random import Random
from typing import Any

import numpy as np

import softlube
from softlube import curve
from softlube.errors import InputError, NotConvergedError
from softlube.model.exact import HERTZ_LOAD
from softlube.model.liquids.roelands import ROELANDS_PRESSURE, ROELANDS_VISCOSITY

ACCURACY = 0.05
TOLERANCE = 0.1
"""Relative difference from the trapezoids that a load may have: they are rough."""


def contact(seed: int, number: int, folder: Path) -> tuple[str, str]:
    """One contact, solved and checked."""
    given = inputs(Random(f"{seed} contacts {number}"))
    try:
        problem = softlube.Contact(**given).problem()
        solution = softlube.Contact(**given).solve(accuracy=ACCURACY)
    except (NotConvergedError, InputError) as error:
        return "refused", f"{given}: {error}"
    wrong = disagreement(given, problem, solution)
    return ("WRONG", f"{given}: {wrong}") if wrong else ("taken", "")


def inputs(rng: Random) -> dict[str, Any]:
    """A contact whose slope is small, with β between 10⁻² and 10⁶ or nearly so, soft, or hard with an oil of Roelands."""
    hard = rng.random() < 0.15
    radius, modulus = 10 ** rng.uniform(-4, -1), 10 ** (rng.uniform(9.5, 11.3) if hard else rng.uniform(4, 8))
    depth = radius * 10 ** rng.uniform(-4, -1.7)
    viscosity, beta = 10 ** rng.uniform(-3, 2), 10 ** rng.uniform(-2, 6)
    speed = 2 / 3 * depth**2 / radius * np.pi * modulus / 3 / (viscosity * beta)
    given: dict[str, Any] = {"radius": radius, "young_modulus": modulus, "viscosity": viscosity}
    given["cavitation"] = rng.choice(["reynolds", "reynolds", "none"])
    way = rng.choices(["load", "indentation", "gap", "touch"], [6, 3, 1, 0.5])[0]
    if way == "load":
        given["load"] = 16 / 9 * modulus * depth * np.sqrt(radius * depth)
    else:
        given["indentation"] = {"indentation": depth, "gap": -depth, "touch": 0.0}[way]
    if rng.random() < 0.35:
        given["thickness"] = np.sqrt(radius * depth) * 10 ** rng.uniform(-0.3, 1.3)
        given["poisson_ratio"] = rng.choice([0.3, 0.45, 0.49, 0.5])
        given["base"] = rng.choice(["bonded", "frictionless"])
    pressure = 4 / (3 * np.pi) * modulus * np.sqrt(depth / radius)
    if hard:
        exponent = min(rng.uniform(0.2, 0.9), 10 * ROELANDS_PRESSURE / pressure)
        given["pressure_viscosity"] = exponent * np.log(viscosity / ROELANDS_VISCOSITY) / ROELANDS_PRESSURE
        given["viscosity_law"] = "roelands"
    elif rng.random() < 0.25:
        given["pressure_viscosity"] = 10 ** rng.uniform(-1, 1) / pressure
    if rng.random() < 0.25:
        given["density_law"] = "dowson-higginson"
    if rng.random() < 0.2:
        given |= {"ball_young_modulus": modulus * 10 ** rng.uniform(-0.5, 2), "ball_poisson_ratio": rng.choice([0.3, 0.5])}
    if rng.random() < 0.1:
        given["substrate_radius"] = rng.choice([3.0, -3.0]) * radius
    if rng.random() < 0.2:
        given |= {"entrainment_speed": speed / 2, "slide_to_roll": rng.choice([-1.0, 0.0, 0.5, 2.0])}
    else:
        given["speed"] = speed
    return given


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
    # The load once more, by trapezoids over the nodes and r⁻³ beyond them; without the condition the pressures nearly cancel.
    rings = np.trapezoid(fields.pressure, fields.theta, axis=1) * 2 * fields.r
    load = float(np.trapezoid(rings, fields.r) + fields.r[0] * rings[0] / 2 + rings[-1] * fields.r[-1])
    size = float(np.trapezoid(np.abs(rings), fields.r))
    if abs(load - fields.load) > TOLERANCE * max(size, abs(fields.load)):
        return f"the pressures carry {load:.4g} and the load is {fields.load:.4g}"
    return _curve(given, problem, solution) if not given.keys() & LAWS and problem.height < 0 else _bounds(quantities)


LAWS = {"thickness", "pressure_viscosity", "density_law"}
"""Inputs of contacts that the master curve does not have."""


def _curve(given: dict[str, Any], problem: softlube.Problem, solution: softlube.Solution) -> str:
    """The master curve, which was made at a hundred times the accuracy."""
    by = {"beta_load": problem.beta_load} if problem.load_controlled else {"beta": problem.beta}
    for name in ("film_center", "film_min", "pressure_max"):
        expected, error = curve.evaluate(name, **by, cavitation=given["cavitation"])
        found = solution.quantities[name]
        if abs(found - expected) > 1.5 * found.error + error + 0.02 * abs(expected):
            return f"{name} is {found}, on the master curve {float(expected):.6g}"
    return ""


def _bounds(quantities: Any) -> str:
    """What holds for every liquid and substrate."""
    if float(quantities["film_min"]) > float(quantities["film_center"]) + quantities["film_min"].error:
        return "the minimum film is more than the film at the centre"
    if float(quantities["pressure_center"]) > float(quantities["pressure_max"]) + quantities["pressure_max"].error:
        return "the pressure at the centre is more than the largest"
    return ""
