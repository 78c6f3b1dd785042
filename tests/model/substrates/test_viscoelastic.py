"""Prony series: what is read and kept, and the lengths or times that a surface remembers over."""

import json

import numpy as np
import pytest

from softlube.errors import InputError
from softlube.model.creep import ELASTIC, Creep
from softlube.model.inputs import declared
from softlube.model.parts import resolve
from softlube.model.problem import Problem
from softlube.model.substrates import (
    CreepingKernel,
    HalfSpace,
    HalfSpaceKernel,
    LayerKernel,
    StandardLinearSolid,
    Viscoelastic,
    ViscoelasticKernel,
    from_plain,
    to_plain,
)


def test_what_is_given_and_kept():
    part = Viscoelastic("3 MPa", prony=[("9 MPa", "1 ms"), (6e6, 1e-5)])
    assert part.prony == "2 MPa @ 10 µs; 3 MPa @ 1 ms"  # of the shear modulus, which is kept
    assert part.shear_modulus == 1e6
    assert part == Viscoelastic(shear_modulus="1 MPa", prony="3 MPa@1 ms; 2 MPa @ 10 us")
    assert part.creep.relaxed == pytest.approx(1)
    assert part.creep.instantaneous == pytest.approx(1 / 6)
    assert resolve(["substrate"], part.flat())["substrate"] == part
    assert declared()["prony"].is_text


def test_text_keeps_every_digit():
    part = Viscoelastic(1e6, prony=[(1e6 / 7, np.pi * 1e-3)])
    assert resolve(["substrate"], part.flat())["substrate"] == part
    assert part.terms[0] == pytest.approx((1e6 / 21, np.pi * 1e-3), rel=1e-15)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("9 MPa", "expected pairs of a modulus and a time such as"),
        ([], "expected pairs of a modulus and a time"),
        (3.0, "expected pairs of a modulus and a time"),
        ([("9 MPa", "1 ms", "2")], "expected pairs of a modulus and a time"),
        ("9 MPa @ 1 mm", "1 mm has the wrong dimension; expected a time such as '1 ms'"),
        ("-9 MPa @ 1 ms", "expected a positive, finite quantity, a pressure such as '9 MPa'"),
        ([("9 MPa", "1 ms")] * 101, "101 terms; 100 are the most"),
    ],
)
def test_what_is_no_series_is_refused(given, message):
    with pytest.raises(InputError, match=f"prony: {message}|prony: .*{message}"):
        Viscoelastic("3 MPa", prony=given)


def test_a_standard_linear_solid_is_a_series_of_one():
    named = StandardLinearSolid("3 MPa", stiffening=4, relaxation_time="1 ms")
    assert named.creep == Viscoelastic("3 MPa", prony=[("9 MPa", "1 ms")]).creep
    with pytest.raises(InputError, match="stiffening: expected a number above 1, got 1"):
        StandardLinearSolid("3 MPa", stiffening=1, relaxation_time="1 ms")


def test_the_substrate_is_chosen_by_its_inputs():
    by_series = resolve(["substrate"], {"young_modulus": "3 MPa", "prony": "9 MPa @ 1 ms"})["substrate"]
    inputs = {"young_modulus": "3 MPa", "stiffening": 4, "substrate_relaxation_time": "1 ms"}
    named = resolve(["substrate"], inputs)["substrate"]
    assert (type(by_series), type(named)) == (Viscoelastic, StandardLinearSolid)
    with pytest.raises(InputError, match="prony, stiffening: no substrate has both"):
        resolve(["substrate"], inputs | {"prony": "9 MPa @ 1 ms"})


def test_the_kernel_remembers_over_speed_times_time():
    kernel = StandardLinearSolid("3 MPa", stiffening=10, relaxation_time="1 ms").kernel(1e-3, 0.5, 2.0)
    assert kernel.shares == pytest.approx((0.45,))  # half of the compliance is an elastic ball's
    assert kernel.lengths == pytest.approx((2.0 * 10e-3 / 1e-3,))
    assert kernel.instantaneous == pytest.approx(0.55)
    assert kernel.in_units(4.0).lengths == pytest.approx((10.0,))
    assert kernel.elastic == HalfSpaceKernel()
    assert kernel.compliance(1e-9) == pytest.approx(0.55)
    assert kernel.compliance(1e9) == pytest.approx(1)
    assert from_plain(json.loads(json.dumps(to_plain(kernel)))) == kernel
    problem = Problem(beta=10.0, substrate=kernel)
    assert Problem.from_plain(json.loads(json.dumps(problem.to_plain()))) == problem


