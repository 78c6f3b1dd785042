"""The sphere: its paraboloid and its true shape."""

import numpy as np
import pytest

import softlube
from softlube.errors import InputError
from softlube.model.indenters import Paraboloid, Sphere, SphereShape, from_plain, to_plain
from softlube.model.indenters.sphere import END
from softlube.model.parts import resolve


def test_a_sphere_is_its_radius():
    assert Sphere("2 mm").radius == pytest.approx(2e-3)
    assert Sphere("2 mm") == Sphere(radius=2e-3)
    assert Sphere("2 mm").compliance == 0


def test_an_elastic_ball_has_names_of_its_own_among_the_inputs_of_an_experiment():
    glass = Sphere("2 mm", young_modulus="64 GPa", poisson_ratio=0.2)
    flat = {"radius": "2 mm", "ball_young_modulus": "64 GPa", "ball_poisson_ratio": 0.2, "young_modulus": "3 MPa"}
    assert resolve(["indenter"], flat)["indenter"] == glass
    assert glass.flat() == {"radius": 2e-3, "ball_young_modulus": 64e9, "ball_poisson_ratio": 0.2}
    # with G = E/(2(1 + ν)), the inverse of G/(2(1 − ν))
    assert 1 / glass.compliance == pytest.approx(64e9 / (2 * 1.2) / (2 * 0.8))


def test_a_ratio_means_nothing_without_a_modulus():
    with pytest.raises(InputError, match="ball_poisson_ratio, ball_young_modulus: the first means nothing without the second"):
        Sphere("2 mm", poisson_ratio=0.3)
    with pytest.raises(InputError, match=r"ball_young_modulus: .*expected a pressure such as '210 GPa'"):
        Sphere("2 mm", young_modulus="64 mm")


def test_the_true_sphere_and_its_paraboloid():
    x = np.array([0.0, 1e-6, 0.3, 0.79])
    true = Sphere("2 mm", true_shape=True).shape(1.0, 1.0)
    assert true == SphereShape(1.0, 1.0)
    assert true.height(x) == pytest.approx([0.0, 0.5e-12, 1 - np.sqrt(1 - 0.3**2), 1 - np.sqrt(1 - 0.79**2)], rel=1e-12)
    assert Sphere("2 mm").shape(1.0, 1.0) == Paraboloid()
    assert true.in_units(4.0).height(0.1) == pytest.approx(true.height(0.2) / 4)


def test_a_sphere_goes_on_as_the_paraboloid_that_touches_it():
    """Height and slope have no jump at 0.8 R, where the slope is 4/3."""
    true = SphereShape(1.0, 1.0)
    below, above = END * (1 - 1e-9), END * (1 + 1e-9)
    assert true.height(above) == pytest.approx(true.height(below), abs=1e-8)
    assert true.slope(above) == pytest.approx(true.slope(below), abs=1e-8) == pytest.approx(4 / 3)
    assert true.slope(3.0) == pytest.approx(3.0 / END * 4 / 3)


def test_a_transform_in_closed_form():
    """The transform is g(x) = x artanh x of the sphere (Sneddon 1965)."""
    x = np.array([0.05, 0.3, 0.7])
    true = SphereShape(1.0, 1.0)
    assert true.depth(x) == pytest.approx(x * np.arctanh(x), rel=1e-12)
    assert true.depth_slope(x) == pytest.approx(np.arctanh(x) + x / (1 - x**2), rel=1e-11)


def test_a_substrate_that_is_a_ball_adds_its_curvature():
    """1/R = 1/R₁ + 1/R₂ of two paraboloids; the true sphere differs from its own paraboloid by as much as on a flat."""
    contact = softlube.Contact(radius="2 mm", substrate_radius="6 mm", young_modulus=1e6, viscosity=1.0, speed=1e-4, load=0.1)
    true = softlube.Contact(**contact.given | {"true_shape": True})
    assert true.reduced_radius == pytest.approx(1.5e-3)
    height = true.unit_height
    r = 0.7 * true.unit_length
    own = 2e-3 - np.sqrt(4e-6 - r**2)
    assert true.shape_for(height).height(0.7) * height == pytest.approx(own + r**2 / 2 / 6e-3, rel=1e-12)
    assert contact.shape_for(height).height(0.7) * height == pytest.approx(r**2 / 2 / 1.5e-3, rel=1e-12)


def test_inputs_and_files():
    true = Sphere("2 mm", true_shape=True)
    assert true.flat()["true_shape"] is True
    assert "true_shape" not in Sphere("2 mm").flat()
    for each in (True, "yes"):
        assert resolve(["indenter"], {"radius": "2 mm", "true_shape": each}) == {"indenter": true}
    assert resolve(["indenter"], {"radius": "2 mm", "true_shape": "no"}) == {"indenter": Sphere("2 mm")}
    with pytest.raises(InputError, match="true_shape: expected 'yes' or 'no', got 'perhaps'"):
        Sphere("2 mm", true_shape="perhaps")
    with pytest.raises(InputError, match="radius: missing; expected a length such as '2 mm'"):
        resolve(["indenter"], {})
    assert from_plain(to_plain(SphereShape(0.1, 0.9))) == SphereShape(0.1, 0.9)
    assert from_plain(None) == Paraboloid()
