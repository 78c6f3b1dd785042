"""Random rigs with layers, oils, two elastic bodies and rolling: one answer, whichever command is asked."""

import json
import math

import numpy as np
import pytest

import softlube
from softlube.cli.main import main
from softlube.model.quantities import header
from softlube.physical.inputs import declared

ACCURACY = 1e-2


def random_rigs(count, seed=17):
    """Inputs in SI, by names: soft rubbers under a liquid of Barus, and ceramics under an oil of Roelands, by turns.

    Layers are about as thick as their contact is wide, αp is up to 2, and β_load is some 30 to 30,000.
    """
    random = np.random.default_rng(seed)
    soft = np.arange(count) % 2 == 0

    def spread(low, high):
        return np.exp(random.uniform(math.log(low), math.log(high), count))

    radius, exponent = spread(1e-3, 2e-2), spread(0.05, 2)
    young = np.where(soft, spread(5e5, 2e7), spread(2e10, 4e11))
    pressure = np.where(soft, young * spread(0.02, 0.2), exponent / 2e-8)
    modulus = 4 / 3 * young  # E* of a rigid ball on an incompressible half-space
    load = (math.pi * pressure) ** 3 * radius**2 / (6 * modulus**2)
    width = (3 * load * radius / (4 * modulus)) ** (1 / 3)
    viscosity = spread(0.05, 5)
    return {
        "radius": radius,
        "substrate_radius": random.choice([-1, 1], count) * radius * spread(1.5, 20),
        "young_modulus": young,
        "poisson_ratio": random.uniform(0.3, 0.5, count),
        "thickness": width * spread(0.5, 1.4),
        "base": random.choice(["bonded", "frictionless"], count),
        "ball_young_modulus": young * spread(0.5, 300),
        "ball_poisson_ratio": random.uniform(0.2, 0.5, count),
        "viscosity": viscosity,
        "pressure_viscosity": exponent / pressure,
        "viscosity_law": np.where(soft, "barus", "roelands"),
        "entrainment_speed": math.pi * modulus * width**4 / (12 * radius**3 * viscosity * spread(30, 3e4)),
        "slide_to_roll": random.uniform(-2, 2, count),
        "load": load,
    }


def check(count, capsys):
    """One value of every quantity and its error by ``softlube solve``, a sweep, and a Stribeck curve that starts there."""
    rigs = {name: values.tolist() for name, values in random_rigs(count).items()}
    table = softlube.sweep(rigs, combine="zip", accuracy=ACCURACY, workers=1).table
    assert len(table) == count
    for row in range(count):
        given = {name: f"{values[row]} {declared()[name].unit}" for name, values in rigs.items()}
        options = [text for name, value in given.items() for text in (f"--{name.replace('_', '-')}", value.strip())]
        assert main(["solve", *options, "--accuracy", str(ACCURACY), "--json"]) == 0
        solved = json.loads(capsys.readouterr().out)["dimensional"]
        speed = rigs["entrainment_speed"][row]
        bodies = [each for each in zip(options[::2], options[1::2], strict=True) if each[0] != "--entrainment-speed"]
        ends = [("--slowest", f"{speed!r} m/s"), ("--fastest", f"{4 * speed!r} m/s"), ("--points", "3")]
        asked = [text for pair in bodies + ends for text in pair]
        assert main(["stribeck", *asked, "--accuracy", str(ACCURACY), "--json"]) == 0
        first = json.loads(capsys.readouterr().out)["rows"][0]
        for name, column in (("friction_total", "friction"), ("film_center",) * 2, ("film_min",) * 2):
            unit = solved[name]["unit"]
            assert first[header(column, unit)] == pytest.approx(solved[name]["value"], rel=1e-6), (row, name)
        for name, quantity in solved.items():
            for key, error in (("value", False), ("error", True)):
                swept = table.loc[row, header(name, quantity["unit"], error=error)]
                expected = np.nan if quantity[key] is None else quantity[key]
                # An error is told by differences of values, and differs by as much as these do.
                noise = 1e-9 * abs(quantity["value"] or 0.0) if error else 0.0
                assert swept == pytest.approx(expected, rel=1e-6, abs=noise, nan_ok=True), (row, name)


def test_one_answer_to_three_random_rigs(capsys):
    check(3, capsys)


@pytest.mark.slow
def test_one_answer_to_twenty_random_rigs(capsys):
    check(20, capsys)
