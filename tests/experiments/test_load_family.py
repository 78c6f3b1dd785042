"""Friction at any load: one curve on a half-space, one for each of a few loads, polynomials between many."""

import numpy as np
import pytest

import softlube
from softlube.experiments.load_curve import LoadCurve, load_curve
from softlube.experiments.load_family import LoadFamily, _between, load_family

ROUGH = 0.02


def slab(load):
    """The problem on a thin bonded slab, under a load [N]."""
    contact = softlube.Contact(
        radius=2e-3, young_modulus=3e6, thickness=0.4e-3, viscosity=2.0, speed=1e-3, load=load, cavitation="reynolds"
    )
    return contact.problem()


def half_space(load):
    return softlube.Contact(radius=2e-3, young_modulus=3e6, viscosity=2.0, speed=1e-3, load=load).problem()


def test_on_a_half_space_all_loads_have_one_curve():
    family = load_family(half_space, [0.02, 0.1, 0.5], 30, 3000, accuracy=ROUGH)
    assert len(family.curves) == 1
    assert family.friction(0.02, 100.0) == family.friction(0.5, 100.0)


def test_a_few_loads_have_their_own_curves():
    family = load_family(slab, [0.1, 0.02, 0.1], 30, 3000, accuracy=ROUGH)
    assert family.loads.tolist() == [0.02, 0.1]
    for load in (0.02, 0.1):
        curve = load_curve(slab(load), 30, 3000, accuracy=ROUGH)
        assert family.friction(load, 200.0) == pytest.approx(float(curve.friction(200.0)[0]), rel=1e-12)
    assert family.friction(0.1, 200.0) != pytest.approx(float(family.friction(0.02, 200.0)), rel=1e-3)


@pytest.mark.slow
def test_between_many_loads():
    """Ten loads share fewer curves, and the friction of one that has none is that of its own."""
    loads = np.geomspace(0.02, 0.2, 10)
    family = load_family(slab, loads, 30, 3000, accuracy=ROUGH)
    assert family.loads.size in (5, 9)
    assert family.loads[0] <= loads[0]
    assert family.loads[-1] >= loads[-1]
    curve = load_curve(slab(loads[4]), 30, 3000, accuracy=ROUGH)
    beta = np.array([40.0, 300.0, 2000.0])
    value, error = curve.friction(beta)
    np.testing.assert_allclose(family.friction(loads[4], beta), value, atol=float(np.max(error)))


def test_parts_of_the_friction_of_a_substrate_that_remembers():
    """Of a curve C = 2 β^−0.4, P = −β^−0.5, and H = β^−0.1 that the substrate makes: each force has its parts of them."""
    parts = {"total": lambda b: 2 * b**-0.4 + b**-0.5 + b**-0.1, "sphere": lambda b: 2 * b**-0.4 - b**-0.5}
    parts["viscous"] = lambda b: 2 * b**-0.4 + b**-0.5
    functions = {name: lambda b, part=part: (part(b), 0 * b) for name, part in parts.items()}
    curves = [LoadCurve(1.0, 1e4, 2.0, functions)] * 2
    family = LoadFamily(np.array([0.1, 0.2]), tuple(curves))
    beta = np.array([3.0, 300.0])
    c, p, h = 2 * beta**-0.4, -(beta**-0.5), beta**-0.1
    for force, expected in (("total", c - p + h), ("sphere", c + p), ("couette", c)):
        assert family.friction(0.14, beta, force=force) == pytest.approx(expected)
    assert family.friction(0.14, beta, slide_to_roll=1.0) == pytest.approx(c / 2 - p + h)


def test_beyond_its_ends_friction_goes_on_with_its_last_slope():
    family = load_family(half_space, [0.1], 30, 3000, accuracy=ROUGH)
    for end, inner in ((30.0, 33.0), (3000.0, 3000 / 1.1)):
        values = family.friction(0.1, np.array([inner, end, end**2 / inner]))
        slopes = np.diff(np.log(values)) / np.log(end / inner)
        assert slopes[1] == pytest.approx(slopes[0], rel=1e-6)


def test_weights_are_lagrange_s():
    family = LoadFamily(np.array([1.0, 2.0, 8.0]), ())
    np.testing.assert_allclose(family._weights(family.loads), np.eye(3), atol=1e-12)
    load = np.array([0.5, 1.3, 5.0, 20.0])  # outside: the end
    x, nodes = np.log(np.clip(load, 1, 8)), np.log(family.loads)
    np.testing.assert_allclose((nodes**2) @ family._weights(load), x**2)


def test_between_loads_the_logarithm_is_a_polynomial():
    """What rises by orders of magnitude is met, and stays positive; what changes sign is interpolated as it is."""
    family = LoadFamily(np.array([1.0, 4.0, 16.0]), ())
    load = np.geomspace(1, 16, 20)
    weights = family._weights(load)
    steep = np.exp(np.log(family.loads) ** 2)[:, None] * np.ones(load.size)
    np.testing.assert_allclose(_between(-steep, weights), -np.exp(np.log(load) ** 2))
    crossing = np.log(family.loads / 3)[:, None] * np.ones(load.size)
    np.testing.assert_allclose(_between(crossing, weights), np.log(load / 3), atol=1e-12)


def test_curves_for_other_numbers_count_by_the_product_of_the_weights():
    family = LoadFamily(np.array([1.0, 4.0, 16.0]), (), (np.array([0.4, 0.6]), np.array([1.0, 2.0, 4.0])))
    load = np.array([2.0, 9.0])
    weights = family._weights(load, (0.5, 3.0))
    assert weights.shape == (18, 2)
    assert weights.sum(axis=0) == pytest.approx(1)
    by_load, other = LoadFamily(family.loads, ())._weights(load), np.log(0.5 / 0.4) / np.log(0.6 / 0.4)
    assert weights[-9:].reshape(3, 3, 2).sum(axis=0) == pytest.approx(other * by_load)
