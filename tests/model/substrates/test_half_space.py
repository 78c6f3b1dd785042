"""The half-space: nothing but 1/ρ, whatever the unit."""

import pytest

from softlube.model.substrates import HalfSpace, HalfSpaceKernel


def test_it_has_no_remainder_and_no_length():
    kernel = HalfSpace("3 MPa").kernel(1e-3)
    assert kernel == HalfSpaceKernel() == kernel.in_units(4.0)
    assert kernel.remainder is None
    assert [part.size for part in kernel.spectrum(10.0)] == [0, 0]


def test_its_modulus_is_the_effective_one():
    """E* = E/(1 − ν²) = 4 × the contact modulus."""
    part = HalfSpace("3 MPa", poisson_ratio=0.3)
    assert 4 * part.contact_modulus == pytest.approx(3e6 / (1 - 0.3**2))
