"""A constant density, which films that change with time ask for."""

from softlube.cli.main import main
from softlube.model.liquids import BarusLaw, Incompressible

BALL = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]


def test_a_liquid_of_constant_density_is_the_liquid():
    assert Incompressible().law(BarusLaw(3.0), 1e6) == BarusLaw(3.0)
    assert Incompressible().density == 1000


def test_density_that_changes_with_time_is_refused(capsys):
    moved = ["--initial-height", "100 um", "--duration", "1 s", "--density-law", "dowson-higginson"]
    sphere = [*BALL[:6], "--load", "100 mN"]
    for more in ([], ["--speed", "1 mm/s"]):
        assert main(["squeeze", *sphere, *moved, *more]) == 2
        assert "density-law: the density must be constant where the film changes with time" in capsys.readouterr().err
