"""A budget ends Newton's method wherever it runs, and only within its block."""

import time

import numpy as np
import pytest

from softlube.solvers import budget
from softlube.solvers.newton import newton


class Endless:
    """x² + 1 = 0, which has no root: Newton's method goes on and on."""

    constrained = np.array([False])

    def linearise(self, x):
        raise AssertionError("not reached")


def burn(seconds):
    end = time.thread_time() + seconds
    while time.thread_time() < end:
        pass


def test_the_budget_is_asked_before_every_step():
    with budget.within(0.005):
        burn(0.01)
        with pytest.raises(budget.OutOfTime):
            newton(Endless(), np.zeros(1))


def test_the_nearest_end_counts_and_only_within_the_block():
    with budget.within(0.005):
        burn(0.01)
        with pytest.raises(budget.OutOfTime), budget.within(100.0):
            budget.check()
    budget.check()
    with budget.within(100.0):
        budget.check()
        with pytest.raises(budget.OutOfTime):
            budget.check(ahead=200.0)
