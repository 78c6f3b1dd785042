"""The rounded cone: its outline, its transform in closed form, the sphere and the sharp cone as limits."""

import numpy as np
import pytest

from softlube.errors import InputError
from softlube.model.dry import dry_contact
from softlube.model.indenters import RoundedCone, RoundedConeShape
from softlube.model.substrates import HalfSpaceKernel


def test_tip_flank_and_base():
    part = RoundedCone(tip_radius="1 mm", flank_angle=np.degrees(np.arctan(0.2)), base_radius="3 mm")
    shape = part.shape(1.0, 1.0)
    x = np.array([1e-3, 3.0])
    assert shape.height(x) == pytest.approx([1e-6 / 2, 0.2 * (np.hypot(3.0, 0.2) - 0.2)], rel=1e-4)
    assert shape.slope([1e-3, 2.9]) == pytest.approx([1e-3, 0.2], rel=3e-3)
    assert shape.slope(6.0) == pytest.approx(0.4, rel=3e-3)  # the paraboloid that touches the flank at the base
    with pytest.raises(
        InputError, match=r"base_radius, tip_radius: the tip reaches up to a radius of 0\.0002 m, beyond the base"
    ):
        RoundedCone(tip_radius="1 mm", flank_angle=np.degrees(np.arctan(0.2)), base_radius="0.2 mm")
    with pytest.raises(InputError, match=r"flank_angle: expected a number between 0\.1 and 60"):
        RoundedCone(tip_radius="1 mm", flank_angle=80, base_radius="2 mm")


def test_the_transform_in_closed_form():
    """The transform is g(x) = m x arctan(x/m)."""
    m, x = 0.3, np.array([1e-3, 0.2, 1.0, 4.0])
    assert RoundedConeShape(1.0, 1.0, m, 10.0).depth(x) == pytest.approx(m * x * np.arctan(x / m), rel=1e-9)


def test_limits():
    """A contact close to the tip is Hertz's; a tip much narrower than the contact leaves the cone's δ = (π/2) m a."""
    hertz = dry_contact(HalfSpaceKernel(), 2e-3)
    on_tip = dry_contact(HalfSpaceKernel(), 2e-3, RoundedConeShape(1.0, 1.0, 0.3, 2.0))
    assert (on_tip.indentation, on_tip.load) == (
        pytest.approx(hertz.indentation, rel=2e-5),
        pytest.approx(hertz.load, rel=4e-5),
    )
    sharp = dry_contact(HalfSpaceKernel(), 1.0, RoundedConeShape(1.0, 1.0, 1e-3, 5.0))
    assert sharp.indentation == pytest.approx(np.pi / 2 * 1e-3, rel=2e-3)
    # Sneddon's p = (E*m/2) arcosh(a/r), E*/π → 1/π² here
    r = np.array([0.1, 0.5, 0.9])
    assert sharp.pressure(r) == pytest.approx(1e-3 / (2 * np.pi) * np.arccosh(1 / r), rel=3e-3)
