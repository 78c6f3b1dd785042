"""Liquids from flow curves: parameters that are known, intervals that hold them, and what the data cannot tell."""

import json

import numpy as np
import pytest

import softlube
from softlube.errors import InputError
from softlube.experiments.flow_curve import CANDIDATES, FlowCurve
from softlube.experiments.rheometer import fit_liquid

BY_WORDS = {each.words: each for each in CANDIDATES}
CARREAU = {"viscosity": 2.0, "relaxation_time": 0.3, "index": 0.5}


def measured(words, values, low, high, rows, seed=0, noise=0.03):
    rate = np.geomspace(low, high, rows)
    scatter = np.exp(noise * np.random.default_rng(seed).standard_normal(rows))
    return FlowCurve.from_arrays(rate, BY_WORDS[words].viscosity(rate, values) * scatter)


@pytest.mark.parametrize(
    ("words", "values", "low", "high"),
    [
        ("newtonian", {"viscosity": 2.0}, 0.1, 100),
        ("power-law", {"consistency": 3.0, "index": 0.6}, 0.1, 100),
        ("carreau", CARREAU, 0.01, 1e3),
        ("carreau with a second plateau", CARREAU | {"infinite_viscosity": 0.01}, 0.01, 1e6),
        ("cross", CARREAU, 0.01, 1e3),
        ("cross with a second plateau", CARREAU | {"infinite_viscosity": 0.01}, 0.01, 1e7),
        ("carreau-yasuda", CARREAU | {"transition": 0.9}, 1e-3, 1e4),
    ],
)
def test_data_without_scatter_give_law_and_parameters_back(words, values, low, high):
    found = fit_liquid(measured(words, values, low, high, 41, noise=0.0))
    assert found.model.candidate.words == words
    assert dict(found.values) == pytest.approx(values, rel=1e-5)
    assert found.scatter < 1e-5


def test_the_law_is_chosen_through_scatter():
    """Cross's and Carreau's laws are told apart, and a second plateau is not seen where there is none."""
    for words in ("carreau", "cross"):
        chosen = [fit_liquid(measured(words, CARREAU, 0.01, 1e3, 31, seed)).model.candidate.words for seed in range(6)]
        assert chosen.count(words) >= 5, chosen


@pytest.mark.slow
def test_intervals_hold_the_parameters():
    """Of 60 flow curves with 3 % scatter 95 % intervals hold each of the true values in at least 90 %."""
    held = dict.fromkeys(CARREAU, 0)
    for seed in range(60):
        found = fit_liquid(measured("carreau", CARREAU, 0.01, 1e3, 25, seed), law="carreau", second_plateau=False)
        for name, each in found.estimates.items():
            held[name] += each.low <= CARREAU[name] <= each.high
    assert min(held.values()) >= 54, held


def test_what_is_printed_is_one_liquid():
    found = fit_liquid(measured("carreau", CARREAU | {"infinite_viscosity": 0.01}, 0.01, 1e5, 31), law="carreau")
    assert eval(found.python, {"softlube": softlube}) == found.liquid
    assert isinstance(found.liquid, softlube.Carreau)
    assert found.liquid.viscosity == pytest.approx(found.values["viscosity"], rel=1e-3)
    words = found.options.split(" --")
    assert words[0] == "--viscosity-law carreau"
    assert [each.split()[0] for each in words[1:]] == ["viscosity", "infinite-viscosity", "relaxation-time", "index"]


def test_a_power_law_is_pasted_with_its_unit():
    found = fit_liquid(measured("power-law", {"consistency": 3.0, "index": 0.6}, 0.1, 100, 21))
    assert eval(found.python, {"softlube": softlube}) == found.liquid


def test_time_and_index_that_cannot_be_told_apart():
    """The liquid has only begun to thin at the highest rate: its time and its index are told together."""
    found = fit_liquid(measured("carreau", CARREAU, 0.01, 5, 21, seed=3), law="carreau", second_plateau=False)
    assert not found.estimates["index"].determined
    assert any("relaxation_time and index cannot be told apart" in each for each in found.verdicts)
    assert any("measure higher shear rates" in each for each in found.verdicts)


def test_no_plateau_is_said():
    """On the power law alone viscosity and time act as one number."""
    found = fit_liquid(measured("carreau", CARREAU, 100, 1e4, 21), law="carreau", second_plateau=False)
    assert any("viscosity and relaxation_time cannot be told apart" in each for each in found.verdicts)
    assert fit_liquid(measured("carreau", CARREAU, 100, 1e4, 21)).model.candidate.words == "power-law"


def test_data_that_do_not_thin_tell_no_time():
    data = measured("newtonian", {"viscosity": 2.0}, 0.1, 100, 12)
    assert fit_liquid(data).model.candidate.words == "newtonian"
    with pytest.raises(InputError, match="do not tell relaxation_time and index of carreau"):
        fit_liquid(data, law="carreau", second_plateau=False)


def test_residuals_in_order_are_told():
    """A law that is asked for and does not fit."""
    found = fit_liquid(measured("cross", CARREAU, 0.001, 1e4, 61, noise=0.01), law="carreau", second_plateau=False)
    assert any("ordered along the shear rate" in each for each in found.verdicts)


def test_objects_show_themselves():
    found = fit_liquid(measured("carreau", CARREAU, 0.01, 1e3, 31), law="carreau", second_plateau=False)
    assert "carreau, viscosity" in repr(found)
    assert "relaxation time" in str(found.summary())
    assert list(found.to_dataframe().index) == list(found.estimates)
    plain = json.loads(json.dumps(found.to_dict(), allow_nan=False))
    assert plain["law"] == "carreau"
    assert plain["laws"][0] == {"law": "carreau", "scatter": found.scatter, "criterion": 0.0}


@pytest.mark.parametrize(
    ("rows", "arguments", "fragment"),
    [
        (4, {}, "4 rows"),
        (7, {"law": "carreau-yasuda", "second_plateau": True}, "too few for the 5 parameters"),
        (9, {"law": "bingham"}, "law: expected one of newtonian, power-law, carreau"),
        (9, {"law": "power-law", "second_plateau": True}, "has no second plateau"),
        (9, {"confidence": 2}, "confidence"),
    ],
)
def test_refusals(rows, arguments, fragment):
    with pytest.raises(InputError) as error:
        fit_liquid(measured("carreau", CARREAU, 0.01, 1e3, rows), **arguments)
    assert fragment in str(error.value)


def test_rates_that_hardly_differ_are_refused():
    with pytest.raises(InputError, match="tell no law"):
        fit_liquid(measured("carreau", CARREAU, 1, 1.5, 20))
