"""Outcomes, and what every kind of task and case promises."""

import json
import pickle

import pytest

from softlube.sweeps.plan import make_plan
from softlube.sweeps.tasks import Outcome
from softlube.sweeps.work import ROOMS

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "load": "100 mN"}
FALL = {"initial_height": "20 um", "duration": "10 ms"}
PLANS = {
    "steady": ("steady", BALL | {"speed": "0.1 mm/s"}),
    "squeeze": ("squeeze", BALL | FALL),
    "sliding": ("squeeze", BALL | FALL | {"speed": "0.1 mm/s"}),
}


def test_an_outcome_with_a_reason_has_failed():
    assert Outcome("too light").failed
    assert not Outcome(quantities={"film_min": (0.1, 1e-3)}).failed


@pytest.mark.parametrize("kind", PLANS)
def test_every_task_travels_and_has_plain_values(kind):
    """It goes to workers and into keys: the copy is equal, its values are JSON, and nothing of another case is in them."""
    motion, parameters = PLANS[kind]
    first, second = make_plan(parameters | {"viscosity": ["2 Pa s", "3 Pa s"]}, motion=motion).cases
    task = first.task
    assert task.kind == kind
    assert task.kind in ROOMS
    assert pickle.loads(pickle.dumps(task)) == task
    plain = json.loads(json.dumps(task.to_plain()))
    assert plain == json.loads(json.dumps(pickle.loads(pickle.dumps(task)).to_plain()))
    assert all(isinstance(number, float) for number in task.place)
    assert (plain == second.task.to_plain()) == (task == second.task)


@pytest.mark.parametrize("kind", PLANS)
def test_inputs_are_those_of_the_plan_in_si(kind):
    motion, parameters = PLANS[kind]
    (case,) = make_plan(parameters, motion=motion).cases
    assert case.inputs["radius"] == pytest.approx(2e-3)
    assert set(case.inputs) == set(parameters)
