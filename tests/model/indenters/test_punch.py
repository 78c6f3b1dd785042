"""The rounded punch: its outline, its transform in closed form, the sphere and the flat punch as limits."""

import numpy as np
import pytest

from softlube.model.dry import dry_contact
from softlube.model.indenters import RoundedPunch, RoundedPunchShape
from softlube.model.substrates import HalfSpaceKernel


def test_the_face_and_its_edge():
    part = RoundedPunch(face_radius="1 mm", edge_radius="0.5 mm")
    assert part.blend_width == pytest.approx(0.4e-3)
    assert part.reference_radius == 0.5e-3
    assert part.shape(1.0, 1.0) == RoundedPunchShape(1.0, 1.0, 2.0, part.blend_width / part.edge_radius)
    shape = RoundedPunchShape(1.0, 1.0, 2.0, 0.0)
    assert shape.flat == 2.0
    assert shape.height([1.9, 2.5]) == pytest.approx([0, 0.5**2 / 2])
    assert shape.slope([1.9, 2.5]) == pytest.approx([0, 0.5])
    assert RoundedPunchShape(1.0, 0.8, 2.0, 0.0).flat == 0  # over a ball nothing is flat


def test_the_transform_in_closed_form():
    """The transform is g(x) = x [√(x² − b²) − b arccos(b/x)] (Popov, Heß & Willert, Handbook of Contact Mechanics, §2.5)."""
    b, x = 0.7, np.array([0.5, 0.7001, 0.9, 3.0])
    inside = np.minimum(b / x, 1)
    exact = x * np.where(x > b, np.sqrt(np.maximum(x**2 - b**2, 0)) - b * np.arccos(inside), 0)
    assert RoundedPunchShape(1.0, 1.0, b, 0.0).depth(x) == pytest.approx(exact, rel=1e-9, abs=1e-14)


def test_a_punch_without_a_face_is_a_sphere():
    small = dry_contact(HalfSpaceKernel(), 1.0, RoundedPunchShape(1.0, 1.0, 1e-6, 0.0))
    sphere = dry_contact(HalfSpaceKernel(), 1.0)
    assert small.indentation == pytest.approx(sphere.indentation, rel=3e-6)
    assert small.load == pytest.approx(sphere.load, rel=3e-6)


def test_a_sharp_edge_is_the_flat_punch():
    """Pressure δ/(π²√(1 − r²)) and load 2δ/π, within the width of the edge."""
    sharp = dry_contact(HalfSpaceKernel(), 1.0, RoundedPunchShape(1.0, 1.0, 1 - 1e-4, 0.0))
    assert sharp.load / sharp.indentation == pytest.approx(2 / np.pi, rel=1e-4)
    r = np.array([0.0, 0.5, 0.9])
    assert sharp.pressure(r) / sharp.indentation == pytest.approx(1 / np.pi**2 / np.sqrt(1 - r**2), rel=1e-3)


def test_a_blend_is_smooth_and_tends_to_the_jump():
    """The curvature rises from 0 to 1 about the border; far from it the outlines differ by w² ln only."""
    sharp, blended = RoundedPunchShape(1.0, 1.0, 2.0, 0.0), RoundedPunchShape(1.0, 1.0, 2.0, 0.02)
    x = np.array([0.0, 1e-3, 1.0, 1.8, 3.0, 4.0])
    assert blended.height(x) == pytest.approx(sharp.height(x), abs=2e-3)
    assert blended.slope(x) == pytest.approx(sharp.slope(x), abs=1e-3)
    h = 1e-4
    bend = (blended.slope(2.0 + h) - blended.slope(2.0 - h)) / (2 * h)
    assert bend == pytest.approx(0.5, abs=0.01)
    assert np.all(blended.slope(np.linspace(1e-3, 4, 300)) > 0)
    ours, exact = (dry_contact(HalfSpaceKernel(), 2.5, each) for each in (blended, sharp))
    assert (ours.load, ours.indentation) == (pytest.approx(exact.load, rel=5e-3), pytest.approx(exact.indentation, rel=5e-3))
