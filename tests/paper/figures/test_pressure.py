"""The pressure's figures: profiles, gradients, the far field."""

import numpy as np
import pytest

from softlube.model.exact import far_field_profile
from softlube.paper.figures import Case
from softlube.paper.figures.base import PROFILES
from softlube.paper.figures.pressure import radial_slope


def test_outlet_gradient_ends_without_a_jump(solution):
    """It goes to zero at the free boundary, from where it is steepest, in a straight line; and is −dp/dx everywhere before."""
    r = np.linspace(0.9, 1.2, 3001)
    slope = radial_slope(solution, r, np.pi)
    assert np.max(np.abs(np.diff(slope))) < 0.01 * np.max(np.abs(slope))
    assert np.all(slope[r > 1.1] == 0)
    pressure = solution.fields.pressure_at(r, np.pi)
    fallen = np.trapezoid(slope, r)
    assert fallen == pytest.approx(pressure[-1] - pressure[0], rel=0.01)


def test_profiles_are_the_solutions(drawn, solutions):
    (along_x, _) = drawn("5").tables
    beta, x, p = (np.asarray(column, dtype=float) for column in along_x.columns.values())
    assert set(beta) == set(PROFILES)
    for value in PROFILES:
        centre = (beta == value) & (x == 0)
        assert p[centre] == pytest.approx(float(solutions[Case(value)].pressure_center), rel=1e-9)
        # the inlet, with its long tail of pressure, is at x > 0
        assert np.interp(1.2, x[beta == value], p[beta == value]) > 0.001
        assert np.interp(-1.2, x[beta == value], p[beta == value]) < 1e-4


def test_gradients_are_the_slopes_of_the_profiles(drawn):
    """The integral of dp/dr along the inlet's ray is the difference of the pressures at its ends."""
    beta, r, slope = (np.asarray(column, dtype=float) for column in drawn("6").tables[0].columns.values())
    place_beta, x, p = (np.asarray(column, dtype=float) for column in drawn("5").tables[0].columns.values())
    for value in PROFILES:
        own, ray = beta == value, place_beta == value
        fallen = np.trapezoid(slope[own], r[own])
        assert fallen == pytest.approx(float(np.diff(np.interp([0.2, 2.0], x[ray], p[ray]))[0]), rel=5e-3)


def test_the_far_pressure_falls_like_the_cube_of_the_radius(drawn):
    """β p → f(0)/r³ of Eq. (9) on the inlet's axis, for every β."""
    columns = drawn("S1").tables[1].columns
    r = np.asarray(columns["r [sqrt(R|h0|)]"])
    far = r > 15
    for name, values in columns.items():
        if name.startswith("beta p"):
            tail = np.asarray(values)[far] * r[far] ** 3
            assert tail == pytest.approx(float(far_field_profile(0.0)), rel=0.02)
