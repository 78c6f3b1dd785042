"""Text with units by the name of an input, and units as they are printed."""

import pint
import pytest

from softlube.errors import InputError
from softlube.model.units import read_quantity
from softlube.physical.units import prefixed, shown, to_si


@pytest.mark.parametrize(
    ("name", "text", "si"),
    [
        ("radius", "2 mm", 2e-3),
        ("radius", "1 inch", 0.0254),
        ("young_modulus", "3 MPa", 3e6),
        ("viscosity", "100 cP", 0.1),
        ("viscosity", "1 poise", 0.1),
        ("speed", "6 cm/min", 1e-3),
        ("load", "1 kgf", 9.80665),
        ("pressure_viscosity", "20 GPa^-1", 2e-8),
        ("indentation", "-1 um", -1e-6),
    ],
)
def test_text_quantities_and_numbers_mean_the_same(name, text, si):
    assert to_si(name, text) == pytest.approx(si, rel=1e-12)
    assert to_si(name, pint.get_application_registry().Quantity(text)) == pytest.approx(si, rel=1e-12)
    assert to_si(name, si) == si


@pytest.mark.parametrize(("value", "reason"), [("2", "has no unit"), ("2 s", "wrong dimension"), ("2 parrots", "unknown unit")])
def test_a_radius_that_is_no_length_is_refused_by_name(value, reason):
    with pytest.raises(InputError, match=rf"radius: .*{reason}.*'2 mm'"):
        to_si("radius", value)


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