def test_under_a_film_that_changes_with_time_the_kernel_remembers_over_times():
    part = StandardLinearSolid("3 MPa", stiffening=10, relaxation_time="1 ms")
    kernel = part.kernel(1e-3, 0.5, time_unit=0.1)
    assert isinstance(kernel, CreepingKernel)
    assert kernel.shares == pytest.approx((0.45,))  # half of the compliance is an elastic ball's
    assert kernel.times == pytest.approx((0.1,))
    assert kernel.elastic == HalfSpaceKernel()
    assert kernel.creep == Creep(kernel.instantaneous, ((kernel.shares[0], kernel.times[0]),))
    assert kernel.in_units(4.0).times == pytest.approx((0.8,))  # the time of a film goes like the height to 3/2
    layer = Viscoelastic("3 MPa", prony="6 MPa @ 0.2 s", thickness="1 mm").kernel(1e-3)
    assert layer.elastic == LayerKernel(1.0)
    assert from_plain(json.loads(json.dumps(to_plain(layer)))) == layer


def test_equal_times_are_one_and_none_is_none():
    creep = CreepingKernel((0.1, 0.2, 0.3, 0.25), (3.0, 1.0, 3.0, 0.0)).creep
    assert creep.instantaneous == pytest.approx(0.4)
    assert [tuple(term) for term in creep.terms] == [(0.2, 1.0), (pytest.approx(0.4), 3.0)]
    assert LayerKernel(1.0).creep == ELASTIC


def test_lengths_are_no_times():
    with pytest.raises(InputError, match=r"substrate: under a film that changes with time .* over times, a CreepingKernel"):
        _ = ViscoelasticKernel((0.5,), (1.0,)).creep
    with pytest.raises(InputError, match=r"substrate: under steady sliding .* over lengths, a ViscoelasticKernel"):
        _ = CreepingKernel((0.5,), (1.0,)).memory


def test_a_substrate_at_rest_under_the_contact_is_relaxed():
    part = StandardLinearSolid("3 MPa", stiffening=10, relaxation_time="1 ms")
    assert part.kernel(1e-3, 1.0, 0.0).memory is None
    assert HalfSpace("3 MPa").kernel(1e-3, 1.0, 1.0).memory is None
    assert HalfSpaceKernel().compliance(1.0) == 1
    with pytest.raises(InputError, match="slide_to_roll: below -2"):
        part.kernel(1e-3, 1.0, -1.0)


@pytest.mark.parametrize(
    ("shares", "lengths", "message"),
    [
        ((0.5,), (), "shares, lengths: expected as many of each, got 1 and 0"),
        ((0.5, 0.5), (1, 2), "shares: expected positive numbers with a sum below 1"),
        ((-0.5,), (1,), "shares: expected positive numbers"),
        ((0.5,), (np.inf,), "lengths: expected finite numbers"),
    ],
)
def test_kernels_that_cannot_be(shares, lengths, message):
    with pytest.raises(InputError, match=message):
        ViscoelasticKernel(shares, lengths)
    with pytest.raises(InputError, match=message.replace("lengths", "times")):
        CreepingKernel(shares, lengths)


def test_a_layer_remembers_like_a_half_space():
    given = {"young_modulus": "3 MPa", "prony": "6 MPa @ 0.2 s", "thickness": "1 mm", "base": "frictionless"}
    part = resolve(("substrate",), given)["substrate"]
    assert isinstance(part, Viscoelastic)
    kernel = part.kernel(1e-3, speed=0.01)
    assert kernel.elastic == LayerKernel(1.0, 0.5, "frictionless")
    assert kernel.lengths == Viscoelastic("3 MPa", prony="6 MPa @ 0.2 s").kernel(1e-3, speed=0.01).lengths
    assert kernel.in_units(4.0).elastic.thickness == 0.5
    assert from_plain(json.loads(json.dumps(to_plain(kernel)))) == kernel
    assert from_plain({"kind": "viscoelastic", "shares": [0.5], "lengths": [1.0]}).elastic == HalfSpaceKernel()


def test_layers_that_cannot_be():
    series = {"young_modulus": "3 MPa", "prony": "6 MPa @ 0.2 s"}
    with pytest.raises(InputError, match="base, thickness: 'frictionless' means nothing without a thickness"):
        Viscoelastic(**series, base="frictionless")
    with pytest.raises(InputError, match="fills the ball"):
        Viscoelastic(**series, thickness="5 mm", radius="4 mm")
    with pytest.raises(InputError, match="an elastic ball on a layer that remembers is not solved"):
        Viscoelastic(**series, thickness="1 mm").kernel(1e-3, 0.5, 0.01)
