"""Units as they are printed."""

import pytest

from softlube.model.prefixes import prefixed, shown
from softlube.model.units import read_quantity


@pytest.mark.parametrize(
    ("value", "unit", "shown"),
    [(2.5e-7, "m", "250 nm"), (3e6, "Pa", "3 MPa"), (0.1, "N", "100 mN"), (-4e-5, "m", "-40 µm"), (5e13, "Pa", "50000 GPa")],
)
def test_prefixes(value, unit, shown):
    factor, name = prefixed(value, unit)
    assert f"{value * factor:.6g} {name}" == shown


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (2e-3, "m", "2 mm"),
        (3e6, "Pa", "3 MPa"),
        (1e-4, "m/s", "100 µm/s"),
        (2.0, "Pa s", "2 Pa s"),
        (2e-8, "1/Pa", "20 1/GPa"),
        (1e-6, "1/Pa", "1 1/MPa"),
        (-1e-6, "m", "-1 µm"),
        (870.0, "kg/m^3", "870 kg/m^3"),
        (5000.0, "s", "5000 s"),
        (0.02, "s", "20 ms"),
        (0.0, "m", "0 m"),
        (1.2345678e-3, "m", "1.2345678 mm"),
    ],
)
def test_values_as_inputs_are_written(value, unit, text):
    assert shown(value, unit) == text
    assert read_quantity(text, unit) == pytest.approx(value, rel=1e-14)
