"""What can be fitted."""

from softlube.experiments.parameters import parameters, unit_of


def test_quantities_with_a_unit_and_numbers_of_liquids_can_be_fitted():
    names = parameters()
    assert names[:3] == ("viscosity", "young_modulus", "friction_offset")
    for name in ("thickness", "pressure_viscosity", "consistency", "index", "relaxation_time", "infinite_viscosity"):
        assert name in names
    for name in ("poisson_ratio", "viscosity_law", "base"):  # a number of the substrate, and texts
        assert name not in names


def test_units():
    assert unit_of("friction_offset") == "N"
    assert unit_of("viscosity") == "Pa s"
    assert unit_of("relaxation_time") == "s"
    assert unit_of("index") == ""
