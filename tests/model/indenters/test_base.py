"""What every shape has: transforms by quadrature, other units, the far field, files; dry contacts on layers."""

import numpy as np
import pytest
from scipy.integrate import quad

from softlube.errors import InputError
from softlube.model.dry import dry_contact, dry_contact_at
from softlube.model.exact import kapitza_pressure
from softlube.model.indenters import (
    Paraboloid,
    PowerShape,
    RoundedConeShape,
    RoundedPunchShape,
    SphereShape,
    from_plain,
    to_plain,
)
from softlube.model.substrates import HalfSpaceKernel, LayerKernel

SHAPES = [
    Paraboloid(),
    SphereShape(0.2, 0.8),
    PowerShape(0.3, 1.0, 4.0),
    PowerShape(0.3, 0.7, 2.5),
    RoundedPunchShape(0.4, 1.0, 0.5, 0.0),
    RoundedPunchShape(0.4, 0.8, 0.5, 0.1),
    RoundedConeShape(0.3, 0.9, 0.2, 2.0),
]


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_derivatives_and_transform(shape):
    """The slope is that of the height, and g(x) = x ∫₀ˣ f′/√(x² − r²) dr by an adaptive quadrature."""
    h = 1e-5
    for x in (0.4, 1.3, 2.9):
        assert shape.slope(x) == pytest.approx((shape.height(x + h) - shape.height(x - h)) / (2 * h), abs=1e-7)
        inner = [np.arcsin(each / x) for each in shape.corners if each < x]
        value = x * quad(lambda t, x=x: float(shape.slope(x * np.sin(t))), 0, np.pi / 2, points=inner, epsabs=1e-13)[0]
        assert shape.depth(x) == pytest.approx(value, rel=1e-9)
        assert shape.depth_slope(x) == pytest.approx((shape.depth(x + h) - shape.depth(x - h)) / (2 * h), abs=1e-6)


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_units_and_files(shape):
    """f(r) H is the same in other units, with lengths over √(RH)."""
    r = np.linspace(0, 3, 7)
    assert shape.in_units(2.0).height(r / np.sqrt(2)) == pytest.approx(shape.height(r) / 2, rel=1e-13)
    assert from_plain(to_plain(shape)) == shape


@pytest.mark.parametrize("exponent", [2.0, 3.0, 4.0])
def test_far_field(exponent):
    """P = r cos θ/((2n + 1)βf²) solves ∇·(u³∇p) = −(1/β)∂u/∂x for u = f ~ rⁿ; at n = 2 it is Kapitza's."""
    shape, beta, r, h = PowerShape(1.0, 1.0, exponent), 7.0, 30.0, 1e-2

    def pressure(r):
        return float(kapitza_pressure(r, 0.0, beta, 0.0)) * shape.far_field(r)[0]

    def flux(r):
        return r * float(shape.height(r)) ** 3 * (pressure(r + h) - pressure(r - h)) / (2 * h)

    radial = (flux(r + h) - flux(r - h)) / (2 * h) / r
    around = -(float(shape.height(r)) ** 3) * pressure(r) / r**2
    assert radial + around == pytest.approx(-float(shape.slope(r)) / beta, rel=1e-5)


def test_no_shape_and_impossible_ones():
    with pytest.raises(InputError, match=r"indenter: no 'wedge' is known; expected .*'paraboloid'"):
        from_plain({"kind": "wedge"})
    with pytest.raises(InputError, match=r"unit: expected a positive, finite number, got 0"):
        SphereShape(0.0, 1.0)


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_dry_contacts_on_a_thick_layer_tend_to_the_half_space(shape):
    thick, solid = (dry_contact(each, 1.5, shape) for each in (LayerKernel(1e4), HalfSpaceKernel()))
    assert thick.indentation == pytest.approx(solid.indentation, rel=3e-4)
    assert thick.load == pytest.approx(solid.load, rel=3e-4)
    assert thick.substrate_rise == pytest.approx(1, abs=3e-4)
    assert solid.substrate_rise == 1
    r = np.array([0.0, 0.7, 1.2, 1.45])
    assert thick.pressure(r) == pytest.approx(solid.pressure(r), rel=3e-4)


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("layer", [HalfSpaceKernel(), LayerKernel(0.8)])
def test_a_load_and_the_indentation_that_it_makes(shape, layer):
    by_load = dry_contact_at(layer, load=0.3, indenter=shape)
    by_depth = dry_contact_at(layer, indentation=by_load.indentation, indenter=shape)
    assert by_load.load == pytest.approx(0.3, rel=1e-10)
    assert by_depth.radius == pytest.approx(by_load.radius, rel=1e-9)
    # The load is the integral of the pressure.
    r, weight = np.polynomial.legendre.leggauss(400)
    r = by_load.radius * (r + 1) / 2
    assert np.pi * by_load.radius * weight @ (r * by_load.pressure(r)) == pytest.approx(0.3, rel=1e-5)
