"""Prony series through data that are known: terms that come back, and as few of them as there are."""

import numpy as np
import pytest

from softlube.experiments.moduli import Moduli
from softlube.experiments.prony import chosen, series_of

RELAXED, TERMS = 3e6, ((4e6, 2e-4), (1e6, 1e-2), (3e6, 1.0), (5e5, 1e2))


def oscillation(terms=TERMS, rows=41, noise=(0.0, 0.0), seed=0, low=1e-3, high=1e5):
    frequency, random = np.geomspace(low, high, rows), np.random.default_rng(seed)
    modulus = RELAXED + sum(weight * 1j * frequency * time / (1 + 1j * frequency * time) for weight, time in terms)
    scatter = [np.exp(each * random.standard_normal(rows)) for each in noise]
    return Moduli.from_arrays(
        frequency=frequency, storage_modulus=modulus.real * scatter[0], loss_modulus=modulus.imag * scatter[1]
    )


def step(creep, noise=0.0, rows=41):
    time, random = np.geomspace(1e-5, 1e4, rows), np.random.default_rng(1)
    scatter = np.exp(noise * random.standard_normal(rows))
    decay = [(weight, np.exp(-time / each)) for weight, each in TERMS]
    if creep:
        return Moduli.from_arrays(time=time, creep_compliance=scatter * (RELAXED + sum(w * (1 - d) for w, d in decay)))
    return Moduli.from_arrays(time=time, relaxation_modulus=scatter * (RELAXED + sum(w * d for w, d in decay)))


@pytest.mark.parametrize(
    "data", [oscillation(), step(creep=False), step(creep=True)], ids=["oscillation", "relaxation", "creep"]
)
def test_data_without_scatter_give_the_series_back(data):
    found = chosen(series_of(data))
    assert found.constant == pytest.approx(RELAXED, rel=1e-9)
    assert found.weights == pytest.approx([weight for weight, _ in TERMS], rel=1e-8)
    assert found.times == pytest.approx([time for _, time in TERMS], rel=1e-8)
    assert max(found.scatter.values()) < 1e-9


def test_number_of_times_is_found_through_scatter():
    """Of twelve tests with scatter at least ten give the four times, neither fewer nor more, near where they are."""
    right = 0
    for seed in range(12):
        found = chosen(series_of(oscillation(noise=(0.01, 0.03), seed=seed)))
        if found.times.size == len(TERMS):
            right += 1
            assert found.times == pytest.approx([time for _, time in TERMS], rel=0.25)
            assert found.scatter["storage_modulus"] < found.scatter["loss_modulus"] < 0.05
    assert right >= 10


def test_a_power_law_is_met_to_its_scatter():
    """E* = E (1 + (iωτ)^½) has no times of its own: as many are taken as the scatter asks for, a few each two decades."""
    frequency = np.geomspace(1e-2, 1e4, 61)
    modulus = 1e6 * (1 + (1j * frequency * 1e-3) ** 0.5)
    exact = chosen(series_of(Moduli.from_arrays(frequency=frequency, storage_modulus=modulus.real, loss_modulus=modulus.imag)))
    assert max(exact.scatter.values()) < 1e-3
    random = np.random.default_rng(0)
    storage, loss = (part * np.exp(0.02 * random.standard_normal(61)) for part in (modulus.real, modulus.imag))
    found = chosen(series_of(Moduli.from_arrays(frequency=frequency, storage_modulus=storage, loss_modulus=loss)))
    assert 6 <= found.times.size < exact.times.size <= 15
    assert max(found.scatter.values()) < 0.025
    assert found.constant == pytest.approx(1e6, rel=0.02)


def test_each_number_of_times_has_a_series_and_more_times_miss_less():
    found = series_of(oscillation(noise=(0.01, 0.01)))
    assert [each.times.size for each in found] == list(range(len(found)))[::-1]
    scatter = [each.scatter["storage_modulus"] for each in found if 0 < each.times.size <= len(TERMS)]
    assert scatter == sorted(scatter)


def test_weights_are_not_negative():
    """A loss modulus that falls faster than any series can follow: the misfit is told, no weight is negative."""
    frequency = np.geomspace(1e-2, 1e2, 21)
    data = Moduli.from_arrays(
        frequency=frequency, storage_modulus=1e6 + 0 * frequency, loss_modulus=1e5 * np.exp(-(np.log(frequency) ** 2))
    )
    found = chosen(series_of(data))
    assert np.all(found.weights > 0)
    assert found.scatter["loss_modulus"] > 0.1
