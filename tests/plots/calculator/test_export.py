"""What the page is given: the master curve's own numbers and the declarations' own words."""

import base64
import json

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from softlube.model.quantities import STEADY
from softlube.physical.inputs import declared
from softlube.plots.calculator.export import FIRST, INPUTS, exported, power_terms
from softlube.theory import master_curve
from softlube.theory.scaling import asymptote


@pytest.fixture(scope="module")
def data():
    return exported()


def test_it_is_plain_json(data):
    assert json.loads(json.dumps(data, allow_nan=False)).keys() == data.keys()


def test_inputs_are_the_declared_ones(data):
    assert tuple(data["inputs"]) == INPUTS
    for name, each in data["inputs"].items():
        assert each["expected"] == declared()[name].expected
        if each["slider"]:
            low, high = each["slider"]
            assert low < declared()[name].read(declared()[name].example) < high
    assert data["first"] == {name: declared()[name].example for name in FIRST}


@pytest.mark.parametrize("family", ["reynolds load", "none indentation"])
def test_knots_values_and_slopes_make_the_same_spline(data, family):
    cavitation, normalisation = family.split()
    exported = data["curve"]["families"][family]
    numbers = np.frombuffer(base64.b64decode(exported["numbers"])).reshape(-1, exported["knots"])
    x = numbers[0]
    places = np.linspace(x[0], x[-1], 1001)
    for k, name in enumerate(exported["names"]):
        curve = master_curve.curve(name, normalisation, cavitation)
        for spline, (value, slope) in zip(
            (curve.spline, curve.error), numbers[1 + 4 * k : 5 + 4 * k].reshape(2, 2, -1), strict=True
        ):
            np.testing.assert_allclose(CubicHermiteSpline(x, value, slope)(places), spline(places), rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_laws_are_sums_of_powers(cavitation):
    laws = {name: law for name in STEADY if (law := asymptote(name, cavitation)) is not None}
    assert len(laws) > 5
    beta = np.geomspace(1e8, 1e30, 23)
    for name, law in laws.items():
        if STEADY[name].limit is None:
            total = sum(factor * beta**power for factor, power in power_terms(law))
            np.testing.assert_allclose(total, law(beta), rtol=1e-12)
