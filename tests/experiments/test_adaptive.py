"""Solutions placed where they are needed: smooth functions take few, kinks and bends more, and errors are honest."""

import math

import numpy as np
import pytest

from softlube.experiments.adaptive import FEWEST, PER_DECADE, Interpolant, first_places, place, place_between


def solved(function, error=0.0):
    """A solver of a function of β, and the β that it has solved."""
    asked = []

    def solve(betas):
        asked.extend(betas)
        return {beta: {"f": (function(beta), error * abs(function(beta)))} for beta in betas}

    return solve, asked


def bend(beta):
    return beta**0.5 / (1 + (beta / 300) ** 2) ** 0.4


def kink(beta):
    return min(beta**0.5, 30 * beta**-0.25)


def sign(beta):
    return math.log(beta / 50)


@pytest.mark.parametrize(("function", "most"), [(lambda beta: 3 * beta**-0.44, 10), (bend, 25), (sign, 15)])
def test_values_lie_within_their_errors(function, most):
    solve, asked = solved(function)
    curve = place(solve, 2.0, 2e4, ["f"], 1e-3)["f"]
    beta = np.geomspace(2, 2e4, 997)
    value, error = curve(beta)
    exact = np.array([function(each) for each in beta])
    assert np.all(np.abs(value - exact) <= error + 1e-12 * np.abs(exact))
    assert len(asked) == len(set(asked)) <= most
    assert np.max(error / curve._scale.max()) < 1.5e-3


def test_a_kink_is_found_and_closed_in():
    """Where one minimum of a film takes over from another the curve is solved closely, and wrong in one interval only."""
    solve, asked = solved(kink)
    curve = place(solve, 2.0, 2e4, ["f"], 1e-3)["f"]
    beta = np.geomspace(2, 2e4, 997)
    exact = np.array([kink(each) for each in beta])
    off = np.abs(curve(beta)[0] / exact - 1)
    assert np.max(off) < 3e-3
    assert np.ptp(np.log(beta[off > 1e-3])) < np.log(10) / 16
    assert len(asked) < 50


@pytest.mark.parametrize("count", [7, 9, 15])
def test_what_a_spline_without_a_node_misses_bounds_what_it_misses_between_them(count):
    """Waves of any length and phase, sampled at few nodes."""
    nodes, fine = np.arange(count), np.linspace(0, count - 1, 40 * count)
    for length in (1, 2, 3, 4, 6, 10):
        for phase in np.linspace(0, 6, 13):
            wave = 1.5 + np.sin(nodes / length + phase)
            curve = Interpolant(np.exp(nodes), np.exp(wave), np.zeros(count), 1e-3)
            value, error = curve(np.exp(fine))
            exact = np.exp(1.5 + np.sin(fine / length + phase))
            assert np.all(np.abs(np.log(value / exact)) <= 0.6 * error / value + 1e-12)


def test_a_power_law_needs_the_first_places_only():
    solve, asked = solved(lambda beta: beta**-0.6)
    place(solve, 1.0, 1e4, ["f"], 1e-3)
    assert asked == first_places(1.0, 1e4)
    assert len(asked) == 9


def test_solutions_no_better_than_the_spline_are_not_refined():
    noise = iter(np.random.default_rng(2).normal(size=1000))
    solve, asked = solved(lambda beta: beta**-0.4 * (1 + 2e-3 * next(noise)), error=0.01)
    place(solve, 1.0, 1e4, ["f"], 1e-3)
    assert len(asked) == 9


def test_on_a_node_the_error_is_the_solution_s():
    solve, _ = solved(bend, error=0.01)
    curve = place(solve, 2.0, 2e4, ["f"], 1e-2)["f"]
    for node in curve.beta:
        value, error = curve(node)
        assert value == pytest.approx(bend(node), rel=1e-12)
        assert error == pytest.approx(0.01 * bend(node), rel=1e-9)
    assert curve(1.1 * curve.beta[3])[1] > 0.01 * bend(1.1 * curve.beta[3])


def test_without_solutions_at_one_end_the_curve_is_shorter():
    def solve(betas):
        return {beta: None if beta < 30 else {"f": (beta**0.5, 0.0)} for beta in betas}

    curve = place(solve, 1.0, 1e5, ["f"], 1e-3)["f"]
    assert 30 <= curve.beta[0] < 60
    assert place(lambda betas: dict.fromkeys(betas), 1.0, 1e5, ["f"], 1e-3) == {}


def test_places_do_not_depend_on_the_ends():
    inner = set(first_places(3.0, 3e4)[1:-1])
    assert inner <= set(first_places(1.7, 8e5))
    assert len(first_places(10.0, 10.5)) >= FEWEST
    for low, high in ((10.0, 11.0), (9.99, 1001.0), (1.0, 1.0001)):
        places = first_places(low, high)
        assert places[0] == low
        assert places[-1] == high
        assert np.all(np.diff(places) > 0)


def test_solutions_are_placed_where_the_curve_is_read():
    """Rows that are many are some of them solved; few of them all, and no more than these."""
    many, few = np.geomspace(2, 2e4, 61).tolist(), np.geomspace(2, 2e4, 7).tolist()
    for rows, most in ((many, 25), (few, 7)):
        solve, asked = solved(bend)
        curve = place(solve, 2.0, 2e4, ["f"], 1e-3, rows)["f"]
        assert set(asked) <= set(rows)
        assert len(asked) <= most
        value, error = curve(rows)
        exact = np.array([bend(row) for row in rows])
        assert np.all(np.abs(value - exact) <= error + 1e-12 * exact)
    assert set(asked) == set(few)
    np.testing.assert_allclose(value, exact, rtol=1e-12)
    solve, asked = solved(bend)
    place(solve, 2.0, 2e4, ["f"], 1e-3, [2.0, 77.0, 2e4])
    assert {2.0, 77.0, 2e4} <= set(asked)


def test_a_place_between_two_places():
    assert place_between(10.0, 1000.0) == pytest.approx(100.0)
    assert place_between(1.0, 10 ** (1.5 / PER_DECADE)) is None
