"""Substrates and liquids other than the paper's, with every command: each combination works or is refused with a reason."""

import itertools
import json

import pytest

import softlube
from softlube.cli.main import main

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}
SLIDING = {"speed": "5 mm/s", "load": "100 mN"}
LAYER = {"thickness": "0.5 mm"}
OIL = {"pressure_viscosity": "2 MPa^-1"}
MODELS = [LAYER, OIL, LAYER | OIL]
DEPTHS = [("load", "100 mN"), ("indentation", "50 um"), ("indentation", "-20 um"), ("indentation", "0 um")]
EVERY = list(itertools.product(("bonded", "frictionless"), (0, 0.3, 0.5), ("reynolds", "none"), range(len(DEPTHS))))
# Every pair of values of two columns is among them.
SOME = [row for row in EVERY if (2 * row[1] * 10 // 3 + (row[0] == "bonded") + 2 * (row[2] == "none") + row[3]) % 4 == 0]


def options(inputs):
    return [part for name, value in inputs.items() for part in ("--" + name.replace("_", "-"), str(value))]


@pytest.mark.parametrize(
    ("base", "ratio", "cavitation", "depth"),
    [pytest.param(*row, marks=[] if row in SOME else pytest.mark.slow) for row in EVERY],
)
def test_a_layer_with_barus(base, ratio, cavitation, depth):
    """αp reaches 0.7 to 1.4 in the contacts; without the Reynolds condition the film pulls, with it it does not."""
    contact = softlube.Contact(
        **BALL, **LAYER, **OIL, speed="5 mm/s", base=base, poisson_ratio=ratio, cavitation=cavitation, **dict([DEPTHS[depth]])
    )
    solution = contact.solve(accuracy=1e-2)
    assert solution.problem.substrate.base == base
    assert solution.film_center.error <= 1e-2 * solution.film_center
    assert (solution.fields.pressure.min() < 0) == (cavitation == "none")
    if depth < 2:
        thickening = contact.problem().liquid.viscosity(solution.fields.pressure).max()
        assert 2 < thickening < 5


def test_rows_that_run_always_cover_every_pair():
    for i, j in itertools.combinations(range(4), 2):
        assert {(row[i], row[j]) for row in SOME} == {(row[i], row[j]) for row in EVERY}


MOVED = {"initial_height": "60 um", "duration": "20 ms", "accuracy": 0.1}


@pytest.mark.parametrize("model", MODELS, ids="+".join)
@pytest.mark.parametrize(
    ("command", "reason"),
    [
        (["solve", *options(SLIDING), "--fast"], "the master curve is for a half-space and constant viscosity"),
        (["solve", *options(SLIDING), "--method", "relaxation"], "the paper's methods know the half-space"),
        (["solve", *options(SLIDING), "--method", "cartesian"], "the paper's methods know the half-space"),
        (["solve", "--beta", "100"], "give a dimensionless or a physical contact"),
        (["flow", "--beta", "100", "--plot", "flow.png"], "give one contact"),
        (["stribeck", *options({"load": "100 mN", "slowest": "4 mm/s", "fastest": "5 mm/s", "points": 2})], None),
        (["fit", "data.csv"], "data.csv"),  # which is not there
        (["curve", "film_min"], "--radius: missing"),
        (["reproduce"], "softlube reproduce does not take it"),
        (["sweep", "plan.toml"], "stands in the plan"),
        (["solve", *options(SLIDING), "--accuracy", "0.1", "--json"], None),
        (["squeeze", "--load", "100 mN", *options(MOVED), "--json"], None),
        (["squeeze", "--approach-speed", "1 mm/s", *options(MOVED), "--json"], None),
        (["squeeze", "--approach-speed", "-20 mm/s", *options(MOVED), "--json"], None),
        (["squeeze", *options(SLIDING), *options(MOVED), "--json"], None),
        (["squeeze", "--speed", "5 mm/s", "--approach-speed", "1 mm/s", *options(MOVED), "--json"], None),
    ],
    ids=lambda value: " ".join(value[:4]) if isinstance(value, list) else "",
)
def test_commands(capsys, monkeypatch, tmp_path, model, command, reason):
    monkeypatch.chdir(tmp_path)
    bare = command[0] in ("curve", "reproduce", "sweep") or "--beta" in command
    ball = {} if bare else {name: BALL[name] for name in BALL if command[0] != "fit" or name != "viscosity"}
    code = main([*command, *options(ball), *options(model)])
    captured = capsys.readouterr()
    assert code == (0 if reason is None else 2), captured.err
    if reason is not None:
        assert reason in captured.err
        assert captured.err.count("\n") == 1
        assert list(tmp_path.iterdir()) == []
    elif "--json" in command:
        final = json.loads(captured.out)
        film = final["final" if command[0] == "squeeze" else "dimensional"]["film_min"]
        assert 0 < film["error"] < 0.3 * film["value"]


def test_the_flow_in_a_film_over_a_layer(tmp_path):
    model = options(BALL | SLIDING | LAYER | OIL)
    assert main(["flow", *model, "--plot", str(tmp_path / "flow.png")]) == 0


def test_sweep_over_layers_and_oils():
    layers = {"thickness": ["0.5 mm", "1 mm"], "base": ["bonded", "frictionless"], "poisson_ratio": 0.4}
    plan = BALL | SLIDING | layers | {"pressure_viscosity": "20 GPa^-1", "viscosity_law": "roelands"}
    table = softlube.sweep(plan, accuracy=0.1).table
    assert list(table["status"]) == ["done"] * 4
    assert table["film_min [m]"].nunique() == 4
    one = softlube.Contact(**plan | {"thickness": "1 mm", "base": "bonded"}).solve(accuracy=0.1)
    assert table["film_min [m]"][2] == pytest.approx(float(one.dimensional["film_min"]), rel=1e-8)
