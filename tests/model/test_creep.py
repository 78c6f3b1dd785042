"""Creep from relaxation and back, exactly."""

import numpy as np
import pytest

from softlube.model.creep import ELASTIC, Creep, Term, creep_of, relaxation_of


@pytest.mark.parametrize("n", [1, 2, 7, 30])
def test_creep_is_the_inverse_of_relaxation(n):
    """At every frequency the complex modulus times the complex compliance is 1, over ten decades of times."""
    random = np.random.default_rng(n)
    times, moduli = np.sort(10 ** random.uniform(-5, 5, n)), 10 ** random.uniform(-3, 3, n)
    creep = creep_of(0.5, zip(moduli, times, strict=True))
    retarded, weights = (np.array([getattr(term, name) for term in creep.terms]) for name in ("time", "weight"))
    assert np.all(weights > 0)
    assert np.all(retarded > times)
    assert np.all(retarded[:-1] < times[1:])
    frequency = 1j * np.logspace(-8, 8, 33)[:, None]
    modulus = 0.5 + np.sum(moduli * frequency * times / (1 + frequency * times), axis=1)
    compliance = creep.instantaneous + np.sum(weights / (1 + frequency * retarded), axis=1)
    assert modulus * compliance == pytest.approx(1, abs=1e-13)
    assert creep.relaxed == pytest.approx(2, rel=1e-14)


def test_one_time():
    """E = E_r + E₁ e^(−t/τ): J₁ = E₁/(E_r (E_r + E₁)), and creep is slower than relaxation by (E_r + E₁)/E_r."""
    creep = creep_of(2.0, [(6.0, 3.0)])
    assert creep.instantaneous == pytest.approx(1 / 8)
    assert creep.terms[0] == pytest.approx((6 / 16, 12.0))


@pytest.mark.parametrize("n", [1, 2, 7, 30])
def test_relaxation_is_the_inverse_of_creep(n):
    random = np.random.default_rng(n)
    times, moduli = np.sort(10 ** random.uniform(-5, 5, n)), 10 ** random.uniform(-3, 3, n)
    relaxed, terms = relaxation_of(creep_of(0.5, zip(moduli, times, strict=True)))
    assert relaxed == pytest.approx(0.5, rel=1e-12)
    assert [term.time for term in terms] == pytest.approx(times, rel=1e-9)
    assert [term.weight for term in terms] == pytest.approx(moduli, rel=1e-6)
    assert relaxation_of(Creep(0.25, ())) == (4.0, ())
    assert relaxation_of(Creep(1 / 8, (Term(6 / 16, 12.0),))) == (2.0, (pytest.approx((6.0, 3.0)),))  # as in `test_one_time`


def test_equal_times_are_one():
    split, whole = (creep_of(1.0, terms) for terms in ([(1.0, 2.0), (2.0, 2.0), (1.0, 5.0)], [(1.0, 5.0), (3.0, 2.0)]))
    assert split == whole
    nearly = creep_of(1.0, [(1.0, 2.0), (2.0, 2.0 * (1 + 1e-14)), (1.0, 5.0)])
    assert nearly.terms[0].weight < 1e-13  # between the two poles
    for one, other in zip(nearly.terms[1:], whole.terms, strict=True):
        assert one == pytest.approx(other, rel=1e-12)


def test_a_vanishing_term_changes_nothing():
    creep = creep_of(1.0, [(9.0, 1.0), (1e-40, 2.0)])
    assert [term.weight for term in creep.terms] == pytest.approx([0.0, 0.9], abs=1e-14)


def test_an_elastic_solid_yields_at_once():
    assert creep_of(1.0, []) == ELASTIC
    assert ELASTIC.relaxed == ELASTIC.instantaneous == 1
