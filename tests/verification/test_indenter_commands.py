"""An indenter through sweeps, Stribeck curves and fits: the numbers are those of single solutions."""

import json

import pytest

import softlube
from softlube.cli.main import main

BLUNT = softlube.PowerProfile("2e8 m^-3", exponent=4)
REST = {"young_modulus": "3 MPa", "viscosity": "2 Pa s", "load": "50 mN"}


def test_a_sweep_over_the_shape_of_a_sphere():
    table = softlube.sweep(REST | {"radius": "2 mm", "true_shape": ["no", "yes"], "speed": "0.1 mm/s"}).table
    for row, true_shape in ((0, False), (1, True)):
        single = softlube.Contact(**REST, radius="2 mm", true_shape=true_shape, speed="0.1 mm/s").solve()
        assert table["film_center [m]"][row] == pytest.approx(float(single.dimensional["film_center"]), rel=1e-6)


@pytest.mark.slow
def test_a_stribeck_curve_and_a_fit_to_it(tmp_path):
    contact = softlube.Contact(indenter=BLUNT, speed="0.1 mm/s", **REST)
    curve = softlube.stribeck_curve(contact, points=7, slowest=5e-5, fastest=5e-4)
    single = softlube.Contact(indenter=BLUNT, entrainment_speed=5e-5, **REST).solve()
    assert curve["friction [N]"][0] == pytest.approx(float(single.dimensional["friction_total"]), rel=1e-3)
    path = tmp_path / "measured.csv"
    curve[["load [N]", "entrainment_speed [m/s]", "friction [N]"]].to_csv(path, index=False)
    fit = softlube.fit(path, indenter=BLUNT, young_modulus="3 MPa")
    assert float(fit.values["viscosity"]) == pytest.approx(2.0, rel=3e-3)


def test_files_and_json_of_a_measured_profile(tmp_path, capsys):
    ball = tmp_path / "ball.csv"
    ball.write_text("r [mm], z [um]\n" + "\n".join(f"{k / 20}, {(k / 20) ** 2 / 4e-3:.6f}" for k in range(25)))
    output = tmp_path / "contact.nc"
    options = [
        "--profile",
        str(ball),
        "--young-modulus",
        "3 MPa",
        "--viscosity",
        "2 Pa s",
        "--speed",
        "1 mm/s",
        "--load",
        "20 mN",
    ]
    assert main(["solve", *options, "--json", "--output", str(output)]) == 0
    printed = json.loads(capsys.readouterr().out)
    ball.unlink()
    solution = softlube.load(output)
    assert printed["dimensional"]["film_center"]["value"] == pytest.approx(float(solution.dimensional["film_center"]), rel=1e-9)
    again = solution.contact.solve()  # the CSV file is gone; the smoothed profile is in the file
    assert float(again.film_center) == pytest.approx(float(solution.film_center), rel=1e-9)
