"""The free boundary behind the contact and the broken film beyond it."""

import numpy as np
import pytest

import softlube
from softlube.readout.free_boundary import filling, free_boundary, is_wet


@pytest.fixture(scope="module")
def full_film():
    return softlube.solve(beta=300, cavitation="none", accuracy=0.01)


def test_free_boundary_tends_to_the_far_ray(solution):
    from softlube.model.exact import far_front_angle

    boundary = free_boundary(solution)
    assert float(boundary.angle(15.0)) == pytest.approx(far_front_angle(), abs=np.radians(1.0))
    assert boundary.angle(0.5) == np.pi
    # p and ∂p/∂n vanish there (to what p grows to within a cell), and the gap is full on its wet side
    y = np.array([0.0, 0.5, 0.9])
    x = boundary.place(y)
    r, theta = np.hypot(x, y), np.arctan2(y, x)
    assert solution.fields.pressure_at(r, theta) == pytest.approx(0, abs=3e-4 * solution.pressure_max)
    assert filling(solution, r * 1.0001, theta) == pytest.approx(1, abs=0.01)
    assert filling(solution, 1.5, np.pi) == pytest.approx(
        float(solution.film_outlet_min / solution.fields.film_at(1.5, np.pi)), rel=0.3
    )


def test_a_full_film_has_no_free_boundary(full_film):
    assert free_boundary(full_film) is None
    assert is_wet(full_film, [1.0, 3.0], np.pi).all()
    assert np.all(filling(full_film, [1.0, 3.0], np.pi) == 1)


def test_wet_is_where_there_is_pressure(solution):
    """Node by node, but for those next to the boundary."""
    fields = solution.fields
    r, theta = np.meshgrid(fields.r[:-2], fields.theta, indexing="ij")
    wet, pressed = is_wet(solution, r, theta), fields.pressure[:-2] > 0
    assert np.mean(wet == pressed) > 0.97
    assert not pressed.all()


def test_symmetry(solution):
    angle = np.linspace(0, np.pi, 9)
    assert filling(solution, 2.0, angle) == pytest.approx(filling(solution, 2.0, -angle))


def test_broken_film_carries_a_constant_flux_along_x(solution):
    """Share of the gap times the gap does not change along a streak."""
    x = np.array([-1.2, -1.6, -2.5, -6.0])
    y = 0.5
    r, theta = np.hypot(x, y), np.arctan2(y, x)
    carried = filling(solution, r, theta) * solution.fields.film_at(r, theta)
    assert np.ptp(carried) < 1e-9 * carried[0]
    # as much as the film has where it breaks, a little more than the outlet's thinnest
    assert 1.0 < carried[0] / float(solution.film_outlet_min) < 2.5
