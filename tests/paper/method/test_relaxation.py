"""Relaxation sweeps: the first guess, the path in β, the control of the factor, refusals."""

import itertools

import numpy as np
import pytest

import softlube
from softlube.model.exact import HERTZ_PRESSURE
from softlube.paper.method import RelaxationError, march_relaxation
from softlube.paper.method.mesh import PaperMesh
from softlube.paper.method.polar import PolarScheme
from softlube.paper.method.relaxation import CUT, FIRST_FACTOR, GUESS_RADIUS, approach, first_guess, remaining_error


@pytest.fixture(scope="module")
def march():
    """The published mesh, β = 10 … 1000 in one march."""
    return {solution.beta: solution for solution in march_relaxation([10, 30, 100, 300, 1000])}


def test_the_first_guess_is_continuously_differentiable_and_lifts_the_sphere():
    r = np.linspace(0, 2, 20001)
    p = first_guess(r)
    assert p[0] == HERTZ_PRESSURE
    assert np.all(p[r >= GUESS_RADIUS] == 0)
    slope = np.diff(p) / np.diff(r)
    assert abs(slope[0]) < 1e-6
    assert np.abs(np.diff(slope)).max() < 1e-4
    scheme = PolarScheme(PaperMesh())
    assert scheme.film(scheme.guess()).min() > 0.1


def test_remaining_error_sums_the_geometric_tail():
    rate, n = 0.99, 200
    changes = [0.3 * rate**k for k in range(n)]
    tail = 0.3 * rate**n / (1 - rate)
    assert remaining_error(changes) == pytest.approx(tail, rel=0.5)
    assert remaining_error(changes) > tail
    assert remaining_error([1e-12] * 300) == np.inf
    assert remaining_error([1e-12] * 10) == np.inf


@pytest.mark.parametrize("beta", [10, 11, 32, 100, 1234.5, 1e4])
def test_the_approach_goes_from_ten_in_bounded_steps(beta):
    betas = approach(beta)
    assert betas[0] == (10 if beta > 10 else beta)
    assert betas[-1] == pytest.approx(beta)
    assert all(1 < after / before < 3.3 for before, after in itertools.pairwise(betas))


def test_the_history_tells_of_sweeps_factors_and_restarts(march):
    history = [run for beta in sorted(march) for run in march[beta].levels[-1].history]
    assert history[0].factor == FIRST_FACTOR
    assert all(change > 0 for run in history for change in run.changes)
    for before, after in itertools.pairwise(history):
        assert after.factor == pytest.approx(before.factor * (1 if before.outcome == "converged" else CUT))
    assert [run.beta for run in history if run.outcome == "converged"] == [10, 30, 100, 300, 1000]
    assert "converged" in str(history[-1])
    assert history[-1].summary()["sweeps"] == len(history[-1].changes)
    assert history[-1].summary()["last_change"] == history[-1].changes[-1]
    # A large β needs a small factor: cuts have happened.
    assert history[-1].factor < 0.5


def test_sweeps_that_run_out_are_a_failure():
    scheme = PolarScheme(PaperMesh(24, 12))
    marching = softlube.paper.method.relaxation.march(scheme, scheme.guess(), [10.0], max_sweeps=20)
    with pytest.raises(RelaxationError, match="20 sweeps") as caught:
        next(marching)
    assert caught.value.history[-1].outcome == "stopped"
    assert caught.value.history[-1].count == 20
