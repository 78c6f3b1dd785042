"""One thread for the linear algebra, and as many as before afterwards."""

import time

import pytest
from threadpoolctl import ThreadpoolController

import softlube
from softlube.solvers.threads import one_thread


def threads():
    return [each["num_threads"] for each in ThreadpoolController().select(user_api="blas").info()]


@pytest.fixture
def _two_threads():
    with ThreadpoolController().limit(limits=2, user_api="blas"):
        yield


@pytest.mark.usefixtures("_two_threads")
def test_one_thread_within_and_two_after():
    within = one_thread(lambda: [*one_thread(threads)(), *threads()])()
    assert len(within) >= 2
    assert set(within) == {1}
    assert set(threads()) == {2}


@pytest.mark.usefixtures("_two_threads")
def test_an_error_restores_them():
    with pytest.raises(ZeroDivisionError):
        one_thread(lambda: 1 / 0)()
    assert set(threads()) == {2}


@pytest.mark.usefixtures("_two_threads")
def test_a_solution_has_one_whoever_asks_for_it():
    during = []
    softlube.solve(beta=30.0, accuracy=0.05, progress=lambda _: during.extend(threads()))
    assert set(during) == {1}
    assert set(threads()) == {2}


def test_it_costs_next_to_nothing():
    nothing = one_thread(lambda: None)
    began = time.process_time()
    for _ in range(100):
        nothing()
    assert time.process_time() - began < 0.1  # a millisecond each
