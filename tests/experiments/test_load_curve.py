"""Film and friction at a given load as curves over β, against solved contacts."""

import numpy as np
import pytest

import softlube
from softlube.discretization.measure import integrate
from softlube.experiments.load_curve import _node, _solution, load_curve


def test_the_poiseuille_part_is_the_moment_of_the_pressure(solution):
    """∫ u ∂p/∂x dA = −∫ p ∂u/∂x dA + boundary, and ∫ p ∂w/∂x dA = 0 for an elastic half-space: so only ∫ p x dA is left.

    This is what makes C − P the whole horizontal force.
    """
    fields = solution.fields
    reach = 0.8 * fields.r[-1]
    part = integrate(fields, lambda xi, s: 3 * fields.film_spline(xi, s) * fields.gradient_on(xi, s)[0], reach)
    moment = integrate(
        fields,
        lambda xi, s: (
            3 * fields.pressure_spline(xi, s) * fields.chart.r_of(xi)[:, None] * np.cos(fields.chart.theta_of(s))[None, :]
        ),
        reach,
    )
    angle = np.linspace(0, np.pi, 2001)
    rim = fields.film_at(reach, angle) * fields.pressure_at(reach, angle) * np.cos(angle) * reach
    boundary = 3 * 2 * np.trapezoid(rim, angle)
    assert part == pytest.approx(boundary - moment, rel=2e-3)
    assert part < 0


def test_a_curve_between_its_nodes():
    curve = load_curve(100, 1e4)
    for beta in (137.0, 1890.0):
        solution = softlube.solve(beta_load=beta)
        assert curve.film_center(beta) == pytest.approx(solution.film_center, rel=1e-3)
        doubt = max(1e-3, float(curve.relative_error("couette", beta)))
        assert curve.friction(beta) == pytest.approx(solution.friction_domain, rel=doubt)
    assert np.isnan(curve.friction(1.0))
    assert np.isnan(curve.relative_error("couette", 1e7))


def test_named_and_numbered_regions_agree_in_the_hertz_limit():
    named, numbered = (_node(22, region, "reynolds", 3e-3) for region in ("domain", 2.0))
    assert named.couette == pytest.approx(numbered.couette, rel=1e-3)
    assert not isinstance(_solution(22, "reynolds", 3e-3), str)
