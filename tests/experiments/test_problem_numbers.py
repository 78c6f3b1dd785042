"""Numbers of a normalised problem, and what parameters do to them."""

import math

import numpy as np
import pytest

import softlube
from softlube.experiments.problem_numbers import moved, nodes_around, numbers_of, powers, with_numbers

TIME, INDEX, SECOND = ("liquid", "time"), ("liquid", "index"), ("liquid", "infinite")


def numbers(load=0.1, **changed):
    carreau = {"viscosity": 2.0, "infinite_viscosity": 0.02, "relaxation_time": 0.01, "index": 0.5, "viscosity_law": "carreau"}
    contact = softlube.Contact(radius=2e-3, young_modulus=3e6, speed=1e-3, load=load, **(carreau | changed))
    return numbers_of(contact.problem())


def test_numbers_of_a_liquid_and_how_they_go_with_the_load():
    """The time is one over the rate at which stress grows, G δ/(R η): δ goes with the load to the power 2/3."""
    found = numbers()
    assert {TIME, INDEX, SECOND} <= found.keys()
    assert found[INDEX] == 0.5
    assert found[SECOND] == pytest.approx(0.01)
    power = powers(found, numbers(0.1 * math.e))
    assert power[TIME] == pytest.approx(2 / 3)
    assert power[INDEX] == power[SECOND] == 0


def test_a_relaxation_time_acts_like_the_load():
    before = numbers()
    factor, apart = moved(numbers(relaxation_time=0.02), before, powers(before, numbers(0.1 * math.e)))
    assert factor == pytest.approx(2**1.5)
    assert apart == {}
    assert numbers(relaxation_time=0.02) == pytest.approx(numbers(0.1 * 2**1.5))


@pytest.mark.parametrize(
    "memory", [{"stiffening": 3.0, "substrate_relaxation_time": 0.1}, {"prony": "6 MPa @ 0.1 s; 1 MPa @ 2 s"}]
)
def test_what_a_substrate_remembers_goes_like_its_times_and_the_load_over_the_viscosity(memory):
    """At β = 1 the speed is (2π/3) G δ²/(ηR), so the length over √(Rδ) goes like τGδ^1.5/η, and δ^1.5 like the load."""

    def of(load=0.1, viscosity=2.0, speed=1e-3, **changed):
        return numbers_of(
            softlube.Contact(
                radius=2e-3, young_modulus=3e6, load=load, viscosity=viscosity, speed=speed, **(memory | changed)
            ).problem()
        )

    before, power = of(), powers(of(), of(0.1 * math.e))
    lengths = [path for path in before if path[:2] == ("substrate", "lengths")]
    assert len(lengths) == (1 if "stiffening" in memory else 2)
    assert [power[path] for path in lengths] == pytest.approx([1] * len(lengths))
    assert of(speed=2e-3) == pytest.approx(before)
    factor, apart = moved(of(viscosity=4.0), before, power)
    assert factor == pytest.approx(0.5)
    assert apart == {}
    if "stiffening" in memory:
        factor, apart = moved(of(substrate_relaxation_time=0.3), before, power)
        assert factor == pytest.approx(3)
        assert apart == {}


def test_index_and_viscosity_change_numbers_that_no_load_changes():
    before = numbers()
    power = powers(before, numbers(0.1 * math.e))
    assert moved(numbers(index=0.6), before, power) == (pytest.approx(1), {INDEX: 0.6})
    factor, apart = moved(numbers(viscosity=4.0), before, power)  # the stress at the rate 1/λ doubles
    assert factor == pytest.approx(2**-1.5)
    assert apart == {SECOND: pytest.approx(0.005)}


def test_no_load_does_two_things_at_once():
    """A layer twice as thick and a pressure coefficient twice as large."""

    def of(load=0.1, thickness=1e-3, pressure_viscosity=2e-8):
        contact = softlube.Contact(
            radius=2e-3, young_modulus=3e6, viscosity=2.0, speed=1e-3, load=load, thickness=thickness,
            pressure_viscosity=pressure_viscosity,
        )  # fmt: skip
        return numbers_of(contact.problem())

    power = powers(of(), of(0.1 * math.e))
    assert moved(of(thickness=2e-3), of(), power)[0] is None
    assert moved(of(pressure_viscosity=4e-8), of(), power)[0] is None


def test_a_problem_with_other_numbers():
    problem = softlube.Contact(
        radius=2e-3, young_modulus=3e6, speed=1e-3, load=0.1, viscosity=2.0, relaxation_time=0.01, index=0.5
    ).problem()
    other = with_numbers(problem, {INDEX: 0.7})
    assert other.liquid.index == 0.7
    assert with_numbers(other, {INDEX: 0.5}) == problem
    assert with_numbers(problem, {}) is problem


def test_nodes():
    nodes = nodes_around(("liquid", "transition"), 1.03)
    assert nodes[0] < 1.03 / 1.3
    assert nodes[-1] > 1.03 * 1.3
    assert np.all(np.diff(nodes) > 0)
    assert nodes_around(("liquid", "transition"), 1.01) == pytest.approx(nodes)  # found again
    assert nodes_around(INDEX, 0.9)[-1] == 1.0
