"""What a command understood stands above its output and in its JSON."""

import json

import pytest

from softlube.cli.echo import echo, understood
from softlube.cli.main import main
from softlube.errors import InputError

README = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s"]
SLIDES = [*README, "--speed", "0,1 mm/s", "--load", "100 mN"]
CONTACT = "Input: radius 2 mm, young_modulus 3 MPa, viscosity 2 Pa s, speed 100 µm/s, load 100 mN."


def test_values_in_si_and_in_a_line():
    inputs = understood(
        {
            "radius": "2,5 mm",
            "ball_young_modulus": "64 GPa",
            "poisson_ratio": "0,3",
            "load": ["20 mN", "50 mN"],
            "speed": [1e-3, 5e-3, 2e-3, 4e-3],
            "base": "bonded",
            "true_shape": "yes",
            "beta": 12.5,
            "thickness": None,
            "pressure_viscosity": "20 GPa-1",
        }
    )
    assert inputs["radius"] == {"value": 2.5e-3, "unit": "m"}
    assert inputs["ball_young_modulus"] == {"value": 64e9, "unit": "Pa"}
    assert inputs["poisson_ratio"] == {"value": 0.3, "unit": ""}
    assert inputs["load"] == {"value": [0.02, 0.05], "unit": "N"}
    assert inputs["base"] == {"value": "bonded", "unit": ""}
    assert echo(inputs) == (
        "Input: radius 2.5 mm, ball_young_modulus 64 GPa, poisson_ratio 0.3, load 20 mN and 50 mN, speed 1 mm/s to 5 mm/s "
        "(4 values), base bonded, true_shape yes, beta 12.5, pressure_viscosity 20 1/GPa."
    )
    with pytest.raises(InputError, match="load: 50 has no unit, and others have"):
        understood({"load": ["20 mN", 50]})


@pytest.mark.parametrize("fast", [[], ["--fast"]])
def test_solve(capsys, fast):
    given = fast or ["--accuracy", "0.01"]
    assert main(["solve", *SLIDES, *given]) == 0
    assert capsys.readouterr().out.splitlines()[0] == CONTACT
    assert main(["solve", *SLIDES, *given, "--json"]) == 0
    inputs = json.loads(capsys.readouterr().out)["inputs"]
    assert inputs == understood({"radius": 2e-3, "young_modulus": 3e6, "viscosity": 2.0, "speed": 1e-4, "load": 0.1})
    assert main(["solve", "--beta", "100", *given]) == 0
    assert capsys.readouterr().out.startswith("Input: beta 100.\n")


@pytest.mark.slow
def test_flow_and_curve(capsys, tmp_path):
    solution, picture = str(tmp_path / "a.nc"), ["--plot", str(tmp_path / "a.png")]
    assert main(["solve", *SLIDES, "--accuracy", "0.01", "--output", solution]) == 0
    capsys.readouterr()
    assert main(["flow", *SLIDES, *picture]) == 0
    assert capsys.readouterr().out.splitlines()[0] == CONTACT
    assert main(["flow", "--solution", solution, *picture]) == 0
    line = capsys.readouterr().out.splitlines()[0]
    assert all(
        text in line for text in ("radius 2 mm", "shear_modulus 1 MPa", "viscosity 2 Pa s", "speed 100 µm/s", "load 100 mN")
    )
    assert main(["curve", "film_center", "--beta", "1e3"]) == 0
    assert capsys.readouterr().out.startswith("Input: beta 1000.\n")


def test_squeeze(capsys):
    given = [*README, "--load", "100 mN", "--initial-height", "100 um", "--duration", "10 ms", "--accuracy", "0.01"]
    assert main(["squeeze", *given]) == 0
    line = capsys.readouterr().out.splitlines()[0]
    assert line == (
        "Input: radius 2 mm, young_modulus 3 MPa, viscosity 2 Pa s, load 100 mN, initial_height 100 µm, duration 10 ms."
    )
    assert main(["squeeze", *given, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["inputs"]["duration"] == {"value": 0.01, "unit": "s"}


def test_stribeck_and_fit(capsys, tmp_path):
    curve = ["--load", "20 mN", "--load", "50 mN", "--slowest", "1 mm/s", "--fastest", "2 mm/s", "--points", "2"]
    assert main(["stribeck", *README, *curve]) == 0
    line = capsys.readouterr().out.splitlines()[0]
    assert line == (
        "Input: radius 2 mm, young_modulus 3 MPa, viscosity 2 Pa s, load 20 mN and 50 mN, slowest 1 mm/s, "
        "fastest 2 mm/s, slide_to_roll 2."
    )
    data = tmp_path / "data.csv"
    data.write_text("load [mN];speed [mm/s];friction [mN]\n100;0,1;0,45\n100;0,2;0,62\n100;0,4;0,9\n")
    assert main(["fit", str(data), "--radius", "2 mm", "--young-modulus", "3 N/mm2", "--output", str(tmp_path / "f.json")]) == 0
    assert capsys.readouterr().out.splitlines()[0] == "Input: radius 2 mm, young_modulus 3 MPa, slide_to_roll 2."
    assert json.loads((tmp_path / "f.json").read_text())["inputs"]["young_modulus"] == {"value": 3e6, "unit": "Pa"}


def test_sweep(capsys, tmp_path):
    plan = tmp_path / "plan.toml"
    plan.write_text(
        '[sweep]\naccuracy = 0.01\n[parameters]\nradius = "2 mm"\nyoung_modulus = "3 MPa"\nviscosity = "2 Pa s"\n'
        'speed = ["0,1 mm/s", "0.2 mm/s"]\nload = "100 mN"\n'
    )
    assert main(["sweep", str(plan), "--workers", "1"]) == 0
    line = capsys.readouterr().out.splitlines()[0]
    assert line == "Input: radius 2 mm, young_modulus 3 MPa, viscosity 2 Pa s, speed 100 µm/s and 200 µm/s, load 100 mN."
