"""Power laws: the paraboloid at n = 2, units of the coefficient, the transform."""

import numpy as np
import pytest

import softlube
from softlube.errors import InputError
from softlube.model.indenters import Paraboloid, PowerProfile, PowerShape, Sphere
from softlube.model.parts import resolve


def test_the_coefficient_in_its_unit():
    part = PowerProfile(coefficient="2e8 m^-3", exponent=4)
    assert part.coefficient == 2e8
    assert part == PowerProfile("0.2 mm^-3", exponent=4.0) == PowerProfile(2e8, exponent=4)
    r = 1e-4
    assert part.shape(1.0, 1.0).height(r / part.reference_radius) * part.reference_radius == pytest.approx(2e8 * r**4)
    assert resolve(["indenter"], part.flat()) == {"indenter": part}
    assert PowerProfile(3e5, exponent=2.5).shape(1.0, 1.0) == PowerShape(1.0, 1.0, 2.5)


def test_at_two_it_is_the_paraboloid_of_radius_one_over_twice_the_coefficient():
    part = PowerProfile("250 m^-1", exponent=2)
    assert part.reference_radius == pytest.approx(2e-3)
    assert part.shape(0.3, 0.7) == Paraboloid()
    shape = PowerShape(0.3, 0.7, 2.0)
    x = np.linspace(0, 3, 5)
    assert shape.height(x) == pytest.approx(x**2 / 2)
    assert shape.depth(x) == pytest.approx(x**2)
    paper = softlube.solve(beta=300.0)
    ours = softlube.solve(beta=300.0, indenter=shape)
    for name, value in paper.quantities.items():
        assert ours.quantities[name] == pytest.approx(value, rel=1e-7), name
    ball = {"young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "1 mm/s", "load": "20 mN"}
    by_power, by_radius = (softlube.Contact(indenter=each, **ball).solve() for each in (part, Sphere("2 mm")))
    for name, value in by_radius.dimensional.items():
        assert by_power.dimensional[name] == pytest.approx(value, rel=1e-9), name


@pytest.mark.parametrize("exponent", [2.0, 3.0, 4.5, 8.0])
def test_galins_transform(exponent):
    """G is the factor n ∫ sinⁿ⁻¹t dt times f, by its quadrature; 8/3 at n = 4."""
    shape, x = PowerShape(1.0, 1.0, exponent), np.array([0.3, 1.7])
    for ours, theirs in zip(shape.transform(x), super(PowerShape, shape).transform(x), strict=True):
        assert ours == pytest.approx(theirs, rel=1e-10)
    assert PowerShape(1.0, 1.0, 4.0).depth(1.0) == pytest.approx(8 / 3 / 8)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"coefficient": "2e8 m^-2", "exponent": 4}, "profile_coefficient, profile_exponent: the unit is m.-2; .*m.\\(-3\\)"),
        ({"coefficient": "2e8", "exponent": 4}, "profile_coefficient: expected a number such as '2e8 m.-3'; got '2e8'"),
        ({"coefficient": "2 m^-1", "exponent": 2.5}, "the unit is m.-1; with the exponent 2.5 expected one of m.\\(-1.5\\)"),
        ({"coefficient": -1.0, "exponent": 4}, "profile_coefficient: expected a positive"),
        ({"coefficient": "-1 m^-3", "exponent": 4}, "profile_coefficient: expected a positive"),
        ({"coefficient": 1.0, "exponent": 1.5}, "profile_exponent: expected a number between 2 and 8, got 1.5"),
        ({"coefficient": 1.0}, "exponent: missing; expected a number such as .4."),
    ],
)
def test_impossible_ones(given, message):
    with pytest.raises(InputError, match=message):
        PowerProfile(**given)
