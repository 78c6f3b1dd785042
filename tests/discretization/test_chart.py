"""Plain polar coordinates: they are themselves, with unit derivatives, in any scale."""

import numpy as np
import pytest

from softlube.discretization.chart import PolarChart
from softlube.discretization.grid import PolarGrid


def test_coordinates_are_radius_and_angle():
    chart, values = PolarChart(), [0, 0.5, 2]
    for there, back in ((chart.xi_of, chart.r_of), (chart.s_of, chart.theta_of)):
        assert there(values).tolist() == [0, 0.5, 2]
        assert back(there(values)).tolist() == [0, 0.5, 2]
    assert chart.dr_dxi(values).tolist() == chart.dtheta_ds(values).tolist() == [1, 1, 1]
    assert chart.scaled(3.0) == chart


@pytest.mark.parametrize("chart", [PolarChart(), PolarGrid(30, 12, edge_width=0.1, side_width=0.2)])
def test_derivatives_are_those_of_the_maps(chart):
    """What every chart promises: `dr_dxi` and `dtheta_ds` against central differences."""
    r, theta, d = np.array([0.2, 0.9, 1.7]), np.array([0.3, 1.5, 2.9]), 1e-6
    xi, s = chart.xi_of(r), chart.s_of(theta)
    assert chart.dr_dxi(r) == pytest.approx((chart.r_of(xi + d) - chart.r_of(xi - d)) / (2 * d), rel=1e-6)
    assert chart.dtheta_ds(s) == pytest.approx((chart.theta_of(s + d) - chart.theta_of(s - d)) / (2 * d), rel=1e-6)
