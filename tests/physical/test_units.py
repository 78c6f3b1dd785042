"""Text with units by the name of an input."""

import pint
import pytest

from softlube.errors import InputError
from softlube.physical.units import to_si


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
